// Built-in shapes and maps: analytic, made in memory, no files.
#pragma once

#include "cotan/scene/scene.hpp"

namespace cotan {

// Every shape has outward normals, uv set 0 and counter-clockwise triangles seen from outside.
// uv follow glTF: v = 0 at the top row of the image. `segments` is the number of cells along u.
Mesh makePlane(float side, int segments, float uvRepeat); // in xz, facing +y, centred
Mesh makeCube(float side, float uvRepeat);                // six faces, split at the edges
Mesh makeSphere(float radius, int segments);              // latitude-longitude, poles split
Mesh makeTorus(float majorRadius, float minorRadius, int segments, float repeatU, float repeatV);
// M. Newell's 32 patches, one high, resting on y = 0, the spout along +x. Every patch covers the
// unit square of uv: u around, v down the pot and along handle and spout.
Mesh makeTeapot(int segmentsPerPatch);
Mesh makeSpout(int segments); // bent, tapering, open tube; uv squashed at the tip
// A unit square patch in xy facing +z, centred, whose uv are p -> L^-1 p with L = [stretch, shear;
// 0, 1] and p measured rightwards and downwards from the top left corner; mirrored negates u.
// (Figure 2.6.4 of the 2006 chapter.)
Mesh makePatch(float stretch, float shear, bool mirrored, int segments);

enum class Relief { domes, bricks, waves };

// A height with its derivatives at (u,v), periodic in the unit square, v downwards.
struct HeightSample {
    double h = 0, hu = 0, hv = 0; // in uv units
};
HeightSample relief(Relief kind, double u, double v);

// The normal map of a relief from its analytic derivatives: 8 bit, exact expansion, green against
// +v (glTF). side: pixels, each texel sampled at its centre.
Image makeReliefMap(Relief kind, int side);

// One shape of white plastic alone, to look at maps on: "plane" (upright), "sphere", "torus" or "teapot"; the plane for
// all other names. It is about 2 units high; the torus repeats its texture six times around, the sphere twice.
Scene shapeScene(const std::string& shape);

// The built-in scene of `cotan render` without a model: a normal-mapped floor, the teapot and a
// few shapes; no tangent stored anywhere.
Scene builtinScene();

} // namespace cotan
