#version 460
#extension GL_GOOGLE_include_directive : require
// The picture: material, frame, perturbed normal, light. Compiled a second time with COTAN_EXACT
// for the frame `exact`, which reads the triangle's vertices and so asks more of the device, and with
// COTAN_LAYERS for translucent materials, whose fragments are kept until they can be put in order.
#ifdef COTAN_EXACT
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#endif
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/normal.h"
#include "cotan/frame.h"
#include "cotan/triangle.h"
#include "cotan/light.h"
#include "cotan/tone.h"
#include "cotan/environment.h"
#include "cotan/shadow.h"
#include "bindings.glsl"
#include "constants.glsl"

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
layout(early_fragment_tests) in; // what opaque surfaces hide is not kept
#else
layout(location = 0) out vec4 outColor;
#endif

#include "frame.glsl"
#include "environment.glsl"
#include "lights.glsl"

bool present(uint map, CotanTextureUse use) { return (MAPS & map) != 0u && use.vRow.w > 0.5; }

vec4 sampled(sampler2D map, CotanTextureUse use)
{
    return texture(map, finiteUv(transformed(use, inTexcoords + inTexcoordOrigin)));
}

vec4 baseColor()
{
    vec4 color = material.baseColor * inColor;
    if (present(COTAN_MAP_BASE_COLOR, material.baseColorMap))
        color *= sampled(baseColorMap, material.baseColorMap);
    return color;
}

// The perturbed normal, outwards on the front side.
vec3 perturbed(cotan_frame frame, vec3 n)
{
    bool mapped = NORMAL_MAPS && present(COTAN_MAP_NORMAL, material.normalMapUse)
        && hasTexcoords(material.normalMapUse);
    if (!mapped)
        return n;
    cotan_normal_format format = cotan_normal_format(material.normalMap.x, material.normalMap.y,
        float(material.normalMap.z), material.factors.w);
    vec3 m = cotan_decode(sampled(normalMap, material.normalMapUse).xyz, format);
    return cotan_normalize_or(cotan_apply(frame, m), n);
}

// The coat's normal, outwards on the front side. frame: of the surface beneath.
vec3 coatNormal(cotan_frame frame, vec3 n)
{
    CotanTextureUse use = material.coatNormalMapUse;
    if (!NORMAL_MAPS || !present(COTAN_MAP_COAT_NORMAL, use) || !hasTexcoords(use))
        return n;
    if (material.coatNormalMap.w == 0)
        frame = frameOf(n, screenDifferences(inPosition, transformedDifference(use, inTexcoords)), use, false);
    cotan_normal_format format = cotan_normal_format(material.coatNormalMap.x,
        material.coatNormalMap.y, float(material.coatNormalMap.z), material.coat.z);
    vec3 m = cotan_decode(sampled(coatNormalMap, use).xyz, format);
    return cotan_normalize_or(cotan_apply(frame, m), n);
}

cotan_coat coatOf(cotan_frame frame, vec3 n, float side)
{
    cotan_coat c;
    c.strength = material.coat.x;
    if (present(COTAN_MAP_COAT, material.coatMap))
        c.strength *= sampled(coatMap, material.coatMap).r;
    c.roughness = material.coat.y;
    if (present(COTAN_MAP_COAT_ROUGHNESS, material.coatRoughnessMap))
        c.roughness *= sampled(coatRoughnessMap, material.coatRoughnessMap).g;
    c.n = coatNormal(frame, n) * side;
    return c;
}

