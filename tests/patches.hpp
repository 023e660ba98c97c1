// Flat patches, views and map texels that several tests share.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "cotan/truth/quad.hpp"
#include "cotan/truth/random.hpp"

namespace cotan::test {

inline constexpr double kDegree = std::numbers::pi / 180;

// uv layouts: position = [a b; c d] (u,v). square, 2:1, 4:1, 45 degree shear, both, mirrored, x3.
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
inline AffinePatch patchOf(const Layout& l)
{
    const double det = l.a * l.d - l.b * l.c;
    AffinePatch p;
    p.gradU = {l.d / det, -l.b / det, 0};
    p.gradV = {-l.c / det, l.a / det, 0};
    return p;
}

// A texel tilted by `degrees` towards a random direction.
inline glm::dvec3 tiltedTexel(Random& random, double degrees)
{
    const double azimuth = random.azimuth();
    const double s = std::sin(degrees * kDegree);
    return {s * std::cos(azimuth), s * std::sin(azimuth), std::cos(degrees * kDegree)};
}

// Truth S: gradients known, scaled together so that the longer has length one.
inline glm::dvec3 truthS(const AffinePatch& p, glm::dvec3 m)
{
    const double s = commonScale(p.gradU, p.gradV);
    return glm::normalize(p.gradU * (s * m.x) + p.gradV * (s * m.y) + p.normal * m.z);
}

// Truth E: bumps of a fixed height, nothing rescaled.
inline glm::dvec3 truthE(const AffinePatch& p, glm::dvec3 m)
{
    return glm::normalize(p.gradU * m.x + p.gradV * m.y + p.normal * m.z);
}

// A camera 5 units from the patch's origin at that tilt, a random way round.
inline PixelCamera viewAt(Random& random, double tiltDegrees, bool orthographic)
{
    const double a = tiltDegrees * kDegree;
    const double z = random.azimuth();
    const glm::dvec3 eye{5 * std::sin(a) * std::cos(z), 5 * std::sin(a) * std::sin(z), 5 * std::cos(a)};
    const glm::dvec3 up = tiltDegrees < 1 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    return PixelCamera::lookAt(eye, {0, 0, 0}, up, 900, orthographic);
}

// A random plane with skewed, stretched uv.
inline AffinePatch randomPatch(Random& random, bool mirrored)
{
    AffinePatch p;
    p.normal = random.direction();
    const glm::dvec3 e = glm::normalize(glm::cross(p.normal, random.direction()));
    const glm::dvec3 h = glm::cross(p.normal, e);
    const double a = random.azimuth();
    p.gradU = (e * std::cos(a) + h * std::sin(a)) * random.range(0.5, 2);
    p.gradV = (h * std::cos(a) - e * std::sin(a)) * (random.range(0.5, 2) * (mirrored ? -1 : 1))
        + p.gradU * random.range(-0.4, 0.4);
    return p;
}

// Applies a frame in double.
inline glm::dvec3 shade(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 m)
{
    return perturb(makeFrame(frame, Covector3d(n), d), m).raw();
}
// The same in float, from differences rounded to float.
inline glm::dvec3 shadeFloat(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 m)
{
    const auto f = makeFrame(frame, Covector3f(glm::vec3(n)), toFloat(d));
    return glm::dvec3(perturb(f, glm::vec3(m)).raw());
}

} // namespace cotan::test
