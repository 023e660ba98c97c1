#version 460
#extension GL_GOOGLE_include_directive : require
// Shades the scene: material, frame, perturbed normal, light. Compiled again with COTAN_EXACT for the frame `exact`,
// which reads the triangle's vertices and needs more device features; with COTAN_LAYERS for translucent materials,
// whose fragments are stored until they can be sorted; with COTAN_MASKED for masked materials, which write their sample
// coverage; and with COTAN_EXTENDED for materials with extensions.
#ifdef COTAN_EXACT
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#endif
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/normal.h"
#include "cotan/frame.h"
#include "cotan/history.h"
#include "cotan/triangle.h"
#include "cotan/light.h"
#include "cotan/sheen.h"
#include "cotan/tone.h"
#include "cotan/environment.h"
#include "cotan/quantise.h"
#include "cotan/shadow.h"
#ifdef COTAN_EXTENDED
#include "cotan/parallax.h"
#endif
#include "bindings.glsl"
#include "constants.glsl"
#include "sample_positions.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inTexcoords; // relative to the mesh's origin in uv
layout(location = 3) in vec4 inColor;
layout(location = 4) in vec4 inTangent;
layout(location = 5) in vec3 inCotangentU;
layout(location = 6) in vec3 inCotangentV;
layout(location = 7) flat in vec4 inTexcoordOrigin;

#ifdef COTAN_LAYERS
#include "layers.glsl"
layout(early_fragment_tests) in; // fragments behind opaque surfaces are not stored
#else
layout(location = 0) out vec4 outColor;
#endif

#include "frame.glsl"
#include "environment.glsl"
#include "lights.glsl"

// Differences of the interpolated unit normal to the next pixels.
struct NormalDifferences {
    vec3 x;
    vec3 y;
};

NormalDifferences normalDifferencesOf(vec3 smoothNormal)
{
    return NormalDifferences(dFdxFine(smoothNormal), dFdyFine(smoothNormal));
}

// The unit direction to the eye; n if the surface is there.
vec3 toEye(vec3 n) { return view.forward.w > 0.5 ? cotan_normalize_or(-inPosition, n) : -view.forward.xyz; }

bool present(uint map, CotanTextureUse use) { return (MAPS & map) != 0u && use.vRow.w > 0.5; }

#ifdef COTAN_EXTENDED
#include "relief.glsl"
#else
const bool RELIEF = false;
vec4 seenTexcoords() { return inTexcoords + inTexcoordOrigin; }
#endif

vec4 sampled(sampler2D map, CotanTextureUse use)
{
    vec2 uv = finiteUv(transformed(use, inTexcoords + inTexcoordOrigin));
    if (APART == 1.0 && !RELIEF)
        return texture(map, uv);
    // A level bias would not shrink the footprint of anisotropic filters. Relief jumps at its edges, the footprint does
    // not: it is that of the surface.
    vec2 dx = finiteUv(dFdxFine(uv) * APART), dy = finiteUv(dFdyFine(uv) * APART);
    return textureGrad(map, RELIEF ? finiteUv(transformed(use, seenTexcoords())) : uv, dx, dy);
}

vec4 baseColor()
{
    vec4 color = material.baseColor * inColor;
    if (present(COTAN_MAP_BASE_COLOR, material.baseColorMap))
        color *= sampled(baseColorMap, material.baseColorMap);
    return color;
}

bool hasNormalMap()
{
    return NORMAL_MAPS && present(COTAN_MAP_NORMAL, material.normalMapUse) && hasTexcoords(material.normalMapUse);
}

// The normal of a normal map texel, outwards on the front side.
vec3 normalOfTexel(vec4 texel, cotan_frame frame, vec3 n)
{
    cotan_normal_format format = cotan_normal_format(material.normalMap.x, material.normalMap.y,
        float(material.normalMap.z), material.factors.w);
    return cotan_normalize_or(cotan_apply(frame, cotan_decode(texel.xyz, format)), n);
}

// The perturbed normal, outwards on the front side. Adds the variance that the texel's length encodes to `variance`.
vec3 perturbed(cotan_frame frame, vec3 n, inout float variance)
{
    if (!hasNormalMap())
        return n;
    vec4 texel = sampled(normalMap, material.normalMapUse);
    if (SPECULAR_ANTIALIASING)
        variance += cotan_variance_of_length(texel.w);
    return normalOfTexel(texel, frame, n);
}

