#include "formats.hpp"

#include <cstring>

#include "core/not_built.hpp"
#include "files/module.hpp"
#include "image/format_table.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

#ifdef COTAN_MODULE_NAME
constexpr bool kBuilt = true;

Result<const ImageFormats*> loadFormats()
{
    const auto offered = loadModule(
        {COTAN_MODULE_NAME, COTAN_MODULE_SUBFOLDER, COTAN_MODULE_INSTALLED, COTAN_MODULE_BUILT}, "cotanImageFormats",
        [](const void* formats) {
            return std::strcmp(static_cast<const ImageFormats*>(formats)->version, COTAN_MODULE_VERSION) == 0;
        },
        "this image format");
    if (!offered)
        return offered.error();
    return static_cast<const ImageFormats*>(*offered);
}
#elif defined(COTAN_FORMATS_LINKED)
constexpr bool kBuilt = true;

Result<const ImageFormats*> loadFormats() { return static_cast<const ImageFormats*>(cotanImageFormats()); }
#else
constexpr bool kBuilt = false;

Result<const ImageFormats*> loadFormats()
{
    return notBuiltWith("OpenImageIO, which reads and writes this image format",
                        "libopenimageio-dev and openimageio-tools");
}
#endif

} // namespace

bool readsOtherFormats() { return kBuilt; }

Result<const ImageFormats*> imageFormats(const std::string& name)
{
    static const Result<const ImageFormats*> formats = loadFormats();
    if (!formats)
        return reworded(formats.error(), name + ": " + formats.error().message);
    return formats;
}

Result<Image> readOther(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const auto formats = imageFormats(name);
    return formats ? (*formats)->read(bytes, name, limits) : formats.error();
}

bool writesItself(const fs::path& file)
{
    const ImageFormat* const format = imageFormatOf(file);
    return format && format->writes && format->openImageIo.empty();
}

} // namespace cotan
