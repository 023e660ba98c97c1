// zlib where there is none.
#include "core/not_built.hpp"
#include "ktx2.hpp"

namespace cotan {

Status unpackZlib(std::span<const std::byte>, std::span<std::byte>)
{
    return notBuiltWith("zlib, which unpacks this picture", "zlib1g-dev");
}

} // namespace cotan
