// The teapot's patches as numbers; makeTeapot (shapes.hpp) tessellates them.
#pragma once

#include <array>
#include <cstdint>

namespace cotan::teapot {

inline constexpr int kPatchCount = 32;
inline constexpr int kControlPointCount = 306;

struct ControlPoint {
    double x, y, z;
};
using Patch = std::array<std::uint16_t, 16>; // four rows of four control points

extern const std::array<Patch, kPatchCount> kPatches;
extern const std::array<ControlPoint, kControlPointCount> kControlPoints;

} // namespace cotan::teapot
