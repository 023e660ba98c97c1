#include "convert_gltf.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/tangents.hpp"
#include "gltf_placed.hpp"

namespace cotan::app {

namespace {

using Json = nlohmann::ordered_json;

std::string fieldOf(std::size_t mesh, std::size_t primitive)
{
    return fmt::format("meshes[{}].primitives[{}]", mesh, primitive);
}

// The materials that a primitive is seen with: its own, then those of KHR_materials_variants.
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

// The texture that a material reads as normal map; null if none.
const Json* normalTextureOf(const Json& root, std::size_t material)
{
    const Json& m = root["materials"][material];
    return m.contains("normalTexture") ? &m["normalTexture"] : nullptr;
}

// By material: whether its normal map is in a format that is not read here, named by an extension or, against the
// specification, by the texture itself.
std::vector<bool> foreignMaps(const GltfDocument& document)
{
    const Json& root = document.root;
    std::map<std::size_t, bool> images;
    std::vector<bool> foreign(countOf(root, "materials"), false);
    for (std::size_t m = 0; m < foreign.size(); ++m) {
        const Json* info = normalTextureOf(root, m);
        if (!info)
            continue;
        const Json& texture = root["textures"][(*info)["index"].get<std::size_t>()];
        foreign[m] = !texture.contains("source");
        if (foreign[m])
            continue;
        const std::size_t image = texture["source"].get<std::size_t>();
        if (!images.contains(image)) {
            const auto bytes = gltfImageBytes(document, image);
            images[image] = bytes && !foreignFormat(*bytes).empty();
        }
        foreign[m] = images[image];
    }
    return foreign;
}

Wrap wrapOf(const Json& root, const Json& texture, const char* axis)
{
    if (!texture.contains("sampler"))
        return Wrap::repeat;
    const int mode = root["samplers"][texture["sampler"].get<std::size_t>()].value(axis, 10497);
    return mode == 33071 ? Wrap::clamp : mode == 33648 ? Wrap::mirror : Wrap::repeat;
}

// Indices of textures that slots other than normalTexture read.
void collectOther(const Json& object, bool top, std::set<std::size_t>& textures)
{
    if (object.is_array())
        for (const Json& item : object)
            collectOther(item, false, textures);
    if (!object.is_object())
        return;
    for (const auto& [key, value] : object.items()) {
        if (top && key == "normalTexture")
            continue;
        const bool slot = key.size() >= 7 && key.ends_with("exture") && value.is_object() && value.contains("index");
        if (slot && value["index"].is_number_unsigned())
            textures.insert(value["index"].get<std::size_t>());
        collectOther(value, false, textures);
    }
}

bool readElsewhere(const Json& root, std::size_t image)
{
    std::set<std::size_t> textures;
    for (std::size_t m = 0; m < countOf(root, "materials"); ++m)
        collectOther(root["materials"][m], true, textures);
    return std::any_of(textures.begin(), textures.end(), [&](std::size_t t) {
        return t < countOf(root, "textures") && root["textures"][t].contains("source")
            && root["textures"][t]["source"].get<std::size_t>() == image;
    });
}

// Takes the images that extensions name in place of a texture's source.
void dropOtherForms(Json& texture, std::size_t index, std::vector<std::string>& notes)
{
    if (!texture.contains("extensions") || !texture["extensions"].is_object())
        return;
    Json kept = Json::object();
    for (const auto& [name, value] : texture["extensions"].items())
        if (value.is_object() && value.contains("source"))
            notes.push_back(fmt::format("textures[{}]: {} taken out, its image is not converted", index, name));
        else
            kept[name] = value;
    if (kept.empty())
        texture.erase("extensions");
    else
        texture["extensions"] = std::move(kept);
}

template<class Visit> Status forEachPrimitive(const Json& root, const Visit& visit)
{
    for (std::size_t m = 0; m < countOf(root, "meshes"); ++m)
        for (std::size_t p = 0; p < root["meshes"][m]["primitives"].size(); ++p)
            if (Status status = visit(m, p); !status)
                return status;
    return Done{};
}

} // namespace

namespace {

// One primitive with one of its materials, added to the job of that material's normal map.
// document: with the material in the primitive's place, for its uv.
Status addUse(const GltfDocument& document, std::size_t m, std::size_t p, std::size_t material,
              bool foreign, const std::vector<glm::dmat3>& placed, std::map<std::size_t, MapJob>& jobs,
              std::vector<std::string>& notes)
{
    const Json& root = document.root;
    const Json* info = normalTextureOf(root, material);
    if (!info)
        return Done{};
    if (foreign) {
        notes.push_back(fieldOf(m, p) + ": its normal map is neither PNG nor JPEG; left as it is");
        return Done{};
    }
    auto geometry = gltfGeometry(document, m, p);
    if (!geometry)
        return geometry.error();
    if (geometry->texcoords.empty() || geometry->indices.empty()) {
        notes.push_back(fieldOf(m, p) + (geometry->indices.empty() ? ": no triangles" : ": no uv for its normal map")
                        + "; its normal map is not converted for it");
        return Done{};
    }
    const Json& texture = root["textures"][(*info)["index"].get<std::size_t>()];
    const std::size_t image = texture["source"].get<std::size_t>();
    MapJob& job = jobs[image];
    job.image = image;
    job.name = root["images"][image].value("name", root["images"][image].value("uri", std::string()));
    if (job.name.empty() || job.name.starts_with("data:"))
        job.name = fmt::format("image {}", image);
    if (std::find(job.materials.begin(), job.materials.end(), material) == job.materials.end())
        job.materials.push_back(material);
    const Mesh mesh = meshOf(std::move(*geometry));
    for (const glm::dmat3& linear : placed) {
        MapUse use;
        use.surface = makeSurface(mesh, Texture{}, linear);
        use.format = {0, 0, -1.0, info->value("scale", 1.0)}; // glTF: exact, xyz, green against +v
        use.wrapU = wrapOf(root, texture, "wrapS");
        use.wrapV = wrapOf(root, texture, "wrapT");
        job.uses.push_back(std::move(use));
    }
    return Done{};
}

} // namespace

std::set<std::size_t> texturesReadBy(const Json& object)
{
    std::set<std::size_t> textures;
    collectOther(object, /*top*/ false, textures);
    return textures;
}

Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes)
{
    const Json& root = document.root;
    const auto placed = placings(root);
    const std::vector<bool> foreign = foreignMaps(document);
    std::map<std::size_t, MapJob> jobs;
    GltfDocument seen = document; // each primitive with the material it is seen with
    const Status status = forEachPrimitive(root, [&](std::size_t m, std::size_t p) -> Status {
        for (const std::size_t material : materialsOf(root, root["meshes"][m]["primitives"][p])) {
            seen.root["meshes"][m]["primitives"][p]["material"] = material;
            if (Status added = addUse(seen, m, p, material, foreign[material], placed[m], jobs, notes); !added)
                return added;
        }
        return Done{};
    });
    if (!status)
        return status.error();
    std::vector<MapJob> result;
    for (auto& [image, job] : jobs) {
        job.alsoElsewhere = readElsewhere(root, image);
        result.push_back(std::move(job));
    }
    return result;
}

