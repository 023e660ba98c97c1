#include "cotan/gltf/lookup.hpp"

#include <algorithm>

namespace cotan {

using Json = nlohmann::ordered_json;

namespace {

// top: object is a material, whose normalTexture is left out.
void collectTextures(const Json& object, bool top, std::set<std::size_t>& textures)
{
    if (object.is_array())
        for (const Json& item : object)
            collectTextures(item, false, textures);
    if (!object.is_object())
        return;
    for (const auto& [key, value] : object.items()) {
        if (top && key == "normalTexture")
            continue;
        const bool slot = key.size() >= 7 && key.ends_with("exture") && value.is_object() && value.contains("index");
        if (slot && value["index"].is_number_unsigned())
            textures.insert(value["index"].get<std::size_t>());
        collectTextures(value, false, textures);
    }
}

} // namespace

std::vector<std::size_t> materialsOf(const Json& root, const Json& primitive)
{
    std::vector<std::size_t> materials;
    const auto add = [&](const Json& object) {
        if (!object.is_object() || !object.contains("material") || !object["material"].is_number_unsigned())
            return;
        const std::size_t m = object["material"].get<std::size_t>();
        if (m < countOf(root, "materials") && std::find(materials.begin(), materials.end(), m) == materials.end())
            materials.push_back(m);
    };
    add(primitive);
    const Json* at = &primitive; // of an extension nothing has been checked
    for (const char* member : {"extensions", "KHR_materials_variants", "mappings"}) {
        if (!at->is_object() || !at->contains(member))
            return materials;
        at = &(*at)[member];
    }
    for (const Json& mapping : *at)
        add(mapping);
    return materials;
}

const Json* normalTextureOf(const Json& root, std::size_t material)
{
    const Json& m = root["materials"][material];
    return m.contains("normalTexture") ? &m["normalTexture"] : nullptr;
}

std::set<std::size_t> texturesReadBy(const Json& object)
{
    std::set<std::size_t> textures;
    collectTextures(object, /*top*/ false, textures);
    return textures;
}

std::set<std::size_t> texturesBesideNormalMap(const Json& material)
{
    std::set<std::size_t> textures;
    collectTextures(material, /*top*/ true, textures);
    return textures;
}

} // namespace cotan
