// Polygons cut into triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace cotan {

// Cuts a polygon of three corners or more into corners - 2 triangles by clipping ears, as seen
// along its mean normal; holes that a bridge of two edges joins to the rim are fine. Appends three
// places in `corners` a triangle; their winding is the polygon's. Of a planar polygon that does not
// cross itself the triangles cover the polygon, once; of others, something near. A polygon without
// area becomes a fan.
// stepsLeft: comparisons of a corner with a triangle that may still be made, one budget for a
// model: many corners that turn inwards take the square of their number. False: it is used up.
bool cutPolygon(std::span<const glm::vec3> corners, std::vector<std::uint32_t>& triangles, std::size_t& stepsLeft);

} // namespace cotan
