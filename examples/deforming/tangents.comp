#version 460
#extension GL_GOOGLE_include_directive : require
// Computes tangents with the averaging of MikkTSpace, 8 bytes per vertex: unit xyz, and the sign as in glTF's TANGENT.
// One invocation per group.
#include "common.glsl"

void main()
{
    uint group = invocation();
    if (group >= derive.count)
        return;
    vec3 n = normalOf(derive.vertices.at[derive.vertexBegin.at[group]]);
    vec3 zero = vec3(0.0);
    vec3 sum = zero;
    for (uint i = derive.cornerBegin.at[group]; i < derive.cornerBegin.at[group + 1u]; ++i) {
        Corner c = cornerAt(derive.corners.at[i]);
        cotan_differences d = cotan_scale_differences(c.dp1, c.dp2, c.duv1, c.duv2);
        // The direction of dP/du.
        float side = sign(d.duvdx.x * d.duvdy.y - d.duvdx.y * d.duvdy.x);
        vec3 along = cotan_normalize_or((d.dpdx * d.duvdy.y - d.dpdy * d.duvdx.y) * side, zero);
        vec3 t = cotan_normalize_or(along - n * dot(n, along), zero);
        sum += t * (dot(t, t) > 0.0 ? cotan_corner_angle(n, c.dp1, c.dp2) : 0.0);
    }
    vec3 t = cotan_normalize_or(sum, zero);
    bool found = dot(t, t) > 0.0;
    t = found ? t : cotan_basis_of_normal(n).x; // any direction in the tangent plane
    writeToGroup(group, vec4(t, found && group >= derive.firstMirrored ? -1.0 : 1.0));
}
