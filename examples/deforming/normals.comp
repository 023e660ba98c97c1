#version 460
#extension GL_GOOGLE_include_directive : require
// Computes unit vertex normals from positions: triangle normals averaged by angle. One invocation per group of
// makeNormalAdjacency. A vertex without a valid triangle keeps its normal.
#include "common.glsl"

void main()
{
    uint group = invocation();
    if (group >= derive.count)
        return;
    vec3 zero = vec3(0.0);
    vec3 sum = zero;
    for (uint i = derive.cornerBegin.at[group]; i < derive.cornerBegin.at[group + 1u]; ++i) {
        Corner c = cornerAt(derive.corners.at[i]);
        cotan_differences d = cotan_scale_differences(c.dp1, c.dp2, c.duv1, c.duv2);
        vec3 face = cotan_normalize_or(cross(d.dpdx, d.dpdy), zero);
        sum += face * (dot(face, face) > 0.0 ? cotan_corner_angle(face, c.dp1, c.dp2) : 0.0);
    }
    vec3 n = cotan_normalize_or(sum, zero);
    for (uint i = derive.vertexBegin.at[group]; dot(n, n) > 0.0 && i < derive.vertexBegin.at[group + 1u]; ++i) {
        uint v = derive.vertices.at[i];
        for (uint k = 0u; k < 3u; ++k)
            derive.normals.at[3u * v + k] = group < derive.firstMirrored ? n[k] : -n[k];
    }
}
