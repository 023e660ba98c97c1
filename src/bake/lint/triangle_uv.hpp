// How one triangle stretches its texture coordinates: what lint takes its shares of, and pictures show.
#pragma once

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

// surface: with uv.
TriangleUv triangleUv(const MappedSurface& surface, std::size_t triangle);
TriangleUv triangleUv(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges); // edgesOf it

} // namespace cotan
