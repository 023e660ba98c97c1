// Lossless WebP files written from the specification (RFC 9649), so that the reader is not tested with files from the
// library that it uses.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cotan::test {

inline std::string little(std::uint64_t value, int bytes)
{
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += char(value >> 8 * i & 0xff);
    return text;
}

inline std::string riffChunk(const std::string& name, const std::string& data)
{
    return name + little(data.size(), 4) + data + std::string(data.size() % 2, '\0');
}

inline std::string riffWebp(const std::string& chunks)
{
    return "RIFF" + little(chunks.size() + 4, 4) + "WEBP" + chunks;
}

// Data of a VP8L chunk: every colour is a literal of 8 bits, without prediction.
inline std::string losslessData(int width, int height, const std::vector<std::array<int, 4>>& rgba)
{
    std::string data(1, '\x2f');
    std::uint64_t bits = 0;
    int held = 0;
    const auto put = [&](std::uint64_t value, int count) { // lowest bit first
        bits |= value << held;
        for (held += count; held >= 8; held -= 8, bits >>= 8)
            data += char(bits & 0xff);
    };
    put(std::uint64_t(width) - 1, 14), put(std::uint64_t(height) - 1, 14);
    put(1, 1), put(0, 3);                                 // alpha is used, version
    put(0, 1), put(0, 1), put(0, 1);                      // no transform, no colour cache, one group of prefix codes
    for (const int symbols : {256 + 24, 256, 256, 256}) { // green and lengths, red, blue, alpha
        // Code lengths 0 and 8 have codes of one bit, 0 and 1. Of the 12 lengths of these codes that are stored, in the
        // order of the format, they are the third and the last.
        put(0, 1), put(12 - 4, 4);
        for (int i = 0; i < 12; ++i)
            put(i == 2 || i == 11 ? 1 : 0, 3);
        put(0, 1); // all symbols
        for (int s = 0; s < symbols; ++s)
            put(s < 256 ? 1 : 0, 1);
    }
    put(1, 1), put(0, 1), put(0, 1), put(0, 1); // distances: a single symbol, 0
    for (const auto& p : rgba)
        for (const int channel : {1, 0, 2, 3})
            for (int bit = 7; bit >= 0; --bit) // codes are stored highest bit first
                put(std::uint64_t(p[std::size_t(channel)] >> bit & 1), 1);
    put(0, 7);
    return data;
}

inline std::string makeWebp(int width, int height, const std::vector<std::array<int, 4>>& rgba)
{
    return riffWebp(riffChunk("VP8L", losslessData(width, height, rgba)));
}

} // namespace cotan::test