void replaceMap(GltfDocument& document, const MapJob& job, std::vector<std::byte> png, std::vector<std::string>& notes)
{
    if (!job.alsoElsewhere) {
        replaceGltfImage(document, job.image, std::move(png), "image/png");
        for (std::size_t t = 0; t < countOf(document.root, "textures"); ++t) {
            Json& texture = document.root["textures"][t];
            if (texture.contains("source") && texture["source"].get<std::size_t>() == job.image)
                dropOtherForms(texture, t, notes);
        }
        return;
    }
    const std::size_t image = addGltfImage(document, std::move(png), "image/png", job.name);
    std::map<std::size_t, std::size_t> copies;
    for (std::size_t m : job.materials) {
        const std::size_t texture = document.root["materials"][m]["normalTexture"]["index"].get<std::size_t>();
        if (!copies.contains(texture))
            copies[texture] = copyGltfTexture(document, texture, image);
        document.root["materials"][m]["normalTexture"]["index"] = copies[texture];
    }
}

namespace {

// What of a material reads tangents and is not converted; empty if nothing.
std::string whyTangentsStay(const Json& root, std::size_t material, bool foreign)
{
    if (foreign)
        return "its normal map, neither PNG nor JPEG,";
    const Json& extensions = root["materials"][material].value("extensions", Json::object());
    if (extensions.contains("KHR_materials_anisotropy"))
        return "KHR_materials_anisotropy reads tangents and";
    if (extensions.contains("KHR_materials_clearcoat") && extensions["KHR_materials_clearcoat"].contains("clearcoatNormalTexture"))
        return "KHR_materials_clearcoat reads tangents and";
    return {};
}

} // namespace

