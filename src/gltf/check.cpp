// Checks the JSON against the tables of schema.hpp.
#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string_view>

#include <fmt/ranges.h>

#include "core/one_line.hpp"
#include "gltf_file.hpp"
#include "schema.hpp"

namespace cotan {

using gltf::Json;

namespace {

using namespace gltf_schema;
using gltf::member;

// ---- traversal ------------------------------------------------------------------------------

// A location in the JSON, formatted only for a message.
struct Location {
    const Location* parent = nullptr;
    std::string_view name;
    std::size_t index = 0; // used where name is empty
};

std::string describe(const Location& location)
{
    if (!location.parent)
        return std::string(location.name);
    const std::string before = describe(*location.parent);
    if (location.name.empty())
        return fmt::format("{}[{}]", before, location.index);
    return before.empty() ? oneLine(location.name) : fmt::format("{}.{}", before, oneLine(location.name));
}

std::string found(const Json& value)
{
    if (value.is_structured())
        return value.is_array() ? "an array" : "an object";
    const std::string text = value.dump(-1, ' ', /*ensure_ascii*/ true);
    return text.size() > 60 ? text.substr(0, 60) + "..." : text;
}

[[noreturn]] void wrong(const Location& location, const std::string& expected, const Json& value)
{
    failGltf("{}: expected {}, found {}", describe(location), expected, found(value));
}

class Checker {
public:
    explicit Checker(const Json& root) : root_(root) {}

    void fields(const Json& value, Fields expected, const Location& location) const
    {
        if (!value.is_object())
            wrong(location, "an object", value);
        for (const Field& field : expected) {
            const Location inner{&location, field.name};
            if (const Json* const there = member(value, field.name))
                check(*there, field, inner);
            else if (field.required)
                failGltf("{}: missing", describe(inner));
        }
    }

private:
    // The number of items of a collection; 0 if it is missing.
    std::size_t sizeOf(std::string_view collection) const
    {
        const auto known = sizes_.find(collection);
        if (known != sizes_.end())
            return known->second;
        const Json* const list =
            member(collection == "lights" ? gltf::extension(root_, "KHR_lights_punctual") : &root_, collection);
        return sizes_[collection] = list && list->is_array() ? list->size() : 0;
    }

    void checkNumber(const Json& value, const Field& field, const Location& location) const
    {
        if (!value.is_number())
            wrong(location, "a number", value);
        if (const auto x = value.get<double>(); !(x >= field.low && x <= field.high))
            wrong(location, fmt::format("a number from {:g} to {:g}", field.low, field.high), value);
    }

    void checkInteger(const Json& value, const Field& field, const Location& location) const
    {
        if (!value.is_number_integer())
            wrong(location, "an integer", value);
        const auto x = value.get<double>();
        if (!(x >= field.low && x <= field.high))
            wrong(location, fmt::format("an integer from {:.0f} to {:.0f}", field.low, field.high), value);
        if (!field.integers.empty() && std::ranges::find(field.integers, x) == field.integers.end())
            wrong(location, fmt::format("one of {}", fmt::join(field.integers, ", ")), value);
        if (value.get<std::uint64_t>() % field.multipleOf != 0)
            wrong(location, fmt::format("a multiple of {}", field.multipleOf), value);
    }

    void checkText(const Json& value, const Field& field, const Location& location) const
    {
        if (!value.is_string())
            wrong(location, "a string", value);
        if (!field.texts.empty()
            && std::ranges::find(field.texts, value.get_ref<const std::string&>()) == field.texts.end())
            wrong(location, fmt::format("one of {}", fmt::join(field.texts, ", ")), value);
    }

    void checkIndex(const Json& value, std::string_view refers, const Location& location) const
    {
        const std::size_t count = sizeOf(refers);
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
            wrong(location, fmt::format("an index below {}, the number of {}", count, refers), value);
    }

    // Checks a value that is no list, or one item of a list.
    void checkOne(const Json& value, const Field& field, const Location& location) const
    {
        switch (field.shape) {
        case Shape::boolean:
            if (!value.is_boolean())
                wrong(location, "true or false", value);
            break;
        case Shape::integer: checkInteger(value, field, location); break;
        case Shape::number: checkNumber(value, field, location); break;
        case Shape::text: checkText(value, field, location); break;
        case Shape::index: checkIndex(value, field.refers, location); break;
        case Shape::object: fields(value, field.inner, location); break;
        case Shape::indexMap:
            if (!value.is_object())
                wrong(location, "an object", value);
            for (const auto& [key, item] : value.items())
                checkIndex(item, field.refers, Location{&location, key});
            break;
        }
    }

    void check(const Json& value, const Field& field, const Location& location) const
    {
        if (!field.list)
            return checkOne(value, field, location);
        if (!value.is_array())
            wrong(location, "an array", value);
        if (field.length > 0 && value.size() != field.length)
            failGltf("{}: expected {} numbers, found {}", describe(location), field.length, value.size());
        for (std::size_t i = 0; i < value.size(); ++i)
            checkOne(value[i], field, Location{&location, {}, i});
    }

    const Json& root_;
    mutable std::map<std::string_view, std::size_t> sizes_; // of collections, filled on demand
};

// ---- version and extensions -----------------------------------------------------------------

// Runs before the structure checks: in version 1 the collections are objects, and the asset may be missing.
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
    const std::string minVersion = asset.value("minVersion", std::string("2.0"));
    if (minVersion != "2.0")
        failGltf("asset.minVersion: expected 2.0, found \"{}\"", oneLine(minVersion));
}

constexpr std::string_view kSupported[] = {
    "KHR_texture_transform",           "KHR_materials_unlit",      "KHR_lights_punctual",
    "KHR_materials_emissive_strength", "KHR_mesh_quantization",    "EXT_mesh_gpu_instancing",
    "KHR_draco_mesh_compression",      "EXT_meshopt_compression",  "KHR_meshopt_compression",
    "KHR_materials_clearcoat",         "KHR_materials_anisotropy", "KHR_materials_ior",
    "KHR_materials_specular",          "KHR_materials_sheen",      "KHR_materials_transmission",
    "KHR_materials_variants"};

// KHR_materials_... extensions change the look of a surface but not its shape and normal map, so the model can be drawn
// without them, with a warning. Any other unknown extension may change the meaning of the data.
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
            const bool image = name == "EXT_texture_avif"; // not read; matters only to callers who need pixels
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
    Checker(root).fields(root, kRoot, Location());
    checkVersion(root["asset"]);
    checkExtensions(root, limits.pixels, warnings);
    if (const Json* const nodes = member(root, "nodes"); nodes && nodes->size() > limits.nodes)
        failGltf("nodes: the limit is {}, found {}", limits.nodes, nodes->size());
}

void checkGltfAnimations(const Json& root) { Checker(root).fields(root, kAnimated, Location()); }

} // namespace cotan
