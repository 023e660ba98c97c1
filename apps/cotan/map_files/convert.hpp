// Converts a map to another convention.
#pragma once

#include <optional>

#include "cotan/frame.hpp"
#include "cotan/maps.hpp"
#include "cotan/view.hpp"
#include "map_files/choose.hpp"
#include "map_files/map_file.hpp"

namespace cotan::app {

// The mesh of a map.
struct MeshOfMap {
    std::filesystem::path file;
    Frame frame = Frame::smooth; // frame of the tangent-space map
    TangentOrigin tangents = TangentOrigin::stored;
    int material = -1; // index; -1: all
    Up up = Up::y;     // up axis of the file, for object space
};

struct ConvertFileOptions {
    StatedConvention from{};
    Convention to{};
    std::string bits = "auto";            // as for bitsFor; .dds and .ktx2 have 8
    std::string compress = "none";        // .dds and .ktx2: a word of compressionWords
    std::string swizzle = "auto";         // a word of swizzleWords
    std::optional<FormatBudget> budget{}; // .dds and .ktx2: chooses the format in place of `compress`
    float strength = 1;                   // factor on the slopes, not 0; negative values turn bumps into dents
    bool mips = false;                    // .dds and .ktx2: all levels, filtered as vectors
    bool normalise = false;               // three channels to three; if false, lengths are kept
    bool dither = false;                  // adds half a step of noise before rounding
    std::optional<MeshOfMap> mesh{};      // for conversion between tangent and object space only; strength must be 1
};

struct ConvertedFile {
    int width = 0, height = 0;
    Bits bits;
    maps::RecodeCounts counts;
    std::size_t covered = 0; // texels that the mesh covers, if there is one; the rest is padding
    // Image::frame of the result, stored in .png, .exr and .ktx2: that of the map; from object space that of the mesh;
    // to object space none.
    std::string frame = {};
    Convention from{}, to{};                    // how the map was read, and how the result is stored
    std::string compress = "none";              // the word of the stored format
    std::optional<maps::TextureCost> cost = {}; // of blocks, if this build can decode them
    std::vector<TriedFormat> tried = {};        // with a budget
    std::vector<std::string> notes = {};        // what contradicts a stated convention, one line each
};

// Converts a file. With a mesh, the map is held in memory; of .dds and .ktx2, the blocks. Errors: ErrorKind::usage for
// options that contradict each other, with messages that begin with "options.mesh: ", "options.strength: ",
// "options.bits: ", "options.compress: ", "options.swizzle: ", "options.from: " or "options.to: "; as openRows,
// createRows and loadScene; ErrorKind::input if the mesh covers no texel; ErrorKind::limit as chooseFormat;
// ErrorKind::stopped.
Result<ConvertedFile> convertFile(const std::filesystem::path& map, const std::filesystem::path& out,
                                  const ConvertFileOptions& options, const FileOptions& files = {});

} // namespace cotan::app
