#include "gltf/json/lookup.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "gltf_model.hpp"
#include "scene/geometry.hpp"

namespace cotan {

using gltf::Json;

GltfRoot::GltfRoot() : json(std::make_unique<GltfJson>()) {}
GltfRoot::GltfRoot(const GltfRoot& other) : json(other.json ? std::make_unique<GltfJson>(*other.json) : nullptr) {}
GltfRoot::GltfRoot(GltfRoot&& other) noexcept = default;
GltfRoot& GltfRoot::operator=(const GltfRoot& other) { return *this = GltfRoot(other); }
GltfRoot& GltfRoot::operator=(GltfRoot&& other) noexcept = default;
GltfRoot::~GltfRoot() = default;

namespace {

// excluded: slots that are skipped.
void collectTextures(const Json& object, const std::vector<const Json*>& excluded, std::set<std::size_t>& textures)
{
    if (object.is_array())
        for (const Json& item : object)
            collectTextures(item, excluded, textures);
    if (!object.is_object())
        return;
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(excluded, &value) != excluded.end())
            continue;
        const Json* const index = key.size() >= 7 && key.ends_with("exture") ? gltf::member(value, "index") : nullptr;
        if (index && index->is_number_unsigned())
            textures.insert(index->get<std::size_t>());
        collectTextures(value, excluded, textures);
    }
}

// The texture info of a material's normal map; null if it has none.
const Json* slotOf(const Json& material, NormalSlot slot)
{
    return slot == NormalSlot::surface
        ? gltf::member(material, "normalTexture")
        : gltf::member(gltf::extension(material, "KHR_materials_clearcoat"), "clearcoatNormalTexture");
}

} // namespace

std::string primitiveField(std::size_t mesh, std::size_t primitive)
{
    return fmt::format("meshes[{}].primitives[{}]", mesh, primitive);
}

std::vector<std::size_t> materialsOf(const Json& root, const Json& primitive)
{
    std::vector<std::size_t> materials;
    const auto add = [&](const Json& object) {
        const Json* const material = gltf::member(object, "material");
        if (!material || !material->is_number_unsigned())
            return;
        const std::size_t m = material->get<std::size_t>();
        if (m < countOf(root, "materials") && std::ranges::find(materials, m) == materials.end())
            materials.push_back(m);
    };
    add(primitive);
    const Json* const mappings = gltf::member(gltf::extension(primitive, "KHR_materials_variants"), "mappings");
    if (mappings && mappings->is_structured()) // extensions have not been checked
        for (const Json& mapping : *mappings)
            add(mapping);
    return materials;
}

gltf::TextureUse normalMapOf(const Json& root, std::size_t material, NormalSlot slot)
{
    return gltf::readTextureUse(slotOf(root["materials"][material], slot));
}

Json& normalSlotOf(Json& root, std::size_t material, NormalSlot slot)
{
    return const_cast<Json&>(*slotOf(root["materials"][material], slot));
}

std::size_t addItem(GltfDocument& document, const char* collection, Json item)
{
    Json& items = rootOf(document)[collection];
    items.push_back(std::move(item));
    return items.size() - 1;
}

void setExtra(Json& material, const char* key, std::string_view text)
{
    if (text.empty())
        return takeOut(material, "extras", key);
    if (!material.contains("extras") || !material["extras"].is_object())
        material["extras"] = Json::object();
    material["extras"][key] = text;
}

void setExpansion(Json& material, Expansion expansion)
{
    setExtra(material, gltf::kUnsignedKey, expansion == Expansion::biased ? "biased" : "");
}

gltf::Texture textureAt(const Json& root, int texture)
{
    return gltf::readTexture(root["textures"][std::size_t(texture)], countOf(root, "images"));
}

Sampler samplerOf(const Json& root, const gltf::Texture& texture)
{
    return texture.sampler < 0 ? Sampler{} : gltf::readSampler(root["samplers"][std::size_t(texture.sampler)]);
}

std::set<std::size_t> texturesReadBy(const Json& object)
{
    std::set<std::size_t> textures;
    collectTextures(object, {}, textures);
    return textures;
}

std::set<std::size_t> texturesBesideNormalMaps(const Json& material)
{
    std::set<std::size_t> textures;
    collectTextures(material, {slotOf(material, NormalSlot::surface), slotOf(material, NormalSlot::coat)}, textures);
    return textures;
}

void takeOut(Json& owner, const char* object, const std::string& name)
{
    const auto found = owner.find(object);
    if (found == owner.end() || !found->is_object())
        return;
    found->erase(name);
    if (found->empty())
        owner.erase(object);
}

void takeOffExtension(Json& root, const std::string& name)
{
    for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
        const auto names = root.find(list);
        if (names == root.end())
            continue;
        auto& items = names->get_ref<Json::array_t&>();
        std::erase(items, name);
        if (items.empty())
            root.erase(list);
    }
}

// ---- the geometry in world space ------------------------------------------------------------

std::vector<std::vector<glm::dmat3>> gltfMeshTransforms(const Json& root)
{
    std::vector<std::vector<glm::dmat3>> result(countOf(root, "meshes"));
    const std::vector<gltf::Node> nodes = gltf::readAll(&root, "nodes", gltf::readNode);
    std::vector<bool> child(nodes.size(), false);
    for (const gltf::Node& node : nodes)
        for (const int c : node.children)
            child[std::size_t(c)] = true;
    std::vector<std::pair<std::size_t, glm::dmat3>> open;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (!child[n])
            open.emplace_back(n, glm::dmat3(1));
    while (!open.empty()) { // a forest, as openGltfDocument has checked
        const auto [n, above] = open.back();
        open.pop_back();
        const gltf::Node& node = nodes[n];
        const glm::dmat3 here = above * glm::dmat3(gltf::localMatrix(node));
        for (const int c : node.children)
            open.emplace_back(std::size_t(c), here);
        if (node.mesh >= 0) // a skin replaces the node's transform
            addDistinctLinearMap(result[std::size_t(node.mesh)], node.skin >= 0 ? glm::dmat3(1) : here);
    }
    addIdentityWhereEmpty(result);
    return result;
}

void makeUnit(std::vector<glm::vec3>& normals)
{
    for (glm::vec3& n : normals)
        n = unitNormal(n);
}

Mesh gltfMesh(GltfGeometry geometry)
{
    Mesh mesh;
    mesh.positions = std::move(geometry.positions);
    mesh.normals = std::move(geometry.normals);
    mesh.texcoords[0] = std::move(geometry.texcoords);
    mesh.indices = std::move(geometry.indices);
    makeUnit(mesh.normals);
    if (mesh.normals.empty())
        makeFlat(mesh);
    else
        mesh.tangents = std::move(geometry.tangents);
    return mesh;
}

} // namespace cotan
