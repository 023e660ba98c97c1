// Cotan portable text: parallax, which moves texture coordinates to where a ray meets a height map. Include lang.h and
// frame.h first.
//
// With the frame `gradient` (or another whose t and b are grad u and grad v per unit of length) a point at height h
// above the surface, on the line of sight, has the texture coordinates uv + h * (t . v, b . v) / (n . v). That is exact
// on a plane, for stretched, sheared and mirrored uv alike, with heights in the unit of positions; on curved surfaces
// the error grows with h over the radius. The usual form with a tangent matrix needs square, unsheared texels.
//
// Heights are stored as 0 to 1. 1 is the surface itself, and 0 lies `depth` below it.
// Take all differences of uv before the offset, and sample maps at the new coordinates with these (textureGrad,
// SampleGrad): the derivatives of moved coordinates jump where the ray passes an edge, and choose wrong mips there.
//
//   cotan_relief r = cotan_relief_start(frame, to_eye, uv, depth, 16.0);
//   for (int i = 0; i < 16 + 6; ++i)
//       r = cotan_relief_next(r, textureGrad(height_map, r.uv, duvdx, duvdy).x);
//   // r.uv: for all maps.
//
// A loop of `steps` readings finds the first layer below the relief; each further reading halves the step. Details that
// are thinner than depth / steps along the ray can be missed.
//
// Sources: T. Kaneko et al., Detailed Shape Representation with Parallax Mapping, 2001; F. Policarpo, M. Oliveira,
// J. Comba, Real-Time Relief Mapping on Arbitrary Polygonal Surfaces, 2005, cited as [2005]. The ray by surface
// gradients instead of a tangent matrix is ours.

#ifndef COTAN_PARALLAX_H
#define COTAN_PARALLAX_H

// Returns the change of (u, v) per unit of height along a ray. Total.
// f: `gradient`. direction: away from the surface, to the eye or to a light; any length.
// Degenerate input: rays within 2.9 degrees of the surface (n . direction < 0.05) are taken as at 2.9 degrees, with a
// factor that falls to zero at the horizon; rays from below, and frames or directions that are not finite, give zero.
COTAN_FUNCTION cotan_vec2 cotan_uv_per_height(cotan_frame f, cotan_vec3 direction)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    cotan_vec3 d = cotan_normalize_or(direction, zero);
    cotan_real lowest = cotan_real(0.05);
    cotan_real up = dot(f.n, d);
    cotan_real k = up >= lowest ? cotan_real(1.0) / up : max(up, cotan_real(0.0)) / (lowest * lowest);
    cotan_vec2 travel = cotan_vec2(dot(f.t, d) * k, dot(f.b, d) * k);
    bool usable = abs(travel.x) + abs(travel.y) <= COTAN_HUGE;
    return usable ? travel : cotan_vec2(cotan_real(0.0), cotan_real(0.0));
}

// Returns the offset of uv for one height that is taken as constant around the point: the cheapest form, for shallow
// maps. height: in the unit of the positions, negative below the surface: (h - 1) * depth of a stored h.
// Source: Kaneko 2001, equation 4, with gradients.
COTAN_FUNCTION cotan_vec2 cotan_parallax_offset(cotan_frame f, cotan_vec3 to_eye, cotan_real height)
{
    return cotan_uv_per_height(f, to_eye) * height;
}

// A search along a ray through the relief.
struct cotan_relief {
    cotan_vec2 uv;     // where to read the height next; after the last reading, the result
    cotan_vec2 origin; // where the ray enters
    cotan_vec2 travel; // change of uv over the whole ray
    cotan_real at;     // of the next reading: 0 where the ray enters, 1 at its end
    cotan_real step;   // to the next reading
    cotan_real begin;  // stored height of the ray where it enters
    cotan_real climb;  // change of its stored height over the whole ray
    cotan_real found;  // 1 once a reading was inside the relief, otherwise 0
};

