#include "codecs.hpp"

#include <fmt/format.h>
#include <webp/decode.h>

#include "image/checks.hpp"
#include "numbers.hpp"

namespace cotan {

namespace {

struct WebpSize {
    std::int64_t width = 0, height = 0; // pixels
};

struct Chunk {
    std::uint64_t data = 0, size = 0; // bytes
};

// VP8's frame header: 3 bytes of tag, of which the lowest bit is 0 in a key frame, a mark, two sizes of 14 bits.
Result<WebpSize> lossySize(Numbers& file, const Chunk& chunk)
{
    if (chunk.size < 10)
        return inputError(fmt::format("its VP8 chunk has {} bytes, expected at least 10", chunk.size));
    const std::uint64_t tag = file.at(chunk.data, 3), firstPart = tag >> 5;
    if ((tag & 1) != 0 || file.at(chunk.data + 3, 3) != 0x2a019d)
        return inputError("its VP8 chunk does not begin with a key frame");
    if (firstPart > chunk.size - 10)
        return inputError(
            fmt::format("the first part of its picture takes {} bytes, its chunk has {} behind the header", firstPart,
                        chunk.size - 10));
    return WebpSize{std::int64_t(file.at(chunk.data + 6, 2) & 0x3fff),
                    std::int64_t(file.at(chunk.data + 8, 2) & 0x3fff)};
}

// VP8L's header: a mark, two sizes of 14 bits less one, whether there is alpha, 3 bits of version.
Result<WebpSize> losslessSize(Numbers& file, const Chunk& chunk)
{
    if (chunk.size < 5)
        return inputError(fmt::format("its VP8L chunk has {} bytes, expected at least 5", chunk.size));
    const std::uint64_t bits = file.at(chunk.data + 1, 4);
    if (file.at(chunk.data, 1) != 0x2f || bits >> 29 != 0)
        return inputError("its VP8L chunk begins with another mark or version");
    return WebpSize{std::int64_t(bits & 0x3fff) + 1, std::int64_t(bits >> 14 & 0x3fff) + 1};
}

// The size of the picture, once its parts have been found to lie within the file, as its header says (RFC 9649).
// Errors: ErrorKind::input, without the file's name.
Result<WebpSize> checkWebp(std::span<const std::byte> bytes)
{
    Numbers file(bytes);
    const std::uint64_t end = 8 + file.at(4, 4);
    if (end > file.size())
        return inputError(fmt::format("its header promises {} bytes, the file has {}", end, file.size()));
    WebpSize canvas;
    for (std::uint64_t at = 12; at + 8 <= end;) {
        const Chunk chunk{at + 8, file.at(at + 4, 4)};
        if (chunk.size > end - chunk.data)
            return inputError(
                fmt::format("a chunk takes {} bytes from {}, the file has {}", chunk.size, chunk.data, end));
        const bool lossy = file.says(at, "VP8 ");
        if (lossy || file.says(at, "VP8L")) {
            auto size = lossy ? lossySize(file, chunk) : losslessSize(file, chunk);
            if (size && canvas.width > 0 && (size->width != canvas.width || size->height != canvas.height))
                return inputError(fmt::format("its canvas is {} x {}, its picture {} x {}", canvas.width, canvas.height,
                                              size->width, size->height));
            return size;
        }
        if (file.says(at, "VP8X")) {
            if (chunk.size < 10)
                return inputError(fmt::format("its VP8X chunk has {} bytes, expected 10", chunk.size));
            if ((file.at(chunk.data, 1) & 0x2) != 0)
                return inputError("expected one picture, found an animation");
            canvas = {std::int64_t(file.at(chunk.data + 4, 3)) + 1, std::int64_t(file.at(chunk.data + 7, 3)) + 1};
        }
        at = chunk.data + chunk.size + chunk.size % 2;
    }
    return inputError("it has no picture");
}

const char* reason(VP8StatusCode status)
{
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY: return "not enough memory";
    case VP8_STATUS_SUSPENDED:
    case VP8_STATUS_NOT_ENOUGH_DATA: return "the data end too soon";
    default: return "the data are damaged";
    }
}

} // namespace

bool readsWebp() { return true; }

Result<Image> readWebp(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const auto broken = [&](std::string_view why) {
        return inputError(fmt::format("{}: broken webp image: {}", name, why));
    };
    const auto size = checkWebp(bytes);
    if (!size)
        return broken(size.error().message);
    if (auto error = checkImageSize(size->width, size->height, PixelType::unorm8, name, limits))
        return *error;
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config))
        return unavailableError(fmt::format("{}: libwebp is of another version than it was built with", name));
    Image image = makeImage(int(size->width), int(size->height), PixelType::unorm8, name);
    config.output.colorspace = MODE_RGBA; // not multiplied by alpha
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = image.bytes8();
    config.output.u.RGBA.stride = image.width * 4;
    config.output.u.RGBA.size = image.data.size();
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    if (const VP8StatusCode status = WebPDecode(data, bytes.size(), &config); status != VP8_STATUS_OK)
        return broken(reason(status));
    return image;
}

} // namespace cotan
