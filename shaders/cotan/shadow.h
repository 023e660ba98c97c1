// Cotan portable text: soft shadows from a map of depths, by percentage-closer filtering (R. Fernando,
// Percentage-Closer Soft Shadows, 2005). Include lang.h first. The map's reads are the caller's:
//   1. COTAN_SHADOW_SEARCH reads around the point, as far as the light's disc can reach it, for the mean depth of
//      what is before it; nothing there: all light arrives;
//   2. COTAN_SHADOW_TAPS comparisons in the disc of cotan_penumbra around it: their mean is what arrives.
// Both compare with the plane through the point, not its depth alone, or wide discs would shade slopes by themselves.

#ifndef COTAN_SHADOW_H
#define COTAN_SHADOW_H

#define COTAN_SHADOW_SEARCH 8
#define COTAN_SHADOW_TAPS 24

// Directions that fill a disc evenly, with cotan_tap_radius: each is the last one turned by the golden angle.
COTAN_FUNCTION cotan_vec2 cotan_next_tap(cotan_vec2 direction)
{
    cotan_real cosine = cotan_real(-0.737368878);
    cotan_real sine = cotan_real(0.675490294);
    return cotan_vec2(
        direction.x * cosine - direction.y * sine, direction.x * sine + direction.y * cosine);
}

// The distance of tap i of `count` from the middle of a disc of radius 1.
COTAN_FUNCTION cotan_real cotan_tap_radius(int i, int count)
{
    return sqrt((cotan_real(i) + cotan_real(0.5)) / cotan_real(count));
}

// Half the width of the half-shadow that a blocker throws which is `distance` nearer to the light. softness: tangent of
// half the angle that the light covers. least: what the map can show. most: beyond it there are too few taps.
COTAN_FUNCTION cotan_real cotan_penumbra(
    cotan_real distance, cotan_real softness, cotan_real least, cotan_real most)
{
    return min(max(distance * softness, least), most);
}

#endif
