// Cotan portable text: lighting. Include lang.h and frame.h first.
//
// Small, standard and the same on the GPU and in the reference renderer: ambient + diffuse +
// Blinn-Phong, and GGX metallic-roughness, with a soft procedural environment; highlights that are
// stretched or have another strength and colour, light that passes through thin sheets, and over all
// a clear coat, as extensions of glTF have them. All colours are linear. n, l, v are unit vectors in
// one space (world, y up, for the environment): normal, to the light, to the eye.

#ifndef COTAN_LIGHT_H
#define COTAN_LIGHT_H

#define COTAN_PI cotan_real(3.14159265358979)

struct cotan_surface {
    cotan_vec3 base_color;
    cotan_real metallic;    // [0,1]
    cotan_real roughness;   // perceptual, [0,1]; alpha = roughness^2, at least 0.045^2
    cotan_real occlusion;   // [0,1], darkens the environment only
    cotan_vec3 emissive;
    cotan_vec3 n;           // perturbed normal, unit
    cotan_vec3 v;           // to the eye, unit
};

COTAN_FUNCTION cotan_real cotan_saturate(cotan_real x)
{
    return min(max(x, cotan_real(0.0)), cotan_real(1.0));
}

COTAN_FUNCTION cotan_real cotan_smooth(cotan_real edge0, cotan_real edge1, cotan_real x)
{
    cotan_real k = cotan_saturate((x - edge0) / (edge1 - edge0));
    return k * k * (cotan_real(3.0) - cotan_real(2.0) * k);
}

// ---- highlights that are smaller than a pixel ----

// The perceptual roughness of a surface whose normals spread within what is seen at once: squares of
// slopes add up. roughness: its own, [0,1]. spread: variance of the slopes, of both directions
// together, >= 0.
COTAN_FUNCTION cotan_real cotan_roughness_of_spread(cotan_real roughness, cotan_real spread)
{
    cotan_real alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + spread, cotan_real(1.0))));
}

// The spread of normals by the turn of the surface within a pixel: the variance over a square of its
// width. dndx, dndy: differences of the unit normal without a map to the next pixels. Over 0.18, where
// differences say little, it stays at that (Y. Tokuyoshi, A. Kaplanyan, Improved Geometric Specular
// Antialiasing, 2019; their pixel is a Gaussian and gives four times as much, which measures worse).
COTAN_FUNCTION cotan_real cotan_spread_of_turn(cotan_vec3 dndx, cotan_vec3 dndy)
{
    return min((dot(dndx, dndx) + dot(dndy, dndy)) / cotan_real(12.0), cotan_real(0.18));
}

// The spread of unit normals whose mean is that long, [0,1]: what the levels of a normal map lose, to be
// kept in a channel of theirs. They lie as exp(kappa cos), kappa by J. Banerjee and others (2005). A
// step of 8 bits is taken as rounding.
COTAN_FUNCTION cotan_real cotan_spread_of_length(cotan_real length_of_mean)
{
    cotan_real r = min(max(length_of_mean, cotan_real(0.05)) + cotan_real(1.0 / 255.0), cotan_real(1.0));
    return cotan_real(2.0) * (cotan_real(1.0) - r * r) / (r * (cotan_real(3.0) - r * r));
}

// How many places along each side of a pixel are lit one by one, 4 to 16, to be rounded down, so that a highlight does
// not lie between them: the sharper it is, the more. roughness: the surface's own, [0,1].
COTAN_FUNCTION cotan_real cotan_places_of_roughness(cotan_real roughness)
{
    cotan_real places = cotan_real(1.5) / max(roughness, cotan_real(0.01)) + cotan_real(0.5);
    return min(max(places, cotan_real(4.0)), cotan_real(16.0));
}

// A half vector that is zero when l = -v.
COTAN_FUNCTION cotan_vec3 cotan_half_vector(cotan_vec3 l, cotan_vec3 v)
{
    cotan_vec3 h = l + v;
    return h * cotan_inversesqrt(max(dot(h, h), cotan_real(1e-12)));
}

