// Portable text: the contribution of one corner of a triangle to the frame `smooth` of its vertex, for shaders that
// derive the frame (cotan/tangents.hpp does the same for arrays). Include lang.h, frame.h and pack.h first. Not part of
// the text that `cotan shader` prints.

#ifndef COTAN_CORNER_H
#define COTAN_CORNER_H

// Returns the angle between two edges from one point, projected along the unit normal n, in radians; a right angle if
// an edge vanishes. Abramowitz and Stegun 4.4.46, with an error of 2e-8, because the arc cosine of a shading language
// may be inaccurate.
COTAN_FUNCTION cotan_real cotan_corner_angle(cotan_vec3 n, cotan_vec3 e1, cotan_vec3 e2)
{
    cotan_vec3 a = e1 - n * dot(n, e1);
    cotan_vec3 b = e2 - n * dot(n, e2);
    a = a * cotan_power_of_two_scale(cotan_max_abs(a));
    b = b * cotan_power_of_two_scale(cotan_max_abs(b));
    cotan_real lengths2 = dot(a, a) * dot(b, b);
    cotan_real x = lengths2 > cotan_real(0.0)
        ? dot(a, b) * cotan_inversesqrt(max(lengths2, cotan_real(1e-30))) : cotan_real(0.0);
    cotan_real y = min(abs(x), cotan_real(1.0));
    cotan_real y2 = y * y;
    cotan_real low = cotan_real(1.5707963050)
        + y * (cotan_real(-0.2145988016) + y * (cotan_real(0.0889789874) - y * cotan_real(0.0501743046)));
    cotan_real high = cotan_real(0.0308918810)
        + y * (cotan_real(-0.0170881256) + y * (cotan_real(0.0066700901) - y * cotan_real(0.0012624911)));
    cotan_real angle = sqrt(cotan_real(1.0) - y) * (low + y2 * y2 * high);
    return x < cotan_real(0.0) ? cotan_real(3.14159265) - angle : angle;
}

// Returns the gradients of u and v of a triangle, weighted by its angle at the corner. Add them up over all triangles
// at a vertex that are on one side of a mirrored seam; the length of the sum does not matter.
//   n           the vertex normal, unit
//   dp1, dp2    from the corner to the next and to the previous vertex of the triangle; duv1, duv2 likewise
// A triangle without area in space or uv gives zero.
COTAN_FUNCTION cotan_covectors cotan_smooth_corner(
    cotan_vec3 n, cotan_vec3 dp1, cotan_vec3 dp2, cotan_vec2 duv1, cotan_vec2 duv2)
{
    cotan_frame f = cotan_frame_gradient(n, dp1, dp2, duv1, duv2);
    bool usable = cotan_sum_abs(f.t) + cotan_sum_abs(f.b) > cotan_real(0.0);
    cotan_real weight = usable ? cotan_corner_angle(n, dp1, dp2) : cotan_real(0.0);
    cotan_covectors c;
    c.t = f.t * weight;
    c.b = f.b * weight;
    return c;
}

// Scales the sum so that the longer covector has length 1, as cotan_perturb_smooth requires at a vertex. Zero stays
// zero.
COTAN_FUNCTION cotan_covectors cotan_smooth_of_sum(cotan_covectors sum)
{
    cotan_real scale = cotan_power_of_two_scale(max(cotan_max_abs(sum.t), cotan_max_abs(sum.b)));
    sum.t = sum.t * scale;
    sum.b = sum.b * scale;
    cotan_real longest2 = max(dot(sum.t, sum.t), dot(sum.b, sum.b));
    cotan_real k = cotan_inversesqrt(max(longest2, cotan_real(1e-12)));
    sum.t = sum.t * k;
    sum.b = sum.b * k;
    return sum;
}

#endif
