// Cotan portable text: lighting. Include lang.h and frame.h first.
//
// The GPU and the reference renderer share these small, standard models: ambient + diffuse + Blinn-Phong, and GGX
// metallic-roughness with a soft procedural environment. As in extensions of glTF: anisotropic highlights, other
// specular strengths and colours, transmission through thin sheets, and a clear coat over everything. All colours are
// linear. n, l, v are unit vectors in one space (world, y up, for the environment): normal, to the light, to the eye.

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

// ---- specular antialiasing: highlights that are smaller than a pixel ----

// Returns the perceptual roughness that includes the variance of normals within the visible footprint; the squares of
// slopes add up. roughness: of the surface itself, [0,1]. spread: variance of the slopes, summed over both directions,
// not negative.
COTAN_FUNCTION cotan_real cotan_roughness_of_variance(cotan_real roughness, cotan_real spread)
{
    cotan_real alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + spread, cotan_real(1.0))));
}

// Returns the variance of normals within a pixel that is due to the curvature of the surface, over a square filter of
// one pixel's width. dndx, dndy: differences of the unit normal without the map to the next pixels. Clamped to 0.18,
// above which the differences say little (Y. Tokuyoshi, A. Kaplanyan, Improved Geometric Specular Antialiasing, 2019;
// their Gaussian pixel filter gives four times as much, with larger measured errors).
COTAN_FUNCTION cotan_real cotan_variance_of_curvature(cotan_vec3 dndx, cotan_vec3 dndy)
{
    return min((dot(dndx, dndx) + dot(dndy, dndy)) / cotan_real(12.0), cotan_real(0.18));
}

// Returns the variance of unit normals whose mean has the given length, [0,1]. The mips of a normal map lose this
// variance, so it is stored in a channel of its own. Assumes a von Mises-Fisher distribution, exp(kappa cos), with
// kappa after A. Banerjee et al. (2005). A difference of one 8-bit step from length 1 counts as rounding.
COTAN_FUNCTION cotan_real cotan_variance_of_length(cotan_real length_of_mean)
{
    cotan_real r = min(max(length_of_mean, cotan_real(0.05)) + cotan_real(1.0 / 255.0), cotan_real(1.0));
    return cotan_real(2.0) * (cotan_real(1.0) - r * r) / (r * (cotan_real(3.0) - r * r));
}

// Returns the number of samples along each side of a pixel that are lit separately, 4 to 16, to be rounded down.
// Sharper highlights need more, or they fall between the samples. roughness: of the surface itself, [0,1].
COTAN_FUNCTION cotan_real cotan_samples_of_roughness(cotan_real roughness)
{
    cotan_real samples = cotan_real(1.5) / max(roughness, cotan_real(0.01)) + cotan_real(0.5);
    return min(max(samples, cotan_real(4.0)), cotan_real(16.0));
}

// Returns the unit half vector; zero if l = -v.
COTAN_FUNCTION cotan_vec3 cotan_half_vector(cotan_vec3 l, cotan_vec3 v)
{
    cotan_vec3 h = l + v;
    return h * cotan_inversesqrt(max(dot(h, h), cotan_real(1e-12)));
}

// The factor (1 - cosine)^5 of Schlick's Fresnel term. cosine: [0,1].
COTAN_FUNCTION cotan_real cotan_grazing(cotan_real cosine)
{
    cotan_real grazing = cotan_real(1.0) - cosine;
    return grazing * grazing * grazing * grazing * grazing;
}

