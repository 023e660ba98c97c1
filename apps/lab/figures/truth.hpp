// What the perturbed normals should be, from the surface's mathematics, and how far pictures are off.
#pragma once

#include <functional>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene.hpp"
#include "figure.hpp"

namespace cotan::figures {

using Height = std::function<HeightSample(double u, double v)>;

// That of the map Relief::domes.
Height domeHeight();

// A point of a surface: its unit normal and the gradients of u and v there, in the world.
struct SurfaceGradients {
    glm::dvec3 normal{0, 0, 1};
    glm::dvec3 u{0};
    glm::dvec3 v{0};
};

// The surface at texture coordinates; nothing where no truth is wanted.
using Chart = std::function<std::optional<SurfaceGradients>(glm::dvec2 uv)>;

// The flat patch of makePatch, in its own space, with texcoords multiplied by `repeat`.
Chart patchChart(double stretch, double shear, bool mirrored, double repeat);
// The sphere of makeSphere with texcoords multiplied by `repeat`, within 75 degrees of its equator.
Chart sphereChart(glm::dvec2 repeat);

// The normals n - s (h_u grad u + h_v grad v), s = 1 / the longer gradient, at the texcoords of a
// picture (Output::uv). Left out: pixels whose tilt is below `minTilt` degrees.
// uv, height and chart speak of the same texcoords.
Image truthNormals(const Image& uv, const Height& height, const Chart& chart, double minTilt = 0);

// The map of a height at 16 bits, exact expansion, green against +v; 8-bit maps would add 0.17
// degrees of their own.
Image heightMap16(const Height& height, int side);

// Says in a panel's caption how far it is off, from the measure of that name. `what`: before the numbers.
void addError(Figure& figure, std::size_t panel, std::string_view measure, std::string_view what = "Off");

// Angles between two pictures of directions, as numbers and as a heat map.
struct Compared {
    AngleStatistics degrees;
    Image heat;
};
Compared compareNormals(const Image& a, const Image& b);

// The same with pixels left out that touch an edge of what both cover: for shapes that differ a little.
Compared compareInterior(const Image& a, const Image& b);

} // namespace cotan::figures
