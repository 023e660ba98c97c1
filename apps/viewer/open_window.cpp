#include <cstring>

#include "core/not_built.hpp"
#include "files/module.hpp"
#include "window.hpp"

namespace cotan::viewer {

#ifdef COTAN_MODULE_NAME
Result<std::unique_ptr<Window>> openWindow(const WindowOptions& options)
{
    const auto module = loadModule(
        {COTAN_MODULE_NAME, COTAN_MODULE_SUBFOLDER, COTAN_MODULE_INSTALLED, COTAN_MODULE_BUILT}, "cotanWindowModule",
        [](const void* offered) {
            return std::strcmp(static_cast<const WindowModule*>(offered)->version, COTAN_MODULE_VERSION) == 0;
        },
        "view");
    if (!module)
        return module.error();
    return static_cast<const WindowModule*>(*module)->open(options);
}
#elif defined(COTAN_WINDOW_LINKED)
extern "C" const void* cotanWindowModule();

Result<std::unique_ptr<Window>> openWindow(const WindowOptions& options)
{
    return static_cast<const WindowModule*>(cotanWindowModule())->open(options);
}
#else
Result<std::unique_ptr<Window>> openWindow(const WindowOptions&)
{
    return notBuiltWith("GLFW, Dear ImGui and Vulkan", "libglfw3-dev, libimgui-dev, libvulkan-dev and glslang-tools");
}
#endif

} // namespace cotan::viewer
