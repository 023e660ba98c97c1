// Cotan portable text: normal-map texels. Include lang.h first.
//
// Converts a texel into m, the normal in the coordinates of the frame (along +u, +v, outwards), and back. How a map is
// stored is passed as a value, cotan_normal_format; there is no global state.

#ifndef COTAN_NORMAL_H
#define COTAN_NORMAL_H

// How a stored component c is expanded to a signed number. Zero is the middle code: 128 in 8 bits, 32768 in 16. A
// sampled float does not reveal its number of bits, so there are two exact expansions; the wrong one tilts a flat texel
// by 0.32 degrees.
#define COTAN_EXPAND_EXACT 0   // 8 bits, (255c - 128)/127: 0 -> -1 (clamped), 128/255 -> 0, 1 -> 1
#define COTAN_EXPAND_BIASED 1  // 2c - 1: no 8-bit value is zero; a flat texel is tilted by 0.32 degrees
#define COTAN_EXPAND_SIGNED 2  // c is already signed; -128/127 is clamped to -1
#define COTAN_EXPAND_EXACT16 3 // 16 bits, (65535c - 32768)/32767: 32768/65535 -> 0, 1 -> 1

// What the channels hold.
#define COTAN_CHANNELS_XYZ 0           // three components of the normal
#define COTAN_CHANNELS_ORTHOGRAPHIC 1  // two channels; z = sqrt(1 - x^2 - y^2)
#define COTAN_CHANNELS_STEREOGRAPHIC 2 // two channels; (x, y)/(1 + z)
#define COTAN_CHANNELS_SLOPE 3         // two channels; (dh/du, dh/dv)

struct cotan_normal_format {
    int expansion;       // COTAN_EXPAND_...
    int channels;        // COTAN_CHANNELS_...
    cotan_real green;    // +1: green points along increasing v; -1: against it
    cotan_real strength; // factor on the slopes; 1 changes nothing, 0 flattens
};

// Returns the signed number, in [-1,1], that a stored component represents.
// c: as sampled, in [0,1] for unsigned formats and in [-1,1] for signed ones.
// Source: [2013] 'Sign expansion' for the exact expansion.
COTAN_FUNCTION cotan_real cotan_expand(cotan_real c, int expansion)
{
    cotan_real exact = c * cotan_real(255.0 / 127.0) - cotan_real(128.0 / 127.0);
    cotan_real exact16 = c * cotan_real(65535.0 / 32767.0) - cotan_real(32768.0 / 32767.0);
    cotan_real biased = c * cotan_real(2.0) - cotan_real(1.0);
    cotan_real x = expansion == COTAN_EXPAND_EXACT
        ? exact
        : (expansion == COTAN_EXPAND_EXACT16 ? exact16 : (expansion == COTAN_EXPAND_BIASED ? biased : c));
    return max(x, cotan_real(-1.0));
}

// The inverse of cotan_expand. x is clamped to [-1,1].
COTAN_FUNCTION cotan_real cotan_compress(cotan_real x, int expansion)
{
    x = min(max(x, cotan_real(-1.0)), cotan_real(1.0));
    cotan_real exact = x * cotan_real(127.0 / 255.0) + cotan_real(128.0 / 255.0);
    cotan_real exact16 = x * cotan_real(32767.0 / 65535.0) + cotan_real(32768.0 / 65535.0);
    cotan_real biased = x * cotan_real(0.5) + cotan_real(0.5);
    return expansion == COTAN_EXPAND_EXACT
        ? exact
        : (expansion == COTAN_EXPAND_EXACT16 ? exact16 : (expansion == COTAN_EXPAND_BIASED ? biased : x));
}

// Returns z of a unit vector from x and y; 0 where x^2 + y^2 > 1. Without this clamp, 6.9 % of 8-bit texels tilted by
// 60 to 90 degrees would give NaN.
COTAN_FUNCTION cotan_real cotan_orthographic_z(cotan_vec2 xy)
{
    return sqrt(max(cotan_real(1.0) - dot(xy, xy), cotan_real(0.0)));
}

