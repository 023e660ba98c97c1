// Compresses rows of pixels in the format of zlib's streams, in a fraction of zlib's time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cotan {

// Bytes that deflatePixels may read beyond the end of a row.
inline constexpr std::size_t kReadAhead = 8;

// Appends rows as blocks of deflate (RFC 1951) with their own Huffman codes, ending on a whole byte; none is the last
// block of a stream. Only whole pixels are compared with earlier ones, each with the one before it and with one that a
// hash of it and the next finds. Parts of a stream can be compressed side by side, since no part refers to another.
// rows: of rowBytes each, one byte and then pixels, followed by kReadAhead bytes of any value; fewer than 2^31 bytes.
// pixelBytes: 3, 4, 6 or 8.
void deflatePixels(std::span<const std::uint8_t> rows, std::size_t rowBytes, std::size_t pixelBytes,
                   std::vector<std::uint8_t>& packed);

} // namespace cotan
