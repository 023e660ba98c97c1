// Zlib compression, for files made by tests.
#pragma once

#include <string>

#include <zlib.h>

namespace cotan::test {

inline std::string deflated(const std::string& text)
{
    uLongf size = compressBound(uLong(text.size()));
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
             uLong(text.size()));
    packed.resize(size);
    return packed;
}

} // namespace cotan::test
