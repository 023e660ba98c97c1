#version 460
#extension GL_GOOGLE_include_directive : require
// 4. Resolves the visibility buffer. The triangle is known, so no screen derivatives are needed. The intersection of
// the pixel's ray with the triangle's plane gives the barycentric coordinates. U and V are computed from the edges or,
// with READ, read: three words per triangle, computed when the mesh was loaded.
#include "common.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    uvec2 at = gl_GlobalInvocationID.xy;
    if (at.x >= draw.width || at.y >= draw.height)
        return;
    uint pixel = at.y * draw.width + at.x;
    uint id = draw.ids.at[pixel];
    vec4 value = vec4(0.0);
    if (id > 0u) {
        uint k = 3u * (id - 1u);
        uint v0 = draw.corners.at[k], v1 = draw.corners.at[k + 1u], v2 = draw.corners.at[k + 2u];
        vec3 p0 = positionOf(v0), e1 = positionOf(v1) - p0, e2 = positionOf(v2) - p0;
        vec2 size = vec2(draw.width, draw.height);
        vec2 device = (vec2(at) + 0.5) / size * 2.0 - 1.0;
        vec3 ray = vec3(2.0 * device.x / kZoom, -device.y / kZoom, -1.0);
        // Cramer's rule for p0 + b1 e1 + b2 e2 = depth * ray.
        vec3 face = cross(e1, e2);
        float determinant = dot(ray, face);
        float b1 = dot(ray, cross(e2, p0)) / determinant;
        float b2 = dot(ray, cross(p0, e1)) / determinant;
        vec3 n0 = normalOf(v0), n1 = normalOf(v1), n2 = normalOf(v2);
        vec3 normal = n0 * (1.0 - b1 - b2) + n1 * b1 + n2 * b2;
        vec2 uv0 = texcoordOf(v0), d1 = texcoordOf(v1) - uv0, d2 = texcoordOf(v2) - uv0;
        vec2 uv = uv0 + d1 * b1 + d2 * b2;
#ifdef READ
        cotan_packed_triangle words =
            cotan_packed_triangle(draw.packed.at[k], draw.packed.at[k + 1u], draw.packed.at[k + 2u]);
        vec3 u = cotan_unpack_triangle_u(words), v = cotan_unpack_triangle_v(words);
#else
        cotan_triangle t = cotan_triangle_of_sound_edges(e1, e2, d1, d2, n0 + n1 + n2);
        vec3 u = t.u, v = t.v;
#endif
        value = seen(cotan_perturb_triangle(normal, u, v, domes(uv)), normal, ray);
    }
    for (uint c = 0u; c < 4u; ++c)
        draw.result.at[4u * pixel + c] = value[c];
}
