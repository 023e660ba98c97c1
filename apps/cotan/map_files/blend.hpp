// Combines a base map and a detail map.
#pragma once

#include <optional>

#include "cotan/maps.hpp"
#include "map_files/map_file.hpp"

namespace cotan::maps {

struct BlendFileOptions {
    StatedConvention base{}, detail{};
    std::optional<Convention> to{}; // not given: as the base is read
    BlendMode mode = BlendMode::reoriented;
    float strength = 1;           // factor on the detail's slopes
    int tilesX = 1, tilesY = 1;   // how often the detail repeats over the base; at least 1
    std::filesystem::path mask{}; // picture whose red multiplies the strength; empty: everywhere
    std::string bits = "auto";    // as bitsFor
    bool dither = false;
};

struct BlendedFile {
    int width = 0, height = 0; // the base's
    Bits bits;
    std::size_t invalid = 0; // texels that are no direction in one of the maps; the other counts alone there
    Convention to{};         // how it is stored
};

// Blends two files; the detail and the mask are held whole. Errors: as openRows, readImage and createRows;
// ErrorKind::usage: "options.bits: ", "options.from: ",
// "options.detailFrom: ", "options.to: "; ErrorKind::stopped.
Result<BlendedFile> blendFiles(const std::filesystem::path& base, const std::filesystem::path& detail,
                               const std::filesystem::path& out, const BlendFileOptions& options,
                               const FileOptions& files = {});

} // namespace cotan::maps
