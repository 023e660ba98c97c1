// The frame `smooth` of a meshlet's vertex, from all triangles around the vertex: those of the meshlet and of its ring.
// Used by meshlet_smooth.mesh and ring.comp. Include common.glsl first.
#include "cotan/corner.h"

struct RingMeshlet {
    uint firstVertex, vertexCount, firstTriangle, triangleCount;
};
RingMeshlet meshletAt(uint i)
{
    return RingMeshlet(draw.meshlets.at[4u * i], draw.meshlets.at[4u * i + 1u], draw.meshlets.at[4u * i + 2u],
        draw.meshlets.at[4u * i + 3u]);
}

// slot: index into draw.meshletVertices. n: normal of the vertex.
cotan_covectors ringFrame(uint slot, vec3 n)
{
    cotan_covectors sum = cotan_covectors(vec3(0.0), vec3(0.0));
    for (uint i = draw.ringBegin.at[slot]; i < draw.ringBegin.at[slot + 1u]; ++i) {
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
