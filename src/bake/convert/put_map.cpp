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

// The texture of a material that a map is put into.
struct Slot {
    const char* parent; // object of the material; null: itself
    const char* name;
    const char* what; // for the name of the image
};
constexpr Slot kNormalSlot{nullptr, "normalTexture", "normals"},
    kOcclusionSlot{nullptr, "occlusionTexture", "occlusion"},
    kBaseColorSlot{"pbrMetallicRoughness", "baseColorTexture", "base colour"},
    kRoughnessSlot{"pbrMetallicRoughness", "metallicRoughnessTexture", "roughness and metallic"},
    kEmissiveSlot{nullptr, "emissiveTexture", "light"};

// Makes the slots of the materials read the image at full strength, with the uv set and transform of their normal maps,
// which the bake read.
void putMap(GltfDocument& document, const std::set<std::size_t>& materials, const std::vector<Slot>& slots,
            std::vector<std::byte> png)
{
    Json& root = rootOf(document);
    const std::size_t image =
        addGltfImage(document, std::move(png), "image/png", fmt::format("baked {}", slots.front().what));
    const std::size_t texture = addItem(document, "textures", Json{{"source", image}});
    std::set<std::size_t> old;
    for (const std::size_t m : materials) {
        Json& material = root["materials"][m];
        Json use = material.contains(kNormalSlot.name) ? material[kNormalSlot.name] : Json::object();
        use["index"] = texture;
        use.erase("scale");
        for (const Slot& to : slots) {
            Json& slot = (to.parent ? material[to.parent] : material)[to.name];
            if (slot.contains("index"))
                old.insert(slot["index"].get<std::size_t>());
            slot = use;
        }
    }
    const std::set<std::size_t> used = texturesReadBy(root["materials"]);
    for (const std::size_t t : old) // textures stay, but unused ones need not keep their images
        if (!used.contains(t))
            root["textures"][t] = Json{{"source", image}};
}

// Sets the factors of maps to 1.
void resetFactors(Json& material, const MaterialImages& maps)
{
    if (maps.roughnessMetallic)
        for (const char* factor : {"roughnessFactor", "metallicFactor"})
            material["pbrMetallicRoughness"].erase(factor);
    if (maps.baseColor)
        if (Json& pbr = material["pbrMetallicRoughness"]; pbr.contains("baseColorFactor"))
            for (const std::size_t i : {0u, 1u, 2u}) // alpha stays
                pbr["baseColorFactor"][i] = 1;
    if (maps.emissive) {
        material["emissiveFactor"] = {1, 1, 1};
        takeOut(material, "extensions", "KHR_materials_emissive_strength");
    }
}

// The map of roughness and metallic with the occlusion in red.
Image withOcclusion(const Image& roughnessMetallic, const Image& occlusion)
{
    Image both = roughnessMetallic;
    const std::size_t size = bytesPerComponent(both.type);
    for (std::size_t i = 0; i < both.pixelCount(); ++i)
        std::copy_n(&occlusion.data[4 * i * size], size, &both.data[4 * i * size]);
    return both;
}

bool multipliesColors(const Json& root, const std::set<std::size_t>& materials)
{
    for (const Json& mesh : root["meshes"])
        for (const Json& primitive : mesh["primitives"])
            if (primitive.contains("material") && materials.contains(primitive["material"].get<std::size_t>())
                && primitive["attributes"].contains("COLOR_0"))
                return true;
    return false;
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

namespace {

Result<std::set<std::size_t>> chosenMaterials(GltfDocument& document, const PutMapOptions& options)
{
    if (!options.material)
        return allMaterials(document);
    COTAN_TRY(chosen, materialNamed(rootOf(document), *options.material));
    return std::set{*chosen};
}

} // namespace

Status putNormalMap(GltfDocument& document, std::vector<std::byte> png, const PutMapOptions& options,
                    std::vector<std::string>& notes)
{
    COTAN_TRY(materials, chosenMaterials(document, options));
    putMap(document, *materials, {kNormalSlot}, std::move(png));
    for (const std::size_t material : *materials) {
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

Result<GltfWritten> writeModelWithMaps(GltfDocument& document, const MaterialImages& given,
                                       const PutMapOptions& options, const std::filesystem::path& output)
{
    std::vector<std::string> notes;
    if (given.normal) {
        COTAN_TRY(png, encodePng(*given.normal));
        COTAN_CHECK(putNormalMap(document, std::move(*png), options, notes));
    }
    MaterialImages maps = given;
    Image both;
    if (maps.occlusion && maps.roughnessMetallic && maps.occlusion != maps.roughnessMetallic) {
        both = withOcclusion(*maps.roughnessMetallic, *maps.occlusion);
        maps.occlusion = maps.roughnessMetallic = &both;
    }
    COTAN_TRY(materials, chosenMaterials(document, options));
    const auto put = [&](const Image* image, const std::vector<Slot>& slots) -> Status {
        if (!image)
            return Done{};
        COTAN_TRY(png, encodePng(*image));
        putMap(document, *materials, slots, std::move(*png));
        return Done{};
    };
    COTAN_CHECK(put(maps.baseColor, {kBaseColorSlot}));
    COTAN_CHECK(put(maps.emissive, {kEmissiveSlot}));
    if (maps.roughnessMetallic)
        COTAN_CHECK(put(maps.roughnessMetallic,
                        maps.occlusion ? std::vector{kRoughnessSlot, kOcclusionSlot} : std::vector{kRoughnessSlot}));
    else
        COTAN_CHECK(put(maps.occlusion, {kOcclusionSlot}));
    for (const std::size_t material : *materials)
        resetFactors(rootOf(document)["materials"][material], maps);
    if (maps.baseColor && multipliesColors(rootOf(document), *materials))
        notes.push_back("the low mesh has vertex colours, which multiply the baked base colour");
    if (options.encode) {
        COTAN_TRY(stored, storeNormalMaps(document, options.encode, options.extension));
        notes.insert(notes.end(), stored->notes.begin(), stored->notes.end());
    }
    auto written = writeGltf(document, output);
    if (written)
        written->notes.insert(written->notes.begin(), notes.begin(), notes.end());
    return written;
}

} // namespace cotan
