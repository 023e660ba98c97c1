// Checks that a baked map shows the detailed surface: compares the simple mesh, drawn with the map, with the normals of
// the detailed surface that a camera sees.
#pragma once

#include "bake/bake_surfaces.hpp"
#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "cotan/view.hpp"

namespace cotan::app {

inline constexpr int kBakeViews = 4;  // front view, and rotations by 90 degrees
inline constexpr int kBakeSide = 640; // pixels

// A map and what it was baked from. References must stay valid until verifyBake returns.
struct BakeToVerify {
    const Scene& scene; // of the low surface
    const LowSurface& low;
    const HighSurface& high;
    const BakeOptions& options; // of the bake; its frame is used to draw
    const Image& map;
    Convention format;                              // of the map
    int material = -1;                              // index of the scene's material that uses the map; -1: all
    TangentOrigin tangents = TangentOrigin::stored; // used to draw
};

// Whether at most 1 % of the pixels of each view show another surface than the camera sees. Smaller fractions are rims
// of detached parts: at most 0.3 % of a view in the cases of tests/bake_cases.hpp, where maps that lose such parts have
// 2 % or more. True if nothing was compared.
bool showsHighSurface(const ComparedViews& compared);

// Draws kBakeViews views of the scene with the map and compares them. In the result `drawn` is the scene with the map,
// and `expected` the high surface where rays from the eye hit it; the degrees compare the pixels of the low surface
// with the filtered normals that renderHighView expects there. side: image size in pixels. Afterwards the renderer has
// no scene. Errors: those of Renderer::load, Renderer::draw and renderHighView; ErrorKind::usage if the scene lacks the
// material.
Result<ComparedViews> verifyBake(Renderer& renderer, const BakeToVerify& bake, int side = kBakeSide);

} // namespace cotan::app
