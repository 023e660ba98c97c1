#version 450
#extension GL_GOOGLE_include_directive : require
// The fragment shader of `cotan cost` for what is beyond the normal map. The floor perturbs the normal by the frame
// `gradient` and writes it with the roughness. COST_CURVATURE and COST_LENGTH add variances to the roughness;
// COST_OFFSET and COST_RELIEF move the coordinates of the map by a height in its fourth channel.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/normal.h"
#include "cotan/frame.h"
#include "cotan/light.h"
#include "cotan/parallax.h"
#include "cost/draw.glsl"

layout(location = 0) in vec3 position; // camera-relative
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(set = 0, binding = 1) uniform sampler2D normalMap;
layout(location = 0) out vec4 color;

const float kDepth = 0.05;

void main()
{
    vec2 dx = dFdx(uv);
    vec2 dy = dFdy(uv);
    cotan_frame f = cotan_frame_gradient(normal, dFdx(position), dFdy(position), dx, dy);
    vec2 at = uv;
#ifdef COST_OFFSET
    at += cotan_parallax_offset(f, -position, (texture(normalMap, uv).w - 1.0) * kDepth);
#endif
#ifdef COST_RELIEF
    cotan_relief r = cotan_relief_start(f, -position, uv, kDepth, 16.0);
    for (int i = 0; i < int(model[0].w); ++i) // not known to the compiler, so that the loop stays one
        r = cotan_relief_next(r, textureGrad(normalMap, r.uv, dx, dy).w);
    at = r.uv;
#endif
    vec4 texel = textureGrad(normalMap, at, dx, dy);
    float roughness = texel.w;
#if defined(COST_CURVATURE) || defined(COST_LENGTH)
    float variance = 0.0;
#ifdef COST_CURVATURE
    variance += cotan_variance_of_curvature(dFdx(f.n), dFdy(f.n));
#endif
#ifdef COST_LENGTH
    variance += cotan_variance_of_length(texel.w);
#endif
    roughness = cotan_roughness_of_variance(0.3, variance);
#endif
    color = vec4(cotan_apply(f, texel.xyz * 2.0 - 1.0) * 0.5 + 0.5, roughness);
}
