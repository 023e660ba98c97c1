// A map as the bytes of a texture file: one rule for `map convert`, models, bakes and the C API.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "maps/mip_rows.hpp"
#include "maps/textures/texel_code.hpp"

namespace cotan::maps {

struct TextureSettings {
    Convention from{}, to{}; // of the map and of the texture
    std::string compress = "none", swizzle = "auto";
    std::filesystem::path file = "map.ktx2"; // its extension is the container
    bool mips = true, normalise = false;     // all levels; unit vectors, as RecodeSettings
};

struct MadeTexture {
    std::vector<std::byte> bytes;
    int levels = 1;
    Convention stored{};               // how the texture is read
    std::optional<TextureCost> cost{}; // of the largest level; none if this build cannot decode the format
};

// Makes the file that `map convert --compress` writes, of a map after makeReadable. Image::frame is stored by KTX2.
// Errors: as codeFor and levelOf.
Result<MadeTexture> makeTexture(Image map, const TextureSettings& settings);

// Rows of a map of this width to be encoded at a time, a multiple of the heights of all blocks.
int rowsAtOnce(int width);

// A level of a texture whose rows arrive one after another.
struct LevelRows {
    TextureLevel made{};

    explicit LevelRows(std::pair<int, int> size) : made{size.first, size.second, {}} {}

    // Adds the next rows, from the top. encode: called with rows that fill blocks, all that wait if they are
    // rowsAtOnce(). Errors: those of `encode`.
    Status add(const Image& rows, const std::function<Result<TextureLevel>(const Image&)>& encode);

private:
    std::vector<std::byte> waiting_{}; // rows to be encoded
    int arrived_ = 0;
};

// The same while the rows of the map arrive: holds the blocks, and a few rows of each level.
class TextureRows {
public:
    // taken: how the rows are stored, a codeConvention. settings: as for makeTexture.
    TextureRows(int width, int height, const TexelCode& code, const Convention& taken, TextureSettings settings);

    // Adds the next rows, from the top, rowsAtOnce() but at the end: unorm8 for rgba8, else float32. map: the same rows
    // of what the texture is compared with, in settings.from; null: nothing. Errors: as levelOf.
    Status add(const Image& rows, const Image* map);

    // Ends the texture, after all rows. frame: Image::frame.
    MadeTexture finish(const std::string& frame);

private:
    TexelCode code_;
    TextureSettings settings_;
    MipRows mips_;
    std::vector<LevelRows> levels_{};
    ValueStatistics degrees_{};
    bool compared_ = false;
};

// How a model can hold blocks: the words of --compress that an extension of glTF names, and that extension.
std::vector<std::string> modelCompressionWords();
std::string extensionOf(const std::string& compress);

// Checks a word of modelCompressionWords. Errors (ErrorKind::usage): "options.compress: ".
Status checkModelCompression(const std::string& compress);

} // namespace cotan::maps
