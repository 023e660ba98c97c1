#version 460
#extension GL_GOOGLE_include_directive : require
// Computes U and V of each triangle, 12 bytes. Needs no adjacency. One invocation per triangle.
#include "common.glsl"

void main()
{
    uint k = invocation();
    if (k >= derive.count)
        return;
    uint v0 = derive.indices.at[3u * k], v1 = derive.indices.at[3u * k + 1u], v2 = derive.indices.at[3u * k + 2u];
    cotan_triangle t = cotan_triangle_of_vertices(positionOf(v0), positionOf(v1), positionOf(v2),
        texcoordOf(v0), texcoordOf(v1), texcoordOf(v2), normalOf(v0), normalOf(v1), normalOf(v2));
    cotan_packed_triangle p = cotan_pack_triangle(t.u, t.v);
    derive.triangles.at[3u * k] = p.a;
    derive.triangles.at[3u * k + 1u] = p.b;
    derive.triangles.at[3u * k + 2u] = p.c;
}