// frame, smoothNormal: outwards on the front side. n: perturbed.
cotan_gloss glossOf(cotan_frame frame, vec3 smoothNormal, vec3 n)
{
    cotan_gloss g = cotan_gloss_of(1.5, 1.0, vec3(1.0));
    float strength = material.anisotropy.x;
    vec2 direction = material.anisotropy.yz;
    if (present(COTAN_MAP_ANISOTROPY, material.anisotropyMap)) {
        vec3 texel = sampled(anisotropyMap, material.anisotropyMap).rgb;
        vec2 turned = vec2(texel.r, -texel.g) * 2.0 + vec2(-1.0, 1.0);
        direction = vec2(turned.x * direction.x - turned.y * direction.y,
            turned.x * direction.y + turned.y * direction.x);
        strength *= texel.b;
    }
    g.t = cotan_direction_on_surface(smoothNormal, frame.t, frame.b, direction, n);
    g.anisotropy = dot(g.t, g.t) > 0.5 ? strength : 0.0;
    return g;
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
    s.v = view.forward.w > 0.5 ? cotan_normalize_or(-inPosition, n) : -view.forward.xyz;
    return s;
}

vec3 finiteVector(vec3 v) { return cotan_sum_abs(v) <= COTAN_HUGE ? v : vec3(0.0); }

// Everything but `shaded`: a vector, and 1 for "here is a surface".
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

#ifdef COTAN_LAYERS
void keepLayer(vec4 value, float depthX, float depthY)
{
    uint index = atomicAdd(lists.count, 1u);
    if (index >= lists.capacity)
        return;
    CotanLayer layer;
    layer.value = value;
    layer.depth = gl_FragCoord.z;
    layer.depthX = depthX;
    layer.depthY = depthY;
    layer.samples = uint(gl_SampleMaskIn[0]);
    layer.instance = draw.order;
#ifdef COTAN_EXACT
    layer.triangle = uint(gl_PrimitiveID);
#else
    layer.triangle = 0u;
#endif
    layer.before = atomicExchange(newest[pixelInBand()], index + 1u);
    layer.spare = 0u;
    layers[index] = layer;
}
#endif

void main()
{
    // Like the position, the uv are differentiated near zero, where floats are dense.
    vec2 uv = transformed(material.normalMapUse, inTexcoords + inTexcoordOrigin);
    Differences d =
        screenDifferences(inPosition, transformedDifference(material.normalMapUse, inTexcoords));
    cotan_differences safe = cotan_scale_differences(d.dpdx, d.dpdy, d.duvdx, d.duvdy);
    vec3 smoothNormal = cotan_safe_normal(inNormal, safe.dpdx, safe.dpdy);
    cotan_frame frame = frameOf(smoothNormal, d, material.normalMapUse, true);
    vec3 n = perturbed(frame, smoothNormal);
    // Seen from behind, the sheet shows the other side of the same bumps.
    float side = gl_FrontFacing ? 1.0 : -1.0;
    n *= side;

    vec4 base = baseColor();
    vec4 value;
    if (OUTPUT == OUTPUT_SHADED) {
        vec3 color = base.rgb;
        if (material.normalMap.w == 0) {
            cotan_surface s = surfaceOf(base.rgb, n);
            Layers over;
            over.glossy = SHADING == SHADING_PBR && (MAPS & COTAN_LAYER_GLOSS) != 0u;
            over.coated = SHADING == SHADING_PBR && (MAPS & COTAN_LAYER_COAT) != 0u;
            if (over.glossy)
                over.gloss = glossOf(frame, smoothNormal, n);
            if (over.coated)
                over.coat = coatOf(frame, smoothNormal, side);
            color = lit(s, over, inPosition, smoothNormal * side);
        }
        float alpha = ALPHA_MODE == ALPHA_BLEND ? clamp(base.a, 0.0, 1.0) : 1.0;
        value = vec4(finished(color), alpha);
    } else {
        value = vectorOutput(frame, n, uv);
    }
#ifdef COTAN_LAYERS
    float depthX = dFdx(gl_FragCoord.z);
    float depthY = dFdy(gl_FragCoord.z);
    if (value.a > 0.0)
        keepLayer(value, depthX, depthY);
#else
    outColor = value;
    // After every texture read: derivatives end where a neighbour is discarded.
    if (ALPHA_MODE == ALPHA_MASK && base.a < material.emissive.w)
        discard;
    if (ALPHA_MODE == ALPHA_BLEND && OUTPUT != OUTPUT_SHADED && base.a < 1.0 / 255.0)
        discard;
#endif
}