// What is left of Schlick's Fresnel term: (1 - cosine)^5. cosine: [0,1].
COTAN_FUNCTION cotan_real cotan_grazing(cotan_real cosine)
{
    cotan_real grazing = cotan_real(1.0) - cosine;
    return grazing * grazing * grazing * grazing * grazing;
}

// A GGX highlight without its Fresnel term: distribution times Smith-correlated visibility.
// roughness: perceptual. n.v counts by its magnitude, as 1e-4 at least. Float keeps 1e-3 of the
// value at every roughness and angle.
COTAN_FUNCTION cotan_real cotan_ggx(
    cotan_vec3 n, cotan_vec3 v, cotan_vec3 l, cotan_real roughness)
{
    cotan_real nl = cotan_saturate(dot(n, l));
    cotan_real nv = max(abs(dot(n, v)), cotan_real(1e-4));
    cotan_vec3 h = cotan_half_vector(l, v);
    cotan_real nh = cotan_saturate(dot(n, h));
    cotan_real rough = max(roughness, cotan_real(0.045));
    cotan_real alpha2 = rough * rough * rough * rough;
    // 1 - nh^2 + nh^2 alpha2. The difference is the squared sine: from the cross product it keeps
    // its digits in a highlight, where the two terms meet and floats would lose a fifth of a mirror's.
    cotan_vec3 nxh = cross(n, h);
    cotan_real sine2 = nh > cotan_real(0.0) ? dot(nxh, nxh) : cotan_real(1.0);
    cotan_real d = sine2 + nh * nh * alpha2;
    cotan_real distribution = alpha2 / (COTAN_PI * d * d);
    cotan_real smith_l = nl * sqrt((nv - nv * alpha2) * nv + alpha2);
    cotan_real smith_v = nv * sqrt((nl - nl * alpha2) * nl + alpha2);
    cotan_real visibility = cotan_real(0.5) / (smith_l + smith_v); // nv and alpha2 are not zero
    return distribution * visibility;
}

// As cotan_ggx, but rougher along t than across it (KHR_materials_anisotropy): alpha is the square
// of roughness across, and alpha + (1 - alpha) strength^2 along. t: unit, perpendicular to n; its
// sign does not matter. strength: [0,1].
COTAN_FUNCTION cotan_real cotan_ggx_stretched(cotan_vec3 n, cotan_vec3 v, cotan_vec3 l,
    cotan_real roughness, cotan_real strength, cotan_vec3 t)
{
    cotan_vec3 b = cross(n, t);
    cotan_real nl = cotan_saturate(dot(n, l));
    cotan_real nv = max(abs(dot(n, v)), cotan_real(1e-4));
    cotan_vec3 h = cotan_half_vector(l, v);
    cotan_real nh = cotan_saturate(dot(n, h));
    cotan_real rough = max(roughness, cotan_real(0.045));
    cotan_real across = rough * rough;
    cotan_real along = cotan_mix(across, cotan_real(1.0), strength * strength);
    cotan_vec3 slope = cotan_vec3(dot(t, h) * across, dot(b, h) * along, nh * (along * across));
    cotan_real w = (along * across) / max(dot(slope, slope), cotan_real(1e-30));
    cotan_real distribution =
        nh > cotan_real(0.0) ? along * across * w * w / COTAN_PI : cotan_real(0.0);
    cotan_vec3 seen = cotan_vec3(dot(t, v) * along, dot(b, v) * across, nv);
    cotan_vec3 reached = cotan_vec3(dot(t, l) * along, dot(b, l) * across, nl);
    cotan_real smith = nl * sqrt(dot(seen, seen)) + nv * sqrt(dot(reached, reached));
    return distribution * (cotan_real(0.5) / max(smith, cotan_real(1e-12)));
}

// What a material says of its reflections beyond metallic-roughness.
struct cotan_gloss {
    cotan_vec3 f0;         // of a dielectric, facing: 0.04 for an index of refraction of 1.5
    cotan_real f90;        // of a dielectric, grazing
    cotan_real transmission; // [0,1]: of what a dielectric does not reflect, the share that passes
    cotan_real anisotropy; // [0,1]; 0: as round as ever
    cotan_vec3 t;          // along it the highlight is stretched: unit, perpendicular to n
};

