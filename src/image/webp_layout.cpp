// Whether a WebP file holds one picture of the size that its headers promise.
#include <fmt/format.h>

#include "numbers.hpp"
#include "webp.hpp"

namespace cotan {

namespace {

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

} // namespace

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

} // namespace cotan
