// Clipping in homogeneous raster coordinates.
#pragma once

#include <array>

#include <glm/vec4.hpp>

namespace cotan::reference {

// A convex polygon; a triangle cut by five planes has at most eight corners.
struct Polygon {
    std::array<glm::dvec4, 8> corner;
    int count = 0;
};

// How far beyond the picture coordinates may reach, in pixels. Keeps the integers of the rasteriser
// small; what lies further out is cut.
inline constexpr double kGuardBand = 16384;

// The part of the triangle in front of the near plane (z <= w) and inside the guard band around
// a picture of width x height pixels. Two triangles that share an edge get the same corners on
// it, bit for bit. Nothing is left (count 0) of a triangle with a non-finite corner.
Polygon clip(const std::array<glm::dvec4, 3>& triangle, int width, int height);

} // namespace cotan::reference