// f0 and f90 of KHR_materials_ior and KHR_materials_specular; nothing passes, nothing is stretched.
// ior 0: reflects all.
COTAN_FUNCTION cotan_gloss cotan_gloss_of(cotan_real ior, cotan_real strength, cotan_vec3 color)
{
    cotan_real ratio = (ior - cotan_real(1.0)) / (ior + cotan_real(1.0));
    cotan_vec3 f0 = color * (ratio * ratio);
    cotan_gloss g;
    g.f0 = cotan_vec3(min(f0.x, cotan_real(1.0)), min(f0.y, cotan_real(1.0)),
        min(f0.z, cotan_real(1.0))) * strength;
    g.f90 = strength;
    g.transmission = cotan_real(0.0);
    g.anisotropy = cotan_real(0.0);
    g.t = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    return g;
}

// What metallic-roughness says by itself: an index of refraction of 1.5.
COTAN_FUNCTION cotan_gloss cotan_plain_gloss()
{
    cotan_real one = cotan_real(1.0);
    cotan_gloss g = cotan_gloss_of(cotan_real(1.5), one, cotan_vec3(one, one, one));
    g.f0 = cotan_vec3(cotan_real(0.04), cotan_real(0.04), cotan_real(0.04));
    return g;
}

// The unit direction on a surface that a frame and a direction in its texture coordinates say:
// along u where they say (1, 0), whether t and b are tangents or gradients, which are perpendicular
// to the other one's tangent; along v, at right angles to u, for (0, 1). Zero where the frame is
// degenerate.
// smooth_n: the frame's normal. n: the perturbed one, to which the result is perpendicular.
COTAN_FUNCTION cotan_vec3 cotan_direction_on_surface(
    cotan_vec3 smooth_n, cotan_vec3 t, cotan_vec3 b, cotan_vec2 direction, cotan_vec3 n)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    cotan_vec3 u = cotan_normalize_or(cross(b, smooth_n), zero);
    cotan_vec3 across = cross(smooth_n, u); // on b's side
    cotan_real along = dot(u, t) < cotan_real(0.0) ? -direction.x : direction.x; // mirrored uv
    cotan_vec3 d = u * along + across * direction.y;
    return cotan_normalize_or(d - n * dot(n, d), zero);
}

// Lambert diffuse and one highlight, as the glTF 2.0 appendix B mixes them, for unit irradiance
// perpendicular to l. highlight: without its Fresnel term.
COTAN_FUNCTION cotan_vec3 cotan_reflect_highlight(
    cotan_surface s, cotan_gloss g, cotan_vec3 l, cotan_real highlight)
{
    cotan_real nl = cotan_saturate(dot(s.n, l));
    cotan_real grazing5 = cotan_grazing(cotan_saturate(dot(s.v, cotan_half_vector(l, s.v))));
    cotan_vec3 f0 = cotan_mix(g.f0, s.base_color, s.metallic);
    cotan_real edge = cotan_mix(g.f90, cotan_real(1.0), s.metallic);
    cotan_vec3 one = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));
    cotan_vec3 fresnel = f0 + (one * edge - f0) * grazing5;
    cotan_real scattered = (cotan_real(1.0) - s.metallic) * (cotan_real(1.0) - g.transmission);
    cotan_vec3 diffuse = (one - fresnel) * s.base_color * (scattered / COTAN_PI);
    return (diffuse + fresnel * highlight) * nl;
}

// Reflected and specular light of one light, for unit irradiance perpendicular to l.
// Lambert diffuse; Smith-correlated GGX with Schlick's Fresnel term, as the glTF 2.0 appendix B
// defines metallic-roughness. Precision: see cotan_ggx.
COTAN_FUNCTION cotan_vec3 cotan_reflect_pbr(cotan_surface s, cotan_vec3 l)
{
    return cotan_reflect_highlight(s, cotan_plain_gloss(), l, cotan_ggx(s.n, s.v, l, s.roughness));
}

