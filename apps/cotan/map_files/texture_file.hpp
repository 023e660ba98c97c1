// Textures as graphics processors take them, with all their levels, in DDS and KTX 2.0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan::maps {

enum class TexelCode { rgba8, bc5, bc7, bc4 };

struct TextureLevel {
    int width = 0, height = 0;
    std::vector<std::byte> texels; // rows of pixels, or of blocks
};

// Whether a file of that name is one of them.
bool isTextureFile(const std::filesystem::path& file);

// levels: each half as large as the one before, the largest first. frame: Image::frame, which KTX2 holds and DDS does
// not. Errors: as writeFileWhole.
Status writeTextureFile(const std::filesystem::path& file, TexelCode code, const std::vector<TextureLevel>& levels,
                        const std::string& frame = {});

// Normals as a level of a texture that is read as `to`. image: unorm8 for rgba8, else float32 as codeConvention has it.
// lengths: of bc7, are kept.
TextureLevel levelOf(const Image& image, TexelCode code, const Convention& to, bool lengths = false);

// Red as BC4. image: float32.
TextureLevel bc4Level(const Image& image);

// "none", "bc5" or "bc7" for a file of that name. Errors (ErrorKind::usage): "options.compress: ", "options.to: " and
// "options.bits: ".
Result<TexelCode> codeFor(const std::string& compress, const std::string& bits, const Convention& to,
                          const std::filesystem::path& file);

// How levelOf takes the normals that are to be read as `to`: for blocks 2c - 1, for bc5 two channels.
Convention codeConvention(TexelCode code, const Convention& to);

} // namespace cotan::maps
