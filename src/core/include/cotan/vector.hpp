// Supplements to GLM: vectors and matrices that may be zero or not finite, and the angle between two vectors.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cotan {

// Whether all components are finite.
template<glm::length_t N, class Real, glm::qualifier Q> bool isFinite(const glm::vec<N, Real, Q>& v)
{
    for (glm::length_t i = 0; i < N; ++i)
        if (!std::isfinite(v[i]))
            return false;
    return true;
}

template<glm::length_t C, glm::length_t R, class Real, glm::qualifier Q> bool isFinite(const glm::mat<C, R, Real, Q>& m)
{
    for (glm::length_t i = 0; i < C; ++i)
        if (!isFinite(m[i]))
            return false;
    return true;
}

// Returns v with length 1; `otherwise` if its length is not finite or not greater than `least`.
template<class Real, glm::qualifier Q>
glm::vec<3, Real, Q> unitOr(const glm::vec<3, Real, Q>& v, const glm::vec<3, Real, Q>& otherwise, Real least = 0)
{
    const Real length = glm::length(v);
    return length > least && std::isfinite(length) ? v / length : otherwise;
}

// Like unitOr with zero for `otherwise`; computed in double and rounded once.
inline glm::vec3 unitOrZero(const glm::dvec3& v) { return glm::vec3(unitOr(v, glm::dvec3(0))); }

// Returns the angle between two vectors of any length in radians, 0 to pi. Uses sine and cosine: in float, the cosine
// alone cannot distinguish 0.02 degrees from 0. 0 if a vector is zero; NaN if one is not finite.
template<class Real, glm::qualifier Q> Real angleBetween(const glm::vec<3, Real, Q>& a, const glm::vec<3, Real, Q>& b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace cotan
