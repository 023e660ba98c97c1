// Replaces functions of codecs.hpp whose library is missing (CMakeLists.txt).
#include "codecs.hpp"
#include "core/not_built.hpp"
#include "image/astc.hpp"

namespace cotan {

namespace {

[[maybe_unused]] Error missing(const std::string& name, const std::string& library, const std::string& package)
{
    const Error error = notBuiltWith(library, package);
    return reworded(error, name + ": " + error.message);
}

} // namespace

#ifdef COTAN_WITHOUT_PNG
static Error noPng(const std::string& name) { return missing(name, "libpng", "libpng-dev"); }

Result<Image> readPng(std::span<const std::byte>, const std::string& name, const LoadLimits&) { return noPng(name); }
Status writePng(OpenFile, const Image&, const std::string& name) { return noPng(name); }
Result<std::vector<std::byte>> encodePng(const Image& image) { return noPng(image.name); }

std::optional<Result<std::unique_ptr<RowReader>>> openPngRows(const std::filesystem::path& file, OpenFile,
                                                              const LoadLimits&)
{
    return noPng(file.string());
}

Result<std::unique_ptr<RowWriter>> createPngRows(OpenFile, const RowFormat&, const std::string& name)
{
    return noPng(name);
}
#endif

#ifdef COTAN_WITHOUT_JPEG // OpenImageIO may read it
std::optional<Result<Image>> readJpeg(std::span<const std::byte>, const std::string&, const LoadLimits&)
{
    return std::nullopt;
}

std::optional<JpegBlocks> readJpegBlocks(std::span<const std::byte>, const LoadLimits&, std::size_t)
{
    return std::nullopt;
}

std::optional<Result<std::vector<std::byte>>> writeJpegLike(const Image&, std::span<const std::byte>, int&)
{
    return std::nullopt;
}

std::string writeJpeg(const Image&, int) { return {}; }
#endif

#ifdef COTAN_WITHOUT_ASTC
bool readsAstc() { return false; }
Status decodeAstc(int, int, std::span<const std::byte>, Image&) { return notBuiltWith("libastcenc", "libastcenc-dev"); }
Result<std::vector<std::byte>> encodeAstc(int, int, const Image&, AstcChannels)
{
    return notBuiltWith("libastcenc", "libastcenc-dev");
}
#endif

#ifdef COTAN_WITHOUT_WEBP
static Error noWebp(const std::string& name) { return missing(name, "libwebp", "libwebp-dev"); }

bool readsWebp() { return false; }
Result<Image> readWebp(std::span<const std::byte>, const std::string& name, const LoadLimits&) { return noWebp(name); }

Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(OpenFile, const AnimationFormat&, const std::string& name)
{
    return noWebp(name);
}

std::optional<Result<std::vector<std::byte>>> writeWebpLike(const Image&, std::span<const std::byte>, int&)
{
    return std::nullopt;
}
#endif

} // namespace cotan
