// Compares the JSON with the tables of schema.hpp.
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>

#include <fmt/ranges.h>

#include "gltf_file.hpp"
#include "schema.hpp"

namespace cotan {

using gltf::Json;

namespace {

using namespace gltf_schema;
using gltf::member;

// ---- the walk -------------------------------------------------------------------------------

// A place in the JSON, written out only for a message.
struct Place {
    const Place* parent = nullptr;
    std::string_view name;
    std::size_t index = 0; // used where name is empty
};

std::string describe(const Place& place)
{
    if (!place.parent)
        return std::string(place.name);
    const std::string before = describe(*place.parent);
    if (place.name.empty())
        return fmt::format("{}[{}]", before, place.index);
    return before.empty() ? oneLine(place.name) : fmt::format("{}.{}", before, oneLine(place.name));
}

std::string found(const Json& value)
{
    if (value.is_structured())
        return value.is_array() ? "an array" : "an object";
    const std::string text = value.dump(-1, ' ', /*ensure_ascii*/ true);
    return text.size() > 60 ? text.substr(0, 60) + "..." : text;
}

[[noreturn]] void wrong(const Place& place, const std::string& expected, const Json& value)
{
    failGltf("{}: expected {}, found {}", describe(place), expected, found(value));
}

class Checker {
public:
    explicit Checker(const Json& root) : root_(root) {}

    void fields(const Json& value, Fields expected, const Place& place) const
    {
        if (!value.is_object())
            wrong(place, "an object", value);
        for (const Field& field : expected) {
            const Place inner{&place, field.name};
            if (const Json* const there = member(value, field.name))
                check(*there, field, inner);
            else if (field.required)
                failGltf("{}: missing", describe(inner));
        }
    }

private:
    // How many items a collection has.
    std::size_t sizeOf(std::string_view collection) const
    {
        const auto known = sizes_.find(collection);
        if (known != sizes_.end())
            return known->second;
        const Json* const list =
            member(collection == "lights" ? gltf::extension(root_, "KHR_lights_punctual") : &root_, collection);
        return sizes_[collection] = list && list->is_array() ? list->size() : 0;
    }

    void checkNumber(const Json& value, const Field& field, const Place& place) const
    {
        if (!value.is_number())
            wrong(place, "a number", value);
        if (const auto x = value.get<double>(); !(x >= field.low && x <= field.high))
            wrong(place, fmt::format("a number from {:g} to {:g}", field.low, field.high), value);
    }

    void checkInteger(const Json& value, const Field& field, const Place& place) const
    {
        if (!value.is_number_integer())
            wrong(place, "an integer", value);
        const auto x = value.get<double>();
        if (!(x >= field.low && x <= field.high))
            wrong(place, fmt::format("an integer from {:.0f} to {:.0f}", field.low, field.high), value);
        if (!field.integers.empty() && std::ranges::find(field.integers, x) == field.integers.end())
            wrong(place, fmt::format("one of {}", fmt::join(field.integers, ", ")), value);
        if (value.get<std::uint64_t>() % field.multipleOf != 0)
            wrong(place, fmt::format("a multiple of {}", field.multipleOf), value);
    }

    void checkText(const Json& value, const Field& field, const Place& place) const
    {
        if (!value.is_string())
            wrong(place, "a string", value);
        if (!field.texts.empty()
            && std::ranges::find(field.texts, value.get_ref<const std::string&>()) == field.texts.end())
            wrong(place, fmt::format("one of {}", fmt::join(field.texts, ", ")), value);
    }

    void checkIndex(const Json& value, std::string_view refers, const Place& place) const
    {
        const std::size_t count = sizeOf(refers);
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
            wrong(place, fmt::format("an index below {}, the number of {}", count, refers), value);
    }

    // What is no list, or an item of one.
    void checkOne(const Json& value, const Field& field, const Place& place) const
    {
        switch (field.shape) {
        case Shape::boolean:
            if (!value.is_boolean())
                wrong(place, "true or false", value);
            break;
        case Shape::integer: checkInteger(value, field, place); break;
        case Shape::number: checkNumber(value, field, place); break;
        case Shape::text: checkText(value, field, place); break;
        case Shape::index: checkIndex(value, field.refers, place); break;
        case Shape::object: fields(value, field.inner, place); break;
        case Shape::indexMap:
            if (!value.is_object())
                wrong(place, "an object", value);
            for (const auto& [key, item] : value.items())
                checkIndex(item, field.refers, Place{&place, key});
            break;
        }
    }

