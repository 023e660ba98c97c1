// Views of the detailed surface, by which baked maps are judged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/bake_surfaces.hpp"
#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/view.hpp"

namespace cotan::app {

// The high surface in a view, and what a map should show.
struct HighView {
    Image normals;  // of the high surface where rays from the eye hit it; float32, alpha 1 there
    Image expected; // normals that the pixels of the low surface should show; float32, alpha 1 where known
    std::vector<std::uint8_t> other;      // per pixel: 1 where bake() takes another surface than the camera sees
    std::size_t others = 0, compared = 0; // pixels where that is so, and where it is known
};

// Traces both surfaces with the camera of `view`. A point of the low surface should show, on the line of
// BakeRays::automatic through it, the outermost high surface that faces outwards and that the camera sees; a pixel the
// mean over 3 x 3 points. The options' own rays, cage and search do not matter, so that detail in the wrong place
// counts. Rays from the eye decide what is seen, independently of the baker's rule. Surfaces farther than
// RayStarts::limit or behind another part of the low surface do not count; if the camera sees none on a line,
// `expected` is unknown. `other` asks the same on the baker's own line: two surfaces are different if they are 0.001 of
// the diagonal of the low surface's box apart. Errors: those of LowTree::make and measureRayStarts.
Result<HighView> renderHighView(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                const View& view);

} // namespace cotan::app
