// Compressed geometry that nobody changed, written as it came: KHR_draco_mesh_compression, EXT_ and
// KHR_meshopt_compression.
#include <algorithm>

#include "edit_state.hpp"
#include "gltf/json/views.hpp"

namespace cotan::gltf_edit {

namespace {

bool isAsRead(const GltfDocument& document, const char* collection, std::size_t index)
{
    const Json& now = rootOf(document)[collection];
    return index < now.size() && now[index] == document.source->root[collection][index];
}

// What of a stream the primitive still has, as the extension names it: ids by attribute. Empty where the positions or
// the triangles are others than in the file.
Json attributesLeft(const GltfDocument& document, const Json& primitive, const GltfPacked::Primitive& packed)
{
    const auto isSame = [&](int accessor) { return isAsRead(document, "accessors", std::size_t(accessor)); };
    if (gltf::valueOr(primitive, "indices", -1) != packed.indices || !isSame(packed.indices)
        || gltf::valueOr(primitive, "mode", gltf::kTriangles) != gltf::kTriangles)
        return Json::object();
    Json left = Json::object();
    for (const auto& [name, id] : packed.draco["attributes"].items()) {
        const int accessor = packed.attributes[name].get<int>();
        if (gltf::valueOr(primitive["attributes"], name, -1) == accessor && isSame(accessor))
            left[name] = id;
    }
    return left.contains("POSITION") ? left : Json::object();
}

void addName(Json& root, const char* list, const std::string& name)
{
    Json& names = root[list];
    if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
}

// How often each accessor is referred to, and how often by primitives that have their stream back.
struct Uses {
    std::vector<std::size_t> all, packed;
};

// Accessors that only streams fill need no bytes of their own.
void restoreAccessors(GltfDocument& document, const Uses& uses)
{
    for (const auto& [index, json] : document.source->file.packed.accessors)
        if (const auto i = std::size_t(index); uses.packed[i] > 0 && uses.all[i] == uses.packed[i])
            rootOf(document)["accessors"][i] = json;
}

} // namespace

void addExtension(Json& root, const GltfPacked& packed, const std::string& name)
{
    addName(root, "extensionsUsed", name);
    if (std::find(packed.required.begin(), packed.required.end(), name) != packed.required.end())
        addName(root, "extensionsRequired", name);
}

std::string meshoptName(const Json& view)
{
    return view["extensions"].contains("EXT_meshopt_compression") ? "EXT_meshopt_compression"
                                                                  : "KHR_meshopt_compression";
}

void restoreDraco(GltfDocument& document)
{
    const GltfPacked& packed = document.source->file.packed;
    if (packed.primitives.empty())
        return;
    Json& root = rootOf(document);
    Uses uses;
    uses.all.resize(countOf(root, "accessors"));
    uses.packed.resize(uses.all.size());
    forEachReference(root, Collection::accessors, [&](Json& index) {
        if (const auto i = index.get<std::size_t>(); i < uses.all.size()) // extensions may say anything
            ++uses.all[i];
    });
    std::size_t restored = 0, withMore = 0;
    for (const GltfPacked::Primitive& p : packed.primitives) {
        Json& primitive = root["meshes"][p.mesh]["primitives"][p.primitive];
        Json left = attributesLeft(document, primitive, p);
        if (left.empty())
            continue;
        for (const auto& [name, id] : left.items())
            ++uses.packed[primitive["attributes"][name].get<std::size_t>()];
        ++uses.packed[std::size_t(p.indices)];
        ++restored;
        withMore += left.size() < p.draco["attributes"].size();
        Json& extension = primitive["extensions"][kDracoExtension] = p.draco;
        extension["attributes"] = std::move(left);
    }
    if (restored > 0) {
        restoreAccessors(document, uses);
        addExtension(root, packed, kDracoExtension);
    }
    if (withMore > 0)
        document.notes.push_back(
            fmt::format("{}: {} of {} streams are kept as they are, with the tangents inside, which "
                        "nothing reads now; \"gltf-transform draco\" packs them without",
                        kDracoExtension, withMore, packed.primitives.size()));
    if (restored < packed.primitives.size())
        document.notes.push_back(fmt::format("{}: {} of {} primitives have other vertices now and are written plain; "
                                             "\"gltf-transform draco\" packs them again",
                                             kDracoExtension, packed.primitives.size() - restored,
                                             packed.primitives.size()));
}

const Json* packedView(const GltfDocument& document, std::size_t view)
{
    const auto found = document.source->file.packed.views.find(view);
    if (found == document.source->file.packed.views.end() || !isAsRead(document, "bufferViews", view))
        return nullptr;
    return &found->second;
}

void notePlainViews(GltfDocument& document)
{
    const std::map<std::size_t, Json>& views = document.source->file.packed.views;
    const std::vector<bool> used = usedItems(rootOf(document), Collection::bufferViews);
    const auto gone = std::ranges::count_if(views, [&](const auto& view) { return !used[view.first]; });
    const Json* const accessors = gltf::member(rootOf(document), "accessors");
    const bool replaced =
        accessors && std::ranges::any_of(*accessors, [&](const Json& accessor) {
            return gltf::valueOr(accessor, "bufferView", std::size_t(0)) >= document.source->views.size();
        });
    if (gone > 0 && replaced)
        document.notes.push_back(fmt::format("{} of {} compressed buffer views are replaced by plain ones; "
                                             "\"gltf-transform meshopt\" packs them again",
                                             gone, views.size()));
}

} // namespace cotan::gltf_edit
