// What a camera sees of the detailed surface, to judge maps by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/bake_surfaces.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/view.hpp"

namespace cotan::app {

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

} // namespace cotan::app
