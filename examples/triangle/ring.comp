#version 460
#extension GL_GOOGLE_include_directive : require
// 3c. What meshlet_smooth.mesh makes, where there are no mesh shaders: one work group a meshlet writes the frames of its
// vertices in 8 bytes each, and smooth.vert reads them. A vertex of two meshlets gets the same from both.
#include "common.glsl"
#include "ring.glsl"
layout(local_size_x = 64) in;

void main()
{
    RingMeshlet m = meshletAt(gl_WorkGroupID.x);
    uint i = gl_LocalInvocationIndex;
    if (i >= m.vertexCount)
        return;
    uint v = draw.meshletVertices.at[m.firstVertex + i];
    vec3 n = normalOf(v);
    cotan_covectors frame = ringFrame(m.firstVertex + i, n);
    vec4 q = cotan_pack_smooth8(n, frame.t, frame.b);
    draw.sources.at[2u * v] = packSnorm2x16(q.xy);
    draw.sources.at[2u * v + 1u] = packSnorm2x16(q.zw);
}
