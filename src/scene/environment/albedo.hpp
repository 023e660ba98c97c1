// What GGX reflects of white light from all around.
#pragma once

#include <glm/vec2.hpp>

namespace cotan::environment {

// The two factors of f0: albedo = f0 * x + y, for cotan_reflect_pbr's specular term (Smith-correlated GGX, Schlick's
// Fresnel), integrated over all lights. Sampled by the normals that are seen (E. Heitz, Sampling the GGX Distribution
// of Visible Normals, 2018).
// nv: cosine between normal and eye, held from 1e-4; roughness in [0,1], held from 0.045.
glm::dvec2 albedoFactors(double nv, double roughness);

} // namespace cotan::environment
