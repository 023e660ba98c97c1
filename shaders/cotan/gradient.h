// Cotan portable text: surface gradients. Include lang.h and frame.h first.
//
// A bump of height h turns a normal by its surface gradient g, the part of grad h in the tangent
// plane: n' = normalize(n - g). Gradients from any source (tangent-space maps over several uv sets,
// object-space maps, volumes, triplanar maps, heights) are vectors of one space: they add, scale,
// mask and interpolate, and are resolved once. -g turns bumps into dents.
//
// n is unit in all functions here. Lengths are those of the positions; "slope" is a change of
// height per unit of a texture coordinate.
//
// Sources: M. Mikkelsen, Surface Gradient Based Bump Mapping Framework, JCGT 9(3) 2020, cited as
// [2020]; J. Blinn, Simulation of Wrinkled Surfaces, 1978.

#ifndef COTAN_GRADIENT_H
#define COTAN_GRADIENT_H

// The perturbed normal, unit. Where n - g vanishes or is not finite: n as given.
// Source: [2020] section 2, after Blinn.
COTAN_FUNCTION cotan_vec3 cotan_resolve_gradient(cotan_vec3 n, cotan_vec3 g)
{
    return cotan_normalize_or(n - g, n);
}

// (dh/du, dh/dv) that a decoded texel stands for: -m.xy / m.z. Slopes above 128 (89.6 degrees), and
// texels at or below the horizon, are held at 128; m = 0 gives zero.
// Source: [2020] section 4, the same limit.
COTAN_FUNCTION cotan_vec2 cotan_slope_of_texel(cotan_vec3 m)
{
    cotan_real steepest = max(abs(m.x), abs(m.y)) * cotan_real(1.0 / 128.0);
    cotan_real z = max(max(m.z, steepest), cotan_real(1e-30));
    return cotan_vec2(-m.x / z, -m.y / z);
}

// From a slope and a frame: h_u t + h_v b. With the frame `gradient` bumps have the map's own
// height in world units; with `cotangent` (and others of unit scale) they do not depend on the size of the
// object. Several uv sets: one frame each, gradients added.
COTAN_FUNCTION cotan_vec3 cotan_gradient_of_slope(cotan_frame f, cotan_vec2 slope)
{
    return f.t * slope.x + f.b * slope.y;
}

// From another normal of the same space, as an object-space map holds: the g that resolves to v.
// v: any length but zero. v at right angles to n or behind it: |n . v| stands in for n . v, at least
// 1e-6, so the slope is steep but finite.
// Source: [2020] section 5.
COTAN_FUNCTION cotan_vec3 cotan_gradient_of_normal(cotan_vec3 n, cotan_vec3 v)
{
    cotan_real k = dot(n, v);
    return (n * k - v) / max(abs(k), cotan_real(1e-6));
}

// From the gradient of a height defined in space (noise, a volume): its part in the tangent plane.
// Source: [2020] section 6.
COTAN_FUNCTION cotan_vec3 cotan_gradient_of_volume(cotan_vec3 n, cotan_vec3 gradient)
{
    return gradient - n * dot(n, gradient);
}

// From differences of a height that was computed in the shader, along the two directions of dpdx
// and dpdy: metric. dhdx, dhdy in units of length. A footprint without area gives zero.
// Source: Blinn; M. Mikkelsen 2010, equation with the sign of the determinant kept.
COTAN_FUNCTION cotan_vec3 cotan_gradient_of_height(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_real dhdx, cotan_real dhdy)
{
    cotan_vec3 dpdy_perp = cross(dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, dpdx);
    cotan_real determinant = dot(dpdx, dpdy_perp);
    bool usable = abs(determinant) > cotan_real(1e-30) && abs(determinant) <= COTAN_HUGE;
    cotan_real scale = usable ? cotan_real(1.0) / determinant : cotan_real(0.0);
    return (dpdy_perp * dhdx + dpdx_perp * dhdy) * scale;
}

// How much each of three planar maps counts: weights of the planes across x, y and z, sum 1. They
// fade out where the surface stands within 11.5 degrees of the plane's edge. n unit (or zero:
// a third each).
// Source: [2020] section 7 has max(|n| - 0.2, 0)^3.
COTAN_FUNCTION cotan_vec3 cotan_triplanar_weights(cotan_vec3 n)
{
    cotan_vec3 w = cotan_vec3(max(abs(n.x) - cotan_real(0.2), cotan_real(0.0)),
        max(abs(n.y) - cotan_real(0.2), cotan_real(0.0)), max(abs(n.z) - cotan_real(0.2), cotan_real(0.0)));
    w = w * w * w;
    cotan_real sum = w.x + w.y + w.z;
    cotan_real third = cotan_real(1.0 / 3.0);
    return sum > cotan_real(0.0) ? w / sum : cotan_vec3(third, third, third);
}

// From three planar maps, sampled at (z,y) for the plane across x, at (x,z) for the one across y and
// at (x,y) for the one across z, in units of length; slopes in that order of coordinates. A
// look-up with a negated coordinate negates that component of the slope.
// weights: as cotan_triplanar_weights gives.
// Source: [2020] section 7.
COTAN_FUNCTION cotan_vec3 cotan_gradient_triplanar(
    cotan_vec3 n, cotan_vec3 weights, cotan_vec2 slope_x, cotan_vec2 slope_y, cotan_vec2 slope_z)
{
    cotan_vec3 volume = cotan_vec3(weights.z * slope_z.x + weights.y * slope_y.x,
        weights.z * slope_z.y + weights.x * slope_x.y,
        weights.x * slope_x.x + weights.y * slope_y.y);
    return cotan_gradient_of_volume(n, volume);
}

#endif
