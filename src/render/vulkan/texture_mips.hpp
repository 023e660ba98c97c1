// Mip chains on the CPU: every level is the area average of the one before, taken of what the
// texels mean: linear light for colours, directions for normal maps, numbers for other data.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan {

enum class TextureKind {
    color, // sRGB with linear alpha; float images are linear already
    // Averaged as decoded vectors, made unit, encoded again; the fourth channel has the length of the average, 1 in
    // the finest level.
    normal,
    data,
};

// How the levels are stored. The four channels are always there.
enum class TexelFormat { srgb8, unorm8, unorm16, float16, float32 };

std::size_t bytesPerTexel(TexelFormat format);

struct MipLevel {
    int width = 0;
    int height = 0;
    std::span<const std::byte> data;
};

struct MipChain {
    TexelFormat format = TexelFormat::unorm8;
    std::vector<MipLevel> levels;            // level 0 may refer to the image itself
    std::vector<std::vector<std::byte>> own; // what the levels refer to otherwise
};

struct MipRequest {
    const Image* image = nullptr; // must outlive the chain; see hasPixels
    TextureKind kind = TextureKind::data;
    Convention normalFormat; // for kind normal
    TexelFormat format = TexelFormat::unorm8;
    int largest = 16384; // levels wider or higher than this are left out
};

// The format that keeps all of an image's precision; filterable16 and filterable32: whether the
// device filters 16-bit unorm and 32-bit float textures.
TexelFormat texelFormat(PixelType type, TextureKind kind, bool filterable16, bool filterable32);

// The chain down to 1x1. Sizes halve rounding down; an odd size is averaged by covered area.
MipChain buildMips(const MipRequest& request);

} // namespace cotan
