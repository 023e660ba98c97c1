#version 460
#extension GL_GOOGLE_include_directive : require
// Computes the frame `smooth` of each vertex, 8 bytes: gradients of uv averaged by angle. One invocation per group.
#include "common.glsl"

void main()
{
    uint group = invocation();
    if (group >= derive.count)
        return;
    vec3 n = normalOf(derive.vertices.at[derive.vertexBegin.at[group]]);
    vec3 t = vec3(0.0), b = vec3(0.0);
    for (uint i = derive.cornerBegin.at[group]; i < derive.cornerBegin.at[group + 1u]; ++i) {
        Corner c = cornerAt(derive.corners.at[i]);
        cotan_covectors one = cotan_smooth_corner(n, c.dp1, c.dp2, c.duv1, c.duv2);
        t += one.t;
        b += one.b;
    }
    writeToGroup(group, cotan_pack_smooth8(n, t, b)); // scales the longer vector to unit length
}
