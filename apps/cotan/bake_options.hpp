// What `cotan bake` was asked for, and what of it the baker needs.
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
                expansion; // empty: by -o
    TangentOrigin tangents = TangentOrigin::stored;
    std::string highNormals = "smooth", highFrame, highConvention; // empty: not given
    std::vector<std::string> highMaps;
    Up up = Up::y;
    std::optional<Up> highUp; // none: as up
    std::string object;       // of the low mesh; empty: all
    std::filesystem::path verify;
    int samples = 1, bits = 8, padding = 0, material = -1, udim = 1001, occlusionRays = 64;
    int memory = kDefaultMemory;
    float maxDistance = 0, extrusion = 0;
    std::string search = "first";
    bool dither = false, matchByName = false, perObject = false;
};

// Everything that was loaded and prepared for one bake.
struct BakeJob {
    Scene lowScene;
    BakeSetup setup;
    std::vector<std::string> warnings; // of the files and of preparing, one line each
    std::size_t objects = 1;           // of the low mesh that are baked into this one map

    Frame frame() const { return setup.options.bake.frame; }
};

// Checks the words, loads the files, prepares. Errors: those of the words and files.
Result<BakeJob> loadBake(const BakeCommandOptions& o);

// The names of the low mesh's objects. Errors: of reading it; ErrorKind::input where it has none.
Result<std::vector<std::string>> lowObjects(const BakeCommandOptions& o);

// An error about one of the library's options, with the command's word for it.
Error withBakeOptionNames(const BakeCommandOptions& o, const Error& error);

} // namespace cotan::app
