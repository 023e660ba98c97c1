// Flat patches with known gradients, views of them and texels on them, and their true normals.
#pragma once

#include <array>
#include <numbers>

#include "cotan/packed_only.hpp"
#include "truth/quad.hpp"
#include "truth/random.hpp"

namespace cotan {

inline constexpr double kDegree = std::numbers::pi / 180;

// A layout of texture coordinates: position = [a b; c d] (u,v).
struct Layout {
    const char* name;
    double a, b, c, d;
};
inline constexpr std::array<Layout, 7> kLayouts = {{
    {"square", 1, 0, 0, 1},
    {"stretch 2:1", 2, 0, 0, 1},
    {"stretch 4:1", 4, 0, 0, 1},
    {"shear 45", 1, 1, 0, 1},
    {"stretch 2:1 and shear 45", 2, 1, 0, 1},
    {"mirrored", -1, 0, 0, 1},
    {"scale 3", 3, 0, 0, 3},
}};

// The patch z = 0 with that layout; its gradients are the rows of the layout's inverse.
AffinePatch patchOf(const Layout& layout);

// A random plane with stretched and skewed uv.
AffinePatch randomPatch(Random& random, bool mirrored);

// A unit texel tilted by `degrees` towards a random direction.
glm::dvec3 tiltedTexel(Random& random, double degrees);

// The texel, unit, of domes of radius 0.1 on a 0.25 grid of uv (Figure 2.6.4 of the 2006
// chapter); the steepest slope is 0.92.
glm::dvec3 domeTexel(double u, double v);

// Truth S, scale invariant: the gradients, scaled together so that the longer has length one, give
// normalize(s gradU m.x + s gradV m.y + n m.z).
glm::dvec3 truthS(const AffinePatch& patch, glm::dvec3 texel);

// Truth E, metric: the same with s = 1. Bumps have the height that the map says.
glm::dvec3 truthE(const AffinePatch& patch, glm::dvec3 texel);

// A camera 5 units from the patch's origin at that tilt, a random way round.
PixelCamera viewAt(Random& random, double tiltDegrees, bool orthographic);

// The perturbed normal of a frame made from differences, in double, and in float from differences
// rounded to float.
glm::dvec3 shade(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 texel);
glm::dvec3 shadeFloat(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 texel);
glm::dvec3 shadeFloat(Frame frame, glm::dvec3 n, const Differences<float>& d, glm::dvec3 texel);

} // namespace cotan
