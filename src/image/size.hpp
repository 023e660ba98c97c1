// The size check that every image passes before anything is allocated for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cotan/files.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

inline std::optional<Error> checkImageSize(std::int64_t width, std::int64_t height, PixelType type,
                                           const std::string& name, const LoadLimits& limits)
{
    if (width <= 0 || height <= 0)
        return inputError(fmt::format("{}: the image size is {} x {}", name, width, height));
    if (width > limits.imageSide || height > limits.imageSide)
        return inputError(fmt::format("{}: the image size is {} x {}, the limit is {} a side", name, width, height,
                                      limits.imageSide));
    const std::uint64_t bytes = std::uint64_t(width) * std::uint64_t(height) * 4 * bytesPerComponent(type);
    if (bytes > limits.imageBytes)
        return memoryError(fmt::format("{}: {} x {} pixels take {} bytes, the limit is {}", name, width, height, bytes,
                                       limits.imageBytes));
    if (limits.expect)
        limits.expect(std::size_t(bytes));
    return std::nullopt;
}

} // namespace cotan
