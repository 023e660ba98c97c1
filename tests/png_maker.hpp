// PNG files written from first principles (the PNG specification and zlib), independent of the library that the reader
// under test uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>

namespace cotan::test {

using Bytes = std::vector<std::byte>;

inline void put(Bytes& bytes, std::string_view text)
{
    for (const char c : text)
        bytes.push_back(static_cast<std::byte>(c));
}

inline std::string big32(std::uint32_t value)
{
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

inline void putChunk(Bytes& bytes, const std::string& type, const std::string& data)
{
    const std::string body = type + data;
    put(bytes, big32(std::uint32_t(data.size())));
    put(bytes, body);
    put(bytes, big32(std::uint32_t(crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size())))));
}

struct Png {
    std::uint32_t width = 1;
    std::uint32_t height = 1;
    int bits = 8;
    int colour = 2; // 0 grey, 2 rgb, 3 palette, 4 grey and alpha, 6 rgb and alpha
    bool interlaced = false;
    std::string rows;        // as stored, each row with its filter byte
    std::string before = {}; // whole chunks between header and pixels
};

inline std::string chunk(const std::string& type, const std::string& data)
{
    Bytes bytes;
    putChunk(bytes, type, data);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline Bytes makePng(const Png& png)
{
    Bytes bytes;
    put(bytes, "\x89PNG\r\n\x1a\n");
    putChunk(bytes, "IHDR",
             big32(png.width) + big32(png.height) + char(png.bits) + char(png.colour) + '\0' + '\0'
                 + char(png.interlaced ? 1 : 0));
    put(bytes, png.before);
    std::string packed(compressBound(uLong(png.rows.size())), '\0');
    uLongf size = uLongf(packed.size());
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(png.rows.data()),
             uLong(png.rows.size()));
    packed.resize(size);
    putChunk(bytes, "IDAT", packed);
    putChunk(bytes, "IEND", "");
    return bytes;
}

} // namespace cotan::test
