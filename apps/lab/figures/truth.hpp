// The true perturbed normals by the surface's mathematics, and the errors of images against them.
#pragma once

#include <functional>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene.hpp"
#include "figure.hpp"

namespace cotan::figures {

using Height = std::function<HeightSample(double u, double v)>;

// The height of the map Relief::domes.
Height domeHeight();

// A point of a surface: its unit normal and the gradients of u and v, in world space.
struct SurfaceGradients {
    glm::dvec3 normal{0, 0, 1};
    glm::dvec3 u{0};
    glm::dvec3 v{0};
};

// Returns the surface at texture coordinates, or nothing where it should not be measured.
using Chart = std::function<std::optional<SurfaceGradients>(glm::dvec2 uv)>;

// The flat patch of makePatch in its own space, with texcoords multiplied by `repeat`.
Chart patchChart(double stretch, double shear, bool mirrored, double repeat);
// The sphere of makeSphere within 75 degrees of its equator, with texcoords multiplied by `repeat`.
Chart sphereChart(glm::dvec2 repeat);

// The normals n - s (h_u grad u + h_v grad v), s = 1 / the longer gradient, at the texcoords in the image `uv`
// (Output::uv). Pixels whose normal is tilted by less than `minTilt` degrees are left out. uv, height and chart use the
// same texcoords.
Image truthNormals(const Image& uv, const Height& height, const Chart& chart, double minTilt = 0);

// The normal map of a height in 16 bits, exact expansion, green against +v. An 8-bit map would add an error of 0.17
// degrees.
Image heightMap16(const Height& height, int side);

// Appends to a panel's caption the error given by the measure named `measure`. `what` precedes the numbers.
void addError(Figure& figure, std::size_t panel, std::string_view measure, std::string_view what = "Error");

// Angles between two images of directions, as statistics and as a heat map.
struct Compared {
    AngleStatistics degrees;
    Image heat;
};
Compared compareNormals(const Image& a, const Image& b);

// Leaves out pixels at an edge of the area that both images cover: for shapes that differ slightly.
Compared compareInterior(const Image& a, const Image& b);

} // namespace cotan::figures
