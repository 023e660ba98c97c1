// One map for a simple scene from detailed ones, in one call:
//
//     HighModel high;
//     high.scenes.push_back(detailedScene);
//     BakeModelOptions options;
//     options.bake.frame = Frame::smooth; // that the shader will use
//     options.bake.width = options.bake.height = 2048;
//     const Result<BakedModel> baked = bakeModel(simpleScene, std::move(high), options);
//     // baked->maps[0].image is the normal map, baked->maps[0].format how it is stored
//
// Scenes are as loadScene gives them or as the built-in shapes are: every mesh has normals, and its material, instances
// and indices are valid. Nothing is read from files, written or printed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cotan/bake/bake.hpp"

namespace cotan {

// The detailed side of a bake.
struct HighModel {
    std::vector<Scene> scenes; // all instances of all of them count
    std::vector<Image> maps;   // normal maps in place of those in the scenes' materials, read by uv set 0 without a
                               // transform: none, one for all scenes, or one for each
};

struct BakeModelOptions {
    BakeOptions bake;             // its tile, cage, starts, highMaps and matched are made from what follows
    std::vector<int> tiles{1001}; // UDIM numbers: 1001 + u + 10 v, u below 10, v upwards. One map each
    int material = -1;            // of the simple scene; -1: all
    TangentOrigin tangents = TangentOrigin::stored; // for the frames `vertex` and `mikktspace`
    const Scene* cage = nullptr; // the triangles of the simple scene in their order, moved out around both sides; rays
                                 // run from it inwards. Null: none. Read by prepareBake only
    const Scene* others = nullptr; // other simple meshes: no map is made for them now, and detail that is nearer to
                                   // them is theirs. Null: none. Read by prepareBake only
    bool matchByName = false;      // a simple mesh NAME_low sees only the detailed mesh NAME_high, any case. Instances
                                   // without a name have that of their mesh
    bool ownMaps = false; // normals of the detailed scenes' own normal maps, or of HighModel::maps. Heights and
                          // occlusion take no notice
    Frame highFrame = Frame::mikktspace;  // that those maps were made for
    std::optional<Convention> highFormat; // how they are stored; none: as the materials say, the default one for
                                          // HighModel::maps
    int padding = 0; // texels around charts that are filled from the nearest chart; 0: all, -1: none
    StoredAs stored;
    bool mask = false; // also gives BakedMap::mask
};

// What a bake works on.
struct BakeSetup {
    LowSurface low;
    HighSurface high;
    BakeModelOptions options;          // as given; in options.bake what was derived. `cage` is null
    std::vector<std::string> warnings; // one line each
    bool storedTangents = false;       // `tangents` is stored, and every mesh of the material has them
};

// Derives what the frame needs on the simple scene, the acceleration structure over the detailed ones, the cage's
// vertices and the matches.
// Errors: those of checkScene, makeLowSurface, HighSurface::make and HighNormalMaps::make. One about an option begins
// with its name, "options.material: ". ErrorKind::usage: a size, number of samples, frame, distance, number of rays,
// material or number of maps out of range, or no tile; ErrorKind::input: a cage of another number of triangles, a mesh
// without its match. An extrusion or the search `nearest` together with a cage are ErrorKind::usage, too.
Result<BakeSetup> prepareBake(const Scene& low, HighModel high, const BakeModelOptions& options);

struct BakedMap {
    int tile = 1001; // UDIM number
    Image image;
    Convention format; // of `image` where it holds normals
    Image mask;        // what became of each texel, as maskOf; empty unless asked for
    BakeStatistics statistics;
};

// Bakes one tile, fills around its charts and stores it. `progress` is called from several threads, not always in
// order. Errors: ErrorKind::input where no triangle lies on the tile, ErrorKind::usage for a number below 1001; both
// begin with "options.tiles: "; ErrorKind::stopped.
Result<BakedMap> bakeTile(const BakeSetup& setup, int tile, const Progress& progress = {});

struct BakedModel {
    std::vector<BakedMap> maps;        // one for each of options.tiles
    std::vector<std::string> warnings; // one line each
};

// All of it: prepares, and bakes every tile. Errors: those of prepareBake and bakeTile.
Result<BakedModel> bakeModel(const Scene& low, HighModel high, const BakeModelOptions& options = {},
                             const Progress& progress = {});

} // namespace cotan
