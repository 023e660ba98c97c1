#include "formats.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "cotan/files/extension.hpp"
#include "cotan/not_built.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

#ifdef COTAN_MODULE_NAME
// Beside an installed program, where it was installed, where it was built.
std::vector<fs::path> modulePlaces()
{
    std::vector<fs::path> places;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error)
        places.push_back(program.parent_path().parent_path() / COTAN_MODULE_SUBFOLDER);
    places.emplace_back(COTAN_MODULE_INSTALLED);
    places.emplace_back(COTAN_MODULE_BUILT);
    return places;
}

constexpr bool kBuilt = true;

Result<const ImageFormats*> loadModule()
{
    std::string problem = "not found";
    for (const fs::path& folder : modulePlaces()) {
        const fs::path file = folder / COTAN_MODULE_NAME;
        std::error_code error;
        if (!fs::exists(file, error))
            continue;
        void* module = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL); // kept until the end
        if (!module) {
            problem = ::dlerror();
            continue;
        }
        const auto entry = reinterpret_cast<const ImageFormats* (*)()>(::dlsym(module, "cotanImageFormats"));
        const ImageFormats* formats = entry ? entry() : nullptr;
        if (formats && std::strcmp(formats->version, COTAN_MODULE_VERSION) == 0)
            return formats;
        problem = fmt::format("{} is not of this version", file.string());
    }
    return unavailableError(fmt::format("this image format needs the module {}: {}", COTAN_MODULE_NAME, problem));
}
#else
constexpr bool kBuilt = false;

Result<const ImageFormats*> loadModule()
{
    return notBuiltWith("OpenImageIO, which reads and writes this image format",
                        "libopenimageio-dev and openimageio-tools");
}
#endif

} // namespace

bool readsOtherFormats() { return kBuilt; }

Result<const ImageFormats*> imageFormats()
{
    static const Result<const ImageFormats*> formats = loadModule();
    return formats;
}

bool knownImage(std::span<const std::byte> bytes, const std::string& name)
{
    using namespace std::string_view_literals;
    constexpr std::array kStarts = {"\xff\xd8\xff"sv, "II*\0"sv, "MM\0*"sv, "\x76\x2f\x31\x01"sv,
                                    "#?"sv,           "BM"sv,    "DDS "sv};
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 4));
    return std::ranges::any_of(kStarts, [&](auto start) { return head.starts_with(start); })
        || (lowerExtension(name) == ".tga" && !bytes.empty());
}

bool writableImage(const fs::path& file)
{
    constexpr std::array<std::string_view, 8> kExtensions = {".png", ".exr", ".tif",  ".tiff",
                                                             ".tga", ".jpg", ".jpeg", ".hdr"};
    return std::ranges::find(kExtensions, lowerExtension(file)) != kExtensions.end();
}

} // namespace cotan