// As cotan_reflect_pbr, with reflections of its own.
COTAN_FUNCTION cotan_vec3 cotan_reflect_glossy(cotan_surface s, cotan_gloss g, cotan_vec3 l)
{
    cotan_real even = cotan_ggx(s.n, s.v, l, s.roughness);
    cotan_real stretched = cotan_ggx_stretched(s.n, s.v, l, s.roughness, g.anisotropy, g.t);
    return cotan_reflect_highlight(s, g, l, g.anisotropy > cotan_real(0.0) ? stretched : even);
}

// A clear layer over the surface (KHR_materials_clearcoat), of index of refraction 1.5: it reflects
// as cotan_reflect_coat and cotan_reflect_coat_environment say, and of all that comes from beneath,
// emission too, it shows 1 - cotan_coat_share.
struct cotan_coat {
    cotan_real strength;  // [0,1]: how much of the surface it covers
    cotan_real roughness; // perceptual, [0,1]
    cotan_vec3 n;         // its own normal, unit
};

// Schlick's Fresnel term at n.v, as the extension has it.
COTAN_FUNCTION cotan_real cotan_coat_share(cotan_coat c, cotan_vec3 v)
{
    cotan_real grazing5 = cotan_grazing(cotan_saturate(abs(dot(c.n, v))));
    return c.strength * (cotan_real(0.04) + cotan_real(0.96) * grazing5);
}

// The coat's highlight of one light, of unit irradiance perpendicular to l. Its Fresnel term is that
// of the half vector, so that light and eye may change places.
COTAN_FUNCTION cotan_real cotan_reflect_coat(cotan_coat c, cotan_vec3 v, cotan_vec3 l)
{
    cotan_real nl = cotan_saturate(dot(c.n, l));
    cotan_real grazing5 = cotan_grazing(cotan_saturate(dot(v, cotan_half_vector(l, v))));
    cotan_real fresnel = cotan_real(0.04) + cotan_real(0.96) * grazing5;
    return c.strength * (fresnel * cotan_ggx(c.n, v, l, c.roughness) * nl);
}

// Lambert diffuse and Blinn-Phong specular, for unit irradiance. The exponent is derived from
// roughness: 2/alpha^2 - 2; the specular colour is 0.04 or, for metals, the base colour.
// The normalisation (exponent + 8)/8pi is the usual approximation.
COTAN_FUNCTION cotan_vec3 cotan_reflect_blinn_phong(cotan_surface s, cotan_vec3 l)
{
    cotan_real nl = cotan_saturate(dot(s.n, l));
    cotan_real nh = cotan_saturate(dot(s.n, cotan_half_vector(l, s.v)));
    cotan_real roughness = max(s.roughness, cotan_real(0.1));
    cotan_real alpha = roughness * roughness;
    cotan_real exponent = cotan_real(2.0) / (alpha * alpha) - cotan_real(2.0);
    exponent = max(exponent, cotan_real(1.0));
    cotan_real specular = pow(max(nh, cotan_real(1e-4)), exponent)
        * (exponent + cotan_real(8.0)) / (cotan_real(8.0) * COTAN_PI);
    cotan_vec3 dielectric = cotan_vec3(cotan_real(0.04), cotan_real(0.04), cotan_real(0.04));
    cotan_vec3 f0 = cotan_mix(dielectric, s.base_color, s.metallic);
    cotan_vec3 diffuse = s.base_color * ((cotan_real(1.0) - s.metallic) / COTAN_PI);
    return (diffuse + f0 * specular) * nl;
}

