// What `cotan bake` was asked for, and what of it the baker needs.
#pragma once

#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/bake/bake.hpp"
#include "memory_limit.hpp"

namespace cotan::app {

struct BakeCommandOptions {
    CommonOptions common;
    std::vector<std::string> high;
    std::string low, cage, mask, device = "auto";
    std::string frame = "smooth", kind = "normal", size = "1024x1024", convention = "opengl", expansion = "exact", tangents = "stored";
    std::string highNormals = "smooth", highFrame, highConvention; // empty: not given
    std::vector<std::string> highMaps;
    std::filesystem::path verify;
    int samples = 1, bits = 8, padding = 0, material = -1, udim = 1001, occlusionRays = 64;
    int memory = kDefaultMemory;
    float maxDistance = 0;
    bool dither = false, matchByName = false;
};

// Everything that was loaded and derived for one bake.
struct BakeJob {
    Scene lowScene;
    LowSurface low;
    std::vector<HighSurface> high; // one; a vector because it has no empty state
    BakeOptions options;
    Frame frame = Frame::cotangent;
    StoredAs stored;
    std::vector<std::string> warnings; // one line each
};

// The format of a convention by its name. `option` is for the message. Errors: ErrorKind::usage.
Result<NormalMapFormat> formatFromName(const std::string& option, const std::string& convention);

// What can be said of --high-normals and its options before anything is loaded.
Status checkHighOptions(const BakeCommandOptions& o);

// Loads the high meshes, and their maps where --high-normals asks for them; job.options.kind is set already.
Status prepareHigh(const BakeCommandOptions& o, BakeJob& job);

// Loads and checks. Errors: those of the files and words.
Result<BakeJob> prepareBake(const BakeCommandOptions& o);

// What can be said of an -o that names a glTF model before anything is loaded. Errors: ErrorKind::usage.
Status checkModelOutput(const BakeCommandOptions& o);

// Writes the low model with the map in it: a glTF model keeps all else as it was, another format is written as glTF.
// TANGENT is what readers of the frame need. Warns where readers that make MikkTSpace would show the map wrongly.
Status writeBakedModel(const BakeCommandOptions& o, const BakeJob& job, const Image& map);

// Draws the low mesh with the stored map from four sides, by the device and the real shader, and
// compares with the normals that rays from the eye find on the high mesh. Writes pictures and heat
// maps into a folder; returns the report.
// The names of the pictures that it writes.
std::vector<std::string> bakePictures();
Result<nlohmann::ordered_json> verifyBake(const BakeCommandOptions& o, const BakeJob& job, const Image& map);

} // namespace cotan::app
