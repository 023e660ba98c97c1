#include "material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cotan {

namespace {

Wrap wrapMode(int mode)
{
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE: return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT: return Wrap::mirror;
    default: return Wrap::repeat;
    }
}

// What the file leaves open becomes linear with mipmaps.
Sampler makeSampler(const tinygltf::Sampler& source)
{
    Sampler sampler;
    sampler.wrapU = wrapMode(source.wrapS);
    sampler.wrapV = wrapMode(source.wrapT);
    if (source.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST)
        sampler.magnify = Filter::nearest;
    switch (source.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
        sampler.minify = Filter::nearest;
        sampler.mip = MipFilter::none;
        break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR: sampler.mip = MipFilter::none; break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
        sampler.minify = Filter::nearest;
        sampler.mip = MipFilter::nearest;
        break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST: sampler.mip = MipFilter::nearest; break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR: sampler.minify = Filter::nearest; break;
    default: break;
    }
    return sampler;
}

double numberOr(const tinygltf::Value& object, const char* name, double otherwise)
{
    return object.Has(name) ? object.Get(name).GetNumberAsDouble() : otherwise;
}

glm::dvec2 pairOr(const tinygltf::Value& object, const char* name, glm::dvec2 otherwise)
{
    if (!object.Has(name))
        return otherwise;
    const tinygltf::Value& pair = object.Get(name);
    return {pair.Get(0).GetNumberAsDouble(), pair.Get(1).GetNumberAsDouble()};
}

// KHR_texture_transform: scale, then turn, then shift. The turn is counter-clockwise as seen in
// the image, whose v runs down; so its sine stands in the first row, not in the second. (The
// extension's example, offset (0,1), a quarter turn, scale 1/2, has to select the lower left
// quadrant.)
void applyTransform(const tinygltf::Value& transform, Texture& texture)
{
    const glm::dvec2 offset = pairOr(transform, "offset", {0, 0});
    const glm::dvec2 scale = pairOr(transform, "scale", {1, 1});
    const double turn = numberOr(transform, "rotation", 0);
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    texture.uRow = glm::vec3(c * scale.x, s * scale.y, offset.x);
    texture.vRow = glm::vec3(-s * scale.x, c * scale.y, offset.y);
}

const tinygltf::Value* findTransform(const tinygltf::ExtensionMap& extensions)
{
    const auto found = extensions.find("KHR_texture_transform");
    return found == extensions.end() ? nullptr : &found->second;
}

// The extension may name another uv set than the texture itself.
int uvSet(int texcoord, const tinygltf::ExtensionMap& extensions)
{
    const tinygltf::Value* const transform = findTransform(extensions);
    if (transform && transform->Has("texCoord"))
        return transform->Get("texCoord").GetNumberAsInt();
    return texcoord;
}

float unitRange(double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); }

float emissiveStrength(const tinygltf::Material& material)
{
    const auto found = material.extensions.find("KHR_materials_emissive_strength");
    return found == material.extensions.end()
        ? 1.0f
        : static_cast<float>(numberOr(found->second, "emissiveStrength", 1));
}

// The extension of a material, of those that are not drawn here, that reads tangents.
std::string tangentReader(const tinygltf::Material& material)
{
    if (material.extensions.contains("KHR_materials_anisotropy"))
        return "KHR_materials_anisotropy";
    const auto coat = material.extensions.find("KHR_materials_clearcoat");
    const bool normals = coat != material.extensions.end() && coat->second.Has("clearcoatNormalTexture");
    return normals ? "KHR_materials_clearcoat" : "";
}

// The factors of a material: everything but its textures.
Material makeFactors(const tinygltf::Material& source)
{
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    material.tangentsFor = tangentReader(source);
    for (int i = 0; i < 4; ++i)
        material.baseColor[i] = unitRange(pbr.baseColorFactor[static_cast<std::size_t>(i)]);
    material.metallic = unitRange(pbr.metallicFactor);
    material.roughness = unitRange(pbr.roughnessFactor);
    for (int i = 0; i < 3; ++i)
        material.emissive[i] = unitRange(source.emissiveFactor[static_cast<std::size_t>(i)])
            * emissiveStrength(source);
    material.occlusionStrength = unitRange(source.occlusionTexture.strength);
    material.normalScale = static_cast<float>(source.normalTexture.scale);
    material.alphaMode = source.alphaMode == "MASK" ? AlphaMode::mask
        : source.alphaMode == "BLEND"               ? AlphaMode::blend
                                                    : AlphaMode::opaque;
    material.alphaCutoff = static_cast<float>(source.alphaCutoff);
    material.doubleSided = source.doubleSided;
    material.unlit = source.extensions.contains("KHR_materials_unlit");
    return material;
}

} // namespace

