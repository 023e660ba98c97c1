// The angle between two vectors.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace cotan {

// Radians, 0 to pi. Lengths do not count. From sine and cosine: the cosine alone cannot tell 0.02 degrees from
// 0 in float. 0 where a vector is zero; NaN where one is not finite.
template<class Real, glm::qualifier Q> Real angleBetween(const glm::vec<3, Real, Q>& a, const glm::vec<3, Real, Q>& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace cotan
