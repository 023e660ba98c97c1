// From a detailed surface to a map on a simple one.
#pragma once

#include <string>
#include <vector>

#include "bake/high_normal_maps.hpp"
#include "bake/high_surface.hpp"
#include "bake/ray_starts.hpp"
#include "bake/surface/low_surface.hpp"
#include "cotan/bake.hpp"
#include "cotan/result.hpp"

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

// The corners of the triangles that UvRaster::firsts is asked about for an image of that size.
// Errors: ErrorKind::input where they lie over one another in too many rows of texels.
Result<std::vector<std::uint32_t>> indicesToDraw(const LowSurface& low, glm::ivec2 size);

// Measures options.starts where bake() needs them and they are null. Errors: those of makeRayStarts.
Status measureRayStarts(const LowSurface& low, const HighSurface& high, BakeOptions& options, const LowRest& rest = {});

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

// ---- the steps of bakeModel -------------------------------------------------------------------

// For who wants to do something between them: all is prepared once, then each tile baked.

// What a bake works on.
struct BakeSetup {
    LowSurface low;
    HighSurface high;
    BakeModelOptions options;          // as given; in options.bake what was derived. `cage` is null
    std::vector<std::string> warnings; // one line each
};

// Derives what the frame needs on the simple scene, the acceleration structure over the detailed ones, the cage's
// vertices and the matches.
// Errors: those of checkScene, makeLowSurface, HighSurface::make and HighNormalMaps::make. One about an option begins
// with its name, "options.material: ". ErrorKind::usage: a size, number of samples, frame, distance, number of rays,
// material or number of maps out of range, or no tile; ErrorKind::input: a cage of another number of triangles, a mesh
// without its match. An extrusion or the search `nearest` together with a cage are ErrorKind::usage, too.
Result<BakeSetup> prepareBake(const Scene& low, HighModel high, const BakeModelOptions& options);

// Bakes one tile, fills around its charts and stores it. `progress` is called from several threads, not always in
// order. Errors: ErrorKind::input where no triangle lies on the tile, ErrorKind::usage for a number below 1001; both
// begin with "options.tiles: "; ErrorKind::stopped.
Result<BakedMap> bakeTile(const BakeSetup& setup, int tile, const Progress& progress = {});

} // namespace cotan
