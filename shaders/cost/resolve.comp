#version 450
#extension GL_GOOGLE_include_directive : require
// The pass of `cotan cost` that resolves a visibility buffer, which stores the triangle of each pixel. It reads the
// three vertices, derives the barycentrics and their change to the next pixels from the rays, and samples the map with
// the gradients of uv. Then it evaluates one row of rows.h (named by COST_ROW). The mesh is relative to the camera.
// COST_TANGENT reads a stored tangent from the three vertices, COST_COTANGENTS two cotangents. COST_TRIANGLE computes U
// and V from the edges, COST_TRIANGLE_READ reads them. COST_EDGES uses the edges instead of the differences.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/normal.h"
#include "cotan/frame.h"
#include "cotan/history.h"
#include "cotan/fused.h"
#include "cotan/triangle.h"
#include "cotan/pack.h"
#include "cost/rows.h"
#include "cost/draw.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1) uniform sampler2D normalMap;
layout(std430, set = 0, binding = 7) buffer Pixels { uvec2 pixels[]; }; // in: triangle index plus 1; out: four halfs

const uint kWidth = 1024u;

// Barycentrics b1 and b2 where the ray meets the triangle's plane, by Cramer's rule.
vec2 barycentrics(vec3 ray, vec3 face, vec3 c1, vec3 c2)
{
    return vec2(dot(ray, c1), dot(ray, c2)) / dot(ray, face);
}

void main()
{
    uint pixel = gl_GlobalInvocationID.y * kWidth + gl_GlobalInvocationID.x;
    uint id = pixels[pixel].x;
    if (id == 0u)
        return;
    uint first = 3u * (id - 1u);
    uint v0 = indices[first];
    uint v1 = indices[first + 1u];
    uint v2 = indices[first + 2u];
    vec3 p0 = positionOf(v0);
    vec3 e1 = positionOf(v1) - p0;
    vec3 e2 = positionOf(v2) - p0;
    vec3 ray = projection[0].xyz + projection[1].xyz * float(gl_GlobalInvocationID.x)
        + projection[2].xyz * float(gl_GlobalInvocationID.y);
    vec3 face = cross(e1, e2);
    vec3 c1 = cross(e2, p0);
    vec3 c2 = cross(p0, e1);
    vec2 at = barycentrics(ray, face, c1, c2);
    vec2 atX = barycentrics(ray + projection[1].xyz, face, c1, c2) - at;
    vec2 atY = barycentrics(ray + projection[2].xyz, face, c1, c2) - at;
    vec2 uv0 = texcoordOf(v0);
    vec2 d1 = texcoordOf(v1) - uv0;
    vec2 d2 = texcoordOf(v2) - uv0;
    vec3 n0 = normalOf(v0);
    vec3 n1 = normalOf(v1);
    vec3 n2 = normalOf(v2);
    cost_inputs i;
    i.n = n0 * (1.0 - at.x - at.y) + n1 * at.x + n2 * at.y;
    vec2 uvX = d1 * atX.x + d2 * atX.y;
    vec2 uvY = d1 * atY.x + d2 * atY.y;
    i.duvdx = uvX;
    i.duvdy = uvY;
    i.dpdx = e1 * atX.x + e2 * atX.y;
    i.dpdy = e1 * atY.x + e2 * atY.y;
#ifdef COST_EDGES
    i.dpdx = e1;
    i.dpdy = e2;
    i.duvdx = d1;
    i.duvdy = d2;
#endif
#ifdef COST_TANGENT
    i.tangent = tangentOf(v0) * (1.0 - at.x - at.y) + tangentOf(v1) * at.x + tangentOf(v2) * at.y;
#endif
#ifdef COST_COTANGENTS
    i.cotangent_u = extraOf(2u * v0) * (1.0 - at.x - at.y) + extraOf(2u * v1) * at.x + extraOf(2u * v2) * at.y;
    i.cotangent_v =
        extraOf(2u * v0 + 1u) * (1.0 - at.x - at.y) + extraOf(2u * v1 + 1u) * at.x + extraOf(2u * v2 + 1u) * at.y;
#endif
#ifdef COST_TRIANGLE
    cotan_triangle t = cotan_triangle_of_sound_edges(e1, e2, d1, d2, n0 + n1 + n2);
    i.triangle_u = t.u;
    i.triangle_v = t.v;
#endif
#ifdef COST_TRIANGLE_READ
    cotan_packed_triangle packed = cotan_packed_triangle(floatBitsToUint(extra[first]),
        floatBitsToUint(extra[first + 1u]), floatBitsToUint(extra[first + 2u]));
    i.triangle_u = cotan_unpack_triangle_u(packed);
    i.triangle_v = cotan_unpack_triangle_v(packed);
#endif
    i.m = textureGrad(normalMap, uv0 + d1 * at.x + d2 * at.y, uvX, uvY).xyz * 2.0 - 1.0;
    vec3 color = COST_ROW(i) * 0.5 + 0.5;
    pixels[pixel] = uvec2(packHalf2x16(color.xy), packHalf2x16(vec2(color.z, 1.0)));
}
