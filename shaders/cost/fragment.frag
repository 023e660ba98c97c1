#version 450
#extension GL_GOOGLE_include_directive : require
#ifdef COST_MESH
#extension GL_EXT_mesh_shader : require
#define COST_FLAT perprimitiveEXT flat
#else
#define COST_FLAT flat
#endif
// The fragment shader that `cotan cost` measures: differences, one texel, one row of rows.h (named by COST_ROW), a
// colour. Interpolated inputs that the row does not use are not declared.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/normal.h"
#include "cotan/frame.h"
#include "cotan/history.h"
#include "cotan/fused.h"
#include "cotan/triangle.h"
#include "cotan/pack.h"
#include "cost/rows.h"

layout(location = 0) in vec3 position; // camera-relative
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
#ifdef COST_TANGENT
layout(location = 3) in vec4 tangent;
#endif
#ifdef COST_COTANGENTS
layout(location = 3) in vec3 cotangentU;
layout(location = 4) in vec3 cotangentV;
#endif
#ifdef COST_TRIANGLE
layout(location = 3) COST_FLAT in vec3 triangleU;
layout(location = 4) COST_FLAT in vec3 triangleV;
#endif
#ifdef COST_TRIANGLE_HALFS
layout(location = 3) COST_FLAT in uvec3 triangleHalfs;
#endif
#ifdef COST_TRIANGLE_READ
layout(std430, set = 0, binding = 6) readonly buffer Triangles { uint triangles[]; };
#endif
#ifdef COST_EDGES
#include "cost/draw.glsl"
#endif

layout(set = 0, binding = 1) uniform sampler2D normalMap;
layout(location = 0) out vec4 color;

#ifdef COST_VARYINGS
// Measures the vertex stage: uses all its outputs, including the position.
void main()
{
    color = vec4(position + normal, 1.0) + uv.xyxy;
#ifdef COST_TANGENT
    color += tangent;
#endif
#ifdef COST_COTANGENTS
    color += vec4(cotangentU * cotangentV, 0.0);
#endif
#ifdef COST_TRIANGLE
    color += vec4(triangleU * triangleV, 0.0);
#endif
#ifdef COST_TRIANGLE_HALFS
    color += vec4(triangleHalfs, 0.0);
#endif
}
#else
void main()
{
    cost_inputs i;
    i.n = normal;
#ifdef COST_EDGES
    uint first = 3u * uint(gl_PrimitiveID);
    uint v0 = indices[first];
    uint v1 = indices[first + 1u];
    uint v2 = indices[first + 2u];
    i.dpdx = positionOf(v1) - positionOf(v0);
    i.dpdy = positionOf(v2) - positionOf(v0);
    i.duvdx = texcoordOf(v1) - texcoordOf(v0);
    i.duvdy = texcoordOf(v2) - texcoordOf(v0);
#else
    i.dpdx = dFdx(position);
    i.dpdy = dFdy(position);
    i.duvdx = dFdx(uv);
    i.duvdy = dFdy(uv);
#endif
#ifdef COST_TANGENT
    i.tangent = tangent;
#endif
#ifdef COST_COTANGENTS
    i.cotangent_u = cotangentU;
    i.cotangent_v = cotangentV;
#endif
#ifdef COST_TRIANGLE
    i.triangle_u = triangleU;
    i.triangle_v = triangleV;
#endif
#ifdef COST_TRIANGLE_HALFS
    cotan_packed_triangle packed = cotan_packed_triangle(triangleHalfs.x, triangleHalfs.y, triangleHalfs.z);
#endif
#ifdef COST_TRIANGLE_READ
    uint word = 3u * uint(gl_PrimitiveID);
    cotan_packed_triangle packed =
        cotan_packed_triangle(triangles[word], triangles[word + 1u], triangles[word + 2u]);
#endif
#if defined(COST_TRIANGLE_HALFS) || defined(COST_TRIANGLE_READ)
    i.triangle_u = cotan_unpack_triangle_u(packed);
    i.triangle_v = cotan_unpack_triangle_v(packed);
#endif
    // The cheapest decoding; the map's encoding is not part of the frame's cost.
    i.m = texture(normalMap, uv).xyz * 2.0 - 1.0;
#ifdef COST_FACING
    if (!gl_FrontFacing)
        i.m = vec3(-i.m.xy, i.m.z);
#endif
    color = vec4(COST_ROW(i) * 0.5 + 0.5, 1.0);
}
#endif
