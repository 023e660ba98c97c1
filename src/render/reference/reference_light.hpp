// From surface to radiance.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/portable.hpp"
#include "cotan/view.hpp"
#include "shadow.hpp"
#include "surface.hpp"

namespace cotan::reference {

// A light, ready for shading.
struct PreparedLight {
    LightKind kind = LightKind::directional;
    glm::vec3 radiance{0};      // colour times intensity
    glm::vec3 position{0};      // relative to the eye
    glm::vec3 toLight{0, 1, 0}; // unit, against the way the light travels
    float range = 0;
    float cosInner = 1;
    float cosOuter = 0;
    bool castsShadow = false;
};

// The view's lights; the first directional one casts the shadow, if the view has shadows.
std::vector<PreparedLight> prepareLights(const View& view, glm::dvec3 eye);

// Lighting in tangent space, as tutorials do it: vectors come to the map's normal, not it to them. Vectors along t, b,
// n n of a pixel.
struct TangentSpace {
    f32::cotan_surface surface; // n: the texel; v: carried to tangent space
    f32::cotan_frame pixel{};   // in the pixel
    bool perVertex = false;     // carry at the corners, and interpolate
    std::array<f32::cotan_frame, 3> corners{};
    std::array<glm::vec3, 3> positions{}; // of the corners, relative to the eye
    std::array<double, 3> weights{};
};

// Nothing where the view lights in the world, where there is no normal map, and where what is asked
// for is missing: tangents at the vertices, or a frame that can be inverted.
// surface: in the world.
std::optional<TangentSpace> tangentSpaceOf(const SurfaceInputs& in, int lane, const SurfaceNormal& normal,
                                           const f32::cotan_surface& surface, bool orthographic);

// A shaded point, beyond what the portable text's surface holds.
struct LitPoint {
    glm::vec3 position{0};        // relative to the eye
    glm::vec3 normal{0};          // unit, not perturbed, on the camera's side: for the shadow
    std::span<const LitTap> taps; // what is reflected is their mean; none: as the surface says
};

// What extensions add to a surface, in the world. Blinn-Phong has none of it.
struct Layers {
    std::optional<f32::cotan_gloss> gloss; // in place of metallic-roughness' own reflections
    std::optional<f32::cotan_sheen> sheen;
    std::optional<f32::cotan_coat> coat;
};

// Linear radiance towards the eye: lights, environment, emission. Not yet exposed.
// tangent: where there is one, lights are taken there and meet its surface in place of `surface`; highlights are not
// stretched.
glm::vec3 radianceOf(const f32::cotan_surface& surface, const Layers& layers, const LitPoint& point, const View& view,
                     const std::vector<PreparedLight>& lights, const ShadowMap& shadow,
                     const std::optional<TangentSpace>& tangent);

// The factors, by colour, of what is behind a surface that transmits.
glm::vec3 transmittanceOf(const f32::cotan_surface& surface, const Layers& layers);

// ---- light on rays: classic normal mapping, and two facets that make a surface of a turned normal
// --------------------

// Light from one direction, of that irradiance perpendicular to it.
struct ArrivingLight {
    glm::vec3 toLight{0};
    glm::vec3 irradiance{0};
};

// A point seen by rays. All in the world.
struct FacetPoint {
    f32::cotan_surface surface; // its n is the turned normal
    f32::cotan_gloss gloss;     // even highlights: anisotropy counts as 0
    glm::vec3 normal{0};        // not turned, unit, on the eye's side
    std::uint32_t seed = 0;     // of the random numbers
};

// Linear radiance towards the eye of what lights and, where the view has one, the environment give, by one of
// View::normalMapping's ways but `shading`: the mean of 64 walks. Emission is not in it.
// A direction to the eye below the surface counts as one along it.
glm::vec3 radianceByRays(const FacetPoint& point, const View& view, const std::vector<ArrivingLight>& lights);

} // namespace cotan::reference
