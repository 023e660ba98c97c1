// From a detailed surface to a map on a simple one.
#pragma once

#include <memory>
#include <vector>

#include "cotan/bake/high_normal_maps.hpp"
#include "cotan/bake/high_surface.hpp"
#include "cotan/bake/ray_starts.hpp"
#include "cotan/progress.hpp"
#include "cotan/scene/view.hpp"
#include "cotan/surface/low_surface.hpp"

namespace cotan {

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

// A baked map before it is stored: per texel a unit texel m (or a world normal; or the value in x),
// zero where nothing was found.
struct Baked {
    int width = 0, height = 0;
    std::vector<glm::vec3> values;
    std::vector<std::uint8_t> states;
    BakeStatistics statistics;
};

// Bakes. `progress` is called from several threads after each row. The result does not
// depend on the number of threads.
// Errors: ErrorKind::input for a cage of another number of vertices.
Result<Baked> bake(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                   const Progress& progress = {});

// Measures options.starts where bake() needs them and they are null. Errors: those of makeRayStarts.
Status measureRayStarts(const LowSurface& low, const HighSurface& high, BakeOptions& options, const LowRest& rest = {});

// What a camera sees of the high surface, and what a map should show of it.
struct SeenHigh {
    Image normals;  // of the high surface itself, where rays from the eye meet it; float32, alpha 1 there
    Image expected; // the normals that the pixels of the low surface should show; float32, alpha 1 where one is known
    std::vector<std::uint8_t> other; // one a pixel: 1 where `expected` is known and bake() takes another surface
    std::size_t others = 0, compared = 0;
};

// Looks at both surfaces with the camera of `view`. A pixel of the low surface should show the outermost surface on the
// baker's line through its point that faces outwards and that the camera really sees: rays from the eye decide, not the
// baker's rule. Nothing further off than RayStarts::limit counts, nor behind another part of the low surface; where the
// camera sees nothing on the line, nothing is known. Two surfaces are different if they lie 0.001 of the diagonal of
// the low surface's box apart.
// Errors: those of LowTree::make and makeRayStarts.
Result<SeenHigh> seeHigh(const LowSurface& low, const HighSurface& high, const BakeOptions& options, const View& view);

// Fills texels without a value from the nearest one that has one, up to `radius` texels away (0: no
// limit), ties to the upper, then the left. So every texel belongs to its nearest chart.
void padCharts(Baked& baked, int radius);

// How a map is stored.
struct StoredAs {
    Convention format;
    PixelType type = PixelType::unorm8;
    bool dither = false; // 8 bit: rounds by a fixed pattern so that gradients do not band
};

// The format that storeBaked writes where `format` is asked for: object normals have no green to turn and need all
// three channels.
Convention storedFormat(BakeKind kind, Convention format);

// The picture of a baked map. Normals by the format; heights and occlusion as grey, heights shifted
// and scaled to [0,1] unless float. Texels without a value become flat (normals) or zero.
Image storeBaked(const Baked& baked, BakeKind kind, const StoredAs& as);

// States as colours: covered green, touched dark green, missed red, negative blue, twice yellow.
Image maskOf(const Baked& baked);

} // namespace cotan
