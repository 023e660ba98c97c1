// Whether a baked map shows the detailed surface: the simple one drawn with the map, and its normals compared
// with those of the detailed surface that a camera sees.
#pragma once

#include "bake/bake_surfaces.hpp"
#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "cotan/view.hpp"

namespace cotan::app {

inline constexpr int kBakeViews = 4;  // from the front, and turned by quarters
inline constexpr int kBakeSide = 640; // pixels

// A map and what it was baked from. All of it is the caller's, and must live until verifyBake returns.
struct BakeToVerify {
    const Scene& scene; // of the low surface
    const LowSurface& low;
    const HighSurface& high;
    const BakeOptions& options; // that the map was baked with; its frame draws
    const Image& map;
    Convention format;                              // of the map
    int material = -1;                              // index of the scene's material that reads the map; -1: all do
    TangentOrigin tangents = TangentOrigin::stored; // that are drawn with
};

// Whether no view shows another surface than the camera sees on more than 1 % of its pixels. Less than that are rims of
// parts that stand off: at most 0.3 % of a view in the cases of tests/bake_cases.hpp, where maps that lose such parts
// have 2 % and more. True where nothing was compared.
bool showsHighSurface(const ComparedViews& compared);

// Draws kBakeViews of the scene with the map and compares. In the result `drawn` is the scene with the map, `expected`
// the high surface itself, as rays from the eye meet it; the degrees compare the pixels of the low surface with those
// normals of the high one that belong there (seeHigh). side: of a picture, in pixels. The renderer has no scene
// afterwards. Errors: those of Renderer::load, Renderer::draw and seeHigh; ErrorKind::usage for a material that the
// scene does not have.
Result<ComparedViews> verifyBake(Renderer& renderer, const BakeToVerify& bake, int side = kBakeSide);

} // namespace cotan::app