// Inputs of tapSurface from the pixel.
struct TapSource {
    cotan_frame frame;
    vec3 n; // interpolated, outwards on the front side
    float side; // 1 if seen from the front, -1 from behind
    NormalDifferences dn; // of the interpolated normals, over the pixel
    vec2 uv; // of the pixel's centre
    vec2 dx, dy; // of uv, over the footprint of one tap
    float variance; // of the interpolated normals in that footprint
    float roughness; // of the material, without added variance
    int tapsPerSide; // taps along each side of the pixel
};
TapSource tapSource;

// Chooses the number of taps by the roughness (the material's own). smoothVariance: of the interpolated normals.
void setTaps(cotan_frame frame, vec3 smoothNormal, float side, NormalDifferences dn, float smoothVariance, vec2 uv,
    Differences d, float roughness)
{
    if (!hasNormalMap())
        return;
    int tapsPerSide = int(cotan_samples_of_roughness(roughness));
    tapCount = tapsPerSide * tapsPerSide;
    tapSource = TapSource(frame, smoothNormal, side, dn, uv, finiteUv(d.duvdx / float(tapsPerSide)),
        finiteUv(d.duvdy / float(tapsPerSide)), smoothVariance / float(tapCount), roughness, tapsPerSide);
}

// Sets the normal of a tap from its part of the map and the surface's curvature; adds lost variance to the roughness.
cotan_surface tapSurface(cotan_surface s, int tap)
{
    if (tapCount == 1)
        return s;
    int tapsPerSide = tapSource.tapsPerSide;
    vec2 offset = vec2(float(tap % tapsPerSide), float(tap / tapsPerSide)) - 0.5 * float(tapsPerSide - 1);
    vec2 uv = finiteUv(tapSource.uv + tapSource.dx * offset.x + tapSource.dy * offset.y);
    vec4 texel = textureGrad(normalMap, uv, tapSource.dx * APART, tapSource.dy * APART);
    vec3 n = normalOfTexel(texel, tapSource.frame, tapSource.n);
    offset /= float(tapsPerSide);
    s.n = cotan_normalize_or(n + tapSource.dn.x * offset.x + tapSource.dn.y * offset.y, n) * tapSource.side;
    s.roughness =
        cotan_roughness_of_variance(tapSource.roughness, tapSource.variance + cotan_variance_of_length(texel.w));
    return s;
}

cotan_surface surfaceOf(vec3 base, vec3 n)
{
    cotan_surface s;
    s.base_color = base;
    s.metallic = material.factors.x;
    s.roughness = material.factors.y;
    float occlusion = 1.0;
    if (present(COTAN_MAP_METALLIC_ROUGHNESS, material.metallicRoughnessMap)) {
        vec4 texel = sampled(metallicRoughnessMap, material.metallicRoughnessMap);
        s.roughness *= texel.g;
        s.metallic *= texel.b;
        occlusion = (MAPS & COTAN_MAP_OCCLUSION_SHARED) != 0u ? texel.r : 1.0;
    }
    if (present(COTAN_MAP_OCCLUSION, material.occlusionMap))
        occlusion = sampled(occlusionMap, material.occlusionMap).r;
    s.occlusion = 1.0 + material.factors.z * (occlusion - 1.0);
    s.emissive = material.emissive.rgb;
    if (present(COTAN_MAP_EMISSIVE, material.emissiveMap))
        s.emissive *= sampled(emissiveMap, material.emissiveMap).rgb;
    s.n = n;
    s.v = toEye(n);
    return s;
}

#ifdef COTAN_EXTENDED
#include "material_layers.glsl"
#endif

vec3 finiteVector(vec3 v) { return cotan_sum_abs(v) <= COTAN_HUGE ? v : vec3(0.0); }

// All outputs but `shaded`: a vector, and alpha 1 for a covered pixel.
vec4 vectorOutput(cotan_frame frame, vec3 n, vec2 uv)
{
    vec3 v = n;
    if (OUTPUT == OUTPUT_TANGENT)
        v = frame.t;
    if (OUTPUT == OUTPUT_BITANGENT)
        v = frame.b;
    if (OUTPUT == OUTPUT_UV)
        v = vec3(uv, 0.0);
    if (OUTPUT == OUTPUT_DEPTH)
        v = vec3(dot(inPosition, view.forward.xyz), 0.0, 0.0);
    return vec4(finiteVector(v), 1.0);
}

