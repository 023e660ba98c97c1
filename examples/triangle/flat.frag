#version 460
#extension GL_GOOGLE_include_directive : require
// Reads U and V of the triangle, flat inputs from its provoking vertex or per primitive from the mesh shader (MESH).
#ifdef MESH
#extension GL_EXT_mesh_shader : require
#endif
#include "common.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
#ifdef MESH
layout(location = 3) perprimitiveEXT in flat uvec3 halfs;
#else
layout(location = 3) in flat uvec3 halfs;
#endif
layout(location = 0) out vec4 color;

void main()
{
    cotan_packed_triangle p = cotan_packed_triangle(halfs.x, halfs.y, halfs.z);
    vec3 r = cotan_perturb_triangle(normal, cotan_unpack_triangle_u(p), cotan_unpack_triangle_v(p), domes(uv));
    color = seen(r, normal, position);
}
