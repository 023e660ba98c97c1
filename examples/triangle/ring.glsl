// The frame `smooth` of a meshlet's vertex, from all triangles around it: those of the meshlet and the ring around
// that. meshlet_smooth.mesh and ring.comp share it. Include common.glsl first.
#include "cotan/corner.h"

struct RingMeshlet {
    uint firstVertex, vertexCount, firstTriangle, triangleCount;
};
RingMeshlet meshletAt(uint i)
{
    return RingMeshlet(draw.meshlets.at[4u * i], draw.meshlets.at[4u * i + 1u], draw.meshlets.at[4u * i + 2u],
        draw.meshlets.at[4u * i + 3u]);
}

// place: in draw.meshletVertices. n: the vertex's normal.
cotan_covectors ringFrame(uint place, vec3 n)
{
    cotan_covectors sum = cotan_covectors(vec3(0.0), vec3(0.0));
    for (uint i = draw.ringBegin.at[place]; i < draw.ringBegin.at[place + 1u]; ++i) {
        uint c = draw.ring.at[i], k = c % 3u, first = c - k;
        uint v0 = draw.corners.at[c];
        uint v1 = draw.corners.at[first + (k == 2u ? 0u : k + 1u)];
        uint v2 = draw.corners.at[first + (k == 0u ? 2u : k - 1u)];
        vec3 p = positionOf(v0);
        vec2 uv = texcoordOf(v0);
        cotan_covectors one = cotan_smooth_corner(
            n, positionOf(v1) - p, positionOf(v2) - p, texcoordOf(v1) - uv, texcoordOf(v2) - uv);
        sum.t += one.t;
        sum.b += one.b;
    }
    return cotan_smooth_of_sum(sum);
}
