// Cotan portable text: soft shadows from a shadow map by percentage-closer filtering (R. Fernando, Percentage-Closer
// Soft Shadows, 2005). Include lang.h first. The caller reads the map, in two steps:
//   1. COTAN_SHADOW_SEARCH reads around the point, as far as the light's disc can reach, give the mean depth of the
//      blockers. Without blockers the point is fully lit;
//   2. COTAN_SHADOW_TAPS comparisons in a disc of radius cotan_penumbra: their mean is the light that arrives.
// Both steps compare with the plane of the surface at the point, not with its depth alone; otherwise wide discs would
// shadow slopes by themselves.

#ifndef COTAN_SHADOW_H
#define COTAN_SHADOW_H

#define COTAN_SHADOW_SEARCH 8
#define COTAN_SHADOW_TAPS 24

// Returns the direction of the next tap: the last one rotated by the golden angle. With cotan_tap_radius the taps fill
// a disc evenly.
COTAN_FUNCTION cotan_vec2 cotan_next_tap(cotan_vec2 direction)
{
    cotan_real cosine = cotan_real(-0.737368878);
    cotan_real sine = cotan_real(0.675490294);
    return cotan_vec2(
        direction.x * cosine - direction.y * sine, direction.x * sine + direction.y * cosine);
}

// Returns the distance of tap i of `count` from the centre of a disc of radius 1.
COTAN_FUNCTION cotan_real cotan_tap_radius(int i, int count)
{
    return sqrt((cotan_real(i) + cotan_real(0.5)) / cotan_real(count));
}

// Returns half the width of the penumbra of a blocker that is `distance` closer to the light. softness: tangent of half
// the angle that the light subtends. minimum: width that the map can resolve. maximum: width above which the taps are
// too sparse.
COTAN_FUNCTION cotan_real cotan_penumbra(
    cotan_real distance, cotan_real softness, cotan_real minimum, cotan_real maximum)
{
    return min(max(distance * softness, minimum), maximum);
}

#endif
