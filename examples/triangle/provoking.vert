#version 460
#extension GL_GOOGLE_include_directive : require
// 1. Vertex k is the provoking vertex of triangle k. It reads the other two vertices and outputs U and V.
#include "common.glsl"
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;
layout(location = 3) flat out uvec3 halfs;

void main()
{
    uint v = draw.sources.at[gl_VertexIndex];
    position = positionOf(v);
    normal = normalOf(v);
    uv = texcoordOf(v);
    gl_Position = projected(position);

    uint k = uint(gl_VertexIndex);
    halfs = uvec3(0u);
    if (k < draw.triangles) { // later vertices provoke no triangle
        uint v1 = draw.corners.at[3u * k + 1u];
        uint v2 = draw.corners.at[3u * k + 2u];
        cotan_triangle t = cotan_triangle_of_sound_edges(positionOf(v1) - position, positionOf(v2) - position,
            texcoordOf(v1) - uv, texcoordOf(v2) - uv, normal + normalOf(v1) + normalOf(v2));
        cotan_packed_triangle p = cotan_pack_triangle(t.u, t.v);
        halfs = uvec3(p.a, p.b, p.c);
    }
}
