// Relief: an adapter between the height map and cotan/parallax.h. Moves the texture coordinates of a fragment to where
// the line of sight meets the heights.
const bool RELIEF = (MAPS & COTAN_MAP_HEIGHT) != 0u; // the material may have a height map

// The point of the relief that is seen.
struct Relief {
    cotan_frame frame; // gradients of the height map's uv set
    vec2 uv; // in this set
    float height; // as stored
    vec4 moved; // change of both uv sets
    float level; // of the height map: that of the shorter side of the pixel's footprint, which keeps walls steep
};
Relief relief = Relief(cotan_frame(vec3(0.0), vec3(0.0), vec3(0.0)), vec2(0.0), 1.0, vec4(0.0), 0.0);

vec4 seenTexcoords()
{
    vec4 texcoords = inTexcoords + inTexcoordOrigin;
    return RELIEF ? texcoords + relief.moved : texcoords;
}

float heightAt(vec2 uv)
{
    vec2 at = finiteUv(transformed(material.heightMapUse, vec4(uv, uv)));
    return textureLod(heightMap, at, relief.level).r;
}

bool hasRelief()
{
    CotanTextureUse use = material.heightMapUse;
    return RELIEF && present(COTAN_MAP_HEIGHT, use) && hasTexcoords(use);
}

// The steps of a ray that changes uv of the height map's set by `travel`: powers of two, which rounding rarely changes.
float stepsOf(vec2 travel)
{
    vec2 texels = transformedDifference(material.heightMapUse, vec4(travel, travel)) * vec2(textureSize(heightMap, 0));
    return clamp(exp2(ceil(log2(max(length(finiteUv(texels)), 1.0)))), material.heights.y, material.heights.z);
}

// n: safe unit normal, outwards on the front side. dpdx, dpdy: screen-space differences of the position.
void findRelief(vec3 n, vec3 dpdx, vec3 dpdy)
{
    if (!hasRelief())
        return;
    CotanTextureUse use = material.heightMapUse;
    vec2 texels = transformedDifference(use, inTexcoords) * vec2(textureSize(heightMap, 0));
    float side = min(length(finiteUv(dFdxFine(texels))), length(finiteUv(dFdyFine(texels)))) * APART;
    relief.level = log2(max(side, 1e-6));
    vec4 dx = dFdxFine(inTexcoords), dy = dFdyFine(inTexcoords);
    cotan_frame first = cotan_frame_gradient(n, dpdx, dpdy, dx.xy, dy.xy);
    cotan_frame second = cotan_frame_gradient(n, dpdx, dpdy, dx.zw, dy.zw);
    vec4 texcoords = inTexcoords + inTexcoordOrigin;
    bool ofSecond = use.uRow.w > 0.5;
    vec2 uv = ofSecond ? texcoords.zw : texcoords.xy;
    relief.frame = first;
    if (ofSecond)
        relief.frame = second;
    vec3 v = toEye(n);
    float depth = material.heights.x;
    // Both sets move by the same way through space.
    vec4 travel = vec4(cotan_relief_start(first, v, vec2(0.0), depth, 1.0).travel,
        cotan_relief_start(second, v, vec2(0.0), depth, 1.0).travel);
    float steps = stepsOf(ofSecond ? travel.zw : travel.xy);
    cotan_relief r = cotan_relief_start(relief.frame, v, uv, depth, steps);
    for (int i = 0; i < int(steps) && r.found < 0.5; ++i)
        r = cotan_relief_next(r, heightAt(r.uv));
    for (int i = 0; i < int(material.heights.w); ++i)
        r = cotan_relief_next(r, heightAt(r.uv));
    relief.uv = r.uv;
    relief.height = 1.0 - r.at;
    relief.moved = travel * r.at;
}

// The fraction of light from the unit direction l that the relief does not keep from the point that is seen: 0 or 1.
float reliefLight(vec3 l)
{
    if (!hasRelief())
        return 1.0;
    float depth = material.heights.x;
    float steps = stepsOf(cotan_relief_shadow(relief.frame, l, relief.uv, relief.height, depth, 1.0).travel);
    cotan_relief r = cotan_relief_shadow(relief.frame, l, relief.uv, relief.height, depth, steps);
    for (int i = 0; i < int(steps) && r.found < 0.5; ++i)
        r = cotan_relief_next(r, heightAt(r.uv));
    return 1.0 - r.found;
}
