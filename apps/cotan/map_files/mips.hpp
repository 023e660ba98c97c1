// A normal map's chain of smaller levels, as files.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "cotan/maps.hpp"
#include "map_files/map_file.hpp"

namespace cotan::maps {

struct MipFileOptions {
    StatedConvention from{};
    std::optional<Convention> to{}; // not given: as the map is read
    VarianceModel model = VarianceModel::lean;
    double roughness = 0.3;        // perceptual roughness of the material, 0 to 1
    bool keepLengths = false;      // three channels: store mean vectors with their shortened lengths
    std::string bits = "auto";     // as bitsFor; .dds and .ktx2 have 8
    std::string compress = "none"; // .dds and .ktx2: "none", "bc5" or "bc7"
    // Asked about each file before the first is written; an error ends the call. May be empty.
    std::function<Status(const std::filesystem::path&)> mayWrite{};
};

// What is said of a level.
struct MipLevelFigures {
    int width = 0, height = 0;
    double meanLength = 1, meanRoughness = 0;
};

struct MippedFile {
    Convention from{}, to{}; // how the map was read, and how its levels are stored
    std::vector<MipLevelFigures> levels;
};

// Writes all levels and the roughness that they need: a .dds or .ktx2 has both, the roughness in alpha; with
// "bc5" OUT_roughness.dds has it, as BC4. OUT.png and others become OUT_0.png, OUT_roughness_0.png, OUT_1.png and so
// on. The map and its levels are held whole. Errors: as readImage and writeImage; ErrorKind::input: the levels take
// more than three times workBudget(); ErrorKind::usage: "options.bits: ", "options.compress: ",
// "options.keepLengths: ", "options.to: "; ErrorKind::stopped, before anything is written.
Result<MippedFile> writeMips(const std::filesystem::path& map, const std::filesystem::path& out,
                             const MipFileOptions& options, const FileOptions& files = {});

// The first file that writeMips writes.
std::filesystem::path firstMipFile(const std::filesystem::path& out);

} // namespace cotan::maps
