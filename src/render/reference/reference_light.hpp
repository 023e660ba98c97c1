// From surface to radiance.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/portable.hpp"
#include "cotan/view.hpp"
#include "shadow.hpp"

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

struct TangentSpace;

// One of several normals of a pixel that are lit one by one.
struct LitTap {
    glm::vec3 n{0};
    float roughness = 0;
};

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
// tangent: where not null, lights are taken there and meet its surface in place of `surface`; highlights are not
// stretched.
glm::vec3 radianceOf(const f32::cotan_surface& surface, const Layers& layers, const LitPoint& point, const View& view,
                     const std::vector<PreparedLight>& lights, const ShadowMap& shadow,
                     const TangentSpace* tangent = nullptr);

// The factors, by colour, of what is behind a surface that transmits.
glm::vec3 transmittanceOf(const f32::cotan_surface& surface, const Layers& layers);

} // namespace cotan::reference
