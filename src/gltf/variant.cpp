#include "variant.hpp"

#include <algorithm>

#include "gltf/json/lookup.hpp"
#include "gltf/json/views.hpp"
#include "named.hpp"

namespace cotan {

using gltf::Json;

namespace {

constexpr const char* kVariants = "KHR_materials_variants";

// By number or by name, of several the first. Of an extension nothing has been checked.
std::size_t findVariant(const Json& root, const std::string& wanted)
{
    std::vector<std::string> names;
    const Json* const extension = gltf::extension(root, kVariants);
    if (const Json* const variants = extension ? gltf::member(*extension, "variants") : nullptr)
        if (variants->is_array())
            for (const Json& variant : *variants)
                names.push_back(variant.is_object() && variant.contains("name") && variant["name"].is_string()
                                    ? variant["name"].get<std::string>()
                                    : std::string());
    return findNamed(names, wanted, "variants");
}

bool names(const Json& mapping, std::size_t variant)
{
    const Json* const variants = mapping.is_object() ? gltf::member(mapping, "variants") : nullptr;
    return variants && variants->is_array()
        && std::any_of(variants->begin(), variants->end(), [&](const Json& v) { return v == variant; });
}

} // namespace

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
            const Json* const extension = gltf::extension(primitives[p], kVariants);
            const Json* const mappings = extension ? gltf::member(*extension, "mappings") : nullptr;
            if (!mappings || !mappings->is_array())
                continue;
            const auto found = std::find_if(mappings->begin(), mappings->end(),
                                            [&](const Json& mapping) { return names(mapping, variant); });
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

} // namespace cotan