    void check(const Json& value, const Field& field, const Place& place) const
    {
        if (!field.list)
            return checkOne(value, field, place);
        if (!value.is_array())
            wrong(place, "an array", value);
        if (field.length > 0 && value.size() != field.length)
            failGltf("{}: expected {} numbers, found {}", describe(place), field.length, value.size());
        for (std::size_t i = 0; i < value.size(); ++i)
            checkOne(value[i], field, Place{&place, {}, i});
    }

    const Json& root_;
    mutable std::map<std::string_view, std::size_t> sizes_; // of collections, as they are asked for
};

// ---- version and extensions -----------------------------------------------------------------

// Before anything about structure: in version 1 the collections are objects, and the asset may be missing.
void refuseVersion1(const Json& root)
{
    if (const Json* const version = member(member(root, "asset"), "version")) {
        const std::string text = version->is_string() ? version->get<std::string>() : version->dump();
        if (text.starts_with("1.") || text == "1" || text.starts_with("0."))
            failGltfVersion1("asset.version");
        return;
    }
    for (const char* const collection : {"meshes", "nodes", "scenes", "accessors", "bufferViews"})
        if (const Json* const found = member(root, collection); found && found->is_object())
            failGltfVersion1(collection);
}

void checkVersion(const Json& asset)
{
    const std::string version = asset["version"];
    if (!version.starts_with("2."))
        failGltf("asset.version: expected 2.x, found \"{}\"", oneLine(version));
    const std::string least = asset.value("minVersion", std::string("2.0"));
    if (least != "2.0")
        failGltf("asset.minVersion: expected 2.0, found \"{}\"", oneLine(least));
}

constexpr std::string_view kSupported[] = {
    "KHR_texture_transform",           "KHR_materials_unlit",      "KHR_lights_punctual",
    "KHR_materials_emissive_strength", "KHR_mesh_quantization",    "EXT_mesh_gpu_instancing",
    "KHR_draco_mesh_compression",      "EXT_meshopt_compression",  "KHR_meshopt_compression",
    "KHR_materials_clearcoat",         "KHR_materials_anisotropy", "KHR_materials_ior",
    "KHR_materials_specular",          "KHR_materials_sheen",      "KHR_materials_transmission",
    "KHR_materials_variants"};

// KHR_materials_... refine how a surface looks and leave shape and normal map alone: such a model can be drawn without
// them, if that is said. Any other unknown extension may change what the data mean.
void checkExtensions(const Json& root, Pixels pixels, GltfWarnings& warnings)
{
    std::vector<std::string> ignored;
    std::set<std::string_view> seen;
    for (const char* const list : {"extensionsRequired", "extensionsUsed"}) {
        const Json* const names = member(root, list);
        for (std::size_t i = 0; names && i < names->size(); ++i) {
            const Json& item = (*names)[i];
            const auto& name = item.get_ref<const std::string&>();
            const auto in = [&](const auto& all) { return std::ranges::find(all, name) != std::end(all); };
            const bool known = in(kSupported) || in(gltf::kReadImageExtensions);
            const bool image = name == "EXT_texture_avif"; // is not read, which matters to who needs the pixels
            const bool harmless = name.starts_with("KHR_materials_") || (image && pixels != Pixels::all);
            if (!known && !harmless && list == std::string_view("extensionsRequired"))
                failGltf("extensionsRequired: \"{}\" is not supported", oneLine(name));
            if (!known && seen.insert(name).second)
                ignored.push_back(name);
        }
    }
    if (!ignored.empty())
        warnings.add("extensionsUsed", fmt::format("ignored: {}", fmt::join(ignored, ", ")));
}

} // namespace

void checkGltfShape(const Json& root, const LoadLimits& limits, GltfWarnings& warnings)
{
    if (!root.is_object())
        failGltf("JSON: expected an object, found {}", found(root));
    refuseVersion1(root);
    Checker(root).fields(root, kRoot, Place());
    checkVersion(root["asset"]);
    checkExtensions(root, limits.pixels, warnings);
    if (const Json* const nodes = member(root, "nodes"); nodes && nodes->size() > limits.nodes)
        failGltf("nodes: the limit is {}, found {}", limits.nodes, nodes->size());
}

void checkGltfAnimations(const Json& root) { Checker(root).fields(root, kAnimated, Place()); }

} // namespace cotan
