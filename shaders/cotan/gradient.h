// Cotan portable text: surface gradients. Include lang.h and frame.h first.
//
// A bump of height h perturbs a normal by its surface gradient g, the part of grad h in the tangent plane: n' =
// normalize(n - g). Gradients from any source (tangent-space maps over several uv sets, object-space maps, volumes,
// triplanar maps, heights) are vectors in one space: they can be added, scaled, masked and interpolated, and are
// resolved once. -g turns bumps into dents.
//
// n is unit in all functions here. Lengths have the unit of the positions; "slope" is a change of height per unit of a
// texture coordinate.
//
// Sources: M. Mikkelsen, Surface Gradient Based Bump Mapping Framework, JCGT 9(3) 2020, cited as [2020]; J. Blinn,
// Simulation of Wrinkled Surfaces, 1978.

#ifndef COTAN_GRADIENT_H
#define COTAN_GRADIENT_H

// Returns the perturbed normal, unit; n as given if n - g vanishes or is not finite.
// Source: [2020] section 2, after Blinn.
COTAN_FUNCTION cotan_vec3 cotan_resolve_gradient(cotan_vec3 n, cotan_vec3 g)
{
    return cotan_normalize_or(n - g, n);
}

// Returns the slope (dh/du, dh/dv) = -m.xy / m.z of a decoded texel. Slopes above 128 (89.6 degrees), and those of
// texels at or below the horizon, are clamped to 128; m = 0 gives zero.
// Source: [2020] section 4, with the same limit.
COTAN_FUNCTION cotan_vec2 cotan_slope_of_texel(cotan_vec3 m)
{
    cotan_real steepest = max(abs(m.x), abs(m.y)) * cotan_real(1.0 / 128.0);
    cotan_real z = max(max(m.z, steepest), cotan_real(1e-30));
    return cotan_vec2(-m.x / z, -m.y / z);
}

// Returns the gradient of a slope in a frame: h_u t + h_v b. With the frame `gradient` bumps have the map's own height
// in world units; with `cotangent` and other frames of unit scale they do not depend on the size of the object. For
// several uv sets, use one frame each and add the gradients.
COTAN_FUNCTION cotan_vec3 cotan_gradient_of_slope(cotan_frame f, cotan_vec2 slope)
{
    return f.t * slope.x + f.b * slope.y;
}

// Returns the gradient that resolves to v, another normal of the same space, for example from an object-space map. v:
// any length but zero. n . v is replaced by its magnitude, at least 1e-6, so a v that is perpendicular to n or behind
// it gives a steep but finite slope.
// Source: [2020] section 5.
COTAN_FUNCTION cotan_vec3 cotan_gradient_of_normal(cotan_vec3 n, cotan_vec3 v)
{
    cotan_real k = dot(n, v);
    return (n * k - v) / max(abs(k), cotan_real(1e-6));
}

// Returns the surface gradient of a height defined in space (noise, a volume): the part of its gradient in the tangent
// plane.
// Source: [2020] section 6.
COTAN_FUNCTION cotan_vec3 cotan_gradient_of_volume(cotan_vec3 n, cotan_vec3 gradient)
{
    return gradient - n * dot(n, gradient);
}

// Returns the metric gradient of a height computed in the shader, from its differences along the two directions of dpdx
// and dpdy. dhdx, dhdy: in units of length. A footprint without area gives zero.
// Source: Blinn; M. Mikkelsen 2010, keeping the sign of the determinant.
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

// Returns the weights of the planar maps across x, y and z; their sum is 1. A map has no weight where its axis is
// within 11.5 degrees of the surface. n: unit; zero gives a third each.
// Source: [2020] section 7: max(|n| - 0.2, 0)^3.
COTAN_FUNCTION cotan_vec3 cotan_triplanar_weights(cotan_vec3 n)
{
    cotan_vec3 w = cotan_vec3(max(abs(n.x) - cotan_real(0.2), cotan_real(0.0)),
        max(abs(n.y) - cotan_real(0.2), cotan_real(0.0)), max(abs(n.z) - cotan_real(0.2), cotan_real(0.0)));
    w = w * w * w;
    cotan_real sum = w.x + w.y + w.z;
    cotan_real third = cotan_real(1.0 / 3.0);
    return sum > cotan_real(0.0) ? w / sum : cotan_vec3(third, third, third);
}

// Returns the gradient of three planar maps, sampled at (z,y) in the plane across x, at (x,z) in the one across y and
// at (x,y) in the one across z, in units of length; slopes in this order of coordinates. If a coordinate is negated for
// the lookup, negate that component of the slope.
// weights: as returned by cotan_triplanar_weights.
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
