// Cotan portable text: light from a picture of the environment. Include lang.h and light.h first.
//
// The picture is an atlas of square tiles, which the caller reads with bilinear filtering and without mips:
//   tiles 0..8   radiance, filtered for roughness 0, 1/8, ... 1
//   tile  9      irradiance of a surface divided by pi
//   tile  10     what GGX reflects of white light: x to be multiplied by f0, y to be added; by n.v and roughness
// Tiles of directions are octahedral maps (Meyer et al., On Floating-Point Normal Vectors, 2010) with y up and a border
// of one texel, so that no filter sees an edge. Where the map is folded a filtered read is off by half a texel. The
// split in two factors is B. Karis's (Real Shading in Unreal Engine 4, 2013). World space, y up.

#ifndef COTAN_ENVIRONMENT_H
#define COTAN_ENVIRONMENT_H

#define COTAN_ENVIRONMENT_WIDTH 970
#define COTAN_ENVIRONMENT_HEIGHT 524
#define COTAN_ENVIRONMENT_STEPS 8      // tiles from roughness 0 to 1
#define COTAN_ENVIRONMENT_IRRADIANCE 9 // tiles
#define COTAN_ENVIRONMENT_ALBEDO 10

// Where a tile starts in the atlas, and its texels a side; the border not counted. tile: a whole number.
COTAN_FUNCTION cotan_vec3 cotan_environment_tile(cotan_real tile)
{
    if (tile < cotan_real(0.5))
        return cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(512.0));
    if (tile < cotan_real(1.5))
        return cotan_vec3(cotan_real(515.0), cotan_real(1.0), cotan_real(256.0));
    if (tile < cotan_real(2.5))
        return cotan_vec3(cotan_real(515.0), cotan_real(259.0), cotan_real(128.0));
    if (tile < cotan_real(4.5))
        return cotan_vec3(cotan_real(773.0), cotan_real(1.0) + cotan_real(130.0) * (tile - cotan_real(3.0)),
            cotan_real(128.0));
    if (tile < cotan_real(8.5)) {
        cotan_real row = tile < cotan_real(6.5) ? cotan_real(0.0) : cotan_real(1.0);
        cotan_real column = tile - cotan_real(5.0) - cotan_real(2.0) * row;
        return cotan_vec3(cotan_real(773.0) + cotan_real(66.0) * column, cotan_real(391.0) + cotan_real(66.0) * row,
            cotan_real(64.0));
    }
    if (tile < cotan_real(9.5))
        return cotan_vec3(cotan_real(773.0), cotan_real(261.0), cotan_real(128.0));
    return cotan_vec3(cotan_real(905.0), cotan_real(1.0), cotan_real(64.0));
}

// A direction of any length but zero, as a place in [0,1]^2: up in the middle, down in the corners.
COTAN_FUNCTION cotan_vec2 cotan_octahedral_place(cotan_vec3 d)
{
    cotan_real size = max(abs(d.x) + abs(d.y) + abs(d.z), cotan_real(1e-30));
    cotan_real x = d.x / size;
    cotan_real z = d.z / size;
    cotan_real folded_x = cotan_copy_sign(cotan_real(1.0) - abs(z), x);
    cotan_real folded_z = cotan_copy_sign(cotan_real(1.0) - abs(x), z);
    cotan_real half_way = cotan_real(0.5);
    return cotan_vec2((d.y < cotan_real(0.0) ? folded_x : x) * half_way + half_way,
        (d.y < cotan_real(0.0) ? folded_z : z) * half_way + half_way);
}

// The direction of a place, on the octahedron: not unit, but |x| + |y| + |z| = 1.
COTAN_FUNCTION cotan_vec3 cotan_octahedral_direction(cotan_vec2 place)
{
    cotan_real x = place.x * cotan_real(2.0) - cotan_real(1.0);
    cotan_real z = place.y * cotan_real(2.0) - cotan_real(1.0);
    cotan_real y = cotan_real(1.0) - abs(x) - abs(z);
    cotan_real fold = max(-y, cotan_real(0.0));
    return cotan_vec3(cotan_copy_sign(abs(x) - fold, x), y, cotan_copy_sign(abs(z) - fold, z));
}

