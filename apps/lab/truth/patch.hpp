// Flat patches with known gradients, views and texels of them, and their true normals.
#pragma once

#include <array>
#include <numbers>

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

// The patch z = 0 with the given layout. Its gradients are the rows of the layout's inverse.
AffinePatch patchOf(const Layout& layout);

// Returns a random plane with stretched and skewed uv.
AffinePatch randomPatch(Random& random, bool mirrored);

// Returns a unit texel tilted by `degrees` towards a random direction.
glm::dvec3 tiltedTexel(Random& random, double degrees);

// The unit texel at (u,v) of domes of radius 0.1 on a 0.25 grid (Figure 2.6.4 of the 2006 chapter). The steepest slope
// is 0.92.
glm::dvec3 domeTexel(double u, double v);

// Truth S, scale invariant: normalize(s gradU m.x + s gradV m.y + n m.z), where s scales the longer gradient to length
// one.
glm::dvec3 truthS(const AffinePatch& patch, glm::dvec3 texel);

// Truth E, metric: the same formula with s = 1, so that bumps have the height given by the map.
glm::dvec3 truthE(const AffinePatch& patch, glm::dvec3 texel);

// A camera 5 units from the patch's origin at the given tilt and a random azimuth.
PixelCamera viewAt(Random& random, double tiltDegrees, bool orthographic);

// The perturbed normal by a frame made from differences: in double, or in float from differences rounded to float.
glm::dvec3 shade(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 texel);
glm::dvec3 shadeFloat(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 texel);
glm::dvec3 shadeFloat(Frame frame, glm::dvec3 n, const Differences<float>& d, glm::dvec3 texel);

} // namespace cotan
