// Points of the low surface for a whole packet, in float: apart from the rays the most expensive part of a bake.
#pragma once

#include <span>

#include "bake/lanes.hpp"
#include "bake/surface/low_surface.hpp"
#include "bake/surface/uv_raster.hpp"

namespace cotan {

struct LowPoints {
    Lanes3 position, normal; // world; the normal unit as interpolated, or zero where unknown
    Lanes3 t, b, n;          // frame at the point

    // Inputs of the frame.
    struct FrameInputs {
        Lanes<float> b1{}, b2{}; // barycentric coordinates
        Lanes3 raw;              // interpolated normal, not normalised
        Lanes3 u, v;             // for frames from cotangents; u is the tangent for frames from tangents
        Lanes<float> handedness{};
        Lanes3 dpdx, dpdy;                   // differences, for all other frames
        Lanes<float> ux{}, uy{}, vx{}, vy{}; // duvdx.x, duvdy.x, duvdx.y, duvdy.y
    } from;
};

// Computes the points at up to kLanes samples. Equal to pointOf in double, except for rounding.
void pointsOf(const LowSurface& surface, std::span<const UvSample> samples, LowPoints& points);

// Encodes target normals as unit texels of these frames, by cotan_encode.
void encode(const LowPoints& points, const Lanes3& targets, Lanes3& texels);

} // namespace cotan
