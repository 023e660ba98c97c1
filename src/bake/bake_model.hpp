// The steps of bakeModel, for who wants to do something between them: all is prepared once, then each tile baked.
#pragma once

#include <string>
#include <vector>

#include "bake/bake_surfaces.hpp"
#include "bake/high_surface.hpp"
#include "bake/surface/low_surface.hpp"
#include "cotan/bake.hpp"

namespace cotan {

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
