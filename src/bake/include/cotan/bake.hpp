// Bakes maps for a simple model from detailed ones, in one call:
//
//     auto low = cotan::loadScene("low.glb"), high = cotan::loadScene("high.glb");
//     cotan::BakeModelOptions options;
//     options.bake.frame = cotan::Frame::smooth; // the frame that the shader uses
//     options.bake.width = options.bake.height = 2048;
//     auto baked = cotan::bakeModel(*low, {.scenes = {*std::move(high)}, .maps = {}}, options);
//     if (!baked)
//         return fail(baked.error().message);
//     cotan::writeImage("map.png", baked->maps[0].image); // baked->maps[0].format: how it is stored
//
// Scenes must be like those of loadScene or the built-in shapes: every mesh has normals, and valid materials, instances
// and indices. Nothing is read from files, written or printed. Without Embree bakeModel returns an error that says so.
// The other two headers of this part are cotan/lint.hpp and cotan/convert.hpp.
#pragma once

#include <array>
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
    normal,           // normals in BakeOptions::frame
    objectNormal,     // world-space normals
    height,           // distance from the low to the high surface along the low normal, model units
    occlusion,        // fraction of the hemisphere above the high surface that is open, cosine weighted
    bentNormal,       // mean direction in which that hemisphere is open, in BakeOptions::frame
    objectBentNormal, // the same in world space
    thickness,        // mean length of rays from the high surface inwards, cosine weighted, model units
    curvature,        // mean curvature of the high surface, 1 / model unit; positive where it is convex
    position,         // world position of the high surface
    // What the materials of the high surface say, at their finest level; of the maps that can be read:
    baseColor,         // linear colour, times vertex colours; sRGB in integers
    roughness,         // 0 to 1
    metallic,          // 0 to 1
    roughnessMetallic, // roughness in green and metallic in blue, as glTF reads them; red is 1
    emissive,          // linear colour, times its strength; sRGB in integers, clamped to 1
    id,                // a colour for each of BakeOptions::idBy, sRGB in integers; samples are not mixed
};

// Whether a map of this kind shows the normals of the high surface, or those of its normal maps.
inline bool showsNormals(BakeKind kind) { return kind == BakeKind::normal || kind == BakeKind::objectNormal; }

// Whether a map of this kind holds directions.
inline bool holdsDirections(BakeKind kind)
{
    return showsNormals(kind) || kind == BakeKind::bentNormal || kind == BakeKind::objectBentNormal;
}

// Whether a map of this kind reads the materials, names or vertex colours of the high surface.
inline bool readsMaterials(BakeKind kind) { return kind >= BakeKind::baseColor; }

// Whether a map of this kind holds one value per texel.
inline bool holdsScalars(BakeKind kind)
{
    return kind == BakeKind::height || kind == BakeKind::occlusion || kind == BakeKind::thickness
        || kind == BakeKind::curvature || kind == BakeKind::roughness || kind == BakeKind::metallic;
}

// What has a colour of its own in a map of ids. Materials and objects of the same name have the same; the nth, counted
// from 1 in the order of the high scenes, has the colour of the label n of PASCAL VOC: the bits of n, from the lowest,
// are the highest bits of red, green, blue, the next bits of red, green, blue, and so on. Black is none.
enum class IdBy {
    material,
    object,      // the instance's name, or its mesh's
    vertexColor, // that of the nearest corner of the triangle, with 8 bits; white without
};

// Which of the surfaces on a line counts.
enum class BakeSearch {
    first,   // the first that an inward ray meets; RayStarts says where rays start
    nearest, // the one nearest to the low surface along its normal, on either side; misses detail that floats above it
};

// Which way rays run. No effect with a cage and for BakeSearch::nearest.
enum class BakeRays {
    automatic,   // straight, and averaged in bands along hard edges, as wide as what the rays must show there needs
    averaged,    // along normals averaged over hard edges: without gaps, but detail that stands off leans
    straight,    // along the low surface's own normals: with gaps at hard edges that are convex
    vertexColor, // between averaged, where the red of the low meshes' vertex colours is 0, and straight, where it is 1
};

// Which normals of the high surface count.
enum class HighNormals {
    smooth, // interpolated between vertices; the face's where they cancel out
    curved, // of the curved surface through the vertices and their normals: for meshes with triangles larger than
            // texels. Needs HighSurface::curve(); smooth without, and where a triangle is not nearly flat
    face,
};

// What casts occlusion if BakeOptions::matched limits rays to some instances.
enum class Occluders {
    matched, // the same instances, as if each pair was baked alone
    all,
};

class HighMaterials;    // internal
class HighNormalMaps;   // internal
struct RayStarts;       // internal
struct DetailedSurface; // internal

