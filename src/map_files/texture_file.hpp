// Textures as graphics processors take them, with all their levels, in DDS and KTX 2.0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

enum class TexelCode { rgba8, bc5, bc4 };

struct TextureLevel {
    int width = 0, height = 0;
    std::vector<std::byte> texels; // rows of pixels, or of blocks
};

// Whether a file of that name is one of them.
bool isTextureFile(const std::filesystem::path& file);

// levels: each half as large as the one before, the largest first. Errors: as writeFileWhole.
Status writeTextureFile(const std::filesystem::path& file, TexelCode code, const std::vector<TextureLevel>& levels);

// A level of an image: unorm8 as it is, float32 of two channels (bc5Convention) as BC5, or its red as BC4.
TextureLevel rgbaLevel(const Image& image);
TextureLevel bc5Level(const Image& image, const Convention& to);
TextureLevel bc4Level(const Image& image);

// "none" or "bc5" for a file of that name: whether blocks are asked for. Errors (ErrorKind::usage): "options.compress:
// ", "options.to: " and "options.bits: ".
Result<bool> wantsBc5(const std::string& compress, const std::string& bits, const Convention& to,
                      const std::filesystem::path& file);

// How bc5Level takes the normals that are to be read as `to`: two channels, 2c - 1.
Convention bc5Convention(const Convention& to);

} // namespace cotan::maps
