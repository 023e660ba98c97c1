// References to accessors, buffer views and images, in the glTF core and in known extensions.
#include <algorithm>
#include <set>

#include "edit_state.hpp"

namespace cotan::gltf_edit {

namespace {

using Visit = std::function<void(Json&)>;

constexpr std::string_view kToAccessors[] = {"meshes/*/primitives/*/indices",
                                             "meshes/*/primitives/*/attributes/*",
                                             "meshes/*/primitives/*/targets/*/*",
                                             "skins/*/inverseBindMatrices",
                                             "animations/*/samplers/*/input",
                                             "animations/*/samplers/*/output",
                                             "nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/*"};
constexpr std::string_view kToViews[] = {"accessors/*/bufferView", "accessors/*/sparse/indices/bufferView",
                                         "accessors/*/sparse/values/bufferView", "images/*/bufferView",
                                         "meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView"};
constexpr std::string_view kToImages[] = {"textures/*/source", "textures/*/extensions/*/source"};

// Skips missing members and other values: animations and extensions are not checked when the file is read.
void visitPath(Json& value, std::string_view path, const Visit& visit)
{
    if (path.empty()) {
        if (value.is_number_unsigned())
            visit(value);
        return;
    }
    const std::string_view step = path.substr(0, path.find('/'));
    const std::string_view rest = path.substr(std::min(step.size() + 1, path.size()));
    if (step == "*") {
        if (value.is_structured())
            for (Json& item : value)
                visitPath(item, rest, visit);
    } else if (const auto found = value.find(step); found != value.end()) {
        visitPath(*found, rest, visit);
    }
}

// Extensions, by name or prefix, that are known to refer to accessors, views, buffers and images only from the paths
// above.
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

void collectExtensions(const Json& value, std::vector<std::string>& met, std::set<std::string>& known)
{
    if (const Json* const extensions = gltf::member(value, "extensions"); extensions && extensions->is_object())
        for (const auto& [name, content] : extensions->items())
            if (known.insert(name).second)
                met.push_back(name);
    for (const auto& [key, item] : value.items())
        if (item.is_structured() && (value.is_array() || key != "extras"))
            collectExtensions(item, met, known);
}

} // namespace

const Collection kAccessors{"accessors", kToAccessors}, kBufferViews{"bufferViews", kToViews},
    kImages{"images", kToImages};

void forEachReference(Json& root, const Collection& collection, const Visit& visit)
{
    for (const std::string_view path : collection.paths)
        visitPath(root, path, visit);
}

std::vector<bool> usedItems(const Json& root, const Collection& collection, std::string_view excluded)
{
    std::vector<bool> used(countOf(root, collection.name), false);
    const Visit mark = [&](const Json& index) {
        if (const auto i = index.get<std::size_t>(); i < used.size())
            used[i] = true;
    };
    for (const std::string_view path : collection.paths)
        if (path != excluded)
            visitPath(const_cast<Json&>(root), path, mark); // not modified
    return used;
}

std::vector<std::string> extensionsIn(const Json& object)
{
    std::vector<std::string> met;
    std::set<std::string> known;
    collectExtensions(object, met, known);
    return met;
}

std::vector<std::string> unknownExtensions(const Json& root)
{
    std::vector<std::string> names = extensionsIn(root);
    std::erase_if(names, [](const std::string& name) { return isKnown(name); });
    std::ranges::sort(names);
    return names;
}

void removeItems(Json& root, const Collection& collection, const std::vector<bool>& removed)
{
    std::vector<std::size_t> moved(removed.size());
    Json kept = Json::array();
    Json& items = root[collection.name];
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
        root.erase(collection.name);
    else
        items = std::move(kept);
}

} // namespace cotan::gltf_edit
