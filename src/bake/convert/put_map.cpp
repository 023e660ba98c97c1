#include "cotan/convert.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "bake/convert/map_jobs.hpp"
#include "core/try.hpp"
#include "cotan/image.hpp"
#include "gltf/json/lookup.hpp"
#include "gltf/json/views.hpp"

namespace cotan {

using gltf::Json;

namespace {

Result<std::size_t> materialNamed(const Json& root, const std::string& name)
{
    std::vector<std::size_t> found;
    for (std::size_t m = 0; m < countOf(root, "materials"); ++m)
        if (root["materials"][m].value("name", "") == name)
            found.push_back(m);
    if (found.size() != 1)
        return about("document",
                     inputError(fmt::format("expected one material named '{}' to put the map in; found {}", name,
                                            found.size())));
    return found.front();
}

// The materials of all primitives; primitives without one get a new one.
std::set<std::size_t> allMaterials(GltfDocument& document)
{
    std::set<std::size_t> materials;
    const auto eachPrimitive = [&](const auto& work) {
        for (Json& mesh : rootOf(document)["meshes"])
            for (Json& primitive : mesh["primitives"])
                work(primitive);
    };
    bool lacking = false;
    eachPrimitive([&](const Json& primitive) { lacking = lacking || !primitive.contains("material"); });
    // Added before the second loop: the first material of a file moves the other collections.
    const std::size_t added = lacking ? addItem(document, "materials", Json{{"name", "baked"}}) : 0;
    eachPrimitive([&](Json& primitive) {
        if (!primitive.contains("material"))
            primitive["material"] = added;
        materials.insert(primitive["material"].get<std::size_t>());
    });
    return materials;
}

// Makes the materials read the image; the uv set and transform of a previous map stay, since the bake read them.
void putMap(GltfDocument& document, const std::set<std::size_t>& materials, std::vector<std::byte> png)
{
    Json& root = rootOf(document);
    const std::size_t image = addGltfImage(document, std::move(png), "image/png", "baked normals");
    const std::size_t texture = addItem(document, "textures", Json{{"source", image}});
    std::set<std::size_t> old;
    for (const std::size_t m : materials) {
        Json& slot = root["materials"][m]["normalTexture"];
        if (slot.contains("index"))
            old.insert(slot["index"].get<std::size_t>());
        slot["index"] = texture;
        slot.erase("scale");
    }
    const std::set<std::size_t> used = texturesReadBy(root["materials"]);
    for (const std::size_t t : old) // textures stay, but unused ones need not keep their images
        if (!used.contains(t))
            root["textures"][t] = Json{{"source", image}};
}

// Gives, keeps or drops TANGENT, as readers of the frame need it.
Status updateTangents(GltfDocument& document, const PutMapOptions& options, std::vector<std::string>& notes)
{
    if (!readsTangents(options.frame)) {
        const auto dropped = dropTangents(document, {.to = options.frame}, foreignNormalMaps(document), {}, {}, notes);
        return dropped ? Status(Done{}) : dropped.error();
    }
    if (options.keepTangents)
        return Done{};
    const auto given = giveTangents(document, {.frame = options.frame, .replace = true, .mappedOnly = true});
    return given ? Status(Done{}) : given.error();
}

} // namespace

Result<std::optional<Frame>> namedFrame(const GltfDocument& document)
{
    const Json& root = rootOf(document);
    std::optional<Frame> named;
    std::size_t first = 0;
    for (std::size_t m = 0; m < countOf(root, "materials"); ++m) {
        const auto frame = frameFromName(gltf::frameText(root["materials"][m]));
        const auto hasMap = [&](NormalSlot slot) { return normalMapOf(root, m, slot).texture >= 0; };
        if (!frame || std::ranges::none_of(kNormalSlots, hasMap))
            continue;
        if (named && *named != *frame)
            return inputError(fmt::format("{}materials[{}].extras.{}: expected {}, as in materials[{}]; found {}",
                                          fileOf(document), m, gltf::kFrameExtra, name(*named), first, name(*frame)));
        if (!named)
            first = m;
        named = frame;
    }
    return named;
}

void nameFrame(GltfDocument& document, std::size_t material, Frame frame)
{
    setExtra(rootOf(document)["materials"][material], gltf::kFrameExtra,
             frame != Frame::mikktspace ? name(frame) : std::string_view());
}

Status putNormalMap(GltfDocument& document, std::vector<std::byte> png, const PutMapOptions& options,
                    std::vector<std::string>& notes)
{
    std::set<std::size_t> materials;
    if (options.material) {
        COTAN_TRY(chosen, materialNamed(rootOf(document), *options.material));
        materials = {*chosen};
    } else {
        materials = allMaterials(document);
    }
    putMap(document, materials, std::move(png));
    for (const std::size_t material : materials) {
        nameFrame(document, material, options.frame);
        setExpansion(rootOf(document)["materials"][material], options.expansion);
    }
    COTAN_CHECK(updateTangents(document, options, notes));
    if (options.frame != Frame::mikktspace)
        notes.push_back(fmt::format(
            "the map is for the frame {}; readers that generate MikkTSpace tangents where TANGENT is missing, "
            "as glTF specifies, will shade it incorrectly",
            name(options.frame)));
    return Done{};
}

Result<GltfWritten> writeModelWithMap(GltfDocument& document, const Image& map, const PutMapOptions& options,
                                      const std::filesystem::path& output)
{
    COTAN_TRY(png, encodePng(map));
    std::vector<std::string> notes;
    COTAN_CHECK(putNormalMap(document, std::move(*png), options, notes));
    auto written = writeGltf(document, output);
    if (written)
        written->notes.insert(written->notes.begin(), notes.begin(), notes.end());
    return written;
}

} // namespace cotan
