// Which areas of a baked map a user should look at.
#pragma once

#include <vector>

#include "bake/bake_surfaces.hpp"

namespace cotan {

// Finds the problem areas of maps of one bake, before they are padded: at most three kinds, the largest first. Areas
// narrower than three texels, as at the edges of charts, do not count, nor do areas of less than 0.02 % of the covered
// texels. kinds: of the maps. Sets BakeStatistics::disputed of all maps, and clears texelOverlapped where the triangles
// that share a texel want the same in it.
std::vector<BakeProblem> problemsOf(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                    const std::vector<BakeKind>& kinds, std::vector<Baked>& maps);

// One line that says whether the map can be used, with what was counted.
std::string verdictOf(const std::vector<BakeProblem>& problems, const BakeStatistics& statistics);

} // namespace cotan
