#include "cotan/image.hpp"

#include <fmt/format.h>

#include "codecs.hpp"
#include "image/format_table.hpp"

namespace cotan {

namespace {

Result<EncodedLike> asPng(const Image& image, std::string whyNot)
{
    auto png = encodePng(image);
    if (!png)
        return png.error();
    return EncodedLike{*std::move(png), "PNG", "image/png", 0, std::move(whyNot)};
}

} // namespace

Result<EncodedLike> encodeLike(const Image& image, std::span<const std::byte> old)
{
    const ImageFormat* const format = imageFormatOf(old);
    if (!format || format->name == "PNG")
        return asPng(image, {});
    const std::string name(format->name);
    if (name != "JPEG" && name != "WebP")
        return asPng(image, fmt::format("{} is not written here", name));
    if (image.type != PixelType::unorm8)
        return asPng(image, fmt::format("{} has 8 bits, and 16 are wanted", name));
    if (name == "JPEG" && !isOpaque(image))
        return asPng(image, "JPEG has no alpha");
    int quality = 0;
    auto bytes = name == "JPEG" ? writeJpegLike(image, old, quality) : writeWebpLike(image, old, quality);
    if (!bytes)
        return asPng(image,
                     name == "JPEG" ? "a grey JPEG has no directions, or this build has no libjpeg"
                                    : "this build has no libwebp");
    if (!*bytes)
        return bytes->error();
    return EncodedLike{**std::move(bytes), name, std::string(format->mime), quality};
}

} // namespace cotan
