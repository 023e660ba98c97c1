#version 450
#extension GL_GOOGLE_include_directive : require
// The vertex stage of `cotan cost`: position, normal and uv; with COST_TANGENT also a stored tangent, with
// COST_COTANGENTS two stored cotangents. Each is fetched, transformed to the space of the frame and output for
// interpolation. COST_PACKED8, COST_PACKED4, COST_PACKED2: fetched in 8, 4 or 2 bytes.
// With COST_TRIANGLE or COST_TRIANGLE_HALFS vertex i is the provoking vertex of triangle i: it reads the triangle's
// vertices and outputs U and V.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/history.h"
#include "cotan/triangle.h"
#include "cotan/pack.h"
layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;
#ifdef COST_TANGENT
#ifdef COST_PACKED2
layout(location = 3) in uint inPacked;
#else
layout(location = 3) in vec4 inTangent;
#endif
layout(location = 3) out vec4 tangent;
#endif
#ifdef COST_COTANGENTS
#if defined(COST_PACKED8)
layout(location = 3) in vec4 inPacked;
#elif defined(COST_PACKED4)
layout(location = 3) in uint inPacked;
#else
layout(location = 3) in vec3 inCotangentU;
layout(location = 4) in vec3 inCotangentV;
#endif
layout(location = 3) out vec3 cotangentU;
layout(location = 4) out vec3 cotangentV;
#endif

#ifdef COST_TRIANGLE
layout(location = 3) flat out vec3 triangleU;
layout(location = 4) flat out vec3 triangleV;
#endif
#ifdef COST_TRIANGLE_HALFS
layout(location = 3) flat out uvec3 triangleHalfs;
#endif

#include "cost/draw.glsl"

#if defined(COST_TRIANGLE) || defined(COST_TRIANGLE_HALFS)
// U and V of the triangle whose provoking vertex this is, from its edges in the space of the frame.
cotan_triangle triangleOfVertex()
{
    uint first = 3u * uint(gl_VertexIndex);
    uint v1 = indices[first + 1u];
    uint v2 = indices[first + 2u];
    return cotan_triangle_of_sound_edges(directionOf(positionOf(v1) - inPosition),
        directionOf(positionOf(v2) - inPosition), texcoordOf(v1) - inUv, texcoordOf(v2) - inUv,
        normal + covectorOf(normalOf(v1) + normalOf(v2)));
}
#endif

void main()
{
    vec4 p = vec4(inPosition, 1.0);
    position = vec3(dot(model[0], p), dot(model[1], p), dot(model[2], p));
    normal = covectorOf(inNormal);
    uv = inUv;
#ifdef COST_TANGENT
#ifdef COST_PACKED2
    vec4 inTangent = cotan_unpack_tangent2(inNormal, inPacked);
#endif
    tangent = vec4(directionOf(inTangent.xyz), inTangent.w);
#endif
#ifdef COST_COTANGENTS
#if defined(COST_PACKED8) || defined(COST_PACKED4)
#ifdef COST_PACKED8
    cotan_covectors stored = cotan_unpack_smooth8(inNormal, inPacked);
#else
    cotan_covectors stored = cotan_unpack_smooth4(inNormal, inPacked);
#endif
    vec3 inCotangentU = stored.t;
    vec3 inCotangentV = stored.b;
#endif
    cotangentU = covectorOf(inCotangentU);
    cotangentV = covectorOf(inCotangentV);
#endif
#ifdef COST_TRIANGLE
    cotan_triangle triangle = triangleOfVertex();
    triangleU = triangle.u;
    triangleV = triangle.v;
#endif
#ifdef COST_TRIANGLE_HALFS
    cotan_triangle triangle = triangleOfVertex();
    cotan_packed_triangle packed = cotan_pack_triangle(triangle.u, triangle.v);
    triangleHalfs = uvec3(packed.a, packed.b, packed.c);
#endif
    gl_Position = projection * vec4(position, 1.0);
}
