#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>

#include <assimp/ObjMaterial.h>
#include <assimp/material.h>

#include "assimp_convert.hpp"
#include "source_material.hpp"

namespace cotan {

namespace {

Wrap wrapFrom(aiTextureMapMode mode)
{
    if (mode == aiTextureMapMode_Mirror)
        return Wrap::mirror;
    return mode == aiTextureMapMode_Wrap ? Wrap::repeat : Wrap::clamp;
}

// Assimp scales, turns about the centre and moves with v up; ours has v down.
void setTransform(Texture& texture, const aiUVTransform& t)
{
    const float c = std::cos(t.mRotation), s = std::sin(t.mRotation);
    const glm::vec3 u(c * t.mScaling.x, -s * t.mScaling.y, 0.5f - 0.5f * c + 0.5f * s + t.mTranslation.x);
    const glm::vec3 v(s * t.mScaling.x, c * t.mScaling.y, 0.5f - 0.5f * s - 0.5f * c + t.mTranslation.y);
    // With v_up = 1 - v_down on both sides.
    texture.uRow = {u.x, -u.y, u.y + u.z};
    texture.vRow = {-v.x, v.y, 1.0f - v.y - v.z};
}

std::optional<float> number(const aiMaterial& source, const char* key, unsigned type, unsigned index)
{
    ai_real value = 0;
    if (source.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value))
        return std::nullopt;
    return value;
}

glm::vec3 color(const aiMaterial& source, const char* key, glm::vec3 fallback)
{
    aiColor3D value;
    if (source.Get(key, 0, 0, value) != aiReturn_SUCCESS || !std::isfinite(value.r) || !std::isfinite(value.g)
        || !std::isfinite(value.b))
        return fallback;
    return glm::max(glm::vec3(value.r, value.g, value.b), glm::vec3(0));
}

// The first texture of the first type that has one.
SourceMap findMap(const aiMaterial& source, std::initializer_list<aiTextureType> types)
{
    for (const aiTextureType type : types) {
        aiString path;
        unsigned uvSet = 0;
        std::array<aiTextureMapMode, 3> modes{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
        if (source.GetTexture(type, 0, &path, nullptr, &uvSet, nullptr, nullptr, modes.data()) != aiReturn_SUCCESS
            || path.length == 0)
            continue;
        SourceMap map{path.C_Str(), {}, number(source, AI_MATKEY_OBJ_BUMPMULT(type, 0)).value_or(1)};
        map.use.texcoord = uvSet == 1 ? 1 : 0;
        map.use.sampler.wrapU = wrapFrom(modes[0]);
        map.use.sampler.wrapV = wrapFrom(modes[1]);
        aiUVTransform transform;
        if (source.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS)
            setTransform(map.use, transform);
        return map;
    }
    return {};
}

} // namespace

Material convertMaterial(const aiMaterial& source, TextureReader& textures, Scene& scene)
{
    SourceMaterial out;
    aiString name;
    const bool named = source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0;
    out.name = named ? name.C_Str() : "unnamed";
    out.color = color(source, "$clr.base", color(source, "$clr.diffuse", out.color));
    out.opacity = number(source, AI_MATKEY_OPACITY).value_or(1);
    out.shininess = number(source, AI_MATKEY_SHININESS).value_or(0);
    out.roughness = number(source, AI_MATKEY_ROUGHNESS_FACTOR);
    out.metallic = number(source, AI_MATKEY_METALLIC_FACTOR);
    out.emission = color(source, "$clr.emissive", out.emission);
    out.colorMap = findMap(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    out.opacityMap = findMap(source, {aiTextureType_OPACITY});
    out.roughnessMap = findMap(source, {aiTextureType_DIFFUSE_ROUGHNESS});
    out.metalnessMap = findMap(source, {aiTextureType_METALNESS});
    out.normalMap = findMap(source, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT});
    out.emissionMap = findMap(source, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
    out.occlusionMap = findMap(source, {aiTextureType_AMBIENT_OCCLUSION});
    return makeMaterial(out, textures, scene);
}

} // namespace cotan
