// Sampling an environment's atlas, whose layout shaders/cotan/environment.h describes, and the shadow on the ground.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/packed_only.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"
#include "scene/render_text.hpp"

namespace cotan {

inline constexpr float kBackdropRoughness = 0.6f; // of Backdrop::blurred
// Maximum half-width of a penumbra, as a fraction of the shadow map's side.
inline constexpr float kMaxPenumbra = 0.02f;

// Bilinear interpolation of at(x, y) at a position in texels, as GPUs filter.
template<class At> glm::vec3 bilinear(glm::vec2 texel, const At& at)
{
    const float fx = std::floor(texel.x - 0.5f), fy = std::floor(texel.y - 0.5f);
    const float kx = texel.x - 0.5f - fx, ky = texel.y - 0.5f - fy;
    const int x = int(fx), y = int(fy);
    const glm::vec3 top = at(x, y) * (1 - kx) + at(x + 1, y) * kx;
    const glm::vec3 bottom = at(x, y + 1) * (1 - kx) + at(x + 1, y + 1) * kx;
    return top * (1 - ky) + bottom * ky;
}

// Bilinear interpolation of a float32 image.
inline glm::vec3 readBilinear(const Image& image, glm::vec2 texel)
{
    return bilinear(texel, [&](int x, int y) {
        x = std::clamp(x, 0, image.width - 1);
        y = std::clamp(y, 0, image.height - 1);
        const float* p = image.floats() + 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
        return glm::vec3(p[0], p[1], p[2]);
    });
}

// Radiance along a direction of any length, filtered for a mirror of the given roughness.
inline glm::vec3 radianceAlong(const EnvironmentMap& map, glm::vec3 direction, float roughness)
{
    const float level = f32::cotan_saturate(roughness) * COTAN_ENVIRONMENT_STEPS;
    const float lower = std::min(std::floor(level), float(COTAN_ENVIRONMENT_STEPS - 1));
    const glm::vec3 a = readBilinear(map.atlas, f32::cotan_environment_texel(direction, lower));
    const glm::vec3 b = readBilinear(map.atlas, f32::cotan_environment_texel(direction, lower + 1));
    return a + (b - a) * (level - lower);
}

// Irradiance of a surface with the given normal, divided by pi.
inline glm::vec3 irradianceAlong(const EnvironmentMap& map, glm::vec3 normal)
{
    return readBilinear(map.atlas, f32::cotan_environment_texel(normal, COTAN_ENVIRONMENT_IRRADIANCE));
}

// The albedo factors of GGX under white light, see environment::albedoFactors.
inline glm::vec2 albedoOf(const EnvironmentMap& map, glm::vec3 n, glm::vec3 v, float roughness)
{
    const float nv = f32::cotan_saturate(glm::dot(n, v));
    const glm::vec3 albedo = readBilinear(map.atlas, f32::cotan_environment_albedo_texel(nv, roughness));
    return {albedo.x, albedo.y};
}

// Light of the environment that a surface reflects.
inline glm::vec3 reflectedGlossy(const EnvironmentMap& map, const f32::cotan_surface& s, const f32::cotan_gloss& g)
{
    const glm::vec3 mirrored = f32::cotan_mirrored(f32::cotan_reflecting_normal(s, g), s.v);
    return f32::cotan_reflect_image(s, g, irradianceAlong(map, s.n), radianceAlong(map, mirrored, s.roughness),
                                    albedoOf(map, s.n, s.v, s.roughness));
}

inline glm::vec3 reflectedOfCoat(const EnvironmentMap& map, const f32::cotan_coat& c, glm::vec3 v)
{
    return f32::cotan_reflect_coat_image(c, radianceAlong(map, f32::cotan_mirrored(c.n, v), c.roughness),
                                         albedoOf(map, c.n, v, c.roughness));
}

// The fraction of light that arrives at a point of the ground (world x and z); 1 outside the map.
inline float groundVisibilityAt(const GroundMap& map, glm::vec2 point)
{
    const glm::vec2 uv = (point - map.low) / map.extent;
    if (!(uv.x > 0 && uv.y > 0 && uv.x < 1 && uv.y < 1))
        return 1;
    return readBilinear(map.visibility, uv * glm::vec2(float(map.visibility.width), float(map.visibility.height))).x;
}

} // namespace cotan