// Returns the search along the line of sight, from the surface down to `depth` below it.
// f: `gradient`. to_eye: to the eye, any length. uv: interpolated. depth: in the unit of positions; zero, negative or
// not finite leaves uv as they are. steps: readings before the search halves its step; less than 1 counts as 1.
// Source: [2005] section 4.
COTAN_FUNCTION cotan_relief cotan_relief_start(
    cotan_frame f, cotan_vec3 to_eye, cotan_vec2 uv, cotan_real depth, cotan_real steps)
{
    bool usable = depth > cotan_real(0.0) && depth <= COTAN_HUGE;
    cotan_vec2 travel = cotan_uv_per_height(f, to_eye) * (usable ? -depth : cotan_real(0.0));
    bool finite = abs(travel.x) + abs(travel.y) <= COTAN_HUGE;
    cotan_relief r;
    r.origin = uv;
    r.travel = finite ? travel : cotan_vec2(cotan_real(0.0), cotan_real(0.0));
    r.step = cotan_real(1.0) / (steps >= cotan_real(1.0) ? steps : cotan_real(1.0));
    r.at = r.step;
    r.begin = cotan_real(1.0);
    r.climb = cotan_real(-1.0);
    r.found = cotan_real(0.0);
    r.uv = r.origin + r.travel * r.at;
    return r;
}

// Returns the search after a reading at r.uv. height: stored, 0 to 1; a NaN counts as outside the relief.
COTAN_FUNCTION cotan_relief cotan_relief_next(cotan_relief r, cotan_real height)
{
    bool inside = height >= r.begin + r.climb * r.at;
    r.found = inside ? cotan_real(1.0) : r.found;
    r.step = r.found > cotan_real(0.5) ? r.step * cotan_real(0.5) : r.step;
    r.at = min(max(r.at + (inside ? -r.step : r.step), cotan_real(0.0)), cotan_real(1.0));
    r.uv = r.origin + r.travel * r.at;
    return r;
}

// Returns the distance along the line of sight from the surface to the point that was found, in units of `depth`: add
// it to the distance of the pixel for a depth that meets other objects where the relief does (gl_FragDepth).
// r: after the last reading. depth, to_eye: as for cotan_relief_start. It fades at grazing views as the relief does;
// views from below give zero.
COTAN_FUNCTION cotan_real cotan_relief_distance(cotan_relief r, cotan_frame f, cotan_vec3 to_eye, cotan_real depth)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    bool usable = depth > cotan_real(0.0) && depth <= COTAN_HUGE;
    cotan_real lowest = cotan_real(0.05);
    cotan_real up = dot(f.n, cotan_normalize_or(to_eye, zero));
    cotan_real k = up >= lowest ? cotan_real(1.0) / up : max(up, cotan_real(0.0)) / (lowest * lowest);
    cotan_real distance = r.at * depth * k;
    return usable && distance <= COTAN_HUGE ? distance : cotan_real(0.0);
}

// Returns the search for the relief's own shadow: from a point of the relief up to the surface, towards a light. Run it
// with cotan_relief_next for `steps` readings; the point is in shadow if r.found is 1. A light behind the surface finds
// nothing: n . l shades that.
// uv, height: of the point that was found, the height as stored. to_light: any length.
COTAN_FUNCTION cotan_relief cotan_relief_shadow(
    cotan_frame f, cotan_vec3 to_light, cotan_vec2 uv, cotan_real height, cotan_real depth, cotan_real steps)
{
    cotan_real h = min(max(height, cotan_real(0.0)), cotan_real(1.0));
    cotan_relief r = cotan_relief_start(f, to_light, uv, depth * (cotan_real(1.0) - h), steps);
    r.travel = r.travel * cotan_real(-1.0);
    // Starts half an 8-bit step above the point, which otherwise shadows itself.
    r.begin = h + cotan_real(0.5 / 255.0);
    r.climb = cotan_real(1.0) - h;
    r.uv = r.origin + r.travel * r.at;
    return r;
}

#endif