struct BakeOptions {
    BakeKind kind = BakeKind::normal;
    Frame frame = Frame::cotangent;
    int width = 1024, height = 1024;
    int samples = 2;       // per texel and axis: 1, 2 or 4
    glm::ivec2 tile{0, 0}; // unit square of uv that the map covers
    BakeSearch search = BakeSearch::first;
    BakeRays rays = BakeRays::automatic;
    std::shared_ptr<const Image> raysMask; // replaces `rays`: between averaged, where its red is 0, and straight, where
                                           // it is 1. Read with the uv of the low surface, repeated. Null: none
    float extrusion = 0;                   // model units: how far in front of the low surface rays start; 0: measured
    float maxDistance = 0;       // model units, in front of and behind the low surface; 0: 10 % of the diagonal of its
                                 // bounding box, for BakeSearch::nearest 5 % of the high surface's
    std::vector<glm::vec3> cage; // a position for each vertex of the low surface; empty: no cage. Rays run from the
                                 // cage through the low surface, and the first surface that they meet counts
    float cageReach = 0;         // model units from the cage; 0: as far behind the low surface as the cage is before it
    std::shared_ptr<const RayStarts> starts; // null: measured by bake(); not used with a cage and by `nearest`
    HighNormals highNormals = HighNormals::smooth;
    std::shared_ptr<const HighNormalMaps> highMaps; // normal maps of the high surface, which replace its normals; not
                                                    // read for heights and occlusion. Null: none
    std::shared_ptr<const HighMaterials> highMaterials; // read by kinds of readsMaterials. Null: their values are zero
    IdBy idBy = IdBy::material;
    int occlusionRays = 64;      // per texel, at least one per sample; also for bent normals and thickness
    float thicknessDistance = 0; // model units: the length of longer rays, stored as 1 in integers; 0: 50 % of the
                                 // diagonal of the high surface's bounding box
    float curvatureRadius = 0; // model units: the radius of a ball that is stored as 1 in integers, 0.5 is flat; 0: 1 %
                               // of that diagonal
    Occluders occluders = Occluders::matched;
    std::vector<std::int64_t> matched; // per instance of the low scene: the group of high instances that rays can hit,
                                       // -1: all; empty: all
    int threads = 0;
};

// A map whose channels are red, green, blue and alpha of maps of one value per texel, or constants.
struct PackedMap {
    std::string name = "packed";
    std::array<std::optional<BakeKind>, 4> kinds; // of holdsScalars; none: the constant
    std::array<float, 4> constants{0, 0, 0, 1};
};

// How a map is stored.
struct StoredAs {
    Convention format;
    PixelType type = PixelType::unorm8;
    bool dither = false; // 8 bit only: ordered dithering, against banding in gradients
};

// ---- the models -----------------------------------------------------------------------------

// The detailed side of a bake.
struct HighModel {
    std::vector<Scene> scenes; // all instances of all scenes count
    std::vector<Image> maps;   // normal maps that replace those of the scenes' materials, read with uv set 0 and no
                               // transform: none, one for all scenes, or one for each
};

struct BakeModelOptions {
    BakeOptions bake; // tile, cage, starts, highMaps, highMaterials and matched are derived from the options below
    std::vector<BakeKind> kinds;   // maps that are made from the same rays, each as it would be alone; empty: bake.kind
    std::vector<PackedMap> packed; // further maps from the same rays; only these if kinds is empty
    std::vector<PixelType> types;  // of the maps of the kinds, then of the packed ones; empty: stored.type
    std::vector<int> tiles;        // UDIM numbers, one map each: 1001 + u + 10 v, u below 10, v upwards; empty: 1001,
                                   // with a warning of triangles on others
    int material = -1;             // of the simple scene; -1: all
    TangentOrigin tangents = TangentOrigin::stored; // for the frames `vertex` and `mikktspace`
    const Scene* cage = nullptr;   // the triangles of the simple scene in the same order, moved out to enclose both
                                   // models; rays run from it inwards. Null: none. Read by prepareBake only
    const Scene* others = nullptr; // other simple meshes, not baked now: detail that is nearer to them than to the
                                   // simple scene is theirs. Null: none. Read by prepareBake only
    bool matchByName = false;      // a simple mesh NAME_low sees only the detailed meshes NAME_high, NAME_high_a, ...,
                                   // and NAME_low.001 only NAME_high.001 (src/bake/name_pairs.hpp has the rule). Names
                                   // are those of instances, or of their meshes if only these have such a word
    bool wrap = false;    // the simple scene is one tile, flat and filling the square of uv once, and what leaves it at
                          // a border comes in at the opposite one. Not with a detailed side that was opened before
    bool ownMaps = false; // bakes the detailed scenes' own normal maps, or HighModel::maps, instead of their normals.
                          // No effect on heights and occlusion
    Frame highFrame = Frame::mikktspace;  // frame that those maps were made for
    std::optional<Convention> highFormat; // how they are stored; none: as the materials say, HighModel::maps by default
    int padding = 0; // texels around charts that are filled from the nearest chart; 0: no limit, -1: none
    StoredAs stored;
    bool mask = false;      // also makes BakedMap::mask
    std::size_t memory = 0; // bytes that all maps of a tile may take together while they are made; 0: the machine's
};

