// WebP where there is no libwebp.
#include "codecs.hpp"
#include "core/not_built.hpp"

namespace cotan {

namespace {

Error noWebp(const std::string& name)
{
    const Error error = notBuiltWith("libwebp", "libwebp-dev");
    return reworded(error, name + ": " + error.message);
}

} // namespace

bool readsWebp() { return false; }
Result<Image> readWebp(std::span<const std::byte>, const std::string& name, const LoadLimits&) { return noWebp(name); }

Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(const std::filesystem::path&, const AnimationFormat&,
                                                             const std::string& name)
{
    return noWebp(name);
}

std::optional<Result<std::vector<std::byte>>> writeWebpLike(const Image&, std::span<const std::byte>, int&)
{
    return std::nullopt;
}

} // namespace cotan
