// Cotan portable text: tone curves, from unbounded light to the range of a display. Include lang.h and light.h first.
//
// Colours are linear, not negative, with the primaries of sRGB; results are linear in [0,1]. Apply the exposure first.

#ifndef COTAN_TONE_H
#define COTAN_TONE_H

#define COTAN_TONE_NONE 0
#define COTAN_TONE_ACES 1
#define COTAN_TONE_NEUTRAL 2
#define COTAN_TONE_AGX 3

COTAN_FUNCTION cotan_vec3 cotan_saturate_color(cotan_vec3 c)
{
    return cotan_vec3(cotan_saturate(c.x), cotan_saturate(c.y), cotan_saturate(c.z));
}

// Khronos PBR Neutral (2024), as specified: subtracts the 4 % of white light that a dielectric reflects, keeps values
// below 0.76 after that, and moves brighter colours towards white.
COTAN_FUNCTION cotan_vec3 cotan_tone_neutral(cotan_vec3 c)
{
    cotan_real start = cotan_real(0.8 - 0.04);
    cotan_real smallest = min(c.x, min(c.y, c.z));
    cotan_real offset =
        smallest < cotan_real(0.08) ? smallest - cotan_real(6.25) * smallest * smallest : cotan_real(0.04);
    cotan_vec3 kept = c - cotan_vec3(offset, offset, offset);
    cotan_real peak = max(kept.x, max(kept.y, kept.z));
    if (peak < start)
        return kept;
    cotan_real headroom = cotan_real(1.0) - start;
    cotan_real lowered = cotan_real(1.0) - headroom * headroom / (peak + headroom - start);
    cotan_real white = cotan_real(1.0) - cotan_real(1.0) / (cotan_real(0.15) * (peak - lowered) + cotan_real(1.0));
    return cotan_mix(kept * (lowered / peak), cotan_vec3(lowered, lowered, lowered), white);
}

// The contrast curve of AgX, as a polynomial by B. Wrensch (Minimal AgX Implementation, 2023).
COTAN_FUNCTION cotan_real cotan_agx_contrast(cotan_real x)
{
    cotan_real x2 = x * x;
    cotan_real x4 = x2 * x2;
    return cotan_real(15.5) * x4 * x2 - cotan_real(40.14) * x4 * x + cotan_real(31.96) * x4
        - cotan_real(6.868) * x2 * x + cotan_real(0.4298) * x2 + cotan_real(0.1191) * x - cotan_real(0.00232);
}

// Encodes linear light logarithmically over 16.5 stops, 6.5 of them above middle grey, and applies the contrast curve.
COTAN_FUNCTION cotan_real cotan_agx_encoded(cotan_real x)
{
    cotan_real stops = log2(max(x, cotan_real(1e-10)));
    return cotan_agx_contrast(cotan_saturate((stops + cotan_real(12.47393)) / cotan_real(12.47393 + 4.026069)));
}

// AgX (T. Sobotka) in the primaries of Rec. 2020, with the matrices of Filament and Blender, without a look.
COTAN_FUNCTION cotan_vec3 cotan_tone_agx(cotan_vec3 c)
{
    // To Rec. 2020 (ITU-R BT.2407), then the inset towards grey.
    cotan_vec3 wide = cotan_vec3(dot(c, cotan_vec3(cotan_real(0.6274), cotan_real(0.3293), cotan_real(0.0433))),
        dot(c, cotan_vec3(cotan_real(0.0691), cotan_real(0.9195), cotan_real(0.0113))),
        dot(c, cotan_vec3(cotan_real(0.0164), cotan_real(0.0880), cotan_real(0.8956))));
    cotan_vec3 inset = cotan_vec3(
        dot(wide, cotan_vec3(cotan_real(0.856627153315983), cotan_real(0.0951212405381588),
            cotan_real(0.0482516061458583))),
        dot(wide, cotan_vec3(cotan_real(0.137318972929847), cotan_real(0.761241990602591),
            cotan_real(0.101439036467562))),
        dot(wide, cotan_vec3(cotan_real(0.11189821299995), cotan_real(0.0767994186031903),
            cotan_real(0.811302368396859))));
    cotan_vec3 e = cotan_vec3(cotan_agx_encoded(inset.x), cotan_agx_encoded(inset.y), cotan_agx_encoded(inset.z));
    // The inverse of the inset, then back to linear light: the curve encodes for a display of gamma 2.2.
    cotan_vec3 o = cotan_vec3(
        dot(e, cotan_vec3(cotan_real(1.1271005818144368), cotan_real(-0.11060664309660323),
            cotan_real(-0.016493938717834573))),
        dot(e, cotan_vec3(cotan_real(-0.1413297634984383), cotan_real(1.157823702216272),
            cotan_real(-0.016493938717834257))),
        dot(e, cotan_vec3(cotan_real(-0.14132976349843826), cotan_real(-0.11060664309660294),
            cotan_real(1.2519364065950405))));
    cotan_real zero = cotan_real(0.0);
    cotan_real gamma = cotan_real(2.2);
    cotan_vec3 l = cotan_vec3(pow(max(o.x, zero), gamma), pow(max(o.y, zero), gamma), pow(max(o.z, zero), gamma));
    return cotan_saturate_color(
        cotan_vec3(dot(l, cotan_vec3(cotan_real(1.6605), cotan_real(-0.5876), cotan_real(-0.0728))),
            dot(l, cotan_vec3(cotan_real(-0.1246), cotan_real(1.1329), cotan_real(-0.0083))),
            dot(l, cotan_vec3(cotan_real(-0.0182), cotan_real(-0.1006), cotan_real(1.1187)))));
}

// Applies a curve: 0 none (clamps), 1 ACES (cotan_tone_map), 2 Khronos neutral, 3 AgX.
COTAN_FUNCTION cotan_vec3 cotan_tone_of(int curve, cotan_vec3 c)
{
    if (curve == COTAN_TONE_ACES)
        return cotan_tone_map(c);
    if (curve == COTAN_TONE_NEUTRAL)
        return cotan_tone_neutral(c);
    if (curve == COTAN_TONE_AGX)
        return cotan_tone_agx(c);
    return cotan_saturate_color(c);
}

#endif