// Where in the atlas a direction is to be read, in texels.
COTAN_FUNCTION cotan_vec2 cotan_environment_texel(cotan_vec3 direction, cotan_real tile)
{
    cotan_vec3 t = cotan_environment_tile(tile);
    cotan_vec2 place = cotan_octahedral_place(direction);
    return cotan_vec2(t.x + place.x * t.z, t.y + place.y * t.z);
}

// Where the factors of n.v and roughness are, in texels: from the first texel's middle to the last one's.
COTAN_FUNCTION cotan_vec2 cotan_environment_albedo_texel(cotan_real nv, cotan_real roughness)
{
    cotan_vec3 t = cotan_environment_tile(cotan_real(COTAN_ENVIRONMENT_ALBEDO));
    cotan_real last = t.z - cotan_real(1.0);
    return cotan_vec2(t.x + cotan_real(0.5) + cotan_saturate(nv) * last,
        t.y + cotan_real(0.5) + cotan_saturate(roughness) * last);
}

// The share of white light that leaves a rough surface after one bounce between its facets (xyz), and after more
// (as a factor on what the first bounces have left over, 1 - albedo.x - albedo.y), by its f0 and f90: C. Fdez-Agueera,
// A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting, 2019, equations 12 and 17. Without the
// second a white metal of roughness 1 shows a third of the light that it gets, seen straight on.
struct cotan_bounces {
    cotan_vec3 once;
    cotan_vec3 more;
};
COTAN_FUNCTION cotan_bounces cotan_bounces_of(cotan_vec3 f0, cotan_real f90, cotan_vec2 albedo)
{
    cotan_vec3 one = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));
    cotan_real left_over = max(cotan_real(1.0) - albedo.x - albedo.y, cotan_real(0.0));
    cotan_vec3 mean = f0 + (one * f90 - f0) * cotan_real(1.0 / 21.0); // of Schlick's term over the cosine
    cotan_bounces b;
    b.once = f0 * albedo.x + one * (albedo.y * f90);
    b.more = b.once * mean / (one - mean * left_over) * left_over;
    return b;
}

// What a surface reflects of its environment. irradiance: tile 9 along n. radiance: where cotan_reflecting_normal
// mirrors the eye, between the two tiles of the roughness. albedo: tile 10.
// What is not reflected at the surface is scattered below it, so that a white dielectric reflects all light; a white
// metal does, too.
COTAN_FUNCTION cotan_vec3 cotan_reflect_image(
    cotan_surface s, cotan_gloss g, cotan_vec3 irradiance, cotan_vec3 radiance, cotan_vec2 albedo)
{
    cotan_vec3 one = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));
    cotan_vec3 f0 = cotan_mix(g.f0, s.base_color, s.metallic);
    cotan_bounces all = cotan_bounces_of(f0, cotan_mix(g.f90, cotan_real(1.0), s.metallic), albedo);
    cotan_bounces shallow = cotan_bounces_of(g.f0, g.f90, albedo);
    cotan_real scattered = (cotan_real(1.0) - s.metallic) * (cotan_real(1.0) - g.transmission);
    cotan_vec3 below = (one - shallow.once - shallow.more) * s.base_color * scattered;
    return (irradiance * (below + all.more) + radiance * all.once) * s.occlusion;
}

// What a coat reflects of its environment. radiance, albedo: as above, for its normal and roughness.
COTAN_FUNCTION cotan_vec3 cotan_reflect_coat_image(cotan_coat c, cotan_vec3 radiance, cotan_vec2 albedo)
{
    return radiance * (c.strength * (cotan_real(0.04) * albedo.x + albedo.y));
}

#endif
