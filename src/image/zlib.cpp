#include <fmt/format.h>
#include <zlib.h>

#include "codecs.hpp"

namespace cotan {

Status unpackZlib(std::span<const std::byte> packed, std::span<std::byte> out)
{
    uLongf got = uLongf(out.size());
    const int done = uncompress(reinterpret_cast<Bytef*>(out.data()), &got,
                                reinterpret_cast<const Bytef*>(packed.data()), uLong(packed.size()));
    if (done != Z_OK)
        return inputError(done == Z_BUF_ERROR ? "zlib: the data end too soon, or go on too long"
                                              : "zlib: the data are damaged");
    if (got != out.size())
        return inputError(fmt::format("zlib: expected {} bytes, found {}", out.size(), got));
    return Done{};
}

} // namespace cotan
