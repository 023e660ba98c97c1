// The storage format of the studio's atlas, and the GGX albedo factors that every atlas contains.
#pragma once

#include <cstddef>

#include <glm/vec2.hpp>

#include "scene/render_text.hpp"

namespace cotan::environment {

// The studio's atlas as embedded in the program: half floats, in rows.
inline constexpr int kChannels = 3;
inline constexpr std::size_t kStudioHalfs = std::size_t(kChannels) * COTAN_ENVIRONMENT_WIDTH * COTAN_ENVIRONMENT_HEIGHT;

// The factors of albedo = f0 * x + y, for cotan_reflect_pbr's specular term (Smith-correlated GGX, Schlick's Fresnel)
// integrated over all light directions. Samples visible normals (E. Heitz, Sampling the GGX Distribution of Visible
// Normals, 2018).
// nv: cosine between normal and eye, clamped to at least 1e-4. roughness: in [0,1], clamped to at least 0.045.
glm::dvec2 albedoFactors(double nv, double roughness);

} // namespace cotan::environment