// Returns a GGX highlight without its Fresnel term: distribution times Smith-correlated visibility. roughness:
// perceptual. n.v is replaced by its magnitude, at least 1e-4. The relative error in float is at most 1e-3 at every
// roughness and angle.
COTAN_FUNCTION cotan_real cotan_ggx(
    cotan_vec3 n, cotan_vec3 v, cotan_vec3 l, cotan_real roughness)
{
    cotan_real nl = cotan_saturate(dot(n, l));
    cotan_real nv = max(abs(dot(n, v)), cotan_real(1e-4));
    cotan_vec3 h = cotan_half_vector(l, v);
    cotan_real nh = cotan_saturate(dot(n, h));
    cotan_real rough = max(roughness, cotan_real(0.045));
    cotan_real alpha2 = rough * rough * rough * rough;
    // 1 - nh^2 + nh^2 alpha2. The difference is the squared sine. In a highlight its terms nearly cancel, and floats
    // would lose a fifth of a mirror's highlight; the cross product keeps the digits.
    cotan_vec3 nxh = cross(n, h);
    cotan_real sine2 = nh > cotan_real(0.0) ? dot(nxh, nxh) : cotan_real(1.0);
    cotan_real d = sine2 + nh * nh * alpha2;
    cotan_real distribution = alpha2 / (COTAN_PI * d * d);
    cotan_real smith_l = nl * sqrt((nv - nv * alpha2) * nv + alpha2);
    cotan_real smith_v = nv * sqrt((nl - nl * alpha2) * nl + alpha2);
    cotan_real visibility = cotan_real(0.5) / (smith_l + smith_v); // nv and alpha2 are not zero
    return distribution * visibility;
}

// Like cotan_ggx, but rougher along t than across it (KHR_materials_anisotropy): alpha is roughness^2 across, and
// alpha + (1 - alpha) strength^2 along. t: unit, perpendicular to n; its sign does not matter. strength: [0,1].
COTAN_FUNCTION cotan_real cotan_ggx_anisotropic(cotan_vec3 n, cotan_vec3 v, cotan_vec3 l,
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
    cotan_vec3 scaled_v = cotan_vec3(dot(t, v) * along, dot(b, v) * across, nv);
    cotan_vec3 scaled_l = cotan_vec3(dot(t, l) * along, dot(b, l) * across, nl);
    cotan_real smith = nl * sqrt(dot(scaled_v, scaled_v)) + nv * sqrt(dot(scaled_l, scaled_l));
    return distribution * (cotan_real(0.5) / max(smith, cotan_real(1e-12)));
}

// The reflections of a material beyond metallic-roughness.
struct cotan_gloss {
    cotan_vec3 f0;         // of a dielectric at normal incidence: 0.04 for an index of refraction of 1.5
    cotan_real f90;        // of a dielectric at grazing incidence
    cotan_real transmission; // [0,1]: fraction of the light not reflected by a dielectric that passes through
    cotan_real anisotropy; // [0,1]; 0: isotropic
    cotan_vec3 t;          // direction along which the highlight is stretched: unit, perpendicular to n
};

// Returns f0 and f90 of KHR_materials_ior and KHR_materials_specular, without transmission and anisotropy. ior 0:
// reflects all light.
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

// The dielectric of plain metallic-roughness: an index of refraction of 1.5.
COTAN_FUNCTION cotan_gloss cotan_plain_gloss()
{
    cotan_real one = cotan_real(1.0);
    cotan_gloss g = cotan_gloss_of(cotan_real(1.5), one, cotan_vec3(one, one, one));
    g.f0 = cotan_vec3(cotan_real(0.04), cotan_real(0.04), cotan_real(0.04));
    return g;
}

// Returns the unit direction on a surface that corresponds to a direction in texture coordinates. (1, 0) gives dP/du,
// whether t and b are tangents or gradients, because a gradient of v is perpendicular to dP/du. (0, 1) gives the
// direction perpendicular to dP/du, on the side of increasing v. Zero if the frame is degenerate.
// smooth_n: the frame's normal. n: the perturbed normal, to which the result is perpendicular.
COTAN_FUNCTION cotan_vec3 cotan_direction_on_surface(
    cotan_vec3 smooth_n, cotan_vec3 t, cotan_vec3 b, cotan_vec2 direction, cotan_vec3 n)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    cotan_vec3 u = cotan_normalize_or(cross(b, smooth_n), zero);
    cotan_vec3 across = cross(smooth_n, u); // on the side of b
    cotan_real along = dot(u, t) < cotan_real(0.0) ? -direction.x : direction.x; // mirrored uv
    cotan_vec3 d = u * along + across * direction.y;
    return cotan_normalize_or(d - n * dot(n, d), zero);
}

