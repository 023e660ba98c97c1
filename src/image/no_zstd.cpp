// Zstandard where there is no libzstd.
#include "core/not_built.hpp"
#include "ktx2.hpp"

namespace cotan {

Status unpackZstd(std::span<const std::byte>, std::span<std::byte>)
{
    return notBuiltWith("libzstd, which unpacks this picture", "libzstd-dev");
}

} // namespace cotan
