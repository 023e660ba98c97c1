// JPEG through libjpeg. Direct, because it is the commonest format in models beside PNG and the
// module of the other formats is slow to load.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "cotan/files/limits.hpp"
#include "cotan/image/file.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

// As decodeImage, for grey and YCbCr or RGB pictures. Nothing for those in CMYK.
std::optional<Result<Image>> readJpeg(std::span<const std::byte> bytes, const std::string& name,
                                      const LoadLimits& limits);

} // namespace cotan
