// Cotan portable text: the backdrop of a scene, and the ground plane. Include lang.h and light.h first.

#ifndef COTAN_BACKDROP_H
#define COTAN_BACKDROP_H

// Returns the colour of a seamless paper backdrop: bright on the ground, darker where it hangs, without an edge
// between. A displayed colour, which exposure does not change. direction: unit, y up.
COTAN_FUNCTION cotan_vec3 cotan_paper(cotan_vec3 direction)
{
    cotan_vec3 lying = cotan_vec3(cotan_real(0.68), cotan_real(0.675), cotan_real(0.665));
    cotan_vec3 hanging = cotan_vec3(cotan_real(0.30), cotan_real(0.302), cotan_real(0.31));
    return cotan_mix(lying, hanging, cotan_smooth(cotan_real(-0.6), cotan_real(0.45), direction.y));
}

// Returns x and z of the point where a view ray meets the level plane y = height. Rays that miss the plane give a point
// far away. origin, direction: of the ray.
COTAN_FUNCTION cotan_vec2 cotan_ground_point(cotan_vec3 origin, cotan_vec3 direction, cotan_real height)
{
    cotan_real ray_length = (height - origin.y) / min(direction.y, cotan_real(-1e-6));
    ray_length = origin.y > height && direction.y < cotan_real(0.0) ? ray_length : cotan_real(1e15);
    return cotan_vec2(origin.x + direction.x * ray_length, origin.z + direction.z * ray_length);
}

#endif