Result<TangentBytes> dropTangents(GltfDocument& document, std::vector<std::string>& notes)
{
    TangentBytes dropped;
    std::set<std::size_t> seen, told;
    const std::vector<bool> foreign = foreignMaps(document);
    const Status status = forEachPrimitive(document.root, [&](std::size_t m, std::size_t p) -> Status {
        const Json& root = document.root;
        const Json& primitive = root["meshes"][m]["primitives"][p];
        if (!primitive["attributes"].contains("TANGENT"))
            return Done{};
        for (const std::size_t material : materialsOf(root, primitive)) {
            const std::string reason = whyTangentsStay(root, material, foreign[material]);
            if (reason.empty())
                continue;
            if (told.insert(material).second)
                notes.push_back(fmt::format("materials[{}]: {} is not converted; TANGENT stays", material, reason));
            return Done{};
        }
        auto count = [&](const Json& attributes, bool base) {
            if (!attributes.contains("TANGENT"))
                return;
            const std::size_t index = attributes["TANGENT"].get<std::size_t>();
            if (!seen.insert(index).second)
                return;
            const Json& accessor = root["accessors"][index];
            const int type = accessor["componentType"].get<int>();
            const std::size_t component = type == 5126 ? 4 : type == 5122 || type == 5123 ? 2 : 1;
            const std::size_t vertices = accessor["count"].get<std::size_t>();
            dropped.vertices += base ? vertices : 0;
            dropped.bytes += vertices * component * (base ? 4 : 3);
        };
        count(primitive["attributes"], true);
        for (const Json& target : primitive.value("targets", Json::array()))
            count(target, false);
        const auto done = dropGltfTangents(document, m, p);
        if (!done)
            return done.error();
        dropped.primitives += *done;
        return Done{};
    });
    if (!status)
        return status.error();
    return dropped;
}

Result<std::size_t> giveTangents(GltfDocument& document, Frame frame)
{
    std::vector<GltfCornerTangents> all;
    const Status status = forEachPrimitive(document.root, [&](std::size_t m, std::size_t p) -> Status {
        const Json& root = document.root;
        const auto materials = materialsOf(root, root["meshes"][m]["primitives"][p]);
        if (std::none_of(materials.begin(), materials.end(), [&](std::size_t k) { return normalTextureOf(root, k); }))
            return Done{};
        auto geometry = gltfGeometry(document, m, p);
        if (!geometry)
            return geometry.error();
        if (geometry->normals.empty() || geometry->texcoords.empty() || geometry->indices.empty())
            return Done{};
        makeUnit(geometry->normals);
        const MeshView view{geometry->positions, geometry->normals, geometry->texcoords, geometry->indices};
        all.push_back({m, p, frame == Frame::vertex ? vertexTangents(view) : mikktspaceTangents(view)});
        return Done{};
    });
    if (!status)
        return status.error();
    if (const auto added = setGltfTangents(document, all); !added)
        return added.error();
    return all.size();
}

} // namespace cotan::app
