// Cotan portable text: even patterns, a picture's colours in 8 bits, and thresholds of translucent shadows. Include
// lang.h and light.h first.

#ifndef COTAN_QUANTISE_H
#define COTAN_QUANTISE_H

// A number in [0, 1) for a texel, the same everywhere: those of neighbours, in any direction, fill the range evenly
// (M. Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018: multiples of the powers of the plastic
// number's inverse). kind: 0 to 3; patterns of different kinds are independent of one another.
COTAN_FUNCTION cotan_real cotan_even_pattern(cotan_uint x, cotan_uint y, cotan_uint kind)
{
    cotan_uint across = (kind < 2u ? x : y) * 3242174889u;
    cotan_uint along = (kind < 2u ? y : x) * 2447445414u;
    cotan_uint sum = across + (kind == 0u || kind == 2u ? along : 0u - along);
    return cotan_real_of(sum >> 8u) * cotan_real(0.000000059604644775390625); // 2^-24
}

// A component in [0, 1] as one of 256 levels, 0 to 255. pattern: in [0, 1); the mean over all is the component. What is
// a level already, within a sixteenth, stays: flat colours of 8 bits are not made noise.
COTAN_FUNCTION cotan_real cotan_level_of(cotan_real component, cotan_real pattern)
{
    cotan_real scaled = min(max(component, cotan_real(0.0)), cotan_real(1.0)) * cotan_real(255.0);
    cotan_real nearest = floor(scaled + cotan_real(0.5));
    return abs(scaled - nearest) < cotan_real(0.0625) ? nearest : floor(scaled + pattern);
}

// The levels of a pixel of a picture, colours encoded as sRGB and, as image files want them, not multiplied by alpha.
// color: linear, times alpha. dither: false rounds to the nearest level.
COTAN_FUNCTION cotan_vec4 cotan_levels_of_pixel(cotan_vec4 color, cotan_uint x, cotan_uint y, bool dither)
{
    cotan_real share =
        color.w > cotan_real(0.0) && color.w < cotan_real(1.0) ? cotan_real(1.0) / color.w : cotan_real(1.0);
    cotan_real middle = cotan_real(0.5);
    cotan_real r = cotan_linear_to_srgb(cotan_saturate(color.x * share));
    cotan_real g = cotan_linear_to_srgb(cotan_saturate(color.y * share));
    cotan_real b = cotan_linear_to_srgb(cotan_saturate(color.z * share));
    return cotan_vec4(cotan_level_of(r, dither ? cotan_even_pattern(x, y, 0u) : middle),
        cotan_level_of(g, dither ? cotan_even_pattern(x, y, 1u) : middle),
        cotan_level_of(b, dither ? cotan_even_pattern(x, y, 2u) : middle),
        cotan_level_of(color.w, dither ? cotan_even_pattern(x, y, 3u) : middle));
}

// The threshold of a texel of a shadow map, in [0, 1): a translucent surface covers the texel where its alpha is
// greater, so that the mean over some texels is its coverage. Of any 3 x 3 texels each ninth of the range has one
// threshold: their mean is off by a ninth at most. layer: 0 to 3; surfaces of different layers, one behind the
// other, stop what is left, as their thirds and what is finer than ninths are independent.
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
