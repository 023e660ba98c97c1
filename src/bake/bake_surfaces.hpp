// From a detailed surface to a map on a simple one.
#pragma once

#include <vector>

#include "bake/high_normal_maps.hpp"
#include "bake/high_surface.hpp"
#include "bake/ray_starts.hpp"
#include "bake/surface/low_surface.hpp"
#include "cotan/bake.hpp"
#include "cotan/result.hpp"
#include "cotan/view.hpp"

namespace cotan {

// A baked map before it is stored: per texel a unit texel m (or a world normal; or the value in x),
// zero where nothing was found.
struct Baked {
    int width = 0, height = 0;
    std::vector<glm::vec3> values;
    std::vector<std::uint8_t> states;
    BakeStatistics statistics;
};

// Bakes. `progress` is called from several threads after each row. The result does not depend on the number of threads.
// options: frame, cage and starts are those of the low surface. Errors: those of makeRayStarts; ErrorKind::input where
// triangles lie over one another in too many rows of texels; ErrorKind::stopped.
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

// The format that storeBaked writes where `format` is asked for: object normals have no green to turn and need all
// three channels.
Convention storedFormat(BakeKind kind, Convention format);

// The picture of a baked map. Normals by the format; heights and occlusion as grey, heights shifted
// and scaled to [0,1] unless float. Texels without a value become flat (normals) or zero.
Image storeBaked(const Baked& baked, BakeKind kind, const StoredAs& as);

// States as colours: covered green, touched dark green, missed red, negative blue, twice yellow.
Image maskOf(const Baked& baked);

} // namespace cotan
