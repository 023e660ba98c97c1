#version 460
#extension GL_GOOGLE_include_directive : require
// The picture: material, frame, perturbed normal, light. Compiled a second time with COTAN_EXACT
// for the frame `exact`, which reads the triangle's vertices and so asks more of the device, with
// COTAN_LAYERS for translucent materials, whose fragments are kept until they can be put in order, with COTAN_MASKED
// for masked ones, which say what samples they cover, and with COTAN_EXTENDED for those that extensions add to.
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
#include "bindings.glsl"
#include "constants.glsl"
#include "sample_places.glsl"

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

// The turn of the surface's own normals to the next pixels.
struct Turn {
    vec3 x;
    vec3 y;
};

Turn turnOf(vec3 smoothNormal)
{
    return COARSE_DERIVATIVES ? Turn(dFdxCoarse(smoothNormal), dFdyCoarse(smoothNormal))
                              : Turn(dFdxFine(smoothNormal), dFdyFine(smoothNormal));
}

bool present(uint map, CotanTextureUse use) { return (MAPS & map) != 0u && use.vRow.w > 0.5; }

vec4 sampled(sampler2D map, CotanTextureUse use)
{
    vec2 uv = finiteUv(transformed(use, inTexcoords + inTexcoordOrigin));
    if (APART == 1.0)
        return texture(map, uv);
    // A bias of the level would not shorten what anisotropic filters read.
    return textureGrad(map, uv, finiteUv(dFdxFine(uv) * APART), finiteUv(dFdyFine(uv) * APART));
}

vec4 baseColor()
{
    vec4 color = material.baseColor * inColor;
    if (present(COTAN_MAP_BASE_COLOR, material.baseColorMap))
        color *= sampled(baseColorMap, material.baseColorMap);
    return color;
}

bool mapped()
{
    return NORMAL_MAPS && present(COTAN_MAP_NORMAL, material.normalMapUse) && hasTexcoords(material.normalMapUse);
}

// The normal that a texel of the normal map says, outwards on the front side.
vec3 normalOfTexel(vec4 texel, cotan_frame frame, vec3 n)
{
    cotan_normal_format format = cotan_normal_format(material.normalMap.x, material.normalMap.y,
        float(material.normalMap.z), material.factors.w);
    return cotan_normalize_or(cotan_apply(frame, cotan_decode(texel.xyz, format)), n);
}

// The perturbed normal, outwards on the front side. spread: what the texel's length says is added to it.
vec3 perturbed(cotan_frame frame, vec3 n, inout float spread)
{
    if (!mapped())
        return n;
    vec4 texel = sampled(normalMap, material.normalMapUse);
    if (SPECULAR_ANTIALIASING)
        spread += cotan_spread_of_length(texel.w);
    return normalOfTexel(texel, frame, n);
}

// What atTap reads of the pixel.
struct TapSource {
    cotan_frame frame;
    vec3 n; // interpolated, outwards on the front side
    float side; // 1 seen from the front, -1 from behind
    Turn turn; // of the interpolated normals, over the pixel
    vec2 uv; // of the pixel's middle
    vec2 dx, dy; // of uv, over the part of a tap
    float spread; // of the interpolated normals in that part
    float roughness; // the material's own
    int aSide; // how many taps
};
TapSource tapSource;

// As many places as the roughness asks for. turned: the spread of the turn. roughness: the material's own.
void setTaps(cotan_frame frame, vec3 smoothNormal, float side, Turn turn, float turned, vec2 uv, Differences d,
    float roughness)
{
    if (!mapped())
        return;
    int aSide = int(cotan_places_of_roughness(roughness));
    tapCount = aSide * aSide;
    tapSource = TapSource(frame, smoothNormal, side, turn, uv, finiteUv(d.duvdx / float(aSide)),
        finiteUv(d.duvdy / float(aSide)), turned / float(tapCount), roughness, aSide);
}

// Its normal, from its part of the map and turned as the surface is there, and as rough as lost length says.
cotan_surface atTap(cotan_surface s, int tap)
{
    if (tapCount == 1)
        return s;
    int aSide = tapSource.aSide;
    vec2 place = vec2(float(tap % aSide), float(tap / aSide)) - 0.5 * float(aSide - 1);
    vec2 uv = finiteUv(tapSource.uv + tapSource.dx * place.x + tapSource.dy * place.y);
    vec4 texel = textureGrad(normalMap, uv, tapSource.dx * APART, tapSource.dy * APART);
    vec3 n = normalOfTexel(texel, tapSource.frame, tapSource.n);
    place /= float(aSide);
    s.n = cotan_normalize_or(n + tapSource.turn.x * place.x + tapSource.turn.y * place.y, n) * tapSource.side;
    s.roughness =
        cotan_roughness_of_spread(tapSource.roughness, tapSource.spread + cotan_spread_of_length(texel.w));
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
    s.v = view.forward.w > 0.5 ? cotan_normalize_or(-inPosition, n) : -view.forward.xyz;
    return s;
}