// Returns Lambert diffuse light and one highlight, combined as in appendix B of glTF 2.0, for unit irradiance
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

// Returns the diffuse and specular reflection of one light, for unit irradiance perpendicular to l. Lambert diffuse;
// Smith-correlated GGX with Schlick's Fresnel term, as appendix B of glTF 2.0 defines metallic-roughness. Precision:
// see cotan_ggx.
COTAN_FUNCTION cotan_vec3 cotan_reflect_pbr(cotan_surface s, cotan_vec3 l)
{
    return cotan_reflect_highlight(s, cotan_plain_gloss(), l, cotan_ggx(s.n, s.v, l, s.roughness));
}

// Like cotan_reflect_pbr, with the reflections of g.
COTAN_FUNCTION cotan_vec3 cotan_reflect_glossy(cotan_surface s, cotan_gloss g, cotan_vec3 l)
{
    cotan_real even = cotan_ggx(s.n, s.v, l, s.roughness);
    cotan_real stretched = cotan_ggx_anisotropic(s.n, s.v, l, s.roughness, g.anisotropy, g.t);
    return cotan_reflect_highlight(s, g, l, g.anisotropy > cotan_real(0.0) ? stretched : even);
}

// A clear layer over the surface (KHR_materials_clearcoat) with an index of refraction of 1.5. It reflects
// cotan_reflect_coat and cotan_reflect_coat_environment, and it transmits 1 - cotan_coat_fraction of all light from
// beneath, including emission.
struct cotan_coat {
    cotan_real strength;  // [0,1]: the fraction of the surface that it covers
    cotan_real roughness; // perceptual, [0,1]
    cotan_vec3 n;         // the coat's own normal, unit
};

// Returns the fraction of light that the coat reflects: Schlick's Fresnel term at n.v, as in the extension.
COTAN_FUNCTION cotan_real cotan_coat_fraction(cotan_coat c, cotan_vec3 v)
{
    cotan_real grazing5 = cotan_grazing(cotan_saturate(abs(dot(c.n, v))));
    return c.strength * (cotan_real(0.04) + cotan_real(0.96) * grazing5);
}

// Returns the coat's highlight of one light, for unit irradiance perpendicular to l. The Fresnel term uses the half
// vector, so light and eye can be exchanged.
COTAN_FUNCTION cotan_real cotan_reflect_coat(cotan_coat c, cotan_vec3 v, cotan_vec3 l)
{
    cotan_real nl = cotan_saturate(dot(c.n, l));
    cotan_real grazing5 = cotan_grazing(cotan_saturate(dot(v, cotan_half_vector(l, v))));
    cotan_real fresnel = cotan_real(0.04) + cotan_real(0.96) * grazing5;
    return c.strength * (fresnel * cotan_ggx(c.n, v, l, c.roughness) * nl);
}

// Lambert diffuse and Blinn-Phong specular, for unit irradiance. The exponent is derived from the roughness:
// 2/alpha^2 - 2. The specular colour is 0.04 or, for metals, the base colour. The normalisation (exponent + 8)/8pi is
// the usual approximation.
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

// Radiance of the procedural environment: a bright sky over a warm ground with one large softbox. blur: 0 as a mirror
// reflects it, 1 as a diffuse surface receives it.
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

// Specular reflection of a uniform environment: x times f0, plus y times f90. Lazarov's analytic fit (B. Karis,
// Physically Based Shading on Mobile, 2014).
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

// Returns v mirrored at n: the direction that a mirror reflects towards v. Both are unit.
COTAN_FUNCTION cotan_vec3 cotan_mirrored(cotan_vec3 n, cotan_vec3 v)
{
    return n * (cotan_real(2.0) * dot(n, v)) - v;
}

// Returns the normal with which an anisotropic highlight reflects the environment: n bent towards the eye, in the plane
// across t (KHR_materials_anisotropy).
COTAN_FUNCTION cotan_vec3 cotan_bent_normal(
    cotan_vec3 n, cotan_vec3 v, cotan_real roughness, cotan_real strength, cotan_vec3 t)
{
    cotan_vec3 b = cross(n, t);
    cotan_vec3 bent = cotan_normalize_or(cross(cross(b, v), b), n);
    cotan_real keep = cotan_real(1.0) - strength * (cotan_real(1.0) - roughness);
    cotan_real keep2 = keep * keep;
    return cotan_normalize_or(cotan_mix(bent, n, keep2 * keep2), n);
}

