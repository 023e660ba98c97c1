// Many points of the low surface at once, in float: what the baker spends its time on beside the rays.
#pragma once

#include <span>

#include "bake/lanes.hpp"
#include "bake/surface/low_surface.hpp"
#include "bake/surface/uv_raster.hpp"

namespace cotan {

struct LowPoints {
    Lanes3 position, normal; // world; the normal unit as interpolated, or zero where unknown
    Lanes3 t, b, n;          // the frame

    // What the frame is made from.
    struct Ingredients {
        Lanes<float> b1{}, b2{}; // barycentric coordinates
        Lanes3 raw;              // normal, not normalised
        Lanes3 u, v;             // of frames from cotangents; u of those from a tangent: the tangent
        Lanes<float> handedness{};
        Lanes3 dpdx, dpdy;                   // of the others: differences
        Lanes<float> ux{}, uy{}, vx{}, vy{}; // duvdx.x, duvdy.x, duvdx.y, duvdy.y
    } from;
};

// The points at up to kLanes places. The same as pointOf in double, to rounding.
void pointsOf(const LowSurface& surface, std::span<const UvSample> places, LowPoints& points);

// Unit texels of these frames, as encode has them.
void encode(const LowPoints& points, const Lanes3& targets, Lanes3& texels);

} // namespace cotan
