// Cotan portable text: dither patterns, the colours of an image in 8 bits, and thresholds of translucent shadows.
// Include lang.h and light.h first.

#ifndef COTAN_QUANTISE_H
#define COTAN_QUANTISE_H

// Returns a number in [0, 1) that depends only on the texel. The numbers of neighbouring texels, in any direction, are
// evenly distributed (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018: multiples of powers of
// the inverse of the plastic number). kind: 0 to 3; patterns of different kinds are independent.
COTAN_FUNCTION cotan_real cotan_even_pattern(cotan_uint x, cotan_uint y, cotan_uint kind)
{
    cotan_uint across = (kind < 2u ? x : y) * 3242174889u;
    cotan_uint along = (kind < 2u ? y : x) * 2447445414u;
    cotan_uint sum = across + (kind == 0u || kind == 2u ? along : 0u - along);
    return cotan_real_of(sum >> 8u) * cotan_real(0.000000059604644775390625); // 2^-24
}

// Returns a component in [0, 1] as one of 256 levels, 0 to 255. pattern: dither value in [0, 1); the mean over all
// patterns is the component. Components within 1/16 of a level are rounded to it, so that flat 8-bit colours get no
// noise.
COTAN_FUNCTION cotan_real cotan_level_of(cotan_real component, cotan_real pattern)
{
    cotan_real scaled = min(max(component, cotan_real(0.0)), cotan_real(1.0)) * cotan_real(255.0);
    cotan_real nearest = floor(scaled + cotan_real(0.5));
    return abs(scaled - nearest) < cotan_real(0.0625) ? nearest : floor(scaled + pattern);
}

// Returns the 8-bit levels of a pixel: sRGB-encoded colours that are not multiplied by alpha, as image files store
// them.
// color: linear, multiplied by alpha. dither: false rounds to the nearest level.
COTAN_FUNCTION cotan_vec4 cotan_levels_of_pixel(cotan_vec4 color, cotan_uint x, cotan_uint y, bool dither)
{
    cotan_real inverse_alpha =
        color.w > cotan_real(0.0) && color.w < cotan_real(1.0) ? cotan_real(1.0) / color.w : cotan_real(1.0);
    cotan_real middle = cotan_real(0.5);
    cotan_real r = cotan_linear_to_srgb(cotan_saturate(color.x * inverse_alpha));
    cotan_real g = cotan_linear_to_srgb(cotan_saturate(color.y * inverse_alpha));
    cotan_real b = cotan_linear_to_srgb(cotan_saturate(color.z * inverse_alpha));
    return cotan_vec4(cotan_level_of(r, dither ? cotan_even_pattern(x, y, 0u) : middle),
        cotan_level_of(g, dither ? cotan_even_pattern(x, y, 1u) : middle),
        cotan_level_of(b, dither ? cotan_even_pattern(x, y, 2u) : middle),
        cotan_level_of(color.w, dither ? cotan_even_pattern(x, y, 3u) : middle));
}

// Returns the threshold of a shadow-map texel, in [0, 1). A translucent surface covers the texel if its alpha is
// greater, so that the mean over several texels is its coverage. In any 3 x 3 texels, each ninth of the range contains
// one threshold; their mean differs from the coverage by at most 1/9. layer: 0 to 3. Surfaces in different layers, one
// behind the other, attenuate the light independently: thirds and digits below 1/9 of their thresholds are independent.
COTAN_FUNCTION cotan_real cotan_shadow_threshold(cotan_uint x, cotan_uint y, cotan_uint layer)
{
    cotan_uint sum = (x + y) % 3u;
    cotan_uint difference = (x + 2u * y) % 3u;
    cotan_uint third = layer == 0u ? sum : layer == 1u ? difference : layer == 2u ? x % 3u : y % 3u;
    cotan_uint ninth = layer == 0u ? difference : layer == 1u ? x % 3u : layer == 2u ? y % 3u : sum;
    cotan_real finer = cotan_even_pattern(x / 3u, y / 3u, layer);
    return (cotan_real_of(3u * third + ninth) + finer) / cotan_real(9.0);
}

#endif
