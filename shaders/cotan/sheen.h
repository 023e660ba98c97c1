// Cotan portable text: the sheen of cloth (KHR_materials_sheen). Include lang.h and light.h first.
//
// Charlie's distribution of fibres. Source: A. Estevez, C. Kulla, Production Friendly Microfacet Sheen
// BRDF, 2017. n, v, l as in light.h.

#ifndef COTAN_SHEEN_H
#define COTAN_SHEEN_H

// The fibres of cloth on the surface (KHR_materials_sheen): they reflect as cotan_reflect_sheen and
// cotan_reflect_sheen_around say, and of what the surface reflects and lets through, not of emission,
// they leave 1 - cotan_sheen_share.
struct cotan_sheen {
    cotan_vec3 color;     // linear, [0,1]
    cotan_real roughness; // perceptual, [0,1], at least 0.15: below, the lobe gives more than it gets
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

// A highlight of fibres that stand on the surface: distribution times visibility, which is at most 1.
// n.v counts by its magnitude; both cosines as 1e-4 at least. The limit is that of Khronos' sample
// renderer.
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

// What white fibres reflect of white light from all around, by the cosine of the eye or the light: a
// fit of ours to the integral of cotan_charlie, 0.005 off in the mean and 0.025 at most above a cosine
// of 0.03.
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

// What the fibres take from what lies beneath, by the smaller of the cosines of light and eye: so they
// may change places.
COTAN_FUNCTION cotan_real cotan_sheen_share(cotan_sheen c, cotan_real cosine)
{
    return max(max(c.color.x, c.color.y), c.color.z) * cotan_sheen_albedo(cosine, c.roughness);
}

// What the fibres and the surface beneath reflect of one light, of unit irradiance perpendicular to l.
// beneath: the surface alone.
COTAN_FUNCTION cotan_vec3 cotan_reflect_sheen(
    cotan_sheen c, cotan_vec3 n, cotan_vec3 v, cotan_vec3 l, cotan_vec3 beneath)
{
    cotan_real nl = cotan_saturate(dot(n, l));
    cotan_real share = cotan_sheen_share(c, min(nl, abs(dot(n, v))));
    return beneath * (cotan_real(1.0) - share)
        + c.color * (cotan_charlie(n, v, l, c.roughness) * nl);
}

// The same of the environment. The lobe is so wide that it sees what the surface does.
// irradiance: divided by pi.
COTAN_FUNCTION cotan_vec3 cotan_reflect_sheen_around(
    cotan_sheen c, cotan_vec3 n, cotan_vec3 v, cotan_vec3 irradiance, cotan_vec3 beneath)
{
    cotan_real nv = abs(dot(n, v));
    return beneath * (cotan_real(1.0) - cotan_sheen_share(c, nv))
        + irradiance * c.color * cotan_sheen_albedo(nv, c.roughness);
}

#endif
