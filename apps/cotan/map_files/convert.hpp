// Stores the same directions another way.
#pragma once

#include <optional>

#include "cotan/frame.hpp"
#include "cotan/maps.hpp"
#include "cotan/view.hpp"
#include "map_files/map_file.hpp"

namespace cotan::maps {

// The mesh that a map belongs to.
struct MeshOfMap {
    std::filesystem::path file;
    Frame frame = Frame::smooth; // that reads the map in tangent space
    TangentOrigin tangents = TangentOrigin::stored;
    int material = -1; // -1: all
    Up up = Up::y;     // of the file, for object space
};

struct ConvertFileOptions {
    StatedConvention from{};
    Convention to{};
    std::string bits = "auto";       // as bitsFor; .dds and .ktx2 have 8
    std::string compress = "none";   // .dds and .ktx2: "none", "bc5", x and y of unit vectors, or "bc7", x, y and z
    float strength = 1;              // factor on the slopes; negative turns bumps into dents; not 0
    bool normalise = false;          // three channels to three: otherwise lengths are kept
    bool dither = false;             // half a step of noise before rounding
    std::optional<MeshOfMap> mesh{}; // between tangent and object space, and only there; strength is 1 then
};

struct ConvertedFile {
    int width = 0, height = 0;
    Bits bits;
    RecodeCounts counts;
    std::size_t shown = 0; // texels that the mesh shows, where there is one; the rest is padding
    // Image::frame of the result, which .png, .exr and .ktx2 store: that of the map, from object space that of the
    // mesh, to object space none.
    std::string frame = {};
    Convention from{}; // how the map was read
};

// Converts a file. With a mesh, or to .dds or .ktx2, the map is held whole. Errors: ErrorKind::usage: options that do
// not go together, begun with "options.mesh: ", "options.strength: ", "options.bits: ", "options.compress: ",
// "options.from: " or "options.to: "; as openRows, createRows and loadScene; ErrorKind::input: no texel is shown by the
// mesh; ErrorKind::stopped.
Result<ConvertedFile> convertFile(const std::filesystem::path& map, const std::filesystem::path& out,
                                  const ConvertFileOptions& options, const FileOptions& files = {});

} // namespace cotan::maps
