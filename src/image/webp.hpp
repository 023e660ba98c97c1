// WebP through libwebp. Direct: OpenImageIO's reader multiplies colours by alpha.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// Whether this build has the library.
bool readsWebp();

// As decodeImage. Animations are refused.
Result<Image> readWebp(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

// As createAnimation, for WebP and pictures of unorm8.
Result<std::unique_ptr<AnimationWriter>> createWebpAnimation(const std::filesystem::path& file,
                                                             const AnimationFormat& format);

// As encodeLike, of a picture of unorm8; quality: 0 without losses. Nothing where this build has no libwebp.
std::optional<Result<std::vector<std::byte>>> writeWebpLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality);

struct WebpSize {
    std::int64_t width = 0, height = 0; // pixels
};

// The size of the picture, once its parts have been found to lie within the file, as its header says (RFC 9649).
// Errors: ErrorKind::input, without the file's name.
Result<WebpSize> checkWebp(std::span<const std::byte> bytes);

} // namespace cotan
