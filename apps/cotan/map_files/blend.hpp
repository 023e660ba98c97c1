// Blends a base map and a detail map.
#pragma once

#include <optional>

#include "cotan/maps.hpp"
#include "map_files/map_file.hpp"

namespace cotan::app {

struct BlendFileOptions {
    StatedConvention base{}, detail{};
    std::optional<Convention> to{}; // empty: that of the base
    maps::BlendMode mode = maps::BlendMode::reoriented;
    float strength = 1;           // factor on the detail's slopes
    int tilesX = 1, tilesY = 1;   // number of repeats of the detail over the base; at least 1
    std::filesystem::path mask{}; // image whose red multiplies the strength; empty: 1 everywhere
    std::string bits = "auto";    // as for bitsFor
    bool dither = false;
};

struct BlendedFile {
    int width = 0, height = 0; // those of the base
    Bits bits;
    std::size_t invalid = 0; // texels without a direction in one of the maps; only the other one counts there
    Convention to{};         // of the result
    std::vector<std::string> notes = {}; // what contradicts a stated convention, one line each
};

// Blends two files; the detail and the mask are held in memory. Errors: as openRows, readImage and createRows;
// ErrorKind::usage: "options.bits: ", "options.from: ", "options.detailFrom: ", "options.to: "; ErrorKind::stopped.
Result<BlendedFile> blendFiles(const std::filesystem::path& base, const std::filesystem::path& detail,
                               const std::filesystem::path& out, const BlendFileOptions& options,
                               const FileOptions& files = {});

} // namespace cotan::app
