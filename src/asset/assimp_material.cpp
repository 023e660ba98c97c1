#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <fmt/format.h>

#include "assimp_convert.hpp"

namespace cotan {

namespace {

// A texture of an Assimp material: which image, and how it is laid on.
struct Slot {
    std::string path; // empty: none
    aiTextureType type = aiTextureType_NONE;
    Texture use;
};

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
    const glm::vec3 u(c * t.mScaling.x, -s * t.mScaling.y,
                      0.5f - 0.5f * c + 0.5f * s + t.mTranslation.x);
    const glm::vec3 v(s * t.mScaling.x, c * t.mScaling.y,
                      0.5f - 0.5f * s - 0.5f * c + t.mTranslation.y);
    // With v_up = 1 - v_down on both sides.
    texture.uRow = {u.x, -u.y, u.y + u.z};
    texture.vRow = {-v.x, v.y, 1.0f - v.y - v.z};
}

// The first texture of the first type that has one.
Slot findSlot(const aiMaterial& source, std::initializer_list<aiTextureType> types)
{
    for (const aiTextureType type : types) {
        aiString path;
        unsigned uvSet = 0;
        std::array<aiTextureMapMode, 3> modes{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap,
                                              aiTextureMapMode_Wrap};
        if (source.GetTexture(type, 0, &path, nullptr, &uvSet, nullptr, nullptr, modes.data())
                != aiReturn_SUCCESS
            || path.length == 0)
            continue;
        Slot slot{path.C_Str(), type, {}};
        slot.use.texcoord = uvSet == 1 ? 1 : 0;
        slot.use.sampler.wrapU = wrapFrom(modes[0]);
        slot.use.sampler.wrapV = wrapFrom(modes[1]);
        aiUVTransform transform;
        if (source.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS)
            setTransform(slot.use, transform);
        return slot;
    }
    return {};
}

Texture use(const Slot& slot, int image)
{
    Texture texture = slot.use;
    texture.image = image;
    return texture;
}

float number(const aiMaterial& source, const char* key, unsigned type, unsigned index,
             float fallback)
{
    ai_real value = 0;
    if (source.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value))
        return fallback;
    return value;
}

glm::vec3 color(const aiMaterial& source, const char* key, glm::vec3 fallback)
{
    aiColor3D value;
    if (source.Get(key, 0, 0, value) != aiReturn_SUCCESS || !std::isfinite(value.r)
        || !std::isfinite(value.g) || !std::isfinite(value.b))
        return fallback;
    return glm::max(glm::vec3(value.r, value.g, value.b), glm::vec3(0));
}

// Blinn-Phong's exponent e is about as wide as GGX with alpha^2 = 2/(e + 2), alpha = roughness^2.
float roughnessFromShininess(float shininess)
{
    constexpr float kUnknown = 0.7f;
    return shininess > 0 ? std::pow(2.0f / (shininess + 2.0f), 0.25f) : kUnknown;
}

void setSurface(const aiMaterial& source, TextureReader& textures, Material& material)
{
    const Slot rough = findSlot(source, {aiTextureType_DIFFUSE_ROUGHNESS});
    const Slot metal = findSlot(source, {aiTextureType_METALNESS});
    const int roughImage = rough.path.empty() ? -1 : textures.image(rough.path, material.name);
    const int metalImage = metal.path.empty() ? -1 : textures.image(metal.path, material.name);
    const float shininess = number(source, AI_MATKEY_SHININESS, 0);
    const float roughness = roughImage >= 0 ? 1 : roughnessFromShininess(shininess);
    material.roughness =
        std::clamp(number(source, AI_MATKEY_ROUGHNESS_FACTOR, roughness), 0.0f, 1.0f);
    material.metallic = std::clamp(
        number(source, AI_MATKEY_METALLIC_FACTOR, metalImage >= 0 ? 1.0f : 0.0f), 0.0f, 1.0f);
    // Without a map of its own the other factor must not be scaled by a white channel's neighbour.
    material.metallicRoughnessMap =
        use(roughImage >= 0 ? rough : metal, textures.metallicRoughness(roughImage, metalImage));
}

