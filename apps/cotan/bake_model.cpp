// `cotan bake -o OUT.glb`: the low model with the map in it.
#include "bake_options.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "cotan/convert/convert_model.hpp"
#include "cotan/gltf/lookup.hpp"
#include "cotan/gltf/tangents.hpp"
#include "cotan/image/file.hpp"
#include "gltf_open.hpp"

namespace cotan::app {

namespace {

using Json = nlohmann::ordered_json;

std::size_t appendTo(Json& root, const char* collection, Json item)
{
    root[collection].push_back(std::move(item));
    return root[collection].size() - 1;
}

// The number in the file of the material that was baked; nothing where all were. A scene numbers its materials as
// meshes use them, so it is found by its name.
Result<std::optional<std::size_t>> chosenMaterial(const BakeCommandOptions& o, const Scene& scene, const Json& root)
{
    if (o.material < 0)
        return std::optional<std::size_t>();
    const std::string& name = scene.materials[std::size_t(o.material)].name;
    std::vector<std::size_t> found;
    for (std::size_t m = 0; root.contains("materials") && m < root["materials"].size(); ++m)
        if (root["materials"][m].value("name", "") == name)
            found.push_back(m);
    if (found.size() != 1)
        return inputError(fmt::format("{}: expected one material of the name '{}' to put the map in; found {}", o.low, name, found.size()));
    return std::optional(found.front());
}

// The materials of the baked primitives; those that had none get one.
std::set<std::size_t> bakedMaterials(Json& root, std::optional<std::size_t> chosen)
{
    if (chosen)
        return {*chosen};
    std::set<std::size_t> materials;
    std::optional<std::size_t> unnamed;
    for (Json& mesh : root["meshes"])
        for (Json& primitive : mesh["primitives"]) {
            if (!primitive.contains("material")) {
                if (!unnamed)
                    unnamed = appendTo(root, "materials", Json{{"name", "baked"}});
                primitive["material"] = *unnamed;
            }
            materials.insert(primitive["material"].get<std::size_t>());
        }
    return materials;
}

// Whether what was baked had TANGENT everywhere and the bake used it.
bool usedStoredTangents(const BakeCommandOptions& o, const Scene& low)
{
    return o.tangents == "stored" && std::all_of(low.meshes.begin(), low.meshes.end(), [&](const Mesh& mesh) {
        return (o.material >= 0 && mesh.material != o.material) || mesh.indices.empty() || !mesh.tangents.empty();
    });
}

// Makes the materials read the image; the uv set and transform of a map that was there stay, since the bake read them.
void putMap(GltfDocument& document, const std::set<std::size_t>& materials, std::vector<std::byte> png)
{
    Json& root = document.root;
    const std::size_t image = addGltfImage(document, std::move(png), "image/png", "baked normals");
    const std::size_t texture = appendTo(root, "textures", Json{{"source", image}});
    std::set<std::size_t> old;
    for (const std::size_t m : materials) {
        Json& slot = root["materials"][m]["normalTexture"];
        if (slot.contains("index"))
            old.insert(slot["index"].get<std::size_t>());
        slot["index"] = texture;
        slot.erase("scale");
    }
    const std::set<std::size_t> used = texturesReadBy(root["materials"]);
    for (const std::size_t t : old) // textures cannot go, but what nobody reads need not keep its picture in the file
        if (!used.contains(t))
            root["textures"][t] = Json{{"source", image}};
}

// TANGENT as readers of the frame need it: what was baked with stays, else it is generated or goes.
Status settleTangents(const BakeCommandOptions& o, const BakeJob& job, GltfDocument& document, std::vector<std::string>& notes)
{
    if (!readsTangents(job.frame)) {
        const auto dropped = dropTangents(document, notes);
        return dropped ? Status(Done{}) : dropped.error();
    }
    if (usedStoredTangents(o, job.lowScene))
        return Done{};
    const auto given = giveTangents(document, {.frame = job.frame, .replace = true, .mappedOnly = true});
    return given ? Status(Done{}) : given.error();
}

} // namespace

Status checkModelOutput(const BakeCommandOptions& o)
{
    if (!namedAsGltf(o.common.output))
        return Done{};
    if (o.kind != "normal")
        return usageError(fmt::format("-o {}: a model takes a map of the kind normal; found {}", o.common.output.string(), o.kind));
    if (o.bits == 32)
        return usageError(fmt::format("-o {}: expected --bits 8 or 16, as a picture in a model has; found 32", o.common.output.string()));
    if (o.udim != 1001)
        return usageError(fmt::format("-o {}: one map covers tile 1001 of the texture coordinates only; found --udim {}",
                                      o.common.output.string(), o.udim));
    return Done{};
}

Status writeBakedModel(const BakeCommandOptions& o, const BakeJob& job, const Image& map)
{
    auto document = namedAsGltf(o.low) ? openGltfDocument(o.low) : gltfDocumentOf(job.lowScene);
    if (!document)
        return document.error();
    auto png = encodePng(map);
    if (!png)
        return png.error();
    const auto chosen = chosenMaterial(o, job.lowScene, document->root);
    if (!chosen)
        return chosen.error();
    putMap(*document, bakedMaterials(document->root, *chosen), std::move(*png));
    std::vector<std::string> notes;
    if (Status settled = settleTangents(o, job, *document, notes); !settled)
        return settled;
    if (job.frame != Frame::mikktspace)
        notes.push_back(fmt::format("the map is for the frame {}; readers that make MikkTSpace tangents where TANGENT is missing, as "
                                    "glTF asks, will show it wrongly", o.frame));
    const auto written = writeGltf(*document, o.common.output);
    if (!written)
        return written.error();
    for (const std::string& note : notes)
        warn(o.common, note);
    for (const std::string& note : written->notes)
        warn(o.common, note);
    return Done{};
}

} // namespace cotan::app
