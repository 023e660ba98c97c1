// JPEG through libjpeg. Direct, because it is the commonest format in models beside PNG and the
// module of the other formats is slow to load.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cotan/files.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// As decodeImage, for grey and YCbCr or RGB pictures. Nothing for those in CMYK.
std::optional<Result<Image>> readJpeg(std::span<const std::byte> bytes, const std::string& name,
                                      const LoadLimits& limits);

// As encodeLike, of an opaque picture of unorm8; quality: of the quantisation tables. Nothing where the old file is
// grey or no JPEG that is read here.
std::optional<Result<std::vector<std::byte>>> writeJpegLike(const Image& image, std::span<const std::byte> old,
                                                            int& quality);

} // namespace cotan
