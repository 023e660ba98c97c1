// Compression and decompression of the levels of KTX2 files, by libraries that may be missing (CMakeLists.txt).
#include <fmt/format.h>
#ifndef COTAN_WITHOUT_ZLIB
#include <zlib.h>
#endif
#ifndef COTAN_WITHOUT_ZSTD
#include <zstd.h>
#endif

#include "codecs.hpp"
#include "core/not_built.hpp"

namespace cotan {

#ifdef COTAN_WITHOUT_ZLIB
bool unpacksZlib() { return false; }
Status unpackZlib(std::span<const std::byte>, std::span<std::byte>)
{
    return notBuiltWith("zlib, which unpacks this image", "zlib1g-dev");
}
#else
bool unpacksZlib() { return true; }
Status unpackZlib(std::span<const std::byte> packed, std::span<std::byte> out)
{
    uLongf got = uLongf(out.size());
    const int done = uncompress(reinterpret_cast<Bytef*>(out.data()), &got,
                                reinterpret_cast<const Bytef*>(packed.data()), uLong(packed.size()));
    if (done != Z_OK)
        return inputError(done == Z_BUF_ERROR ? "zlib: the data are too short or too long"
                                              : "zlib: the data are damaged");
    if (got != out.size())
        return inputError(fmt::format("zlib: expected {} bytes, found {}", out.size(), got));
    return Done{};
}
#endif

#ifdef COTAN_WITHOUT_ZSTD
bool unpacksZstd() { return false; }
Status unpackZstd(std::span<const std::byte>, std::span<std::byte>)
{
    return notBuiltWith("libzstd, which unpacks this image", "libzstd-dev");
}

std::vector<std::byte> packZstd(std::span<const std::byte>) { return {}; }
#else
bool unpacksZstd() { return true; }
Status unpackZstd(std::span<const std::byte> packed, std::span<std::byte> out)
{
    const std::size_t got = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
    if (ZSTD_isError(got) != 0)
        return inputError(fmt::format("zstd: {}", ZSTD_getErrorName(got)));
    if (got != out.size())
        return inputError(fmt::format("zstd: expected {} bytes, found {}", out.size(), got));
    return Done{};
}

std::vector<std::byte> packZstd(std::span<const std::byte> data)
{
    constexpr int kLevel = 12; // blocks hardly shrink further
    std::vector<std::byte> packed(ZSTD_compressBound(data.size()));
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), data.data(), data.size(), kLevel);
    packed.resize(ZSTD_isError(size) != 0 ? 0 : size);
    return packed;
}
#endif

} // namespace cotan
