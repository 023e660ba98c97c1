// Bytes for levels of KTX 2.0 files: a ramp of all values, and data compressed by Zstandard.
#pragma once

#include <string>

#include <zstd.h>

namespace cotan::test {

inline std::string ramp(std::size_t bytes)
{
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i)
        text += char(i * 37 + 11);
    return text;
}

inline std::string zstd(const std::string& text)
{
    std::string packed(ZSTD_compressBound(text.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
    return packed;
}

} // namespace cotan::test