// ---- results --------------------------------------------------------------------------------

// Flags of a texel.
enum TexelState : std::uint8_t {
    texelCovered = 1,     // a triangle covers the centre (or a sample)
    texelTouched = 2,     // a triangle only comes near; filled for filtering
    texelMissed = 4,      // a ray hit nothing
    texelNegative = 8,    // the normal lies below the frame's horizon
    texelOverlapped = 16, // several triangles cover it that want different normals there
    texelPadded = 32,     // filled from the nearest chart
    texelNearer = 64,     // another surface is nearer to the low one than the first hit: BakeSearch::nearest differs
    texelFurther = 128,   // missed, but a surface lies on the line beyond the search distance
};

struct BakeStatistics {
    std::size_t texels = 0, covered = 0, touched = 0, missed = 0, negative = 0, twice = 0;
    std::size_t further = 0; // missed texels with texelFurther
    // Covered texels with texelNearer. Parts smaller than 16 samples across that stand off by less than 15 % of the
    // search distance (by default 1.5 % of the low surface's diagonal) are counted in part only.
    std::size_t nearer = 0;
    std::size_t disputed = 0; // of the texels covered twice, those where normals differ by over 5 degrees (estimated)
    std::size_t rays = 0;
    std::size_t mirroredTriangles = 0, degenerateTriangles = 0; // in uv
    double rayDistance = 0;                                     // search distance used; meaningless with a cage
    double rayStart = 0;   // maximum distance in front from which rays start; 0 with a cage and for `nearest`
    double seconds = 0;    // for rays and frames
    double padSeconds = 0; // for filling around charts, if bakeTile did so
};

// A colour of a map of ids.
struct IdColor {
    std::string name;        // of the material or object
    std::uint32_t color = 0; // 0xrrggbb
};

// An area of a map that should not be used as it is.
struct BakeProblem {
    enum class Kind {
        noSurface,    // no high surface lies in front or behind
        tooFar,       // one lies beyond the search distance or the cage's reach
        belowHorizon, // normals point below the frame's horizon
        disputed,     // triangles share texels, but want different normals
        beyondPart, // rays of BakeOptions::extrusion start beyond another part of the low surface, and find its detail
    };
    Kind kind = Kind::noSurface;
    std::size_t texels = 0;
    double degrees = 0;  // mean: below the horizon, or between the normals; 0: unknown
    glm::ivec2 at{0, 0}; // a texel in the largest such area
    std::string text;    // one line: how much, where, why, and what helps
};

struct BakedMap {
    int tile = 1001;                  // UDIM number
    BakeKind kind = BakeKind::normal; // of a packed map that of its first channel with one
    std::optional<PackedMap> packed = {};
    Image image; // in integers a position is a fraction of `box`, and a height one between the lowest and the highest
    Bounds box;  // of the high surface
    double unit = 0;               // curvature and thickness: the radius or the length that is stored as 1 in integers
    std::vector<IdColor> ids = {}; // of all materials or objects of the high surface, for a map of ids
    Convention format = {};        // how `image` is stored, if it holds directions
    Image mask = {};               // states of the texels as colours, see maskOf; empty unless requested
    BakeStatistics statistics;
    std::vector<BakeProblem> problems = {}; // at most three, the largest first; none: the map can be used
    std::string verdict = {};               // one line that says so
};

struct BakedModel {
    std::vector<BakedMap> maps;        // for each of options.tiles those of the kinds, then the packed ones
    std::vector<std::string> warnings; // one line each, also of problems; about an option: "options.NAME: ..."
};

// Prepares, then bakes every tile. Errors: those of prepareBake and bakeTile.
Result<BakedModel> bakeModel(const Scene& low, HighModel high, const BakeModelOptions& options = {},
                             const Progress& progress = {});

// ---- several bakes from one detailed model ----------------------------------------------------

// Opens the detailed side once: its acceleration structure and normal maps then serve any number of bakes, of other
// simple scenes, frames, kinds and sizes. options: bake.threads, and bake.highNormals, matchByName, ownMaps, highFrame
// and highFormat, which hold for every bake from it. Maps are read if a kind shows normals; curvature and materials are
// prepared for the kinds that are given here, ids for bake.idBy. Errors: those of prepareBake that concern the detailed
// scenes.
Result<std::shared_ptr<const DetailedSurface>> openDetailed(HighModel high, const BakeModelOptions& options);

// Bakes as with the HighModel that `high` was opened from; gives the same bytes.
Result<BakedModel> bakeModel(const Scene& low, std::shared_ptr<const DetailedSurface> high,
                             const BakeModelOptions& options = {}, const Progress& progress = {});

} // namespace cotan
