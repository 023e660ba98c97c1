// What a file holds, checked: every offset, stride and count is looked at once, then read without doubt.
#include "gltf_model.hpp"

#include <algorithm>
#include <set>

#include <fmt/ranges.h>

#include "core/parse_number.hpp"
#include "gltf/json/lookup.hpp"

namespace cotan {

using gltf::Accessor, gltf::Elements, gltf::Json;

namespace {

// ---- materials of a variant -----------------------------------------------------------------

constexpr const char* kVariants = "KHR_materials_variants";

// By number or by name, of several the first. Of an extension nothing has been checked.
std::size_t findVariant(const Json& root, const std::string& wanted)
{
    std::vector<std::string> names;
    const Json* const variants = gltf::member(gltf::extension(root, kVariants), "variants");
    if (variants && variants->is_array())
        for (const Json& variant : *variants) {
            const Json* const name = gltf::member(variant, "name");
            names.push_back(name && name->is_string() ? name->get<std::string>() : std::string());
        }
    return findNamed(names, wanted, "variants");
}

bool names(const Json& mapping, std::size_t variant)
{
    const Json* const variants = gltf::member(mapping, "variants");
    return variants && variants->is_array()
        && std::find(variants->begin(), variants->end(), variant) != variants->end();
}

// Gives every primitive that has one for limits.variant its material there (KHR_materials_variants); the others keep
// theirs. Throws GltfProblem: ErrorKind::usage where the model has no such variant; damaged mappings.
void chooseGltfVariant(GltfModel& model)
{
    Json& root = model.file.json;
    if (model.limits.variant.empty())
        return;
    const std::size_t variant = findVariant(root, model.limits.variant), materials = countOf(root, "materials");
    const auto meshes = root.find("meshes");
    for (std::size_t m = 0; meshes != root.end() && m < meshes->size(); ++m) {
        Json& primitives = (*meshes)[m]["primitives"];
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const Json* const mappings = gltf::member(gltf::extension(primitives[p], kVariants), "mappings");
            if (!mappings || !mappings->is_array())
                continue;
            const auto found =
                std::ranges::find_if(*mappings, [&](const Json& mapping) { return names(mapping, variant); });
            if (found == mappings->end())
                continue;
            const Json material = found->value("material", Json());
            if (!material.is_number_unsigned() || material.get<std::uint64_t>() >= materials)
                failGltf("{}.extensions.{}: expected the number of one of {} materials, found {}", primitiveField(m, p),
                         kVariants, materials, oneLine(material.dump()));
            primitives[p]["material"] = material;
        }
    }
}

// ---- accessors ------------------------------------------------------------------------------

// Accessors that serve as nothing but texture coordinates: there a NaN is replaced, not refused.
std::set<int> texcoordAccessors(const gltf::Structure& structure)
{
    std::set<int> texcoords;
    std::set<int> others;
    for (const gltf::Mesh& mesh : structure.meshes)
        for (const gltf::Primitive& primitive : mesh.primitives)
            for (const auto& [name, accessor] : primitive.attributes)
                (name.starts_with("TEXCOORD_") ? texcoords : others).insert(accessor);
    for (const int accessor : others)
        texcoords.erase(accessor);
    return texcoords;
}

void findViews(GltfModel& model)
{
    std::size_t i = 0;
    model.views = gltf::readAll(&model.file.json, "bufferViews", [&](const Json& json) {
        const gltf::BufferView v = gltf::readBufferView(json);
        const std::span<const std::byte> buffer = model.file.buffers[v.buffer];
        if (v.offset + v.length > buffer.size())
            failGltf("bufferViews[{}]: it ends at byte {} of buffers[{}], which has {}", i, v.offset + v.length,
                     v.buffer, buffer.size());
        ++i;
        return gltf::ViewBytes{buffer.subspan(v.offset, v.length), v.stride};
    });
}

// Fills GltfModel::views and ::accessors. Checks all buffer views, and all accessors with their sparse parts, against
// the buffers and against the allowance, and refuses NaN and infinity in float accessors other than texture
// coordinates. The readers below rely on it.
void findAccessors(GltfModel& model)
{
    findViews(model);
    const std::set<int> texcoords = texcoordAccessors(model.structure);
    // Accessors without a view are zeros that cost the file nothing, and many may share one view: what they add up to
    // bounds memory and time. Counts are below 2^53 and elements at most 64 bytes, so one of them overflows nothing.
    const std::size_t most = gltfAllowance(model);
    std::size_t total = 0, i = 0;
    model.accessors = gltf::readAll(&model.file.json, "accessors", [&](const Json& json) {
        const std::string field = fmt::format("accessors[{}]", i);
        const Accessor a = gltf::readAccessor(json);
        Elements elements = gltf::findElements(
            a, [&](std::size_t view) { return model.views[view]; }, field);
        takeBytes(total, a.count * gltf::elementSize(a), most, "the accessors take", model.file.size, field);
        gltf::checkSparse(elements, field);
        if (!texcoords.contains(int(i++)))
            gltf::checkFinite(elements, field);
        return elements;
    });
}

} // namespace

std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const char* what)
{
    if (const auto found = std::find(names.begin(), names.end(), wanted); found != names.end())
        return std::size_t(found - names.begin());
    std::size_t number = 0;
    if (parseNumber(std::string_view(wanted), number) && number < names.size())
        return number;
    throw GltfProblem{usageError(
        names.empty() ? fmt::format("expected a model with {} for \"{}\", it has none", what, wanted)
                      : fmt::format("expected one of its {} {} by number or name ({}), found \"{}\"", names.size(),
                                    what, oneLine(fmt::format("{}", fmt::join(names, ", "))), wanted))};
}

void readGltfModel(GltfModel& model, const std::filesystem::path& path, const LoadLimits& limits)
{
    model.limits = limits;
    model.file = openGltf(path, limits, model.warnings);
    checkGltfShape(model.file.json, model.limits, model.warnings);
    loadGltfBuffers(model.file, model.limits);
    unpackGltf(model.file, model.limits);
    chooseGltfVariant(model);
    model.structure = gltf::readStructure(model.file.json);
    findAccessors(model);
    poseGltf(model);
}

void takeGltfBytes(GltfModel& model, std::size_t bytes, const std::string& field)
{
    takeBytes(model.bytesTaken, bytes, gltfAllowance(model), "the geometry takes", model.file.size, field);
}

} // namespace cotan