// Returns the normal with which a surface reflects the environment: its own, unless the highlight is anisotropic.
COTAN_FUNCTION cotan_vec3 cotan_reflecting_normal(cotan_surface s, cotan_gloss g)
{
    cotan_vec3 bent = cotan_bent_normal(s.n, s.v, s.roughness, g.anisotropy, g.t);
    return g.anisotropy > cotan_real(0.0) ? bent : s.n;
}

// Returns ambient light and reflections from the environment, with the reflections of g.
COTAN_FUNCTION cotan_vec3 cotan_reflect_environment_glossy(cotan_surface s, cotan_gloss g)
{
    cotan_vec2 scale_bias = cotan_split_sum(cotan_saturate(dot(s.n, s.v)), s.roughness);
    cotan_vec3 f0 = cotan_mix(g.f0, s.base_color, s.metallic);
    cotan_real bias = scale_bias.y * cotan_mix(g.f90, cotan_real(1.0), s.metallic);
    cotan_vec3 specular = f0 * scale_bias.x + cotan_vec3(bias, bias, bias);
    cotan_real scattered = (cotan_real(1.0) - s.metallic) * (cotan_real(1.0) - g.transmission);
    cotan_vec3 r = cotan_mirrored(cotan_reflecting_normal(s, g), s.v);
    cotan_vec3 ambient = cotan_environment(s.n, cotan_real(1.0)) * (s.base_color * scattered)
        + cotan_environment(r, s.roughness) * specular;
    return ambient * s.occlusion;
}

// Returns ambient light and reflections from the environment.
COTAN_FUNCTION cotan_vec3 cotan_reflect_environment(cotan_surface s)
{
    return cotan_reflect_environment_glossy(s, cotan_plain_gloss());
}

// Returns the factors for light from behind that reaches the eye straight through a thin sheet
// (KHR_materials_transmission without a volume). Roughness does not blur it.
COTAN_FUNCTION cotan_vec3 cotan_transmittance(cotan_surface s, cotan_gloss g)
{
    cotan_vec2 scale_bias = cotan_split_sum(cotan_saturate(abs(dot(s.n, s.v))), s.roughness);
    cotan_vec3 one = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));
    cotan_vec3 transmitted = one - (g.f0 * scale_bias.x + one * (g.f90 * scale_bias.y));
    cotan_real passes = (cotan_real(1.0) - s.metallic) * g.transmission;
    return s.base_color * passes
        * cotan_vec3(cotan_saturate(transmitted.x), cotan_saturate(transmitted.y), cotan_saturate(transmitted.z));
}

// Returns the coat's reflection of the environment.
COTAN_FUNCTION cotan_vec3 cotan_reflect_coat_environment(cotan_coat c, cotan_vec3 v)
{
    cotan_vec2 scale_bias = cotan_split_sum(cotan_saturate(dot(c.n, v)), c.roughness);
    return cotan_environment(cotan_mirrored(c.n, v), c.roughness)
        * (c.strength * (cotan_real(0.04) * scale_bias.x + scale_bias.y));
}

// Falloff of a point or spot light at distance d: 1/d^2, windowed to reach zero at `range` (KHR_lights_punctual).
// range <= 0 means infinite. Distances below 0.01 count as 0.01.
COTAN_FUNCTION cotan_real cotan_light_falloff(cotan_real d, cotan_real range)
{
    cotan_real q = range > cotan_real(0.0) ? d / range : cotan_real(0.0);
    cotan_real window = cotan_saturate(cotan_real(1.0) - q * q * q * q);
    return window / max(d * d, cotan_real(1e-4));
}

// Tone curve: the short rational fit of ACES by K. Narkowicz (2015), not S. Hill's, applied per channel. x: linear,
// not negative; the result is linear in [0,1].
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

// The sRGB transfer function (IEC 61966-2-1) and its inverse; x in [0,1].
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
