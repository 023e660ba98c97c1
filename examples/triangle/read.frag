#version 460
#extension GL_GOOGLE_include_directive : require
// 2. Reads U and V by the triangle's index. They were computed when the mesh was loaded, 12 bytes per triangle.
#include "common.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec4 color;

void main()
{
    uint k = 3u * uint(gl_PrimitiveID);
    cotan_packed_triangle p = cotan_packed_triangle(draw.packed.at[k], draw.packed.at[k + 1u], draw.packed.at[k + 2u]);
    vec3 r = cotan_perturb_triangle(normal, cotan_unpack_triangle_u(p), cotan_unpack_triangle_v(p), domes(uv));
    color = seen(r, normal, position);
}
