// Surroundings as a picture: the reads that cotan/environment.h leaves to its caller.

vec3 atlas(vec2 texel)
{
    vec2 size = vec2(float(COTAN_ENVIRONMENT_WIDTH), float(COTAN_ENVIRONMENT_HEIGHT));
    return textureLod(environmentMap, texel / size, 0.0).rgb;
}

// Radiance along a direction, as a mirror of that roughness sees it.
vec3 radianceAlong(vec3 direction, float roughness)
{
    float level = cotan_saturate(roughness) * COTAN_ENVIRONMENT_STEPS;
    float lower = min(floor(level), COTAN_ENVIRONMENT_STEPS - 1.0);
    return mix(atlas(cotan_environment_texel(direction, lower)),
        atlas(cotan_environment_texel(direction, lower + 1.0)), level - lower);
}

vec2 albedoAt(float nv, float roughness)
{
    return atlas(cotan_environment_albedo_texel(cotan_saturate(nv), roughness)).xy;
}

// What a surface reflects of its surroundings: towards n mirrored, with reflectances as cotan_reflect_image has them.
vec3 reflectedOfImage(cotan_surface s, vec3 n, vec3 dielectric, float f90)
{
    return cotan_reflect_image(s, dielectric, f90,
        atlas(cotan_environment_texel(s.n, COTAN_ENVIRONMENT_IRRADIANCE)),
        radianceAlong(cotan_mirrored(n, s.v), s.roughness), albedoAt(dot(s.n, s.v), s.roughness));
}

// What its coat reflects.
vec3 coatReflectedOfImage(cotan_coat coat, vec3 v)
{
    vec2 share = albedoAt(dot(coat.n, v), coat.roughness);
    return radianceAlong(cotan_mirrored(coat.n, v), coat.roughness)
        * (coat.strength * (0.04 * share.x + share.y));
}