// Returns the unit vector with the stereographic coordinates p = (x, y)/(1 + z). p: any finite value.
COTAN_FUNCTION cotan_vec3 cotan_from_stereographic(cotan_vec2 p)
{
    cotan_real d = cotan_real(2.0) / (cotan_real(1.0) + dot(p, p));
    return cotan_vec3(d * p.x, d * p.y, d - cotan_real(1.0));
}

// The inverse of cotan_from_stereographic: p of a unit vector m with m.z > -1; smaller m.z are clamped to -0.999.
COTAN_FUNCTION cotan_vec2 cotan_to_stereographic(cotan_vec3 m)
{
    cotan_real s = cotan_real(1.0) / (cotan_real(1.0) + max(m.z, cotan_real(-0.999)));
    return cotan_vec2(m.x * s, m.y * s);
}

// Returns the decoded texel m for cotan_apply. m is not unit in general: a filtered XYZ texel keeps its length, and
// cotan_apply normalises. format.strength scales the slopes m.xy / m.z.
// texel: as sampled; two-channel maps use x and y only.
COTAN_FUNCTION cotan_vec3 cotan_decode(cotan_vec3 texel, cotan_normal_format format)
{
    cotan_real x = cotan_expand(texel.x, format.expansion);
    cotan_real y = cotan_expand(texel.y, format.expansion);
    cotan_real z = cotan_expand(texel.z, format.expansion);
    cotan_vec2 xy = cotan_vec2(x, y);
    cotan_vec3 m = cotan_vec3(x, y, z);
    if (format.channels == COTAN_CHANNELS_ORTHOGRAPHIC)
        m = cotan_vec3(x, y, cotan_orthographic_z(xy));
    if (format.channels == COTAN_CHANNELS_STEREOGRAPHIC)
        m = cotan_from_stereographic(xy);
    if (format.channels == COTAN_CHANNELS_SLOPE)
        m = cotan_vec3(-x, -y, cotan_real(1.0));
    return cotan_vec3(m.x * format.strength, m.y * format.strength * format.green, m.z);
}

// The inverse of cotan_decode: the stored components, each in the range of the expansion; z of two-channel maps is the
// code of zero. format.strength must not be 0. Components of slope maps are clamped to slope 1, which is 45 degrees;
// choose the strength accordingly. Orthographic and slope maps cannot store m.z <= 0, so such an m is first moved to
// the horizon.
// m: unit vector, as cotan_encode returns it.
COTAN_FUNCTION cotan_vec3 cotan_encode_texel(cotan_vec3 m, cotan_normal_format format)
{
    cotan_vec3 e =
        cotan_vec3(m.x / format.strength, m.y / (format.strength * format.green), m.z);
    e = e * cotan_inversesqrt(max(dot(e, e), cotan_real(1e-30)));
    cotan_vec2 stereographic = cotan_to_stereographic(e);
    cotan_real z = max(e.z, cotan_real(1e-6));
    cotan_vec3 stored = e;
    if (format.channels == COTAN_CHANNELS_ORTHOGRAPHIC) {
        cotan_real longest2 = max(e.x * e.x + e.y * e.y, cotan_real(1e-30));
        cotan_real s = e.z < cotan_real(0.0) ? cotan_inversesqrt(longest2) : cotan_real(1.0);
        stored = cotan_vec3(e.x * s, e.y * s, cotan_real(0.0));
    }
    if (format.channels == COTAN_CHANNELS_STEREOGRAPHIC)
        stored = cotan_vec3(stereographic.x, stereographic.y, cotan_real(0.0));
    if (format.channels == COTAN_CHANNELS_SLOPE)
        stored = cotan_vec3(-e.x / z, -e.y / z, cotan_real(0.0));
    return cotan_vec3(
        cotan_compress(stored.x, format.expansion),
        cotan_compress(stored.y, format.expansion),
        cotan_compress(stored.z, format.expansion));
}

#endif
