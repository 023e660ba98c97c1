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

// What a surface reflects of its surroundings.
vec3 reflectedOfImage(cotan_surface s)
{
    float nv = cotan_saturate(dot(s.n, s.v));
    return cotan_reflect_image(s, atlas(cotan_environment_texel(s.n, COTAN_ENVIRONMENT_IRRADIANCE)),
        radianceAlong(cotan_mirrored(s.n, s.v), s.roughness),
        atlas(cotan_environment_albedo_texel(nv, s.roughness)).xy);
}
