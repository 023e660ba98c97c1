// How the atlas of the studio is stored, and the factors of GGX's albedo that every atlas holds.
#pragma once

#include <cstddef>

#include <glm/vec2.hpp>

#include "scene/picture_text.hpp"

namespace cotan::environment {

// The studio's atlas as the program holds it: halfs, rows first.
inline constexpr int kChannels = 3;
inline constexpr std::size_t kStudioHalfs = std::size_t(kChannels) * COTAN_ENVIRONMENT_WIDTH * COTAN_ENVIRONMENT_HEIGHT;

// The two factors of f0: albedo = f0 * x + y, for cotan_reflect_pbr's specular term (Smith-correlated GGX, Schlick's
// Fresnel), integrated over all lights. Sampled by the normals that are seen (E. Heitz, Sampling the GGX Distribution
// of Visible Normals, 2018).
// nv: cosine between normal and eye, held from 1e-4; roughness in [0,1], held from 0.045.
glm::dvec2 albedoFactors(double nv, double roughness);

} // namespace cotan::environment
