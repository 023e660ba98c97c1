// Checks of what an image file's header states: its size, before anything is allocated for it, and its frame.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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
        return inputError(fmt::format("{}: the image size is {} x {}, the limit is {} per side", name, width, height,
                                      limits.imageSide));
    const std::uint64_t bytes = std::uint64_t(width) * std::uint64_t(height) * 4 * bytesPerComponent(type);
    if (bytes > limits.imageBytes)
        return memoryError(fmt::format("{}: {} x {} pixels take {} bytes, the limit is {}", name, width, height, bytes,
                                       limits.imageBytes));
    if (limits.expect)
        limits.expect(std::size_t(bytes));
    return std::nullopt;
}

// The key under which image files store for which frame a normal map was made: a PNG text, an OpenEXR attribute, a KTX2
// key.
inline constexpr std::string_view kFrameKey = "cotanFrame";
inline constexpr std::size_t kMaxFrameText = 64;

// The value of kFrameKey, safe for messages: up to 64 printable ASCII characters without spaces. Empty for any other
// value.
inline std::string_view frameText(std::string_view value)
{
    const bool printable = std::ranges::all_of(value, [](char c) { return c > ' ' && c < 0x7f; });
    return printable && value.size() <= kMaxFrameText ? value : std::string_view{};
}

} // namespace cotan
