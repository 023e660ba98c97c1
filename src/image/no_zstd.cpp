// Zstandard where there is no libzstd.
#include "codecs.hpp"
#include "core/not_built.hpp"

namespace cotan {

Status unpackZstd(std::span<const std::byte>, std::span<std::byte>)
{
    return notBuiltWith("libzstd, which unpacks this picture", "libzstd-dev");
}

} // namespace cotan
