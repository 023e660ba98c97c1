// GPU textures with all their levels, in DDS and KTX 2.0.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/value_statistics.hpp"
#include "cotan/convention.hpp"
#include "cotan/maps.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan::maps {

// How texels are stored: pixels, or blocks.
struct TexelCode {
    enum Kind { rgba8, bc3, bc5, bc5Signed, bc7, bc4, eacRg11, eacR11, astc, uastc };
    Kind kind = rgba8;
    int width = 4, height = 4;     // texels of a block
    bool two = false;              // x and y only
    Swizzle swizzle = Swizzle::rg; // where these are

    constexpr TexelCode(Kind k = rgba8) : kind(k) {} // NOLINT(google-explicit-constructor)
    constexpr TexelCode(int w, int h) : kind(astc), width(w), height(h) {}
    friend bool operator==(const TexelCode& code, Kind other) { return code.kind == other; }

    bool twoChannels() const
    {
        return kind == bc3 || kind == bc5 || kind == bc5Signed || kind == eacRg11
            || (two && (kind == astc || swizzle != Swizzle::rg));
    }
    // Whether alpha is free for the roughness, which else has a file of its own.
    bool holdsRoughness() const { return !twoChannels() && kind != uastc; }
};

// Of ASTC, in the order of their VkFormats from 157 on, which alternate with those of sRGB.
inline constexpr std::array<TexelCode, 8> kAstcSizes{{{4, 4}, {5, 4}, {5, 5}, {6, 5}, {6, 6}, {8, 5}, {8, 6}, {8, 8}}};

// The words of --compress: none, bc3, bc5, bc5-snorm, bc7, uastc, eac-rg11, astc-4x4 to astc-8x8.
std::vector<std::string> compressionWords();

// The words of --swizzle: auto, rg, ra, ag, rrrg.
std::vector<std::string> swizzleWords();

// Bits that the code takes for each texel.
double bitsPerTexel(const TexelCode& code);

// A word of compressionWords as a code, without channels; nothing for another word.
std::optional<TexelCode> codeNamed(const std::string& compress);

struct TextureLevel {
    int width = 0, height = 0;
    std::vector<std::byte> texels; // rows of pixels, or of blocks
};

// Whether the file's extension is that of a texture format.
bool isTextureFile(const std::filesystem::path& file);

// The bytes of a file. levels: the largest first, each half as large as the one before. frame: Image::frame, which only
// KTX2 stores.
std::string textureBytes(const std::filesystem::path& file, const TexelCode& code,
                         const std::vector<TextureLevel>& levels, const std::string& frame = {});

// Normals as a level of a texture that is read as `to`. image: in codeConvention; unorm8 for rgba8, else float32.
// lengths: for bc7 and uastc, keeps the lengths of vectors. Errors: ErrorKind::unavailable for ASTC in a build without
// it.
Result<TextureLevel> levelOf(const Image& image, const TexelCode& code, const Convention& to, bool lengths = false);

// Degrees between a map and its texture. NaN if no texel has a direction.
struct TextureCost {
    double mean = 0, percentile99 = 0;
};

// Adds the angles between rows of a map and what a reader of a texture that is read as `to` finds in their blocks, each
// read in its own convention. file: for its extension. Errors: as decodeImage.
Status addCosts(const Image& map, const Convention& convention, const TextureLevel& level, const TexelCode& code,
                const Convention& to, const std::filesystem::path& file, ValueStatistics& degrees);

// Parses a word of --compress for a file, and where its two channels are. Errors (ErrorKind::usage): "options.compress:
// ", "options.to: ", "options.bits: " and "options.swizzle: ".
Result<TexelCode> codeFor(const std::string& compress, const std::string& bits, const Convention& to,
                          const std::filesystem::path& file, const std::string& swizzle = "auto");

// The convention in which levelOf expects normals that are read as `to`: blocks need 2c - 1, those of two channels also
// x and y only.
Convention codeConvention(const TexelCode& code, const Convention& to);

// The convention that the written file has.
Convention storedConvention(const TexelCode& code, const Convention& to);

} // namespace cotan::maps
