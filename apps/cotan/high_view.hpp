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
    std::vector<std::uint8_t> other; // per pixel: 1 where `expected` is known and bake() takes another surface
    std::size_t others = 0, compared = 0;
};

// Traces both surfaces with the camera of `view`. A pixel of the low surface should show, on the baker's line through
// its surface point, the outermost high surface that faces outwards and that the camera sees. Rays from the eye decide
// this, independently of the baker's rule. Surfaces farther than RayStarts::limit or behind another part of the low
// surface do not count; if the camera sees none on the line, `expected` is unknown. Two surfaces are different if they
// are 0.001 of the diagonal of the low surface's box apart.
// Errors: those of LowTree::make and measureRayStarts.
Result<HighView> renderHighView(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                const View& view);

} // namespace cotan::app
