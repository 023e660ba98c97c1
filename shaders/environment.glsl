// Surroundings as a picture: the reads that cotan/environment.h leaves to its caller.

vec3 atlas(vec2 texel)
{
    vec2 size = vec2(float(COTAN_ENVIRONMENT_WIDTH), float(COTAN_ENVIRONMENT_HEIGHT));
    return textureLod(environmentMap, texel / size, 0.0).rgb;
}

// Radiance along a direction, as a mirror of that roughness sees it.
vec3 radianceAlong(vec3 direction, float roughness)
{
    float level = cotan_saturate(roughness) * float(COTAN_ENVIRONMENT_STEPS);
    float lower = min(floor(level), float(COTAN_ENVIRONMENT_STEPS - 1));
    return mix(atlas(cotan_environment_texel(direction, lower)),
        atlas(cotan_environment_texel(direction, lower + 1.0)), level - lower);
}

// The factors of what GGX reflects of white light.
vec2 albedoOf(vec3 n, vec3 v, float roughness)
{
    return atlas(cotan_environment_albedo_texel(cotan_saturate(dot(n, v)), roughness)).xy;
}

// Irradiance of a surface with that normal, divided by pi.
vec3 irradianceOf(vec3 n) { return atlas(cotan_environment_texel(n, float(COTAN_ENVIRONMENT_IRRADIANCE))); }

// What a surface reflects of its environment.
vec3 reflectedGlossy(cotan_surface s, cotan_gloss g)
{
    vec3 mirrored = cotan_mirrored(cotan_reflecting_normal(s, g), s.v);
    return cotan_reflect_image(s, g, irradianceOf(s.n), radianceAlong(mirrored, s.roughness),
        albedoOf(s.n, s.v, s.roughness));
}

// The same of metallic-roughness alone.
vec3 reflectedOfImage(cotan_surface s) { return reflectedGlossy(s, cotan_plain_gloss()); }

vec3 reflectedOfCoat(cotan_coat c, vec3 v)
{
    return cotan_reflect_coat_image(c, radianceAlong(cotan_mirrored(c.n, v), c.roughness),
        albedoOf(c.n, v, c.roughness));
}
