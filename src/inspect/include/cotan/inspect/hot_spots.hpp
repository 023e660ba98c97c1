// Where on a model to look: the worst places of what lint takes shares of.
#pragma once

#include <string>
#include <vector>

#include "cotan/scene/scene.hpp"

namespace cotan {

struct HotSpot {
    std::string text; // "shear 63 degrees, 12 % of body"
    double badness = 0;
    Camera camera; // looks at the worst triangle of its kind along its normal
};

// For each mesh and each of: uv without area, stretch over kStretched, shear over kSheared (cotan/lint/lint.hpp), a
// stored tangent whose side is not that of the uv. The worst first; at most `most`.
std::vector<HotSpot> hotSpots(const Scene& scene, std::size_t most = 50);

} // namespace cotan
