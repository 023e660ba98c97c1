// Scalar operations of the portable text, counted by running it with a counting number type.
#pragma once

#include <string_view>

namespace cotan::cost {

// Additions include subtractions; sign changes and constants are free. Computing the ten differences of a tangent-free
// frame is not counted.
struct Operations {
    int multiply = 0;
    int add = 0;
    int merged = 0; // the part of `add` that takes a product: free with a fused multiply-add
    int divide = 0;
    int root = 0; // sqrt
    int inverseRoot = 0;
    int maximum = 0; // min and max
    int compare = 0; // and selects
    int bits = 0;    // copying a sign, scaling by a power of two
    int total() const { return multiply + add + divide + root + inverseRoot + maximum + compare + bits; }
    int totalFused() const { return total() - merged; }
};

// Operations of a row of shaders/cost/rows.h, from interpolated inputs to the unit normal. All zero for an unknown
// name.
Operations operationsOfRow(std::string_view row);

// Operations of building the frame alone from a unit normal: the functions cotan_frame_NAME, including the guards of
// cotangent, gradient, orthonormal and exact. All zero for other names.
Operations operationsOfFrame(std::string_view frame);

// Operations of deriving U and V of a triangle from its edges in a vertex, mesh or compute stage:
// cotan_triangle_of_edges if `total`, else cotan_triangle_of_sound_edges.
Operations operationsOfTriangleVectors(bool total);

// Operations of cotan_safe_normal, which the total frames contain.
Operations operationsOfSafeNormal();

} // namespace cotan::cost
