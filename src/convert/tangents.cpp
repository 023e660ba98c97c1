#include "cotan/convert/tangents.hpp"

#include <set>

#include <fmt/format.h>

#include "cotan/convert/map_jobs.hpp"
#include "cotan/gltf/lookup.hpp"

namespace cotan {

using Json = nlohmann::ordered_json;

namespace {

// What of a material reads tangents and is not converted; empty if nothing.
std::string whyTangentsStay(const Json& root, std::size_t material, bool foreign)
{
    if (foreign)
        return "its normal map, in a format that is not read here,";
    const std::string reader = gltf::tangentReader(root["materials"][material]);
    return reader.empty() ? reader : reader + " reads tangents and";
}

} // namespace

Result<TangentBytes> dropTangents(GltfDocument& document, std::vector<std::string>& notes)
{
    TangentBytes dropped;
    std::set<std::size_t> seen, told;
    const std::vector<bool> foreign = foreignNormalMaps(document);
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
            const gltf::Accessor accessor = gltf::readAccessor(root["accessors"][index]);
            dropped.vertices += base ? accessor.count : 0;
            dropped.bytes += accessor.count * gltf::elementSize(accessor);
        };
        count(primitive["attributes"], true);
        for (const Json& target : primitive.value("targets", Json::array()))
            count(target, false);
        dropped.primitives += dropGltfTangents(document, m, p);
        return Done{};
    });
    if (!status)
        return status.error();
    return dropped;
}

} // namespace cotan
