// `cotan cost` where there is no Vulkan to ask: it takes any words and says what is missing.
#include "commands.hpp"
#include "cotan/not_built.hpp"

namespace cotan::app {

void addCostCommand(Arguments& tool)
{
    Arguments command = tool.command("cost", "Measure what each frame costs. Not in this build: needs Vulkan.");
    command.takesAnything();
    command.does([]() -> Status { return notBuiltWith("Vulkan", "libvulkan-dev and glslang-tools"); });
}

} // namespace cotan::app
