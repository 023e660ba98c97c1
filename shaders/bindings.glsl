// Bindings of the structs in gpu_structs.glsl, and of textures.
#include "gpu_structs.glsl"

layout(set = 0, binding = 0, std140) uniform ViewBlock { CotanView view; };
layout(set = 0, binding = 1, std430) readonly buffer LightBlock { CotanLight lights[]; };
layout(set = 0, binding = 2) uniform sampler2DShadow shadowMap;
layout(set = 0, binding = 5) uniform sampler2D environmentMap; // if ENVIRONMENT_MAP
layout(set = 0, binding = 6) uniform sampler2D shadowDepth; // shadowMap without depth comparison
layout(set = 0, binding = 7) uniform sampler2D groundMap; // if GROUND

layout(set = 1, binding = 0, std140) uniform MaterialBlock { CotanMaterial material; };
layout(set = 1, binding = 1) uniform sampler2D baseColorMap;
layout(set = 1, binding = 2) uniform sampler2D metallicRoughnessMap;
layout(set = 1, binding = 3) uniform sampler2D normalMap;
layout(set = 1, binding = 4) uniform sampler2D occlusionMap;
layout(set = 1, binding = 5) uniform sampler2D emissiveMap;
#ifdef COTAN_EXTENDED
layout(set = 1, binding = 6) uniform sampler2D coatMap;
layout(set = 1, binding = 7) uniform sampler2D coatRoughnessMap;
layout(set = 1, binding = 8) uniform sampler2D coatNormalMap;
layout(set = 1, binding = 9) uniform sampler2D anisotropyMap;
layout(set = 1, binding = 10) uniform sampler2D specularMap;
layout(set = 1, binding = 11) uniform sampler2D specularColorMap;
layout(set = 1, binding = 12) uniform sampler2D sheenColorMap;
layout(set = 1, binding = 13) uniform sampler2D sheenRoughnessMap;
layout(set = 1, binding = 14) uniform sampler2D transmissionMap;
layout(set = 1, binding = 15) uniform sampler2D heightMap;
#endif

layout(push_constant, std430) uniform DrawBlock { CotanDraw draw; };

vec3 cameraRelative(vec3 p)
{
    vec4 q = vec4(p, 1.0);
    return vec3(dot(draw.rowX, q), dot(draw.rowY, q), dot(draw.rowZ, q));
}

// For differences of positions and for tangents.
vec3 directionToWorld(vec3 d)
{
    return vec3(dot(draw.rowX.xyz, d), dot(draw.rowY.xyz, d), dot(draw.rowZ.xyz, d));
}

// For normals and other covectors; the result is scaled by a positive factor.
vec3 covectorToWorld(vec3 c)
{
    return vec3(dot(draw.normalX.xyz, c), dot(draw.normalY.xyz, c), dot(draw.normalZ.xyz, c));
}

vec3 toShadowMap(vec3 p)
{
    vec4 q = vec4(p, 1.0);
    return vec3(dot(view.shadowX, q), dot(view.shadowY, q), dot(view.shadowZ, q));
}

// Transforms differences of texture coordinates: the linear part of a use.
vec2 transformedDifference(CotanTextureUse use, vec4 texcoords)
{
    vec2 uv = use.uRow.w > 0.5 ? texcoords.zw : texcoords.xy;
    return vec2(dot(use.uRow.xy, uv), dot(use.vRow.xy, uv));
}

// Whether the mesh has the uv set that a use reads.
bool hasTexcoords(CotanTextureUse use)
{
    uint flag = use.uRow.w > 0.5 ? COTAN_DRAW_HAS_TEXCOORDS1 : COTAN_DRAW_HAS_TEXCOORDS0;
    return (draw.flags & flag) != 0u;
}

vec2 transformed(CotanTextureUse use, vec4 texcoords)
{
    return transformedDifference(use, texcoords) + vec2(use.uRow.z, use.vRow.z);
}

// Replaces texture coordinates that a sampler must not see: those of a file may be NaN or infinite.
vec2 finiteUv(vec2 uv) { return abs(uv.x) + abs(uv.y) <= 1e30 ? uv : vec2(0.0); }
