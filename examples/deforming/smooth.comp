#version 460
#extension GL_GOOGLE_include_directive : require
// The frame `smooth` of every vertex, 8 bytes: gradients of u and v averaged by angle. One invocation a group.
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
        cotan_frame f = cotan_frame_gradient(n, c.dp1, c.dp2, c.duv1, c.duv2);
        bool usable = cotan_sum_abs(f.t) + cotan_sum_abs(f.b) > 0.0;
        float weight = usable ? angleSeen(c, n) : 0.0;
        t += f.t * weight;
        b += f.b * weight;
    }
    writeToGroup(group, cotan_pack_smooth8(n, t, b)); // which makes the longer one long
}
