// WebP where there is no libwebp.
#include <fmt/format.h>

#include "codecs.hpp"
#include "core/not_built.hpp"

namespace cotan {

bool readsWebp() { return false; }

Result<Image> readWebp(std::span<const std::byte>, const std::string& name, const LoadLimits&)
{
    const Error missing = notBuiltWith("libwebp", "libwebp-dev");
    return reworded(missing, fmt::format("{}: {}", name, missing.message));
}

std::optional<Result<std::vector<std::byte>>> writeWebpLike(const Image&, std::span<const std::byte>, int&)
{
    return std::nullopt;
}

Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(const std::filesystem::path& file, const AnimationFormat&)
{
    const Error missing = notBuiltWith("libwebp", "libwebp-dev");
    return reworded(missing, fmt::format("{}: {}", file.string(), missing.message));
}

} // namespace cotan
