#include "formats.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "cotan/files/extension.hpp"
#include "cotan/files/module.hpp"
#include "cotan/not_built.hpp"
#include "format_starts.hpp"

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

Result<const ImageFormats*> imageFormats()
{
    static const Result<const ImageFormats*> formats = loadFormats();
    return formats;
}

bool knownImage(std::span<const std::byte> bytes, const std::string& name)
{
    return formatStart(bytes) || (lowerExtension(name) == ".tga" && !bytes.empty());
}

bool writableImage(const fs::path& file)
{
    constexpr std::array<std::string_view, 8> kExtensions = {".png", ".exr", ".tif",  ".tiff",
                                                             ".tga", ".jpg", ".jpeg", ".hdr"};
    return std::ranges::find(kExtensions, lowerExtension(file)) != kExtensions.end();
}

} // namespace cotan
