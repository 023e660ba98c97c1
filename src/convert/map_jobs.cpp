#include "cotan/convert/map_jobs.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "cotan/gltf/lookup.hpp"
#include "cotan/gltf/placed.hpp"
#include "cotan/image/file.hpp"

namespace cotan {

using Json = nlohmann::ordered_json;

namespace {

bool readElsewhere(const Json& root, std::size_t image)
{
    std::set<std::size_t> textures;
    for (std::size_t m = 0; m < countOf(root, "materials"); ++m)
        textures.merge(texturesBesideNormalMap(root["materials"][m]));
    return std::any_of(textures.begin(), textures.end(), [&](std::size_t t) {
        return t < countOf(root, "textures") && textureAt(root, int(t)).image == int(image);
    });
}

// Makes the image, which is a PNG now, a texture's own, and takes those that extensions name in its place.
void dropOtherForms(Json& root, std::size_t index, std::size_t image, std::vector<std::string>& notes)
{
    Json& texture = root["textures"][index];
    texture["source"] = image;
    if (!texture.contains("extensions") || !texture["extensions"].is_object())
        return;
    Json kept = Json::object();
    std::vector<std::string> dropped;
    for (const auto& [name, value] : texture["extensions"].items())
        if (!value.is_object() || !value.contains("source")) {
            kept[name] = value;
        } else {
            dropped.push_back(name);
            if (value["source"] != image)
                notes.push_back(fmt::format("textures[{}]: {} taken out, its image is not converted", index, name));
        }
    if (kept.empty())
        texture.erase("extensions");
    else
        texture["extensions"] = std::move(kept);
    for (const std::string& name : dropped)
        if (std::ranges::none_of(root["textures"], [&](const Json& t) { return gltf::extension(t, name); }))
            takeOffExtension(root, name);
}

// One primitive with one of its materials, added to the job of that material's normal map.
// document: with the material in the primitive's place, for its uv.
Status addUse(const GltfDocument& document, std::size_t m, std::size_t p, std::size_t material, bool foreign,
              const std::vector<glm::dmat3>& placed, std::map<std::size_t, MapJob>& jobs,
              std::vector<std::string>& notes)
{
    const Json& root = document.root;
    const gltf::TextureUse map = normalMapOf(root, material);
    if (map.texture < 0)
        return Done{};
    if (foreign) {
        notes.push_back(primitiveField(m, p) + ": its normal map is in a format that is not read here; left as it is");
        return Done{};
    }
    auto geometry = gltfGeometry(document, m, p);
    if (!geometry)
        return geometry.error();
    if (geometry->texcoords.empty() || geometry->indices.empty()) {
        notes.push_back(primitiveField(m, p)
                        + (geometry->indices.empty() ? ": no triangles" : ": no uv for its normal map")
                        + "; its normal map is not converted for it");
        return Done{};
    }
    const gltf::Texture texture = textureAt(root, map.texture);
    const Sampler sampler = samplerOf(root, texture);
    const auto image = std::size_t(texture.image);
    MapJob& job = jobs[image];
    job.image = image;
    job.name = root["images"][image].value("name", root["images"][image].value("uri", std::string()));
    if (job.name.empty() || job.name.starts_with("data:"))
        job.name = fmt::format("image {}", image);
    if (std::find(job.materials.begin(), job.materials.end(), material) == job.materials.end())
        job.materials.push_back(material);
    const Mesh mesh = gltfMesh(std::move(*geometry));
    for (const glm::dmat3& linear : placed) {
        MapUse use;
        use.surface = makeSurface(mesh, Texture{}, linear);
        use.strength = map.scale;
        use.wrapU = sampler.wrapU;
        use.wrapV = sampler.wrapV;
        job.uses.push_back(std::move(use));
    }
    return Done{};
}

} // namespace

std::vector<bool> foreignNormalMaps(const GltfDocument& document)
{
    const Json& root = document.root;
    std::map<std::size_t, bool> images;
    std::vector<bool> foreign(countOf(root, "materials"), false);
    for (std::size_t m = 0; m < foreign.size(); ++m) {
        const gltf::TextureUse map = normalMapOf(root, m);
        if (map.texture < 0)
            continue;
        const int source = textureAt(root, map.texture).image;
        foreign[m] = source < 0;
        if (foreign[m])
            continue;
        const auto image = std::size_t(source);
        if (!images.contains(image)) {
            const auto bytes = gltfImageBytes(document, image);
            images[image] = bytes && !foreignFormat(*bytes).empty();
        }
        foreign[m] = images[image];
    }
    return foreign;
}

Result<std::vector<MapJob>> mapJobs(const GltfDocument& document, std::vector<std::string>& notes)
{
    const Json& root = document.root;
    const auto placed = gltfPlacings(root);
    const std::vector<bool> foreign = foreignNormalMaps(document);
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
            if (textureAt(document.root, int(t)).image == int(job.image))
                dropOtherForms(document.root, t, job.image, notes);
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

} // namespace cotan
