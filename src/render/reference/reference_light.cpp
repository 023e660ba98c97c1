#include "pixel.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "scene/environment_map.hpp"

namespace cotan::reference {

namespace {

// Light from one direction; the irradiance is on a plane perpendicular to it.
struct ArrivingLight {
    glm::vec3 toLight{0};
    glm::vec3 irradiance{0};
};

// Empty if no light reaches the point.
std::optional<ArrivingLight> arrivalOf(const PreparedLight& light, const LitPoint& point, const PixelInputs& all)
{
    glm::vec3 toLight = light.toLight;
    float strength = 1;
    if (light.kind != LightKind::directional) {
        const glm::vec3 offset = light.position - point.position;
        const float distance = glm::length(offset);
        toLight = offset / std::max(distance, 1e-6f);
        strength = f32::cotan_light_falloff(distance, light.range);
        if (light.kind == LightKind::spot)
            strength *= f32::cotan_smooth(light.cosOuter, light.cosInner, glm::dot(toLight, light.toLight));
    } else if (light.castsShadow) {
        strength = lightVisibility(all.shadow, point.position, point.normal, toLight, all.view.shadowSoftness);
    }
    if (!(strength > 0))
        return std::nullopt;
    return ArrivingLight{toLight, light.radiance * strength};
}

// The light reflected by a surface.
glm::vec3 reflected(const f32::cotan_surface& surface, const Layers& layers, glm::vec3 toLight, Shading shading)
{
    if (shading == Shading::blinnPhong)
        return f32::cotan_reflect_blinn_phong(surface, toLight);
    const glm::vec3 light = layers.gloss ? f32::cotan_reflect_glossy(surface, *layers.gloss, toLight)
                                         : f32::cotan_reflect_pbr(surface, toLight);
    return layers.sheen ? f32::cotan_reflect_sheen(*layers.sheen, surface.n, surface.v, toLight, light) : light;
}

glm::vec3 environmentLight(const f32::cotan_surface& surface, const Layers& layers, const View& view)
{
    const f32::cotan_gloss gloss = layers.gloss.value_or(f32::cotan_plain_gloss());
    const glm::vec3 light = view.environmentMap ? reflectedGlossy(*view.environmentMap, surface, gloss)
                                                : f32::cotan_reflect_environment_glossy(surface, gloss);
    if (!layers.sheen)
        return light;
    const glm::vec3 irradiance =
        view.environmentMap ? irradianceAlong(*view.environmentMap, surface.n) : f32::cotan_environment(surface.n, 1);
    return f32::cotan_reflect_sheen_around(*layers.sheen, surface.n, surface.v, irradiance * surface.occlusion, light);
}

// The mean of what the surface reflects with each of the point's normals.
template<class Reflect> glm::vec3 meanOfTaps(f32::cotan_surface surface, const LitPoint& point, const Reflect& reflect)
{
    if (point.taps.empty())
        return reflect(surface);
    glm::vec3 sum(0);
    for (const LitTap& tap : point.taps) {
        surface.n = tap.n;
        surface.roughness = tap.roughness;
        sum += reflect(surface);
    }
    return sum / float(point.taps.size());
}

} // namespace

std::vector<PreparedLight> prepareLights(const View& view, glm::dvec3 eye)
{
    std::vector<PreparedLight> prepared;
    bool shadowAssigned = !view.shadows;
    for (const Light& light : view.lights) {
        PreparedLight p;
        p.kind = light.kind;
        p.radiance = light.color * light.intensity;
        p.position = glm::vec3(glm::dvec3(light.position) - eye);
        p.toLight = f32::cotan_normalize_or(-light.direction, glm::vec3(0, 1, 0));
        p.range = light.range;
        p.cosOuter = std::cos(light.outerCone);
        // The minimum difference of the cosines prevents 0/0 for a cone without a soft rim.
        p.cosInner = std::max(std::cos(light.innerCone), p.cosOuter + 1e-4f);
        p.castsShadow = !shadowAssigned && light.kind == LightKind::directional;
        shadowAssigned = shadowAssigned || p.castsShadow;
        prepared.push_back(p);
    }
    return prepared;
}

glm::vec3 radianceOf(const PixelInputs& all, const SurfaceInputs& in, int lane, const f32::cotan_surface& surface,
                     const Layers& layers, const LitPoint& point)
{
    const View& view = all.view;
    glm::vec3 radiance = surface.emissive, fromCoat(0);
    for (const PreparedLight& light : all.lights) {
        const std::optional<ArrivingLight> arrival = arrivalOf(light, point, all);
        if (!arrival || (light.castsShadow && reliefLight(in, lane, arrival->toLight) == 0))
            continue;
        radiance += arrival->irradiance * meanOfTaps(surface, point, [&](const f32::cotan_surface& s) {
                        return reflected(s, layers, arrival->toLight, view.shading);
                    });
        if (layers.coat)
            fromCoat += arrival->irradiance * f32::cotan_reflect_coat(*layers.coat, surface.v, arrival->toLight);
    }
    if (view.environment) {
        radiance +=
            meanOfTaps(surface, point, [&](const f32::cotan_surface& s) { return environmentLight(s, layers, view); });
        if (layers.coat)
            fromCoat += surface.occlusion
                * (view.environmentMap ? reflectedOfCoat(*view.environmentMap, *layers.coat, surface.v)
                                       : f32::cotan_reflect_coat_environment(*layers.coat, surface.v));
    }
    if (!layers.coat)
        return radiance;
    return radiance * (1 - f32::cotan_coat_fraction(*layers.coat, surface.v)) + fromCoat;
}

glm::vec3 transmittanceOf(const f32::cotan_surface& surface, const Layers& layers)
{
    if (!layers.gloss)
        return glm::vec3(0);
    glm::vec3 transmittance = f32::cotan_transmittance(surface, *layers.gloss);
    if (layers.sheen)
        transmittance *= 1 - f32::cotan_sheen_fraction(*layers.sheen, std::abs(glm::dot(surface.n, surface.v)));
    if (layers.coat)
        transmittance *= 1 - f32::cotan_coat_fraction(*layers.coat, surface.v);
    return transmittance;
}

} // namespace cotan::reference
