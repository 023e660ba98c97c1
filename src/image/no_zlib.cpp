// zlib where there is none.
#include "codecs.hpp"
#include "core/not_built.hpp"

namespace cotan {

Status unpackZlib(std::span<const std::byte>, std::span<std::byte>)
{
    return notBuiltWith("zlib, which unpacks this picture", "zlib1g-dev");
}

} // namespace cotan
