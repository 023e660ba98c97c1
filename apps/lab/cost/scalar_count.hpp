// Scalar operations of the portable text, counted by running it on numbers that count.
#pragma once

#include <string_view>

namespace cotan::cost {

// Additions include subtractions; sign changes and constants are free. The ten differences of a
// tangent-free frame are made before the count begins.
struct Operations {
    int multiply = 0;
    int add = 0;
    int merged = 0; // of `add`: those that take a product, which a fused multiply-add does for free
    int divide = 0;
    int root = 0; // sqrt
    int inverseRoot = 0;
    int maximum = 0; // min and max
    int compare = 0; // and selects
    int bits = 0;    // copying a sign, scaling by a power of two
    int total() const { return multiply + add + divide + root + inverseRoot + maximum + compare + bits; }
    int totalFused() const { return total() - merged; }
};

// Everything of that row of shaders/cost/rows.h: from interpolated inputs to the unit normal. All
// zero for a name that is no row.
Operations operationsOfRow(std::string_view row);

// Building the frame alone, from a unit normal: the functions cotan_frame_NAME, those of cotangent,
// gradient, orthonormal and exact with their guards. All zero for other names.
Operations operationsOfFrame(std::string_view frame);

// U and V of a triangle from its edges, for the vertex, mesh or compute stage: cotan_triangle_of_edges, or
// cotan_triangle_of_sound_edges.
Operations operationsOfTriangleVectors(bool total);

// cotan_safe_normal, which the total frames contain.
Operations operationsOfSafeNormal();

} // namespace cotan::cost