// The samples that a masked material covers: those where alpha, as a plane over the pixel, reaches the cutoff. Its
// edges are as smooth as those of triangles. (B. Golus, Anti-aliased Alpha Test: The Esoteric Alpha To Coverage, 2017,
// sharpens alpha by the same differences.)
uint samplesOfMask(float alpha)
{
    vec2 slope = FOUR_SAMPLES ? vec2(dFdxFine(alpha), dFdyFine(alpha)) : vec2(0.0);
    uint samples = 0u;
    for (int i = 0; i < 4; ++i)
        samples |= alpha + dot(slope, kSampleOffsets[i]) < material.emissive.w ? 0u : 1u << i;
    return samples;
}

#ifdef COTAN_LAYERS
void storeLayer(vec3 light, vec3 transmittance, uint samples, float depthX, float depthY)
{
    if (outsideBand())
        return;
    uint index = atomicAdd(lists.count, 1u);
    if (index >= lists.capacity)
        return;
    CotanLayer layer;
    layer.light = vec4(light, gl_FragCoord.z);
    layer.transmittance = vec4(transmittance, depthX);
    layer.depthY = depthY;
    layer.orderAndCoverage = draw.order * 16u + (uint(gl_SampleMaskIn[0]) & samples);
#ifdef COTAN_EXACT
    layer.triangle = uint(gl_PrimitiveID);
#else
    layer.triangle = 0u;
#endif
    layer.previous = atomicExchange(newest[pixelInBand()], index + 1u);
    layers[index] = layer;
}
#endif

void main()
{
    // Differences of uv are taken relative to the mesh's origin, near zero, where floats are dense, as for positions.
    Differences d =
        screenDifferences(inPosition, transformedDifference(material.normalMapUse, inTexcoords));
    cotan_differences safe = cotan_scale_differences(d.dpdx, d.dpdy, d.duvdx, d.duvdy);
    vec3 smoothNormal = cotan_safe_normal(inNormal, safe.dpdx, safe.dpdy);
#ifdef COTAN_EXTENDED
    findRelief(smoothNormal, d.dpdx, d.dpdy);
#endif
    vec2 uv = transformed(material.normalMapUse, seenTexcoords());
    cotan_frame frame = frameOf(smoothNormal, d, material.normalMapUse, true);
    NormalDifferences dn = NormalDifferences(vec3(0.0), vec3(0.0));
    if (SPECULAR_ANTIALIASING)
        dn = normalDifferencesOf(smoothNormal);
    float smoothVariance = cotan_variance_of_curvature(dn.x, dn.y);
    float variance = smoothVariance;
    vec3 n = perturbed(frame, smoothNormal, variance);
    // From behind, the same bumps are seen from their other side.
    float side = gl_FrontFacing ? 1.0 : -1.0;
    n *= side;

    vec4 base = baseColor();
    vec4 value;
    vec3 transmitted = vec3(0.0);
    if (OUTPUT == OUTPUT_SHADED) {
        vec3 color = base.rgb;
        if (material.normalMap.w == 0) {
            cotan_surface s = surfaceOf(base.rgb, n);
            if (SPECULAR_ANTIALIASING) {
                setTaps(frame, smoothNormal, side, dn, smoothVariance, uv, d, s.roughness);
                s.roughness = cotan_roughness_of_variance(s.roughness, variance);
            }
            Layers over;
            over.glossy = over.sheened = over.coated = false;
#ifdef COTAN_EXTENDED
            addLayers(over, frame, smoothNormal, n, side, smoothVariance);
#endif
            color = lit(s, over, inPosition, smoothNormal * side);
            if (over.glossy && (MAPS & COTAN_LAYER_TRANSMISSION) != 0u)
                transmitted = finiteVector(transmittance(s, over));
        }
        float alpha = ALPHA_MODE == ALPHA_BLEND ? clamp(base.a, 0.0, 1.0) : 1.0;
        value = vec4(outputColor(color), alpha);
    } else {
        value = vectorOutput(frame, n, uv);
    }
#ifdef COTAN_LAYERS
    float depthX = dFdx(gl_FragCoord.z);
    float depthY = dFdy(gl_FragCoord.z);
    uint samples = ALPHA_MODE == ALPHA_MASK ? samplesOfMask(base.a) : 15u;
    if (value.a > 0.0 && samples != 0u)
        storeLayer(value.rgb * value.a, (1.0 - value.a) + transmitted * value.a, samples, depthX, depthY);
#else
    outColor = value;
#ifdef COTAN_MASKED
    gl_SampleMask[0] = int(samplesOfMask(base.a));
#endif
    if (ALPHA_MODE == ALPHA_BLEND && OUTPUT != OUTPUT_SHADED && base.a < 1.0 / 255.0)
        discard;
#endif
}
