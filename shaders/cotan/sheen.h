// Cotan portable text: the sheen of cloth (KHR_materials_sheen). Include lang.h and light.h first.
//
// The Charlie distribution of fibres. Source: A. Estevez, C. Kulla, Production Friendly Microfacet Sheen BRDF, 2017. n,
// v, l as in light.h.

#ifndef COTAN_SHEEN_H
#define COTAN_SHEEN_H

// The layer of fibres on a surface (KHR_materials_sheen). It reflects cotan_reflect_sheen and
// cotan_reflect_sheen_around, and it leaves 1 - cotan_sheen_fraction of the light that the surface reflects and
// transmits, but all of the emission.
struct cotan_sheen {
    cotan_vec3 color;     // linear, [0,1]
    cotan_real roughness; // perceptual, [0,1], at least 0.15: below that, the lobe would reflect more than it receives
};

// The natural logarithm of Charlie's masking term for a cosine in [0,0.5]. k: (1 - alpha)^2.
// Source: table 1 of the paper.
COTAN_FUNCTION cotan_real cotan_charlie_fit(cotan_real x, cotan_real k)
{
    cotan_real a = cotan_mix(cotan_real(21.5473), cotan_real(25.3245), k);
    cotan_real b = cotan_mix(cotan_real(3.82987), cotan_real(3.32435), k);
    cotan_real c = cotan_mix(cotan_real(0.19823), cotan_real(0.16801), k);
    cotan_real d = cotan_mix(cotan_real(-1.97760), cotan_real(-1.27393), k);
    cotan_real e = cotan_mix(cotan_real(-4.32054), cotan_real(-4.85967), k);
    return a / (cotan_real(1.0) + b * pow(max(x, cotan_real(1e-6)), c)) + d * x + e;
}

COTAN_FUNCTION cotan_real cotan_charlie_masking(cotan_real cosine, cotan_real alpha)
{
    cotan_real k = (cotan_real(1.0) - alpha) * (cotan_real(1.0) - alpha);
    cotan_real low = cotan_charlie_fit(min(cosine, cotan_real(1.0) - cosine), k);
    cotan_real high = cotan_real(2.0) * cotan_charlie_fit(cotan_real(0.5), k) - low;
    return exp2((cosine < cotan_real(0.5) ? low : high) * cotan_real(1.4426950408889634));
}

// Returns the highlight of fibres that stand on the surface: distribution times visibility, which is limited to 1 as in
// Khronos' sample renderer. n.v is replaced by its magnitude; both cosines are at least 1e-4.
COTAN_FUNCTION cotan_real cotan_charlie(
    cotan_vec3 n, cotan_vec3 v, cotan_vec3 l, cotan_real roughness)
{
    cotan_real nl = min(max(dot(n, l), cotan_real(1e-4)), cotan_real(1.0));
    cotan_real nv = min(max(abs(dot(n, v)), cotan_real(1e-4)), cotan_real(1.0));
    cotan_real rough = max(roughness, cotan_real(0.15));
    cotan_real alpha = rough * rough;
    cotan_real inverse = cotan_real(1.0) / alpha;
    cotan_vec3 nxh = cross(n, cotan_half_vector(l, v));
    cotan_real sine2 = max(dot(nxh, nxh), cotan_real(1e-4));
    cotan_real distribution = (cotan_real(2.0) + inverse) * pow(sine2, cotan_real(0.5) * inverse)
        / (cotan_real(2.0) * COTAN_PI);
    cotan_real masking = cotan_real(1.0) + cotan_charlie_masking(nv, alpha)
        + cotan_charlie_masking(nl, alpha);
    return distribution * min(cotan_real(0.25) / (masking * nv * nl), cotan_real(1.0));
}

// Returns the albedo of white fibres under uniform light, by the cosine of the eye or of the light. Our fit to the
// integral of cotan_charlie; its error is 0.005 in the mean, and at most 0.025 for cosines above 0.03.
COTAN_FUNCTION cotan_real cotan_sheen_albedo(cotan_real cosine, cotan_real roughness)
{
    cotan_real x = cotan_saturate(cosine);
    cotan_real i = cotan_real(1.0) / max(roughness, cotan_real(0.15));
    cotan_real edge = cotan_real(0.10817)
        + i * (cotan_real(-0.61020) + i * (cotan_real(0.19288) - i * cotan_real(0.01465)));
    cotan_real slope = cotan_real(-0.85077)
        + i * (cotan_real(-1.23079) + i * (cotan_real(-0.11429) + i * cotan_real(0.01061)));
    cotan_real bend = cotan_real(-0.21246)
        + i * (cotan_real(0.48991) + i * (cotan_real(-0.37141) + i * cotan_real(0.03188)));
    return min(exp2(edge + x * (slope + x * bend)), cotan_real(1.0));
}

// Returns the fraction of light that the fibres take from the surface beneath. cosine: the smaller one of light and
// eye, so that these can be exchanged.
COTAN_FUNCTION cotan_real cotan_sheen_fraction(cotan_sheen c, cotan_real cosine)
{
    return max(max(c.color.x, c.color.y), c.color.z) * cotan_sheen_albedo(cosine, c.roughness);
}

// Returns the light of one light source that the fibres and the surface beneath reflect, for unit irradiance
// perpendicular to l. beneath: the light from the surface alone.
COTAN_FUNCTION cotan_vec3 cotan_reflect_sheen(
    cotan_sheen c, cotan_vec3 n, cotan_vec3 v, cotan_vec3 l, cotan_vec3 beneath)
{
    cotan_real nl = cotan_saturate(dot(n, l));
    cotan_real fraction = cotan_sheen_fraction(c, min(nl, abs(dot(n, v))));
    return beneath * (cotan_real(1.0) - fraction)
        + c.color * (cotan_charlie(n, v, l, c.roughness) * nl);
}

// Like cotan_reflect_sheen, for the light of the environment. The lobe is so wide that the irradiance of the surface is
// used. irradiance: divided by pi.
COTAN_FUNCTION cotan_vec3 cotan_reflect_sheen_around(
    cotan_sheen c, cotan_vec3 n, cotan_vec3 v, cotan_vec3 irradiance, cotan_vec3 beneath)
{
    cotan_real nv = abs(dot(n, v));
    return beneath * (cotan_real(1.0) - cotan_sheen_fraction(c, nv))
        + irradiance * c.color * cotan_sheen_albedo(nv, c.roughness);
}

#endif
