// Light on a surface: an adapter between the scene's lights and cotan/light.h.

// The share of the shadow light that reaches p: 3x3 comparisons, weighted so that the result is
// continuous (sixteen texels, read as four gathers). n: unit, geometric, on the lit side.
float shadowAt(vec3 p, vec3 n, float nl)
{
    // Along the normal, most where the light grazes: a texel of the map covers a slope there.
    vec3 offset = n * (view.shadow.x * (0.5 + 2.0 * sqrt(max(1.0 - nl * nl, 0.0))));
    vec3 s = toShadowMap(p + offset);
    bool inside = s.x > 0.0 && s.x < 1.0 && s.y > 0.0 && s.y < 1.0 && s.z > 0.0 && s.z < 1.0;
    if (!inside)
        return 1.0;
    float depth = s.z - view.shadow.z;
    vec2 texel = s.xy * view.shadow.y - 0.5;
    vec2 base = floor(texel);
    vec2 f = texel - base;
    vec2 near = base / view.shadow.y;
    vec2 far = (base + 2.0) / view.shadow.y;
    // A gather returns, in order, the texels at (0,1) (1,1) (1,0) (0,0).
    vec4 a = textureGather(shadowMap, near, depth);
    vec4 b = textureGather(shadowMap, vec2(far.x, near.y), depth);
    vec4 c = textureGather(shadowMap, vec2(near.x, far.y), depth);
    vec4 d = textureGather(shadowMap, far, depth);
    vec2 g = 1.0 - f;
    float sum = dot(a, vec4(g.x, 1.0, g.y, g.x * g.y)) + dot(b, vec4(1.0, f.x, f.x * g.y, g.y))
        + dot(c, vec4(g.x * f.y, f.y, 1.0, g.x)) + dot(d, vec4(f.y, f.x * f.y, f.x, 1.0));
    return sum / 9.0;
}

// The same of a light that covers a disc: cotan/shadow.h. lit: whether what arrives matters.
float softShadowAt(vec3 p, vec3 n, float nl, bool lit)
{
    vec3 s = toShadowMap(p + n * (view.shadow.x * (0.5 + 1.5 * sqrt(max(1.0 - nl * nl, 0.0)))));
    bool inside = s.x > 0.0 && s.x < 1.0 && s.y > 0.0 && s.y < 1.0 && s.z > 0.0 && s.z < 1.0;
    // How the depth of the plane through the point changes with the place in the map.
    float size = view.shadow.x * view.shadow.y;
    vec2 slope = vec2(dot(n, view.shadowX.xyz), dot(n, view.shadowY.xyz)) * (size * view.soft.z / max(nl, 0.2));
    float texel = 1.0 / view.shadow.y;
    float depth = s.z - view.shadow.z * (1.0 + min(length(slope) / view.soft.z, 4.0));
    float reach = cotan_penumbra(s.z, view.soft.x, 2.0 * texel, view.soft.y);

    // Loops of no rounds cost nothing where a branch would not be left out: see MAPS.
    int rounds = inside && lit ? COTAN_SHADOW_SEARCH : 0;
    vec2 sum = vec2(0.0);
    vec2 direction = vec2(1.0, 0.0);
    for (int i = 0; i < rounds; ++i) {
        vec2 offset = direction * (reach * cotan_tap_radius(i, COTAN_SHADOW_SEARCH));
        vec4 found = textureGather(shadowDepth, s.xy + offset);
        vec4 before = vec4(lessThan(found, vec4(depth + dot(slope, offset))));
        sum += vec2(dot(found, before), dot(before, vec4(1.0)));
        direction = cotan_next_tap(direction);
    }
    if (sum.y == 0.0)
        rounds = 0;
    float radius = cotan_penumbra(s.z - sum.x / max(sum.y, 1.0), view.soft.x, 1.5 * texel, view.soft.y);
    float arriving = 0.0;
    rounds = rounds == 0 ? 0 : COTAN_SHADOW_TAPS;
    for (int i = 0; i < rounds; ++i) {
        vec2 offset = direction * (radius * cotan_tap_radius(i, COTAN_SHADOW_TAPS));
        arriving += textureLod(shadowMap, vec3(s.xy + offset, depth + dot(slope, offset)), 0.0);
        direction = cotan_next_tap(direction);
    }
    return rounds == 0 ? 1.0 : arriving / float(COTAN_SHADOW_TAPS);
}

