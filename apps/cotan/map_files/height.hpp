// Files of heights to files of normals, and back.
#pragma once

#include <optional>

#include "cotan/maps.hpp"
#include "map_files/map_file.hpp"

namespace cotan::maps {

// What a picture covers, in metres.
struct Metres {
    double width = 1;
    double height = 0; // 0: texels are square
};

struct FromHeightFileOptions {
    Convention to{};
    Kernel kernel = Kernel::central; // not spectral
    Wrap wrap = Wrap::repeat;
    std::optional<Metres> metres{}; // with them `range` counts, without them `strength`
    double range = 0;               // metres from black to white, or per unit of floats; negative: white is low
    double strength = 1;            // height from black to white, in hundredths of the picture's width
    std::string bits = "auto";      // as bitsFor
    bool dither = false;
};

struct FromHeightFile {
    int width = 0, height = 0;
    PixelType heights = PixelType::unorm8; // the picture's; with 8 bits one step is a slope of slopeX / 255 / 2
    double slopeX = 0, slopeY = 0;         // per unit of stored height and texel
    Bits bits;
    std::size_t invalid = 0; // texels without a finite height beside them: written as flat
};

// A normal map from a height picture, whose red is read. Errors: as openRows and createRows; ErrorKind::usage:
// "options.bits: ", "options.to: "; ErrorKind::stopped.
Result<FromHeightFile> normalsFromHeightFile(const std::filesystem::path& heights, const std::filesystem::path& out,
                                             const FromHeightFileOptions& options, const FileOptions& files = {});

struct ToHeightFileOptions {
    StatedConvention from{};
    Kernel kernel = Kernel::spectral; // how the slopes were made
    Boundary boundary = Boundary::periodic;
    std::optional<Metres> metres{}; // heights come in metres, otherwise in texels
    std::string bits = "auto";      // as bitsFor; auto: 16 where the file can hold it
};

struct ToHeightFile {
    int width = 0, height = 0;
    Bits bits;
    Heights heights;   // of texels
    double unit = 1;   // a texel's width, in metres where they were given
    Convention from{}; // how the map was read
};

// The heights of a normal map; floats keep their unit, others go from black, the lowest, to white. The map is held
// whole. Errors: as readImage and writeImage; ErrorKind::input: more memory than workBudget() is needed;
// ErrorKind::usage: "options.bits: ", "options.from: "; ErrorKind::stopped.
Result<ToHeightFile> heightFromNormalsFile(const std::filesystem::path& map, const std::filesystem::path& out,
                                           const ToHeightFileOptions& options, const FileOptions& files = {});

} // namespace cotan::maps
