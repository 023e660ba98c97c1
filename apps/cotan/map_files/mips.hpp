// Writes the mip levels of a normal map to files.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "cotan/maps.hpp"
#include "map_files/map_file.hpp"
#include "maps/textures/texel_code.hpp"

namespace cotan::app {

struct MipFileOptions {
    StatedConvention from{};
    std::optional<Convention> to{}; // empty: as the map is read
    maps::VarianceModel model = maps::VarianceModel::lean;
    double roughness = 0.3;        // perceptual roughness of the material, 0 to 1
    bool keepLengths = false;      // three channels: store mean vectors with their shortened lengths
    std::string bits = "auto";     // as for bitsFor; .dds and .ktx2 have 8
    std::string compress = "none"; // .dds and .ktx2: a word of compressionWords
    std::string swizzle = "auto";  // a word of swizzleWords
    // Called for each file before the first is written; an error ends the call. May be empty.
    std::function<Status(const std::filesystem::path&)> mayWrite{};
};

// Figures of a level for reports.
struct MipLevelFigures {
    int width = 0, height = 0;
    double meanLength = 1, meanRoughness = 0;
};

struct MippedFile {
    Convention from{}, to{}; // conventions of the map and of its levels
    std::vector<MipLevelFigures> levels;
    std::vector<std::string> notes = {}; // what contradicts a stated convention, one line each
};

// Writes all levels and the roughness that they need: .dds and .ktx2 hold both, the roughness in alpha; where
// alpha is not free it is in OUT_roughness.dds, as pixels, BC4 or EAC R11. OUT.png and other formats become OUT_0.png,
// OUT_roughness_0.png, OUT_1.png etc. The blocks of .dds and .ktx2 are held in memory, of other formats the map and its
// levels. Errors: as readImage and writeImage; ErrorKind::input: the levels take more than three times workBudget();
// ErrorKind::usage: "options.bits: ", "options.compress: ", "options.swizzle: ", "options.keepLengths: ", "options.to:
// "; ErrorKind::stopped, before anything is written.
Result<MippedFile> writeMips(const std::filesystem::path& map, const std::filesystem::path& out,
                             const MipFileOptions& options, const FileOptions& files = {});

// Grey as a level of one channel: bc4, eacR11 or uastc of float32, or an image of unorm8 for rgba8.
maps::TextureLevel greyLevel(const Image& image, const maps::TexelCode& code);

// The first file that writeMips writes.
std::filesystem::path firstMipFile(const std::filesystem::path& out);

} // namespace cotan::app
