// Converts height image files to normal map files, and back.
#pragma once

#include <optional>

#include "cotan/maps.hpp"
#include "map_files/map_file.hpp"

namespace cotan::app {

// The extent of an image in metres.
struct Metres {
    double width = 1;
    double height = 0; // 0: texels are square
};

struct FromHeightFileOptions {
    Convention to{};
    maps::Kernel kernel = maps::Kernel::central; // not spectral
    maps::Wrap wrap = maps::Wrap::repeat;
    std::optional<Metres> metres{}; // if set, `range` applies, else `strength`
    double range = 0;               // metres from black to white, or per unit of floats; negative: white is low
    double strength = 1;            // height from black to white, in percent of the image width
    std::string bits = "auto";      // as for bitsFor
    bool dither = false;
};

struct FromHeightFile {
    int width = 0, height = 0;
    PixelType heights = PixelType::unorm8; // of the height image; with 8 bits one step is a slope of slopeX / 255 / 2
    double slopeX = 0, slopeY = 0;         // per unit of stored height and texel
    Bits bits;
    std::size_t invalid = 0; // texels without a finite height beside them: written as flat
};

// Makes a normal map from a height image, whose red is read. Errors: as openRows and createRows; ErrorKind::usage:
// "options.bits: ", "options.to: "; ErrorKind::stopped.
Result<FromHeightFile> normalsFromHeightFile(const std::filesystem::path& heights, const std::filesystem::path& out,
                                             const FromHeightFileOptions& options, const FileOptions& files = {});

struct ToHeightFileOptions {
    StatedConvention from{};
    maps::Kernel kernel = maps::Kernel::spectral; // by which the slopes were made
    maps::Boundary boundary = maps::Boundary::periodic;
    std::optional<Metres> metres{}; // if set, heights are in metres, else in texels
    std::string bits = "auto";      // as for bitsFor; auto: 16 if the file can hold them
};

struct ToHeightFile {
    int width = 0, height = 0;
    Bits bits;
    maps::Heights heights;               // in texels
    double unit = 1;                     // width of a texel, in metres if `metres` was given
    Convention from{};                   // how the map was read
    std::vector<std::string> notes = {}; // what contradicts a stated convention, one line each
};

// Writes the heights of a normal map; floats keep their unit, integers go from black (lowest) to white. The map is held
// in memory. Errors: as readImage and writeImage; ErrorKind::input: more memory than workBudget() is needed;
// ErrorKind::usage: "options.bits: ", "options.from: "; ErrorKind::stopped.
Result<ToHeightFile> heightFromNormalsFile(const std::filesystem::path& map, const std::filesystem::path& out,
                                           const ToHeightFileOptions& options, const FileOptions& files = {});

} // namespace cotan::app
