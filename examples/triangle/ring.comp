#version 460
#extension GL_GOOGLE_include_directive : require
// 3c. Replaces meshlet_smooth.mesh on devices without mesh shaders. One work group per meshlet writes the frames of its
// vertices, 8 bytes each, which smooth.vert reads. Two meshlets write the same frame to a vertex that they share.
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
