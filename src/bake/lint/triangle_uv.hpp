// How one triangle stretches its texture coordinates, and how its stored tangents lie against them: what lint takes its
// shares of, and pictures show.
#pragma once

#include <array>
#include <cstddef>

#include "bake/surface/mapped_surface.hpp"

namespace cotan {

struct TriangleUv {
    bool usable = false;     // it has an area in space; all else is 0 without
    bool degenerate = false; // uv along a line, or one point; stretch is 0 then
    double stretch = 0;      // the longer axis of uv's unit circle over the shorter: at least 1
    double shear = 0;        // degrees between the gradients of u and v and a right angle
    double gradient = 0;     // the longer of the two, per unit of length
    double density = 0;      // uv per unit of length: the root of the area in uv over that in space
    int orientation = 0;     // as orientationOf: -1 mirrored
};

// Of a triangle with these edges (edgesOf). surface: with uv.
TriangleUv triangleUv(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges);

// A stored tangent at one corner of a triangle, against the texture coordinates.
struct StoredCorner {
    bool compared = false; // there is a tangent and a dP/du to hold it against
    bool reversed = false; // w points against +v
    double degrees = 0;    // from dP/du, in the plane of the normal; 180 where the tangent has no direction there
};

// All corners of such a triangle. Nothing is compared where its uv have no area.
std::array<StoredCorner, 3> storedCorners(const MappedSurface& surface, std::size_t triangle,
                                          const TriangleEdges& edges);

} // namespace cotan
