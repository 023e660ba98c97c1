// The one texel that several places of a surface share.
#pragma once

#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "cotan/packed_only.hpp"

namespace cotan {

// What a place wants: normalize(frame * texel) = target.
struct Demand {
    glm::dmat3 frame{1}; // columns: t and b times the factor on the slopes, n
    glm::dvec3 target{0, 0, 1};
};

// Whether the frame turns different texels into different normals.
bool invertible(const glm::dmat3& frame);

// The unit texel that minimises the sum of |normalize(frame_i * texel) - target_i|^2: exact for one
// place, Gauss-Newton on the sphere of directions from the sum of the places' own texels for more.
// Demands whose frame is not invertible are left out; `otherwise` where there is no other.
glm::dvec3 solveTexel(std::span<const Demand> demands, glm::dvec3 otherwise);

// Degrees between what the place wants and what it gets.
double degreesOff(const Demand& demand, glm::dvec3 texel);

} // namespace cotan
