// Cotan portable text: texture coordinates that do not come from a mesh. Include lang.h, frame.h and gradient.h first.
//
// A frame needs the gradients of u and v and nothing else. Where a formula gives u and v, it gives their gradients too,
// and no screen derivatives are taken: nothing jumps at the edge of a decal or at the seam of a tiled pattern.
//
// Sources: M. Mikkelsen, Surface Gradient Based Bump Mapping Framework, JCGT 9(3) 2020, cited as [2020]; M. Mikkelsen,
// Practical Real-Time Hex-Tiling, JCGT 11(2) 2022, cited as [2022].

#ifndef COTAN_MAPPING_H
#define COTAN_MAPPING_H

// Returns the frame of a projector (a decal, a slide, a planar or cylindrical map) on a surface: the parts of grad u
// and grad v in the tangent plane. It is metric, like `gradient`: multiply t by the width of the decal and b by its
// height for bumps of the map's own steepness.
// n: the surface normal, any length. grad_u, grad_v: changes of u and v per unit of length, in the space of n. A box
// with the unit axes x, y and the sizes w, h has x / w and y / h; with v downwards -y / h. Mirrored and turned
// boxes need nothing else.
// Degenerate input: gradients that are not finite give t = b = 0; a surface edge-on to the projector gives t or b = 0.
// Source: [2020] section 3.
COTAN_FUNCTION cotan_frame cotan_frame_projected(cotan_vec3 n, cotan_vec3 grad_u, cotan_vec3 grad_v)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    bool usable = cotan_sum_abs(grad_u) + cotan_sum_abs(grad_v) <= COTAN_HUGE;
    cotan_frame f;
    f.n = cotan_safe_normal(n, zero, zero);
    f.t = usable ? grad_u - f.n * dot(f.n, grad_u) : zero;
    f.b = usable ? grad_v - f.n * dot(f.n, grad_v) : zero;
    return f;
}

// Returns a difference of a coordinate that jumps by `period`, such as an angle of atan2 or a result of fract, without
// the jump: the nearest value of d + k * period. Apply it to each screen derivative, and pass the result to a frame and
// to the texture lookup with gradients.
// d: finite, less than half a period without the jump: true where the pattern spans more than two pixels. period:
// positive; zero or less returns d.
COTAN_FUNCTION cotan_real cotan_wrapped_difference(cotan_real d, cotan_real period)
{
    bool usable = period > cotan_real(0.0);
    cotan_real p = usable ? period : cotan_real(1.0);
    return usable ? d - p * floor(d / p + cotan_real(0.5)) : d;
}

// Returns the slope of a map that is looked up at rotated (and scaled) coordinates uv' = s * R(angle) * uv, in slopes
// of uv: R is a counter-clockwise rotation from u to v. Rotated tiles keep their bumps lit from the same side.
// slope: of the texel, by cotan_slope_of_texel. cosine, sine: of the angle. With a scale of s the bumps are s times as
// dense; multiply the result by s for a fixed height, or not, for a fixed steepness.
// Source: [2022] section 4: the transpose of the rotation.
COTAN_FUNCTION cotan_vec2 cotan_slope_of_rotated(cotan_vec2 slope, cotan_real cosine, cotan_real sine)
{
    return cotan_vec2(cosine * slope.x + sine * slope.y, cosine * slope.y - sine * slope.x);
}

// The three hexagons that meet at a point, with their weights.
struct cotan_hex_tiles {
    cotan_vec2 a; // whole numbers that identify the hexagon: the seed of its random rotation and offset
    cotan_vec2 b;
    cotan_vec2 c;
    cotan_vec3 weights; // of a, b and c; their sum is 1
};

// Returns the hexagons for hex tiling and texture bombing: look the map up once per hexagon, with a rotation and offset
// of its own, rotate the slopes back (cotan_slope_of_rotated), and add them by weight. Slopes add up to that of the
// weighted heights, so the result is a normal of a surface; mixed normals are not.
// uv: finite, up to 1e5. sharpness: exponent of the weights, 1 to 16; 7 is usual.
// Source: [2022] section 3: a skewed grid of triangles of side 1 / (2 sqrt 3).
COTAN_FUNCTION cotan_hex_tiles cotan_hex_tiles_at(cotan_vec2 uv, cotan_real sharpness)
{
    cotan_vec2 at = uv * cotan_real(3.4641016151377544);
    cotan_vec2 skewed = cotan_vec2(at.x - at.y * cotan_real(0.5773502691896258), at.y * cotan_real(1.1547005383792515));
    cotan_vec2 base = cotan_vec2(floor(skewed.x), floor(skewed.y));
    cotan_vec2 rest = cotan_vec2(skewed.x - base.x, skewed.y - base.y);
    cotan_real z = cotan_real(1.0) - rest.x - rest.y;
    cotan_real upper = z < cotan_real(0.0) ? cotan_real(1.0) : cotan_real(0.0);
    cotan_real turn = cotan_real(1.0) - cotan_real(2.0) * upper;
    cotan_hex_tiles h;
    h.a = cotan_vec2(base.x + upper, base.y + upper);
    h.b = cotan_vec2(base.x + upper, base.y + cotan_real(1.0) - upper);
    h.c = cotan_vec2(base.x + cotan_real(1.0) - upper, base.y + upper);
    // Barycentric coordinates in the triangle, whose lower or upper half of the skewed square holds the point.
    cotan_vec3 w = cotan_vec3(z * turn, upper + turn * rest.y, upper + turn * rest.x);
    w = cotan_vec3(pow(max(w.x, cotan_real(0.0)), sharpness), pow(max(w.y, cotan_real(0.0)), sharpness),
        pow(max(w.z, cotan_real(0.0)), sharpness));
    h.weights = w / max(w.x + w.y + w.z, cotan_real(1e-30));
    return h;
}

#endif
