// Environment maps: the texture reads that cotan/environment.h leaves to its caller.

vec3 readAtlas(vec2 texel)
{
    vec2 size = vec2(float(COTAN_ENVIRONMENT_WIDTH), float(COTAN_ENVIRONMENT_HEIGHT));
    return textureLod(environmentMap, texel / size, 0.0).rgb;
}

// Radiance from a direction, prefiltered for a reflection of the given roughness, [0,1].
vec3 radianceAlong(vec3 direction, float roughness)
{
    float level = cotan_saturate(roughness) * float(COTAN_ENVIRONMENT_STEPS);
    float lower = min(floor(level), float(COTAN_ENVIRONMENT_STEPS - 1));
    return mix(readAtlas(cotan_environment_texel(direction, lower)),
        readAtlas(cotan_environment_texel(direction, lower + 1.0)), level - lower);
}

// The factors of f0 and f90 in the GGX albedo.
vec2 albedoOf(vec3 n, vec3 v, float roughness)
{
    return readAtlas(cotan_environment_albedo_texel(cotan_saturate(dot(n, v)), roughness)).xy;
}

// Irradiance at a surface with normal n, divided by pi.
vec3 irradianceOf(vec3 n) { return readAtlas(cotan_environment_texel(n, float(COTAN_ENVIRONMENT_IRRADIANCE))); }

// Light of the environment that a surface reflects.
vec3 reflectedGlossy(cotan_surface s, cotan_gloss g)
{
    vec3 mirrored = cotan_mirrored(cotan_reflecting_normal(s, g), s.v);
    return cotan_reflect_image(s, g, irradianceOf(s.n), radianceAlong(mirrored, s.roughness),
        albedoOf(s.n, s.v, s.roughness));
}

// The same for plain metallic-roughness.
vec3 reflectedOfImage(cotan_surface s) { return reflectedGlossy(s, cotan_plain_gloss()); }

vec3 reflectedOfCoat(cotan_coat c, vec3 v)
{
    return cotan_reflect_coat_image(c, radianceAlong(cotan_mirrored(c.n, v), c.roughness),
        albedoOf(c.n, v, c.roughness));
}
