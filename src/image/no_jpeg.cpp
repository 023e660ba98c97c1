// JPEG where there is no libjpeg: what reads all other formats may read it, too.
#include "codecs.hpp"

namespace cotan {

std::optional<Result<Image>> readJpeg(std::span<const std::byte>, const std::string&, const LoadLimits&)
{
    return std::nullopt;
}

std::optional<Result<std::vector<std::byte>>> writeJpegLike(const Image&, std::span<const std::byte>, int&)
{
    return std::nullopt;
}

} // namespace cotan
