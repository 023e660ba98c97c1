#include "pixel.hpp"

#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/environment_map.hpp"

namespace cotan::reference {

namespace {

constexpr float kMaxHalf = 65504; // largest value of a half-float target

// Roughness of the gradient environment as a backdrop.
constexpr float kBackgroundBlur = 0.35f;

glm::vec3 finite(glm::vec3 v)
{
    for (int i = 0; i < 3; ++i)
        v[i] = std::isfinite(v[i]) ? v[i] : 0.0f;
    return v;
}

// The value to write for a radiance: exposed, finite, and tone mapped unless the view is linear.
glm::vec3 displayed(const View& view, glm::vec3 radiance)
{
    const glm::vec3 c = glm::clamp(finite(radiance * view.exposure), 0.0f, kMaxHalf);
    return view.linearOutput ? c : f32::cotan_tone_of(int(view.toneMapping), c);
}

f32::cotan_surface surfaceOf(const PixelInputs& all, const SurfaceInputs& in, glm::vec3 baseColor, int lane,
                             glm::vec3 n)
{
    const Material& m = *in.draw->material;
    glm::vec4 mr = mapTexel(in, in.draw->maps->metallicRoughness, m.metallicRoughnessMap, lane);
    glm::vec4 occlusion = mapTexel(in, in.draw->maps->occlusion, m.occlusionMap, lane);
    glm::vec4 emissive = mapTexel(in, in.draw->maps->emissive, m.emissiveMap, lane);
    f32::cotan_surface s;
    s.base_color = baseColor;
    s.metallic = f32::cotan_saturate(m.metallic * mr.z);
    s.roughness = f32::cotan_saturate(m.roughness * mr.y);
    s.occlusion = 1 + m.occlusionStrength * (occlusion.x - 1);
    s.emissive = m.emissive * glm::vec3(emissive);
    s.n = n;
    s.v = toEye(all.projection, in.points->position[std::size_t(lane)]);
    return s;
}

// Sets direction and strength of the anisotropy from the factors and the map.
void setAnisotropy(f32::cotan_gloss& gloss, const SurfaceInputs& in, int lane, const SurfaceNormal& normal)
{
    const Anisotropy& a = in.draw->material->anisotropy;
    glm::vec2 direction(std::cos(a.rotation), -std::sin(a.rotation)); // along +u and +v
    gloss.anisotropy = a.strength;
    if (in.draw->maps->anisotropy) {
        const glm::vec4 texel = mapTexel(in, in.draw->maps->anisotropy, a.map, lane);
        const glm::vec2 turn = glm::vec2(texel.x, -texel.y) * 2.0f + glm::vec2(-1, 1);
        direction = {turn.x * direction.x - turn.y * direction.y, turn.x * direction.y + turn.y * direction.x};
        gloss.anisotropy *= texel.z;
    }
    const f32::cotan_frame& frame = normal.frame;
    gloss.t = f32::cotan_direction_on_surface(normal.interpolated, frame.t, frame.b, direction, normal.perturbed);
    if (gloss.t == glm::vec3(0))
        gloss.anisotropy = 0;
}

Layers layersOf(const PixelInputs& all, const SurfaceInputs& in, int lane, const SurfaceNormal& normal)
{
    Layers layers;
    const Material& m = *in.draw->material;
    if (all.view.shading == Shading::blinnPhong)
        return layers;
    if (m.glossy()) {
        const glm::vec4 strength = mapTexel(in, in.draw->maps->specular, m.specular.map, lane);
        const glm::vec4 color = mapTexel(in, in.draw->maps->specularColor, m.specular.colorMap, lane);
        layers.gloss = f32::cotan_gloss_of(m.specular.ior, f32::cotan_saturate(m.specular.strength * strength.w),
                                           m.specular.color * glm::vec3(color));
        layers.gloss->transmission = f32::cotan_saturate(
            m.transmission.strength * mapTexel(in, in.draw->maps->transmission, m.transmission.map, lane).x);
        if (m.anisotropy.strength > 0)
            setAnisotropy(*layers.gloss, in, lane, normal);
    }
    if (m.sheen.present()) {
        const glm::vec4 color = mapTexel(in, in.draw->maps->sheenColor, m.sheen.colorMap, lane);
        const glm::vec4 roughness = mapTexel(in, in.draw->maps->sheenRoughness, m.sheen.roughnessMap, lane);
        layers.sheen =
            f32::cotan_sheen{m.sheen.color * glm::vec3(color), f32::cotan_saturate(m.sheen.roughness * roughness.w)};
    }
    if (m.coat.strength > 0) {
        f32::cotan_coat coat;
        coat.strength = f32::cotan_saturate(m.coat.strength * mapTexel(in, in.draw->maps->coat, m.coat.map, lane).x);
        coat.roughness = f32::cotan_saturate(m.coat.roughness
                                             * mapTexel(in, in.draw->maps->coatRoughness, m.coat.roughnessMap, lane).y);
        const CoatNormal own = coatNormalOf(in, lane, normal);
        coat.n = own.n;
        if (all.view.specularAntialiasing)
            coat.roughness = f32::cotan_roughness_of_variance(coat.roughness, own.variance);
        layers.coat = coat;
    }
    return layers;
}

// Returns the radiance that leaves the surface, and its transmittance.
std::pair<glm::vec3, glm::vec3> shadedColor(const PixelInputs& all, const SurfaceInputs& in, glm::vec3 baseColor,
                                            int lane)
{
    if (in.draw->material->unlit)
        return {baseColor, glm::vec3(0)};
    SurfaceNormal normal = normalOf(in, lane);
    f32::cotan_surface surface = surfaceOf(all, in, baseColor, lane, normal.perturbed);
    LitPoint point{
        in.points->position[std::size_t(lane)], in.triangle->front ? normal.interpolated : -normal.interpolated, {}};
    std::vector<LitTap> taps;
    if (all.view.specularAntialiasing) {
        if (normal.mapped)
            taps = tapsOf(in, lane, normal, surface.roughness);
        point.taps = taps;
        surface.roughness = f32::cotan_roughness_of_variance(surface.roughness, normal.variance);
    }
    const Layers layers = layersOf(all, in, lane, normal);
    return {radianceOf(all, in, lane, surface, layers, point), transmittanceOf(surface, layers)};
}

glm::vec3 dataOutput(const PixelInputs& all, const SurfaceInputs& in, int lane)
{
    if (all.view.output == Output::depth) {
        glm::dvec3 p = in.points->position[std::size_t(lane)];
        return {float(glm::dot(p, all.projection.forward)), 0, 0};
    }
    SurfaceNormal normal = normalOf(in, lane);
    switch (all.view.output) {
    case Output::tangent: return normal.t;
    case Output::bitangent: return normal.b;
    case Output::uv: return {normal.uv, 0};
    default: return normal.perturbed;
    }
}

glm::vec3 backdropAlong(const View& view, glm::vec3 ray)
{
    if (view.backdrop == Backdrop::paper)
        return f32::cotan_paper(ray) / view.exposure;
    if (view.backdrop == Backdrop::gradient || !view.environmentMap)
        return f32::cotan_environment(ray, kBackgroundBlur);
    return radianceAlong(*view.environmentMap, ray, view.backdrop == Backdrop::sharp ? 0 : kBackdropRoughness);
}

} // namespace

std::optional<Fragment> shade(const PixelInputs& all, const SurfaceInputs& in, int lane)
{
    const glm::vec4 base = baseColorOf(in, lane);
    const bool blend = in.draw->material->alphaMode == AlphaMode::blend, shaded = all.view.output == Output::shaded;
    if (blend && (shaded ? !(base.w > 0) : base.w < 1.0f / 255.0f))
        return std::nullopt;
    if (!shaded)
        return Fragment{.value = glm::vec4(finite(dataOutput(all, in, lane)), 1)};
    const auto [radiance, transmittance] = shadedColor(all, in, glm::vec3(base), lane);
    const float alpha = blend ? f32::cotan_saturate(base.w) : 1;
    return Fragment{glm::vec4(displayed(all.view, radiance), alpha), (1 - alpha) + finite(transmittance) * alpha};
}

glm::vec4 background(const PixelInputs& all, int x, int y)
{
    const View& view = all.view;
    if (view.output != Output::shaded || !(view.background || view.ground))
        return glm::vec4(0);
    const glm::vec3 ray = rayDirection(all.projection, x + 0.5, y + 0.5);
    float visibility = 1;
    if (view.ground) {
        const glm::dvec3 start = rayOrigin(all.projection, x + 0.5, y + 0.5); // relative to the eye
        const double height = view.ground->height - all.projection.eye.y;
        const glm::dvec2 point = f64::cotan_ground_point(start, glm::dvec3(ray), height);
        visibility =
            groundVisibilityAt(*view.ground, glm::vec2(point + glm::dvec2(all.projection.eye.x, all.projection.eye.z)));
    }
    return view.background ? glm::vec4(displayed(view, backdropAlong(view, ray) * visibility), 1)
                           : glm::vec4(0, 0, 0, 1 - visibility);
}

} // namespace cotan::reference
