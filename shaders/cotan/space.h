// Cotan portable text: vectors to and from texture space. Include lang.h, frame.h and light.h first.
//
// A frame has three covectors t, b, n. t*m.x + b*m.y + n*m.z takes a texel m out of texture space. For another vector
// there are two ways in, and they are equal only where t, b and n are orthonormal:
// - cotan_to_texture_space is the inverse. Use it for vectors that are compared with a texel's normal, such as those to
//   the light and to the eye: a vector along the perturbed normal becomes one along m, so highlights stay in place.
// - cotan_texture_travel is the transpose. Use it for a path of a point, such as a ray: with the frame `gradient` its
//   x and y are the changes of u and v along the path, and its z is the change of height.
// Lighting in world space needs neither, and is exact for all frames.
//
// Sources: C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5 (2006), cited as [2006]: its last remark
// on frames that are not orthogonal.

#ifndef COTAN_SPACE_H
#define COTAN_SPACE_H

// Returns m with t*m.x + b*m.y + n*m.z = v: v in texture space, along (+u, +v, outwards). Its length is not kept.
// f: any frame; its vectors need not be orthogonal or unit. v: any length, in the space of f.
// Degenerate input: dependent or zero covectors (a frame without a map) give (0, 0, n . v); v that is not finite: zero.
// Source: [2006]. The direction is that of cotan_encode.
COTAN_FUNCTION cotan_vec3 cotan_to_texture_space(cotan_frame f, cotan_vec3 v)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    v = cotan_sum_abs(v) <= COTAN_HUGE ? v : zero;
    cotan_vec3 m = cotan_encode(f, v);
    cotan_vec3 back = f.t * m.x + f.b * m.y + f.n * m.z; // along v
    cotan_vec3 along = m * (dot(v, back) / dot(back, back));
    cotan_real height = dot(f.n, v);
    cotan_vec3 flat_v = cotan_vec3(zero.x, zero.y, abs(height) <= COTAN_HUGE ? height : zero.z);
    return cotan_sum_abs(along) <= COTAN_HUGE ? along : flat_v;
}

// Returns the changes of u, v and height of a point that moves by v: (t . v, b . v, n . v).
// f: `gradient` for changes of u and v per unit of length; with a frame of unit scale, up to the common scale of t, b.
// v: in the space of f. Total where f and v are finite.
COTAN_FUNCTION cotan_vec3 cotan_texture_travel(cotan_frame f, cotan_vec3 v)
{
    return cotan_vec3(dot(f.t, v), dot(f.b, v), dot(f.n, v));
}

// Returns a unit direction of the texture on the surface, perpendicular to the perturbed normal n, for anisotropic
// highlights. (1, 0) gives dP/du, along increasing u at constant v, whether t and b are tangents or gradients, since
// grad v is perpendicular to dP/du. (0, 1) gives the direction perpendicular to it, on the side of increasing v.
// glTF stretches the highlight along this direction (KHR_materials_anisotropy); where it is the direction of grooves,
// as of brushed metal or hair, the highlight is stretched across it.
// t itself is along dP/du only where it is perpendicular to b.
// f: the frame of the uv set that the direction belongs to. n: unit. along: for glTF's anisotropyRotation r in radians
// (cos(r), -sin(r)), since v runs down there; where the texture has a transform, in the transformed coordinates.
// Degenerate input: a frame without t and b, `along` of zero, a direction parallel to n: zero. Test for it, and shade
// without anisotropy.
// Source: the dual basis of [2006]; KHR_materials_anisotropy, whose bitangent is perpendicular to the tangent.
COTAN_FUNCTION cotan_vec3 cotan_tangent_direction(cotan_frame f, cotan_vec3 n, cotan_vec2 along)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    return cotan_direction_on_surface(cotan_normalize_or(f.n, zero), f.t, f.b, along, n);
}

#endif
