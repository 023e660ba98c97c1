// Cotan portable text: lighting. Include lang.h first.
//
// Small, standard and the same on the GPU and in the reference renderer: ambient + diffuse +
// Blinn-Phong, and GGX metallic-roughness, with a soft procedural environment. All colours are
// linear. n, l, v are unit vectors in one space (world, y up, for the environment): normal, to
// the light, to the eye.

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

// A half vector that is zero when l = -v.
COTAN_FUNCTION cotan_vec3 cotan_half_vector(cotan_vec3 l, cotan_vec3 v)
{
    cotan_vec3 h = l + v;
    return h * cotan_inversesqrt(max(dot(h, h), cotan_real(1e-12)));
}

// Reflected and specular light of one light, for unit irradiance perpendicular to l.
// Lambert diffuse; Smith-correlated GGX with Schlick's Fresnel term, as the glTF 2.0 appendix B
// defines metallic-roughness. n.v counts by its magnitude, as 1e-4 at least. Float keeps 1e-3 of the
// value at every roughness and angle.
COTAN_FUNCTION cotan_vec3 cotan_reflect_pbr(cotan_surface s, cotan_vec3 l)
{
    cotan_real nl = cotan_saturate(dot(s.n, l));
    cotan_real nv = max(abs(dot(s.n, s.v)), cotan_real(1e-4));
    cotan_vec3 h = cotan_half_vector(l, s.v);
    cotan_real nh = cotan_saturate(dot(s.n, h));
    cotan_real vh = cotan_saturate(dot(s.v, h));
    cotan_real roughness = max(s.roughness, cotan_real(0.045));
    cotan_real alpha2 = roughness * roughness * roughness * roughness;
    // 1 - nh^2 + nh^2 alpha2. The difference is the squared sine: from the cross product it keeps its
    // digits in a highlight, where the two terms meet and floats would lose a fifth of a mirror's.
    cotan_vec3 nxh = cross(s.n, h);
    cotan_real sine2 = nh > cotan_real(0.0) ? dot(nxh, nxh) : cotan_real(1.0);
    cotan_real d = sine2 + nh * nh * alpha2;
    cotan_real distribution = alpha2 / (COTAN_PI * d * d);
    cotan_real smith_l = nl * sqrt((nv - nv * alpha2) * nv + alpha2);
    cotan_real smith_v = nv * sqrt((nl - nl * alpha2) * nl + alpha2);
    cotan_real visibility = cotan_real(0.5) / (smith_l + smith_v); // nv and alpha2 are not zero
    cotan_real grazing = cotan_real(1.0) - vh;
    cotan_real grazing5 = grazing * grazing * grazing * grazing * grazing;
    cotan_vec3 dielectric = cotan_vec3(cotan_real(0.04), cotan_real(0.04), cotan_real(0.04));
    cotan_vec3 f0 = cotan_mix(dielectric, s.base_color, s.metallic);
    cotan_vec3 one = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));
    cotan_vec3 fresnel = f0 + (one - f0) * grazing5;
    cotan_vec3 diffuse = (one - fresnel) * s.base_color
        * ((cotan_real(1.0) - s.metallic) / COTAN_PI);
    return (diffuse + fresnel * (distribution * visibility)) * nl;
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

// Ambient light and reflections from the environment. The split-sum factor is Lazarov's analytic
// fit (B. Karis, Physically Based Shading on Mobile, 2014).
COTAN_FUNCTION cotan_vec3 cotan_reflect_environment(cotan_surface s)
{
    cotan_real nv = cotan_saturate(dot(s.n, s.v));
    cotan_vec3 r = s.n * (cotan_real(2.0) * dot(s.n, s.v)) - s.v;
    cotan_real a = cotan_real(1.0) - s.roughness;
    cotan_real a004 = min(a * a, exp2(cotan_real(-9.28) * nv)) * a
        + (cotan_real(0.0425) - cotan_real(0.0275) * s.roughness);
    cotan_real scale = cotan_real(-1.04) * a004
        + (cotan_real(1.04) - cotan_real(0.572) * s.roughness);
    cotan_real bias = cotan_real(1.04) * a004
        + (cotan_real(0.022) * s.roughness - cotan_real(0.04));
    cotan_vec3 dielectric = cotan_vec3(cotan_real(0.04), cotan_real(0.04), cotan_real(0.04));
    cotan_vec3 f0 = cotan_mix(dielectric, s.base_color, s.metallic);
    cotan_vec3 specular = f0 * scale + cotan_vec3(bias, bias, bias);
    cotan_vec3 diffuse = s.base_color * (cotan_real(1.0) - s.metallic);
    cotan_vec3 ambient = cotan_environment(s.n, cotan_real(1.0)) * diffuse
        + cotan_environment(r, s.roughness) * specular;
    return ambient * s.occlusion;
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
