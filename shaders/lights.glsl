// Light on a surface: an adapter between the scene's lights and cotan/light.h.

// The fraction of the shadow light that reaches p: 3x3 comparisons, weighted so that the result is continuous (sixteen
// texels, in four gathers). n: unit geometric normal on the lit side.
float shadowAt(vec3 p, vec3 n, float nl)
{
    // Offsets p along the normal, most at grazing light, where a shadow map texel covers a range of depths.
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
    // A gather returns the texels at (0,1) (1,1) (1,0) (0,0), in this order.
    vec4 a = textureGather(shadowMap, near, depth);
    vec4 b = textureGather(shadowMap, vec2(far.x, near.y), depth);
    vec4 c = textureGather(shadowMap, vec2(near.x, far.y), depth);
    vec4 d = textureGather(shadowMap, far, depth);
    vec2 g = 1.0 - f;
    float sum = dot(a, vec4(g.x, 1.0, g.y, g.x * g.y)) + dot(b, vec4(1.0, f.x, f.x * g.y, g.y))
        + dot(c, vec4(g.x * f.y, f.y, 1.0, g.x)) + dot(d, vec4(f.y, f.x * f.y, f.x, 1.0));
    return sum / 9.0;
}

// The same fraction for a light that covers a disc, as in cotan/shadow.h. lit: false skips all reads.
float softShadowAt(vec3 p, vec3 n, float nl, bool lit)
{
    vec3 s = toShadowMap(p + n * (view.shadow.x * (0.5 + 1.5 * sqrt(max(1.0 - nl * nl, 0.0)))));
    bool inside = s.x > 0.0 && s.x < 1.0 && s.y > 0.0 && s.y < 1.0 && s.z > 0.0 && s.z < 1.0;
    // Change of depth in the plane through p, per unit of map u and v.
    float size = view.shadow.x * view.shadow.y;
    vec2 slope = vec2(dot(n, view.shadowX.xyz), dot(n, view.shadowY.xyz)) * (size * view.soft.z / max(nl, 0.2));
    float texel = 1.0 / view.shadow.y;
    float depth = s.z - view.shadow.z * (1.0 + min(length(slope) / view.soft.z, 4.0));
    float searchRadius = cotan_penumbra(s.z, view.soft.x, 2.0 * texel, view.soft.y);

    // Loops with zero iterations cost nothing, even on drivers that execute both sides of a branch (see MAPS).
    int iterations = inside && lit ? COTAN_SHADOW_SEARCH : 0;
    vec2 sum = vec2(0.0);
    vec2 direction = vec2(1.0, 0.0);
    for (int i = 0; i < iterations; ++i) {
        vec2 offset = direction * (searchRadius * cotan_tap_radius(i, COTAN_SHADOW_SEARCH));
        vec4 found = textureGather(shadowDepth, s.xy + offset);
        vec4 blockers = vec4(lessThan(found, vec4(depth + dot(slope, offset))));
        sum += vec2(dot(found, blockers), dot(blockers, vec4(1.0)));
        direction = cotan_next_tap(direction);
    }
    if (sum.y == 0.0)
        iterations = 0;
    float radius = cotan_penumbra(s.z - sum.x / max(sum.y, 1.0), view.soft.x, 1.5 * texel, view.soft.y);
    float visible = 0.0;
    iterations = iterations == 0 ? 0 : COTAN_SHADOW_TAPS;
    for (int i = 0; i < iterations; ++i) {
        vec2 offset = direction * (radius * cotan_tap_radius(i, COTAN_SHADOW_TAPS));
        visible += textureLod(shadowMap, vec3(s.xy + offset, depth + dot(slope, offset)), 0.0);
        direction = cotan_next_tap(direction);
    }
    return iterations == 0 ? 1.0 : visible / float(COTAN_SHADOW_TAPS);
}

// What material extensions add to a surface. The flags are compile-time constants.
struct Layers {
    bool glossy;
    bool sheened;
    bool coated;
    cotan_gloss gloss;
    cotan_sheen sheen;
    cotan_coat coat;
};

// Light that leaves the surface. The coat attenuates `base`, but not `coat`.
struct Reflected {
    vec3 base;
    vec3 coat;
};

// Number of evenly spaced points in the pixel whose normals are lit individually for specular antialiasing; 1 without a
// normal map. Set by main.
int tapCount = 1;
// The surface at one of these points. Recomputed for each light, because 256 normals are too many to store.
cotan_surface tapSurface(cotan_surface s, int tap);

#ifdef COTAN_EXTENDED
float reliefLight(vec3 l); // relief.glsl
#endif

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
        sum += reflectedOf(tapSurface(s, i), over, l);
    return sum / float(tapCount);
}

// Adds the contribution of one light. p: camera-relative; n: unit geometric normal on the visible side.
void addLight(inout Reflected sum, CotanLight light, cotan_surface s, Layers over, vec3 p, vec3 n)
{
    vec3 l = -light.direction.xyz;
    float attenuation = 1.0;
    if (light.position.w > 0.5) {
        vec3 toLight = light.position.xyz - p;
        l = cotan_normalize_or(toLight, vec3(0.0, 1.0, 0.0));
        attenuation = cotan_light_falloff(length(toLight), light.direction.w);
        if (light.position.w > 1.5)
            attenuation *= cotan_smooth(light.cone.x, light.cone.y, -dot(l, light.direction.xyz));
    }
    if (SHADOWS && light.color.w > 0.5) {
        attenuation *= SOFT_SHADOWS ? softShadowAt(p, n, dot(n, l), dot(s.n, l) > 0.0) : shadowAt(p, n, dot(n, l));
#ifdef COTAN_EXTENDED
        attenuation *= reliefLight(l);
#endif
    }
    sum.base += light.color.rgb * (attenuation * reflected(s, over, l));
    if (over.coated)
        sum.coat += light.color.rgb * (attenuation * cotan_reflect_coat(over.coat, s.v, l));
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
        sum += environmentLightOf(tapSurface(s, i), over);
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
    return sum.base * (1.0 - cotan_coat_fraction(over.coat, s.v)) + sum.coat;
}

// Transmittance for the colours behind the surface.
vec3 transmittance(cotan_surface s, Layers over)
{
    vec3 factor = cotan_transmittance(s, over.gloss);
    if (over.sheened)
        factor *= 1.0 - cotan_sheen_fraction(over.sheen, abs(dot(s.n, s.v)));
    if (over.coated)
        factor *= 1.0 - cotan_coat_fraction(over.coat, s.v);
    return factor;
}
