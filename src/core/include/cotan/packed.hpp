// GLM's packed vectors and matrices, by the names of the usual ones: 3 floats are 12 bytes, even if a program defines
// GLM_FORCE_DEFAULT_ALIGNED_GENTYPES, which changes glm::vec3. Otherwise they are the usual types. The core's
// interfaces use them, so that program and library agree on the layout.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace cotan::packed {

template<glm::length_t N, class Real> using vec = glm::vec<N, Real, glm::packed_highp>;
template<glm::length_t N, class Real> using mat = glm::mat<N, N, Real, glm::packed_highp>;
using vec2 = vec<2, float>;
using vec3 = vec<3, float>;
using vec4 = vec<4, float>;

static_assert(sizeof(vec2) == 8 && sizeof(vec3) == 12 && sizeof(vec4) == 16 && alignof(vec4) == alignof(float),
              "Cotan expects GLM's packed vectors to be their numbers and nothing else");

} // namespace cotan::packed
