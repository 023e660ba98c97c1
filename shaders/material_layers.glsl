// glTF material extensions: reads their maps into the layers of cotan/light.h and cotan/sheen.h.

// The coat's normal, outwards on the front side. frame: of the base surface. variance: as for perturbed.
vec3 coatNormal(cotan_frame frame, vec3 n, inout float variance)
{
    CotanTextureUse use = material.coatNormalMapUse;
    if (!NORMAL_MAPS || !present(COTAN_MAP_COAT_NORMAL, use) || !hasTexcoords(use))
        return n;
    if (material.coatNormalMap.w == 0)
        frame = frameOf(n, screenDifferences(inPosition, transformedDifference(use, inTexcoords)), use, false);
    cotan_normal_format format = cotan_normal_format(material.coatNormalMap.x,
        material.coatNormalMap.y, float(material.coatNormalMap.z), material.coat.z);
    vec4 texel = sampled(coatNormalMap, use);
    if (SPECULAR_ANTIALIASING)
        variance += cotan_variance_of_length(texel.w);
    return cotan_normalize_or(cotan_apply(frame, cotan_decode(texel.xyz, format)), n);
}

// smoothVariance: of the interpolated normals.
cotan_coat coatOf(cotan_frame frame, vec3 n, float side, float smoothVariance)
{
    cotan_coat c;
    c.strength = material.coat.x;
    if (present(COTAN_MAP_COAT, material.coatMap))
        c.strength *= sampled(coatMap, material.coatMap).r;
    c.roughness = material.coat.y;
    if (present(COTAN_MAP_COAT_ROUGHNESS, material.coatRoughnessMap))
        c.roughness *= sampled(coatRoughnessMap, material.coatRoughnessMap).g;
    float variance = smoothVariance;
    c.n = coatNormal(frame, n, variance) * side;
    if (SPECULAR_ANTIALIASING)
        c.roughness = cotan_roughness_of_variance(c.roughness, variance);
    return c;
}

// Sets the anisotropy. frame, smoothNormal: outwards on the front side. n: perturbed.
void setAnisotropy(inout cotan_gloss g, cotan_frame frame, vec3 smoothNormal, vec3 n)
{
    float strength = material.anisotropy.x;
    vec2 direction = material.anisotropy.yz;
    if (present(COTAN_MAP_ANISOTROPY, material.anisotropyMap)) {
        vec3 texel = sampled(anisotropyMap, material.anisotropyMap).rgb;
        vec2 rotation = vec2(texel.r, -texel.g) * 2.0 + vec2(-1.0, 1.0);
        direction = vec2(rotation.x * direction.x - rotation.y * direction.y,
            rotation.x * direction.y + rotation.y * direction.x);
        strength *= texel.b;
    }
    g.t = cotan_direction_on_surface(smoothNormal, frame.t, frame.b, direction, n);
    g.anisotropy = dot(g.t, g.t) > 0.5 ? strength : 0.0;
}

cotan_gloss glossOf()
{
    float strength = material.specular.w;
    if (present(COTAN_MAP_SPECULAR, material.specularMap))
        strength *= sampled(specularMap, material.specularMap).a;
    vec3 color = material.specular.rgb;
    if (present(COTAN_MAP_SPECULAR_COLOR, material.specularColorMap))
        color *= sampled(specularColorMap, material.specularColorMap).rgb;
    cotan_gloss g = cotan_gloss_of(material.anisotropy.w, strength, color);
    if ((MAPS & COTAN_LAYER_TRANSMISSION) != 0u) {
        g.transmission = material.coat.w;
        if (present(COTAN_MAP_TRANSMISSION, material.transmissionMap))
            g.transmission *= sampled(transmissionMap, material.transmissionMap).r;
    }
    return g;
}

cotan_sheen sheenOf()
{
    cotan_sheen c;
    c.color = material.sheen.rgb;
    if (present(COTAN_MAP_SHEEN_COLOR, material.sheenColorMap))
        c.color *= sampled(sheenColorMap, material.sheenColorMap).rgb;
    c.roughness = material.sheen.w;
    if (present(COTAN_MAP_SHEEN_ROUGHNESS, material.sheenRoughnessMap))
        c.roughness *= sampled(sheenRoughnessMap, material.sheenRoughnessMap).a;
    return c;
}

// frame, smoothNormal: outwards on the front side. n: perturbed. side: -1 on the back.
void addLayers(inout Layers over, cotan_frame frame, vec3 smoothNormal, vec3 n, float side, float smoothVariance)
{
    over.glossy = SHADING == SHADING_PBR && (MAPS & COTAN_LAYER_GLOSS) != 0u;
    over.sheened = SHADING == SHADING_PBR && (MAPS & COTAN_LAYER_SHEEN) != 0u;
    over.coated = SHADING == SHADING_PBR && (MAPS & COTAN_LAYER_COAT) != 0u;
    if (over.glossy)
        over.gloss = glossOf();
    if (over.glossy && (MAPS & COTAN_LAYER_ANISOTROPY) != 0u)
        setAnisotropy(over.gloss, frame, smoothNormal, n);
    if (over.sheened)
        over.sheen = sheenOf();
    if (over.coated)
        over.coat = coatOf(frame, smoothNormal, side, smoothVariance);
}