void setBaseColor(const aiMaterial& source, TextureReader& textures, Scene& scene,
                  Material& material)
{
    const Slot slot = findSlot(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    if (!slot.path.empty())
        material.baseColorMap = use(slot, textures.image(slot.path, material.name));
    glm::vec3 base = color(source, "$clr.base", color(source, "$clr.diffuse", glm::vec3(0.8f)));
    if (base == glm::vec3(0) && material.baseColorMap.present())
        base = glm::vec3(1); // exporters that leave the factor at black mean the map alone

    float opacity = number(source, AI_MATKEY_OPACITY, 1);
    if (opacity <= 0) {
        scene.warnings.push_back(
            fmt::format("material {}: its opacity is 0; taken as opaque", material.name));
        opacity = 1;
    }
    material.baseColor = glm::vec4(base, std::min(opacity, 1.0f));
    if (opacity < 1)
        material.alphaMode = AlphaMode::blend;

    const Slot cut = findSlot(source, {aiTextureType_OPACITY});
    if (cut.path.empty())
        return;
    if (cut.path == slot.path)
        material.alphaMode = AlphaMode::mask;
    else
        scene.warnings.push_back(fmt::format(
            "material {}: the opacity map {} is left out; alpha is read from the colour map",
            material.name, cut.path));
}

// Names that say that green points down: "directx", or "dx" standing alone or after "normal".
bool namesDirectX(const std::string& path)
{
    std::string name = path.substr(path.find_last_of("/\\") + 1);
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto letter = [&](std::size_t i) {
        return i < name.size() && std::isalpha(static_cast<unsigned char>(name[i]));
    };
    if (name.find("directx") != std::string::npos)
        return true;
    for (std::size_t at = name.find("dx"); at != std::string::npos; at = name.find("dx", at + 1)) {
        const bool starts =
            at == 0 || !letter(at - 1) || std::string_view(name).substr(0, at).ends_with("normal");
        if (starts && !letter(at + 2))
            return true;
    }
    return false;
}

void setNormalMap(const aiMaterial& source, TextureReader& textures, Scene& scene,
                  Material& material)
{
    const Slot slot = findSlot(
        source, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT});
    if (slot.path.empty())
        return;
    const float strength = number(source, AI_MATKEY_OBJ_BUMPMULT(slot.type, 0), 1);
    bool converted = false;
    material.normalMap =
        use(slot, textures.normalMap(slot.path, material.name, strength, converted));
    if (!material.normalMap.present() || converted)
        return; // the strength is in the conversion
    material.normalScale = strength;
    if (namesDirectX(slot.path)) {
        material.normalFormat.greenAlongV = true;
        scene.warnings.push_back(fmt::format(
            "material {}: normal map {} is taken as green down (DirectX), as its name says",
            material.name, slot.path));
    }
}

void setEmission(const aiMaterial& source, TextureReader& textures, Material& material)
{
    const Slot slot = findSlot(source, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
    material.emissive = color(source, "$clr.emissive", glm::vec3(0));
    if (slot.path.empty())
        return;
    material.emissiveMap = use(slot, textures.image(slot.path, material.name));
    if (material.emissiveMap.present() && material.emissive == glm::vec3(0))
        material.emissive = glm::vec3(1);
}

} // namespace

Material convertMaterial(const aiMaterial& source, TextureReader& textures, Scene& scene)
{
    Material material;
    aiString name;
    if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0)
        material.name = name.C_Str();
    else
        material.name = "unnamed";
    material.doubleSided = true; // these formats do not say
    setBaseColor(source, textures, scene, material);
    setSurface(source, textures, material);
    setNormalMap(source, textures, scene, material);
    setEmission(source, textures, material);
    const Slot occlusion = findSlot(source, {aiTextureType_AMBIENT_OCCLUSION});
    if (!occlusion.path.empty())
        material.occlusionMap = use(occlusion, textures.image(occlusion.path, material.name));
    return material;
}

} // namespace cotan
