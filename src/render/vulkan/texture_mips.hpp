// Mip chains on the CPU. Every level is the area average of the level before, of decoded values: linear light for
// colours, directions for normal maps, numbers for other data.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan {

enum class TextureKind {
    color, // sRGB with linear alpha; float images are already linear
    // Decoded vectors are averaged, normalised and encoded again. The fourth channel stores the length of the average,
    // 1 in the finest level.
    normal,
    data,
};

// Storage of the levels, always with four channels.
enum class TexelFormat { srgb8, unorm8, unorm16, float16, float32 };

std::size_t bytesPerTexel(TexelFormat format);

struct MipLevel {
    int width = 0;
    int height = 0;
    std::span<const std::byte> data;
};

struct MipChain {
    TexelFormat format = TexelFormat::unorm8;
    std::vector<MipLevel> levels;            // level 0 may refer to the image
    std::vector<std::vector<std::byte>> own; // owns the data of other levels
};

struct MipRequest {
    const Image* image = nullptr; // must outlive the chain; hasPixels() is true
    TextureKind kind = TextureKind::data;
    Convention normalFormat; // of kind `normal`
    TexelFormat format = TexelFormat::unorm8;
    int largest = 16384; // levels with a larger side are omitted
};

// The format that keeps an image's full precision. filterable16, filterable32: whether the device filters 16-bit unorm
// and 32-bit float textures.
TexelFormat texelFormat(PixelType type, TextureKind kind, bool filterable16, bool filterable32);

// Builds the chain down to 1x1. Sizes are halved and rounded down; levels of odd size are averaged by covered area.
MipChain buildMips(const MipRequest& request);

} // namespace cotan