// Radiance of the procedural environment: a bright sky over a warm ground with one large soft
// box. blur 0 is a mirror's view, 1 is what a diffuse surface sees.
COTAN_FUNCTION cotan_vec3 cotan_environment(cotan_vec3 direction, cotan_real blur)
{
    cotan_vec3 ground = cotan_vec3(cotan_real(0.16), cotan_real(0.14), cotan_real(0.12));
    cotan_vec3 horizon = cotan_vec3(cotan_real(0.62), cotan_real(0.66), cotan_real(0.72));
    cotan_vec3 zenith = cotan_vec3(cotan_real(0.28), cotan_real(0.42), cotan_real(0.68));
    cotan_real width = cotan_mix(cotan_real(0.06), cotan_real(0.9), blur);
    cotan_real above = cotan_smooth(-width, width, direction.y);
    cotan_real height = cotan_saturate(direction.y);
    cotan_vec3 sky = cotan_mix(horizon, zenith, cotan_mix(sqrt(height), cotan_real(0.5), blur));
    cotan_vec3 radiance = cotan_mix(ground, sky, above);
    cotan_vec3 box = cotan_vec3(cotan_real(0.48), cotan_real(0.80), cotan_real(0.36));
    cotan_real edge = cotan_mix(cotan_real(0.93), cotan_real(0.2), blur);
    cotan_real soft = cotan_mix(cotan_real(0.03), cotan_real(0.8), blur);
    cotan_real lit = cotan_smooth(edge - soft, edge + soft, dot(direction, box));
    cotan_real strength = cotan_mix(cotan_real(2.2), cotan_real(0.35), sqrt(blur));
    return radiance + cotan_vec3(strength, strength, strength) * lit;
}

// What a highlight reflects of an even environment: x times f0, plus y times f90. Lazarov's
// analytic fit (B. Karis, Physically Based Shading on Mobile, 2014).
COTAN_FUNCTION cotan_vec2 cotan_split_sum(cotan_real nv, cotan_real roughness)
{
    cotan_real a = cotan_real(1.0) - roughness;
    cotan_real a004 = min(a * a, exp2(cotan_real(-9.28) * nv)) * a
        + (cotan_real(0.0425) - cotan_real(0.0275) * roughness);
    cotan_real scale = cotan_real(-1.04) * a004
        + (cotan_real(1.04) - cotan_real(0.572) * roughness);
    cotan_real bias = cotan_real(1.04) * a004
        + (cotan_real(0.022) * roughness - cotan_real(0.04));
    return cotan_vec2(scale, bias);
}

// Where a mirror with normal n shows v what is. Both unit.
COTAN_FUNCTION cotan_vec3 cotan_mirrored(cotan_vec3 n, cotan_vec3 v)
{
    return n * (cotan_real(2.0) * dot(n, v)) - v;
}

// The normal that a stretched highlight reflects the environment with: n bent towards the eye, in
// the plane across t that holds what the stretched lobe gathers (KHR_materials_anisotropy).
COTAN_FUNCTION cotan_vec3 cotan_bent_normal(
    cotan_vec3 n, cotan_vec3 v, cotan_real roughness, cotan_real strength, cotan_vec3 t)
{
    cotan_vec3 b = cross(n, t);
    cotan_vec3 bent = cotan_normalize_or(cross(cross(b, v), b), n);
    cotan_real keep = cotan_real(1.0) - strength * (cotan_real(1.0) - roughness);
    cotan_real keep2 = keep * keep;
    return cotan_normalize_or(cotan_mix(bent, n, keep2 * keep2), n);
}

// The normal that a surface mirrors the environment with: its own, unless the highlight is stretched.
COTAN_FUNCTION cotan_vec3 cotan_reflecting_normal(cotan_surface s, cotan_gloss g)
{
    cotan_vec3 bent = cotan_bent_normal(s.n, s.v, s.roughness, g.anisotropy, g.t);
    return g.anisotropy > cotan_real(0.0) ? bent : s.n;
}

