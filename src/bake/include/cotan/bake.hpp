// Bakes maps for a simple model from detailed ones, in one call:
//
//     auto low = cotan::loadScene("low.glb"), high = cotan::loadScene("high.glb");
//     cotan::BakeModelOptions options;
//     options.bake.frame = cotan::Frame::smooth; // that the shader will use
//     options.bake.width = options.bake.height = 2048;
//     auto baked = cotan::bakeModel(*low, {.scenes = {*std::move(high)}, .maps = {}}, options);
//     if (!baked)
//         return fail(baked.error().message);
//     cotan::writeImage("map.png", baked->maps[0].image); // baked->maps[0].format: how it is stored
//
// Scenes are as loadScene gives them or as the built-in shapes are: every mesh has normals, and its material, instances
// and indices are valid. Nothing is read from files, written or printed. Without Embree bakeModel says that it is
// missing. cotan/lint.hpp and cotan/convert.hpp are the other two thirds of this part.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/convention.hpp"
#include "cotan/frame.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- what to bake ---------------------------------------------------------------------------

enum class BakeKind {
    normal,       // texels of the named frame
    objectNormal, // world-space normals
    height,       // distance from the low to the high surface along the low normal, model units
    occlusion,    // share of the hemisphere above the high surface that is open, cosine weighted
};

// Whether a map of the kind holds directions.
inline bool showsNormals(BakeKind kind) { return kind == BakeKind::normal || kind == BakeKind::objectNormal; }

// Which of the surfaces on a line counts.
enum class BakeSearch {
    first,   // the first that a ray from outside inwards meets; it starts where RayStarts says
    nearest, // the one nearest to the low surface along its normal, either way. Loses what stands off over a surface
};

// Which normals of the high surface count.
enum class HighNormals {
    smooth, // interpolated between vertices; those of the faces where they cancel out
    curved, // of the curved surface through the vertices and their normals, where the ray meets it: for meshes whose
            // triangles are larger than texels. After curve(); smooth without, and where a triangle is not nearly flat
    face,
};

class HighNormalMaps; // inside
struct RayStarts;     // inside

struct BakeOptions {
    BakeKind kind = BakeKind::normal;
    Frame frame = Frame::cotangent;
    int width = 1024, height = 1024;
    int samples = 1;       // per texel and axis: 1, 2 or 4
    glm::ivec2 tile{0, 0}; // unit square of uv
    BakeSearch search = BakeSearch::first;
    float extrusion = 0;         // model units: how far in front of the low surface rays start; 0: measured
    float maxDistance = 0;       // model units, in front of and behind the low surface; 0: 10 % of the diagonal of its
                                 // box, or for BakeSearch::nearest 5 % of that of the high surface
    std::vector<glm::vec3> cage; // one a vertex of the low surface; empty: none. Rays run from the cage through the
                                 // low surface, and the first surface counts
    float cageReach = 0;         // model units from the cage; 0: as far behind the low surface as the cage is before it
    std::shared_ptr<const RayStarts> starts; // of this pair; null: bake() measures. Unused with a cage and by `nearest`
    HighNormals highNormals = HighNormals::smooth;
    std::shared_ptr<const HighNormalMaps> highMaps; // of the high surface: their normals instead; heights and
                                                    // occlusion take no notice. Null: none
    int occlusionRays = 64;
    std::vector<std::int64_t> matched; // per instance of the low scene: the high instance that counts, -1: all;
                                       // empty: all
    int threads = 0;
};

// How a map is stored.
struct StoredAs {
    Convention format;
    PixelType type = PixelType::unorm8;
    bool dither = false; // 8 bit: rounds by a fixed pattern so that gradients do not band
};

// ---- the models -----------------------------------------------------------------------------

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

// ---- what comes of it -----------------------------------------------------------------------

// What became of each texel: flags.
enum TexelState : std::uint8_t {
    texelCovered = 1,   // a triangle covers the centre (or a sample)
    texelTouched = 2,   // a triangle only comes near: filled for filtering
    texelMissed = 4,    // some ray found nothing
    texelNegative = 8,  // the normal lies below the frame's horizon
    texelTwice = 16,    // several triangles cover it
    texelPadded = 32,   // filled from the nearest chart
    texelNearer = 64,   // another surface lies nearer to the low one than the first hit: BakeSearch::nearest differs
    texelFurther = 128, // missed, but there is a surface on the line, further away than rays look
};

struct BakeStatistics {
    std::size_t texels = 0, covered = 0, touched = 0, missed = 0, negative = 0, twice = 0;
    std::size_t further = 0; // of the missed ones those with texelFurther
    // Covered ones with texelNearer. Some are left out of parts that are smaller than 16 samples across and less than
    // 1.5 % of the low surface's diagonal off.
    std::size_t nearer = 0;
    std::size_t rays = 0;
    std::size_t mirroredTriangles = 0, degenerateTriangles = 0; // in uv
    double rayDistance = 0;                                     // the search distance used
    double rayStart = 0;   // the largest distance from which rays start in front; 0 with a cage and for `nearest`
    double seconds = 0;    // of the rays and frames
    double padSeconds = 0; // of filling around charts, where bakeTile did so
};

struct BakedMap {
    int tile = 1001; // UDIM number
    Image image;
    Convention format; // of `image` where it holds normals
    Image mask;        // what became of each texel, as maskOf; empty unless asked for
    BakeStatistics statistics;
};

struct BakedModel {
    std::vector<BakedMap> maps;        // one for each of options.tiles
    std::vector<std::string> warnings; // one line each
};

// All of it: prepares, and bakes every tile. Errors: those of prepareBake and bakeTile.
Result<BakedModel> bakeModel(const Scene& low, HighModel high, const BakeModelOptions& options = {},
                             const Progress& progress = {});

} // namespace cotan