#ifdef COTAN_EXTENDED
#include "material_layers.glsl"
#endif

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

// The samples that a masked material covers: where alpha, taken as a plane over the pixel, is not below the cutoff. So
// an edge is as smooth as that of a triangle (B. Golus, Anti-aliased Alpha Test: The Esoteric Alpha To Coverage, 2017,
// sharpens alpha by the same differences).
uint samplesOfMask(float alpha)
{
    vec2 slope = FOUR_SAMPLES ? vec2(dFdxFine(alpha), dFdyFine(alpha)) : vec2(0.0);
    uint samples = 0u;
    for (int i = 0; i < 4; ++i)
        samples |= alpha + dot(slope, kSamplePlaces[i]) < material.emissive.w ? 0u : 1u << i;
    return samples;
}

#ifdef COTAN_LAYERS
void keepLayer(vec3 light, vec3 through, uint samples, float depthX, float depthY)
{
    if (outsideBand())
        return;
    uint index = atomicAdd(lists.count, 1u);
    if (index >= lists.capacity)
        return;
    CotanLayer layer;
    layer.light = vec4(light, gl_FragCoord.z);
    layer.through = vec4(through, depthX);
    layer.depthY = depthY;
    layer.place = draw.order * 16u + (uint(gl_SampleMaskIn[0]) & samples);
#ifdef COTAN_EXACT
    layer.triangle = uint(gl_PrimitiveID);
#else
    layer.triangle = 0u;
#endif
    layer.before = atomicExchange(newest[pixelInBand()], index + 1u);
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
    Turn turn = Turn(vec3(0.0), vec3(0.0));
    if (SPECULAR_ANTIALIASING)
        turn = turnOf(smoothNormal);
    float turned = cotan_spread_of_turn(turn.x, turn.y);
    float spread = turned;
    vec3 n = perturbed(frame, smoothNormal, spread);
    // Seen from behind, the sheet shows the other side of the same bumps.
    float side = gl_FrontFacing ? 1.0 : -1.0;
    n *= side;

    vec4 base = baseColor();
    vec4 value;
    vec3 passing = vec3(0.0);
    if (OUTPUT == OUTPUT_SHADED) {
        vec3 color = base.rgb;
        if (material.normalMap.w == 0) {
            cotan_surface s = surfaceOf(base.rgb, n);
            if (SPECULAR_ANTIALIASING) {
                setTaps(frame, smoothNormal, side, turn, turned, uv, d, s.roughness);
                s.roughness = cotan_roughness_of_spread(s.roughness, spread);
            }
            Layers over;
            over.glossy = over.sheened = over.coated = false;
#ifdef COTAN_EXTENDED
            addLayers(over, frame, smoothNormal, n, side, turned);
#endif
            color = lit(s, over, inPosition, smoothNormal * side);
            if (over.glossy && (MAPS & COTAN_LAYER_TRANSMISSION) != 0u)
                passing = finiteVector(transmittance(s, over));
        }
        float alpha = ALPHA_MODE == ALPHA_BLEND ? clamp(base.a, 0.0, 1.0) : 1.0;
        value = vec4(finished(color), alpha);
    } else {
        value = vectorOutput(frame, n, uv);
    }
#ifdef COTAN_LAYERS
    float depthX = dFdx(gl_FragCoord.z);
    float depthY = dFdy(gl_FragCoord.z);
    uint samples = ALPHA_MODE == ALPHA_MASK ? samplesOfMask(base.a) : 15u;
    if (value.a > 0.0 && samples != 0u)
        keepLayer(value.rgb * value.a, (1.0 - value.a) + passing * value.a, samples, depthX, depthY);
#else
    outColor = value;
#ifdef COTAN_MASKED
    gl_SampleMask[0] = int(samplesOfMask(base.a));
#endif
    if (ALPHA_MODE == ALPHA_BLEND && OUTPUT != OUTPUT_SHADED && base.a < 1.0 / 255.0)
        discard;
#endif
}
