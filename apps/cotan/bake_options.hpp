// The options of `cotan bake`, and what the baker needs of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake_surfaces.hpp"
#include "common.hpp"
#include "loading.hpp"

namespace cotan::app {

struct BakeCommandOptions : CommonOptions {
    std::vector<std::string> high;
    std::string low, cage, mask, device = "auto";
    std::string frame = "mikktspace", kind = "normal", size = "1024x1024", convention = "opengl",
                expansion; // empty: depends on -o
    TangentOrigin tangents = TangentOrigin::stored;
    std::string highNormals = "smooth", highFrame, highConvention; // empty: not given
    std::vector<std::string> highMaps;
    Up up = Up::y;
    std::optional<Up> highUp; // empty: as `up`
    std::string object;       // of the low mesh; empty: all
    std::filesystem::path verify;
    int samples = 1, bits = 8, padding = 0, material = -1, udim = 1001, occlusionRays = 64;
    int memory = kDefaultMemory;
    float maxDistance = 0, extrusion = 0;
    std::string search = "first", occluders = "matched";
    bool dither = false, matchByName = false, perObject = false;
};

// Everything loaded and prepared for one bake.
struct BakeJob {
    Scene lowScene;
    BakeSetup setup;
    std::vector<std::string> warnings; // from loading and preparing, one line each
    std::size_t objects = 1;           // number of low-mesh objects baked into this map

    Frame frame() const { return setup.options.bake.frame; }
};

// Checks the options, loads the files and prepares the bake. Errors: those of the options and files.
Result<BakeJob> loadBake(const BakeCommandOptions& o);

// The names of the low mesh's objects. Errors: those of reading it; ErrorKind::input if it has no object.
Result<std::vector<std::string>> lowObjects(const BakeCommandOptions& o);

// Replaces the name of a library option in an error by that of the command's option.
Error withBakeOptionNames(const BakeCommandOptions& o, const Error& error);

} // namespace cotan::app
