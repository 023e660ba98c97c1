#include <fmt/format.h>
#include <zstd.h>

#include "codecs.hpp"

namespace cotan {

Status unpackZstd(std::span<const std::byte> packed, std::span<std::byte> out)
{
    const std::size_t got = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
    if (ZSTD_isError(got) != 0)
        return inputError(fmt::format("zstd: {}", ZSTD_getErrorName(got)));
    if (got != out.size())
        return inputError(fmt::format("zstd: expected {} bytes, found {}", out.size(), got));
    return Done{};
}

} // namespace cotan