// What extensions add to a surface; which of it is there is known when the shader is compiled.
struct Layers {
    bool glossy;
    bool sheened;
    bool coated;
    cotan_gloss gloss;
    cotan_sheen sheen;
    cotan_coat coat;
};

// All that leaves the surface, by whether it comes through the coat.
struct Reflected {
    vec3 base;
    vec3 coat;
};

// Even places in the pixel whose normals are lit one by one where highlights are antialiased: how many, one without a
// normal map. For main to set.
int tapCount = 1;
// The surface there. Read for each light again: 256 normals are too many to keep.
cotan_surface atTap(cotan_surface s, int tap);

vec3 reflectedOf(cotan_surface s, Layers over, vec3 l)
{
    if (SHADING == SHADING_BLINN_PHONG)
        return cotan_reflect_blinn_phong(s, l);
    vec3 light = over.glossy ? cotan_reflect_glossy(s, over.gloss, l) : cotan_reflect_pbr(s, l);
    return over.sheened ? cotan_reflect_sheen(over.sheen, s.n, s.v, l, light) : light;
}

vec3 reflected(cotan_surface s, Layers over, vec3 l)
{
    if (!SPECULAR_ANTIALIASING)
        return reflectedOf(s, over, l);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < tapCount; ++i)
        sum += reflectedOf(atTap(s, i), over, l);
    return sum / float(tapCount);
}

// What one light adds. p: camera-relative; n: unit geometric normal on the seen side.
void addLight(inout Reflected sum, CotanLight light, cotan_surface s, Layers over, vec3 p, vec3 n)
{
    vec3 l = -light.direction.xyz;
    float reach = 1.0;
    if (light.position.w > 0.5) {
        vec3 way = light.position.xyz - p;
        l = cotan_normalize_or(way, vec3(0.0, 1.0, 0.0));
        reach = cotan_light_falloff(length(way), light.direction.w);
        if (light.position.w > 1.5)
            reach *= cotan_smooth(light.cone.x, light.cone.y, -dot(l, light.direction.xyz));
    }
    if (SHADOWS && light.color.w > 0.5)
        reach *= SOFT_SHADOWS ? softShadowAt(p, n, dot(n, l), dot(s.n, l) > 0.0) : shadowAt(p, n, dot(n, l));
    sum.base += light.color.rgb * (reach * reflected(s, over, l));
    if (over.coated)
        sum.coat += light.color.rgb * (reach * cotan_reflect_coat(over.coat, s.v, l));
}

vec3 environmentLightOf(cotan_surface s, Layers over)
{
    vec3 light;
    if (ENVIRONMENT_MAP)
        light = over.glossy ? reflectedGlossy(s, over.gloss) : reflectedOfImage(s);
    else
        light = over.glossy ? cotan_reflect_environment_glossy(s, over.gloss) : cotan_reflect_environment(s);
    if (over.sheened) {
        vec3 irradiance = ENVIRONMENT_MAP ? irradianceOf(s.n) : cotan_environment(s.n, 1.0);
        light = cotan_reflect_sheen_around(over.sheen, s.n, s.v, irradiance * s.occlusion, light);
    }
    return light;
}

vec3 environmentLight(cotan_surface s, Layers over)
{
    if (!SPECULAR_ANTIALIASING)
        return environmentLightOf(s, over);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < tapCount; ++i)
        sum += environmentLightOf(atTap(s, i), over);
    return sum / float(tapCount);
}

vec3 lit(cotan_surface s, Layers over, vec3 p, vec3 n)
{
    Reflected sum = Reflected(s.emissive, vec3(0.0));
    for (uint i = 0u; i < view.counts.x; ++i)
        addLight(sum, lights[i], s, over, p, n);
    if (ENVIRONMENT) {
        sum.base += environmentLight(s, over);
        if (over.coated)
            sum.coat += s.occlusion
                * (ENVIRONMENT_MAP ? reflectedOfCoat(over.coat, s.v) : cotan_reflect_coat_environment(over.coat, s.v));
    }
    if (!over.coated)
        return sum.base;
    return sum.base * (1.0 - cotan_coat_share(over.coat, s.v)) + sum.coat;
}

// The factors, by colour, of what is behind a surface that transmits.
vec3 transmittance(cotan_surface s, Layers over)
{
    vec3 through = cotan_transmittance(s, over.gloss);
    if (over.sheened)
        through *= 1.0 - cotan_sheen_share(over.sheen, abs(dot(s.n, s.v)));
    if (over.coated)
        through *= 1.0 - cotan_coat_share(over.coat, s.v);
    return through;
}