int gltfNormalMapSet(const GltfModel& model, int material)
{
    if (material < 0)
        return -1;
    const tinygltf::NormalTextureInfo& info =
        model.tiny.materials[static_cast<std::size_t>(material)].normalTexture;
    return info.index < 0 ? -1 : uvSet(info.texCoord, info.extensions);
}

// The image of a texture, or the one that an extension gives it in another format; -1 if there is none.
int GltfMaterials::imageOf(const tinygltf::Texture& texture) const
{
    if (texture.source >= 0)
        return texture.source;
    const nlohmann::json& file = model_.file.json;
    const std::size_t images = file.contains("images") ? file["images"].size() : 0;
    for (const auto& [name, extension] : texture.extensions)
        if (extension.IsObject() && extension.Has("source") && extension.Get("source").IsInt())
            if (const int image = extension.Get("source").GetNumberAsInt();
                image >= 0 && static_cast<std::size_t>(image) < images)
                return image;
    return -1;
}

int GltfMaterials::imageSlot(int image)
{
    const auto [slot, isNew] = slots_.emplace(image, static_cast<int>(scene_.images.size()));
    if (isNew)
        scene_.images.emplace_back();
    return slot->second;
}

Texture GltfMaterials::texture(int index, int texcoord, const tinygltf::ExtensionMap& extensions,
                               const Mesh& mesh, const std::string& field)
{
    Texture texture;
    if (index < 0)
        return texture;
    const tinygltf::Texture& source = model_.tiny.textures[static_cast<std::size_t>(index)];
    const int image = model_.limits.pixels == Pixels::all ? source.source : imageOf(source);
    if (image < 0) {
        model_.warnings.add(fmt::format("textures[{}]", index),
                            "no PNG or JPEG image, the texture is left out");
        return texture;
    }
    const int set = uvSet(texcoord, extensions);
    if (set < 0 || set > 1 || mesh.texcoords[static_cast<std::size_t>(set)].empty()) {
        model_.warnings.add(field,
                            fmt::format("it asks for TEXCOORD_{}, which is missing from a "
                                        "mesh that uses it; left out there",
                                        set));
        return texture;
    }
    texture.texcoord = set;
    if (source.sampler >= 0)
        texture.sampler =
            makeSampler(model_.tiny.samplers[static_cast<std::size_t>(source.sampler)]);
    if (const tinygltf::Value* const transform = findTransform(extensions))
        applyTransform(*transform, texture);
    texture.image = imageSlot(image);
    return texture;
}

Material GltfMaterials::make(int index, const Mesh& mesh)
{
    if (index < 0)
        return {};
    const tinygltf::Material& source = model_.tiny.materials[static_cast<std::size_t>(index)];
    const std::string field = fmt::format("materials[{}].", index);
    const auto map = [&](const auto& info, const char* name) {
        return texture(info.index, info.texCoord, info.extensions, mesh, field + name);
    };
    Material material = makeFactors(source);
    material.baseColorMap = map(source.pbrMetallicRoughness.baseColorTexture, "baseColorTexture");
    material.metallicRoughnessMap =
        map(source.pbrMetallicRoughness.metallicRoughnessTexture, "metallicRoughnessTexture");
    material.normalMap = map(source.normalTexture, "normalTexture");
    material.occlusionMap = map(source.occlusionTexture, "occlusionTexture");
    material.emissiveMap = map(source.emissiveTexture, "emissiveTexture");
    return material;
}

int GltfMaterials::use(int material, const Mesh& mesh)
{
    const int sets = (mesh.texcoords[0].empty() ? 0 : 1) + (mesh.texcoords[1].empty() ? 0 : 2);
    const std::pair key(material, material < 0 ? 0 : sets);
    const auto known = made_.find(key);
    if (known != made_.end())
        return known->second;
    const int slot = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(make(material, mesh));
    made_.emplace(key, slot);
    return slot;
}

} // namespace cotan
