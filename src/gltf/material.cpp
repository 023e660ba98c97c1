#include "material.hpp"

namespace cotan {

int gltfNormalMapSet(const GltfModel& model, int material)
{
    if (material < 0)
        return -1;
    const gltf::TextureUse& map = model.structure.materials[static_cast<std::size_t>(material)].normal;
    return map.texture < 0 ? -1 : map.texcoord;
}

// The image of a texture, or the one that an extension gives it in another format; -1 if there is none.
int GltfMaterials::imageOf(const gltf::Texture& texture) const
{
    return texture.image >= 0 || model_.limits.pixels == Pixels::all ? texture.image : texture.foreign;
}

int GltfMaterials::imageSlot(int image)
{
    image = firstEqual(image);
    const auto [slot, isNew] = slots_.emplace(image, static_cast<int>(scene_.images.size()));
    if (isNew)
        scene_.images.emplace_back();
    return slot->second;
}

Texture GltfMaterials::texture(const gltf::TextureUse& use, const Mesh& mesh, const std::string& field)
{
    Texture texture;
    if (use.texture < 0)
        return texture;
    const gltf::Texture& source = model_.structure.textures[static_cast<std::size_t>(use.texture)];
    const int image = imageOf(source);
    if (image < 0) {
        model_.warnings.add(fmt::format("textures[{}]", use.texture), "no PNG or JPEG image, the texture is left out");
        return texture;
    }
    const int set = use.texcoord;
    if (set < 0 || set > 1 || mesh.texcoords[static_cast<std::size_t>(set)].empty()) {
        model_.warnings.add(field,
                            fmt::format("it asks for TEXCOORD_{}, which is missing from a "
                                        "mesh that uses it; left out there",
                                        set));
        return texture;
    }
    texture.texcoord = set;
    if (source.sampler >= 0)
        texture.sampler = model_.structure.samplers[static_cast<std::size_t>(source.sampler)];
    texture.uRow = use.uRow;
    texture.vRow = use.vRow;
    texture.image = imageSlot(image);
    return texture;
}

Material GltfMaterials::make(int index, const Mesh& mesh)
{
    if (index < 0)
        return {};
    const gltf::MaterialSource& source = model_.structure.materials[static_cast<std::size_t>(index)];
    const auto map = [&](const gltf::TextureUse& use, const char* name) {
        return texture(use, mesh, fmt::format("materials[{}].{}", index, name));
    };
    Material material = source.factors;
    if (!source.frame.empty()) {
        material.normalFrame = frameFromName(source.frame);
        if (!material.normalFrame)
            model_.warnings.add(
                fmt::format("materials[{}].extras.{}", index, gltf::kFrameExtra),
                fmt::format("expected the name of a frame, found '{}'; left out", oneLine(source.frame)));
    }
    material.baseColorMap = map(source.baseColor, "baseColorTexture");
    material.metallicRoughnessMap = map(source.metallicRoughness, "metallicRoughnessTexture");
    material.normalMap = map(source.normal, "normalTexture");
    material.occlusionMap = map(source.occlusion, "occlusionTexture");
    material.emissiveMap = map(source.emissive, "emissiveTexture");
    // Layers that are not there need no pictures.
    if (material.coat.strength > 0) {
        material.coat.map = map(source.coat, "clearcoatTexture");
        material.coat.roughnessMap = map(source.coatRoughness, "clearcoatRoughnessTexture");
        material.coat.normalMap = map(source.coatNormal, "clearcoatNormalTexture");
    }
    if (material.anisotropy.strength > 0)
        material.anisotropy.map = map(source.anisotropy, "anisotropyTexture");
    if (material.specular.strength > 0) {
        material.specular.map = map(source.specular, "specularTexture");
        material.specular.colorMap = map(source.specularColor, "specularColorTexture");
    }
    if (material.sheen.present()) {
        material.sheen.colorMap = map(source.sheenColor, "sheenColorTexture");
        material.sheen.roughnessMap = map(source.sheenRoughness, "sheenRoughnessTexture");
    }
    if (material.transmission.strength > 0)
        material.transmission.map = map(source.transmission, "transmissionTexture");
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