// Ambient light and reflections from the environment, with reflections of its own.
COTAN_FUNCTION cotan_vec3 cotan_reflect_environment_glossy(cotan_surface s, cotan_gloss g)
{
    cotan_vec2 share = cotan_split_sum(cotan_saturate(dot(s.n, s.v)), s.roughness);
    cotan_vec3 f0 = cotan_mix(g.f0, s.base_color, s.metallic);
    cotan_real bias = share.y * cotan_mix(g.f90, cotan_real(1.0), s.metallic);
    cotan_vec3 specular = f0 * share.x + cotan_vec3(bias, bias, bias);
    cotan_real scattered = (cotan_real(1.0) - s.metallic) * (cotan_real(1.0) - g.transmission);
    cotan_vec3 r = cotan_mirrored(cotan_reflecting_normal(s, g), s.v);
    cotan_vec3 ambient = cotan_environment(s.n, cotan_real(1.0)) * (s.base_color * scattered)
        + cotan_environment(r, s.roughness) * specular;
    return ambient * s.occlusion;
}

// Ambient light and reflections from the environment.
COTAN_FUNCTION cotan_vec3 cotan_reflect_environment(cotan_surface s)
{
    return cotan_reflect_environment_glossy(s, cotan_plain_gloss());
}

// The light from behind that reaches the eye through a thin sheet, straight on: factors
// (KHR_materials_transmission without a volume). Roughness does not blur it.
COTAN_FUNCTION cotan_vec3 cotan_transmittance(cotan_surface s, cotan_gloss g)
{
    cotan_vec2 share = cotan_split_sum(cotan_saturate(abs(dot(s.n, s.v))), s.roughness);
    cotan_vec3 one = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));
    cotan_vec3 enters = one - (g.f0 * share.x + one * (g.f90 * share.y));
    cotan_real passes = (cotan_real(1.0) - s.metallic) * g.transmission;
    return s.base_color * passes
        * cotan_vec3(cotan_saturate(enters.x), cotan_saturate(enters.y), cotan_saturate(enters.z));
}

// What the coat reflects of the environment.
COTAN_FUNCTION cotan_vec3 cotan_reflect_coat_environment(cotan_coat c, cotan_vec3 v)
{
    cotan_vec2 share = cotan_split_sum(cotan_saturate(dot(c.n, v)), c.roughness);
    return cotan_environment(cotan_mirrored(c.n, v), c.roughness)
        * (c.strength * (cotan_real(0.04) * share.x + share.y));
}

// Falloff of a point or spot light at distance d: 1/d^2, windowed to reach zero at `range`
// (KHR_lights_punctual). range <= 0 means infinite. Nearer than 0.01 the light is as at 0.01.
COTAN_FUNCTION cotan_real cotan_light_falloff(cotan_real d, cotan_real range)
{
    cotan_real q = range > cotan_real(0.0) ? d / range : cotan_real(0.0);
    cotan_real window = cotan_saturate(cotan_real(1.0) - q * q * q * q);
    return window / max(d * d, cotan_real(1e-4));
}

// Tone curve: S. Hill's fit is not used; this is the short rational curve of K. Narkowicz (2015),
// applied per channel. x: linear, >= 0; result linear in [0,1].
COTAN_FUNCTION cotan_real cotan_tone(cotan_real x)
{
    cotan_real y = x * (cotan_real(2.51) * x + cotan_real(0.03))
        / (x * (cotan_real(2.43) * x + cotan_real(0.59)) + cotan_real(0.14));
    return cotan_saturate(y);
}
COTAN_FUNCTION cotan_vec3 cotan_tone_map(cotan_vec3 c)
{
    return cotan_vec3(cotan_tone(c.x), cotan_tone(c.y), cotan_tone(c.z));
}

// sRGB transfer function (IEC 61966-2-1), both ways; x in [0,1].
COTAN_FUNCTION cotan_real cotan_linear_to_srgb(cotan_real x)
{
    cotan_real curve = cotan_real(1.055) * pow(max(x, cotan_real(1e-8)), cotan_real(1.0 / 2.4))
        - cotan_real(0.055);
    return x <= cotan_real(0.0031308) ? x * cotan_real(12.92) : curve;
}
COTAN_FUNCTION cotan_real cotan_srgb_to_linear(cotan_real x)
{
    cotan_real curve = pow((max(x, cotan_real(0.0)) + cotan_real(0.055)) / cotan_real(1.055),
        cotan_real(2.4));
    return x <= cotan_real(0.04045) ? x / cotan_real(12.92) : curve;
}

#endif
