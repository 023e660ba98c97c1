// A stored tangent at one corner of a triangle, against the texture coordinates: what lint takes its shares of.
#pragma once

#include <array>
#include <cstddef>

#include "bake/surface/mapped_surface.hpp"

namespace cotan {

struct StoredCorner {
    bool compared = false; // there is a tangent and a dP/du to hold it against
    bool reversed = false; // w points against +v
    double degrees = 0;    // from dP/du, in the plane of the normal; 180 where the tangent has no direction there
};

// All corners of a triangle with these edges (edgesOf). surface: with uv. Nothing is compared where the triangle's uv
// have no area.
std::array<StoredCorner, 3> storedCorners(const MappedSurface& surface, std::size_t triangle,
                                          const TriangleEdges& edges);

} // namespace cotan
