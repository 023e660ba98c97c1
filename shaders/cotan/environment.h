// Cotan portable text: light from an environment map. Include lang.h and light.h first.
//
// The map is an atlas of square tiles, which the caller reads with bilinear filtering and without mips:
//   tiles 0..8   radiance, filtered for roughness 0, 1/8, ... 1
//   tile  9      irradiance divided by pi
//   tile  10     GGX reflection of white light, by n.v and roughness: x is multiplied by f0, y is added
// Tiles of directions are octahedral maps (Meyer et al., On Floating-Point Normal Vectors, 2010) with y up and a border
// of one texel, so that filtering crosses no edge. At the folds of the map a filtered read has an error of half a
// texel. The split into two factors is that of B. Karis (Real Shading in Unreal Engine 4, 2013). World space, y up.

#ifndef COTAN_ENVIRONMENT_H
#define COTAN_ENVIRONMENT_H

#define COTAN_ENVIRONMENT_WIDTH 970
#define COTAN_ENVIRONMENT_HEIGHT 524
#define COTAN_ENVIRONMENT_STEPS 8      // intervals between the tiles of roughness 0 to 1
#define COTAN_ENVIRONMENT_IRRADIANCE 9 // index of a tile
#define COTAN_ENVIRONMENT_ALBEDO 10

// Returns the position of a tile in the atlas in xy and its size in texels in z, both without the border. tile: an
// integer.
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

// Maps a direction of any length but zero to a point in [0,1]^2: up to the middle, down to the corners.
COTAN_FUNCTION cotan_vec2 cotan_octahedral_point(cotan_vec3 d)
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

// Maps a point in [0,1]^2 to its direction on the octahedron: not unit, but |x| + |y| + |z| = 1.
COTAN_FUNCTION cotan_vec3 cotan_octahedral_direction(cotan_vec2 uv)
{
    cotan_real x = uv.x * cotan_real(2.0) - cotan_real(1.0);
    cotan_real z = uv.y * cotan_real(2.0) - cotan_real(1.0);
    cotan_real y = cotan_real(1.0) - abs(x) - abs(z);
    cotan_real fold = max(-y, cotan_real(0.0));
    return cotan_vec3(cotan_copy_sign(abs(x) - fold, x), y, cotan_copy_sign(abs(z) - fold, z));
}

// Returns the position in the atlas, in texels, at which to read a direction.
COTAN_FUNCTION cotan_vec2 cotan_environment_texel(cotan_vec3 direction, cotan_real tile)
{
    cotan_vec3 t = cotan_environment_tile(tile);
    cotan_vec2 uv = cotan_octahedral_point(direction);
    return cotan_vec2(t.x + uv.x * t.z, t.y + uv.y * t.z);
}

// Returns the position in the atlas, in texels, of the factors for n.v and roughness: from the centre of the first
// texel to that of the last.
COTAN_FUNCTION cotan_vec2 cotan_environment_albedo_texel(cotan_real nv, cotan_real roughness)
{
    cotan_vec3 t = cotan_environment_tile(cotan_real(COTAN_ENVIRONMENT_ALBEDO));
    cotan_real last = t.z - cotan_real(1.0);
    return cotan_vec2(t.x + cotan_real(0.5) + cotan_saturate(nv) * last,
        t.y + cotan_real(0.5) + cotan_saturate(roughness) * last);
}

// Fractions of white light that leave a rough surface after one bounce between its facets and after more (C.
// Fdez-Agueera, A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting, 2019, equations 12 and 17).
// Without the second, a white metal of roughness 1, seen straight on, reflects a third of the light that it receives.
struct cotan_bounces {
    cotan_vec3 once;
    cotan_vec3 more;
};
COTAN_FUNCTION cotan_bounces cotan_bounces_of(cotan_vec3 f0, cotan_real f90, cotan_vec2 albedo)
{
    cotan_vec3 one = cotan_vec3(cotan_real(1.0), cotan_real(1.0), cotan_real(1.0));
    cotan_real left_over = max(cotan_real(1.0) - albedo.x - albedo.y, cotan_real(0.0));
    cotan_vec3 mean = f0 + (one * f90 - f0) * cotan_real(1.0 / 21.0); // mean of Schlick's term over the cosine
    cotan_bounces b;
    b.once = f0 * albedo.x + one * (albedo.y * f90);
    b.more = b.once * mean / (one - mean * left_over) * left_over;
    return b;
}

// Returns the light of the environment that a surface reflects. irradiance: tile 9 along n. radiance: interpolated
// between the two nearest tiles of the roughness, where cotan_reflecting_normal mirrors the eye. albedo: tile 10.
// Light that is not reflected at the surface is scattered below it, so that white dielectrics and white metals both
// reflect all light.
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

// Returns the coat's reflection of the environment. radiance, albedo: as in cotan_reflect_image, for the coat's normal
// and roughness.
COTAN_FUNCTION cotan_vec3 cotan_reflect_coat_image(cotan_coat c, cotan_vec3 radiance, cotan_vec2 albedo)
{
    return radiance * (c.strength * (cotan_real(0.04) * albedo.x + albedo.y));
}

#endif
