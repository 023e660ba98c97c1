// Who refers to accessors, buffer views and images, in the core of glTF and in known extensions.
#include <algorithm>
#include <array>
#include <set>

#include "edit_state.hpp"

namespace cotan::gltf_edit {

namespace {

using Visit = std::function<void(Json&)>;

// A member that is an object or array; nothing where it is missing or something else: animations
// and extensions are not checked when the file is read.
Json* inside(Json& object, const char* member)
{
    if (!object.is_object())
        return nullptr;
    const auto found = object.find(member);
    return found != object.end() && found->is_structured() ? &*found : nullptr;
}

template<class Each> void forItems(Json& object, const char* list, const Each& each)
{
    if (Json* const items = inside(object, list))
        for (Json& item : *items)
            if (item.is_structured())
                each(item);
}

void visitMember(Json& object, const char* member, const Visit& visit)
{
    const auto found = object.find(member);
    if (found != object.end() && found->is_number_unsigned())
        visit(*found);
}

void visitValues(Json& object, const Visit& visit)
{
    for (Json& value : object)
        if (value.is_number_unsigned())
            visit(value);
}

Json* extension(Json& object, const char* name)
{
    Json* const extensions = inside(object, "extensions");
    return extensions ? inside(*extensions, name) : nullptr;
}

void visitPrimitive(Json& primitive, const Visit& visit)
{
    visitMember(primitive, "indices", visit);
    if (Json* const attributes = inside(primitive, "attributes"))
        visitValues(*attributes, visit);
    forItems(primitive, "targets", [&](Json& target) { visitValues(target, visit); });
}

void visitAccessors(Json& root, const Visit& visit)
{
    forItems(root, "meshes",
             [&](Json& mesh) { forItems(mesh, "primitives", [&](Json& p) { visitPrimitive(p, visit); }); });
    forItems(root, "skins", [&](Json& skin) { visitMember(skin, "inverseBindMatrices", visit); });
    forItems(root, "animations", [&](Json& animation) {
        forItems(animation, "samplers", [&](Json& sampler) {
            visitMember(sampler, "input", visit);
            visitMember(sampler, "output", visit);
        });
    });
    forItems(root, "nodes", [&](Json& node) {
        if (Json* const instancing = extension(node, "EXT_mesh_gpu_instancing"))
            if (Json* const attributes = inside(*instancing, "attributes"))
                visitValues(*attributes, visit);
    });
}

void visitViews(Json& root, const Visit& visit)
{
    forItems(root, "accessors", [&](Json& accessor) {
        visitMember(accessor, "bufferView", visit);
        if (Json* const sparse = inside(accessor, "sparse"))
            for (const char* const part : {"indices", "values"})
                if (Json* const p = inside(*sparse, part))
                    visitMember(*p, "bufferView", visit);
    });
    forItems(root, "images", [&](Json& image) { visitMember(image, "bufferView", visit); });
    forItems(root, "meshes", [&](Json& mesh) {
        forItems(mesh, "primitives", [&](Json& primitive) {
            if (Json* const draco = extension(primitive, "KHR_draco_mesh_compression"))
                visitMember(*draco, "bufferView", visit);
        });
    });
}

void visitImages(Json& root, const Visit& visit)
{
    forItems(root, "textures", [&](Json& texture) {
        visitMember(texture, "source", visit);
        if (Json* const extensions = inside(texture, "extensions"))
            for (Json& e : *extensions)
                if (e.is_object())
                    visitMember(e, "source", visit);
    });
}

// Extensions, by their names or what those begin with, that are known to refer to no accessor, view, buffer or image
// but in the places that are visited above.
constexpr std::string_view kKnown[] = {"KHR_lights_punctual",
                                       "KHR_mesh_quantization",
                                       "KHR_draco_mesh_compression",
                                       "KHR_animation_pointer",
                                       "EXT_mesh_gpu_instancing",
                                       "MSFT_texture_dds",
                                       "MSFT_lod",
                                       "FB_ngon_encoding"};
constexpr std::string_view kKnownFamilies[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                               "KHR_xmp",        "KHR_node_",    "EXT_materials_"};

bool isKnown(std::string_view name)
{
    return std::ranges::find(kKnown, name) != std::end(kKnown)
        || std::ranges::any_of(kKnownFamilies, [&](std::string_view family) { return name.starts_with(family); });
}

struct ExtensionNames {
    std::vector<std::string> met;
    std::set<std::string> known;
};

void collectExtensions(const Json& value, ExtensionNames& names)
{
    if (const Json* const extensions = gltf::member(value, "extensions"); extensions && extensions->is_object())
        for (const auto& [name, content] : extensions->items())
            if (names.known.insert(name).second)
                names.met.push_back(name);
    for (const auto& [key, item] : value.items())
        if (item.is_structured() && (value.is_array() || key != "extras"))
            collectExtensions(item, names);
}

} // namespace

const char* nameOf(Collection collection)
{
    constexpr std::array names{"accessors", "bufferViews", "images"};
    return names[std::size_t(collection)];
}

void forEachReference(Json& root, Collection collection, const Visit& visit)
{
    switch (collection) {
    case Collection::accessors: return visitAccessors(root, visit);
    case Collection::bufferViews: return visitViews(root, visit);
    case Collection::images: return visitImages(root, visit);
    }
}

std::vector<bool> usedItems(const Json& root, Collection collection)
{
    std::vector<bool> used(countOf(root, nameOf(collection)), false);
    // Only read through: the visitors serve changing and looking alike.
    forEachReference(const_cast<Json&>(root), collection, [&](Json& index) {
        if (const auto i = index.get<std::size_t>(); i < used.size())
            used[i] = true;
    });
    return used;
}

std::vector<std::string> extensionsIn(const Json& object)
{
    ExtensionNames names;
    collectExtensions(object, names);
    return std::move(names.met);
}

std::vector<std::string> unknownExtensions(const Json& root)
{
    std::vector<std::string> names = extensionsIn(root);
    std::erase_if(names, [](const std::string& name) { return isKnown(name); });
    std::ranges::sort(names);
    return names;
}

void removeItems(Json& root, Collection collection, const std::vector<bool>& removed)
{
    std::vector<std::size_t> moved(removed.size());
    Json kept = Json::array();
    Json& items = root[nameOf(collection)];
    for (std::size_t i = 0; i < removed.size(); ++i) {
        moved[i] = kept.size();
        if (!removed[i])
            kept.push_back(std::move(items[i]));
    }
    forEachReference(root, collection, [&](Json& index) {
        if (const auto i = index.get<std::size_t>(); i < moved.size())
            index = moved[i];
    });
    if (kept.empty())
        root.erase(nameOf(collection));
    else
        items = std::move(kept);
}

} // namespace cotan::gltf_edit
