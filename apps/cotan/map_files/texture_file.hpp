// GPU textures with all their levels, in DDS and KTX 2.0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan::app {

enum class TexelCode { rgba8, bc5, bc7, bc4 };

struct TextureLevel {
    int width = 0, height = 0;
    std::vector<std::byte> texels; // rows of pixels, or of blocks
};

// Whether the file's extension is that of a texture format.
bool isTextureFile(const std::filesystem::path& file);

// Writes a texture. levels: the largest first, each half as large as the one before. frame: Image::frame, which only
// KTX2 stores. Errors: as writeFileWhole.
Status writeTextureFile(const std::filesystem::path& file, TexelCode code, const std::vector<TextureLevel>& levels,
                        const std::string& frame = {});

// Normals as a level of a texture that is read as `to`. image: in codeConvention; unorm8 for rgba8, else float32.
// lengths: for bc7, keeps the lengths of vectors.
TextureLevel levelOf(const Image& image, TexelCode code, const Convention& to, bool lengths = false);

// Red as a BC4 level. image: float32.
TextureLevel bc4Level(const Image& image);

// Parses "none", "bc5" or "bc7" for a file. Errors (ErrorKind::usage): "options.compress: ", "options.to: " and
// "options.bits: ".
Result<TexelCode> codeFor(const std::string& compress, const std::string& bits, const Convention& to,
                          const std::filesystem::path& file);

// The convention in which levelOf expects normals that are read as `to`: blocks need 2c - 1, bc5 also two channels.
Convention codeConvention(TexelCode code, const Convention& to);

} // namespace cotan::app
