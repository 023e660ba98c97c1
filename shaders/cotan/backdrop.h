// Cotan portable text: what is behind a scene, and the plane beneath it. Include lang.h and light.h first.

#ifndef COTAN_BACKDROP_H
#define COTAN_BACKDROP_H

// A photographer's seamless paper: bright where it lies, darker where it hangs, and no edge between. As it is to be
// shown, whatever the exposure. direction: unit, y up.
COTAN_FUNCTION cotan_vec3 cotan_paper(cotan_vec3 direction)
{
    cotan_vec3 lying = cotan_vec3(cotan_real(0.68), cotan_real(0.675), cotan_real(0.665));
    cotan_vec3 hanging = cotan_vec3(cotan_real(0.30), cotan_real(0.302), cotan_real(0.31));
    return cotan_mix(lying, hanging, cotan_smooth(cotan_real(-0.6), cotan_real(0.45), direction.y));
}

// Where a view ray meets the level plane y = height: its x and z. origin, direction: of the ray. Far away for rays that
// do not.
COTAN_FUNCTION cotan_vec2 cotan_ground_place(cotan_vec3 origin, cotan_vec3 direction, cotan_real height)
{
    cotan_real way = (height - origin.y) / min(direction.y, cotan_real(-1e-6));
    way = origin.y > height && direction.y < cotan_real(0.0) ? way : cotan_real(1e15);
    return cotan_vec2(origin.x + direction.x * way, origin.z + direction.z * way);
}

#endif
