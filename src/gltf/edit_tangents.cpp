// TANGENT of primitives: set, with as few vertices copied as possible, or dropped.
#include <algorithm>
#include <cstring>
#include <map>

#include "cotan/tangents.hpp"
#include "edit_state.hpp"

namespace cotan {

using namespace gltf_edit;

namespace {

// Primitives that share all attributes, and so their vertices.
struct Group {
    std::vector<const GltfCornerTangents*> members;
    std::vector<std::vector<std::uint32_t>> triangles; // of each member
    std::size_t vertexCount = 0;
};

Json& primitiveOf(GltfDocument& document, const GltfCornerTangents& t)
{
    return rootOf(document)["meshes"][t.mesh]["primitives"][t.primitive];
}

// What two primitives have in common if they share vertices, as text.
std::string sharedKey(const Json& primitive)
{
    Json attributes = primitive["attributes"];
    attributes.erase("TANGENT");
    Json targets = primitive.value("targets", Json::array());
    return nlohmann::json(attributes).dump() + nlohmann::json(targets).dump();
}

std::vector<Group> makeGroups(GltfDocument& document, std::span<const GltfCornerTangents> tangents)
{
    std::map<std::string, std::size_t> known;
    std::vector<Group> groups;
    for (const GltfCornerTangents& t : tangents) {
        const Json& primitive = primitiveOf(document, t);
        const std::string field = primitiveField(t.mesh, t.primitive);
        const Json& attributes = primitive["attributes"];
        for (const char* const needed : {"POSITION", "NORMAL"})
            if (!attributes.contains(needed))
                failGltf("{}: expected {}, without which glTF gives TANGENT no meaning", field, needed);
        const auto [place, isNew] = known.emplace(sharedKey(primitive), groups.size());
        if (isNew)
            groups.emplace_back().vertexCount =
                rootOf(document)["accessors"][attributes["POSITION"].get<std::size_t>()]["count"];
        Group& group = groups[place->second];
        group.members.push_back(&t);
        group.triangles.push_back(readTriangles(document, gltf::readPrimitive(primitive)));
        if (group.triangles.back().size() != t.corners.size())
            throw Error{ErrorKind::usage,
                        fmt::format("{}: expected {} corner tangents, found {}", field, group.triangles.back().size(),
                                    t.corners.size())};
    }
    return groups;
}

// ---- one group ------------------------------------------------------------------------------

std::size_t addTangents(GltfDocument& document, const std::vector<glm::vec4>& values)
{
    std::vector<std::byte> bytes(values.size() * sizeof(glm::vec4));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    const std::size_t view = addView(document, std::move(bytes), sizeof(glm::vec4), gltf::kArrayBuffer);
    return addAccessor(
        document, {{"bufferView", view}, {"componentType", gltf::kFloat}, {"count", values.size()}, {"type", "VEC4"}});
}

bool sameOrder(const GltfDocument& document, const Json& primitive, std::span<const std::uint32_t> indices)
{
    if (primitive.value("mode", 4) != 4)
        return false;
    const std::vector<std::uint32_t> before = readTriangles(document, gltf::readPrimitive(primitive));
    return std::equal(before.begin(), before.end(), indices.begin(), indices.end());
}

// Returns how many vertices were added.
std::size_t setGroup(GltfDocument& document, const Group& group)
{
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec4> corners;
    for (std::size_t m = 0; m < group.members.size(); ++m) {
        indices.insert(indices.end(), group.triangles[m].begin(), group.triangles[m].end());
        const auto& c = group.members[m]->corners;
        corners.insert(corners.end(), c.begin(), c.end());
    }
    const VertexSplit split = splitVertices(group.vertexCount, indices, corners);
    const std::size_t count = split.sources.size();
    const bool copied = count > group.vertexCount;
    // A vertex that no triangle uses gets a unit vector, as glTF asks for.
    std::vector<glm::vec4> values(count, glm::vec4(1, 0, 0, 1));
    for (std::size_t i = 0; i < corners.size(); ++i)
        values[split.indices[i]] = corners[i];
    const std::size_t tangents = addTangents(document, values);

    Renewed renewed{{tangents, tangents}}; // those are for the new vertices already
    std::size_t first = 0;
    for (std::size_t m = 0; m < group.members.size(); ++m) {
        Json& primitive = primitiveOf(document, *group.members[m]);
        const std::size_t length = group.triangles[m].size();
        const auto own = std::span(split.indices).subspan(first, length);
        first += length;
        if (!sameOrder(document, primitive, own))
            setTriangles(document, primitive, own, count);
        primitive["attributes"]["TANGENT"] = tangents;
        if (copied) {
            renewVertices(document, primitive, split.sources, renewed);
            noteCopied(document, primitive, primitiveField(group.members[m]->mesh, group.members[m]->primitive));
        }
    }
    return count - group.vertexCount;
}

// glTF wants a target to have some attribute: one without any becomes an explicit "no change".
void fillEmptyTarget(GltfDocument& document, std::size_t count, Json& target)
{
    const Json zero = {0, 0, 0};
    target["POSITION"] = addAccessor(
        document, {{"componentType", gltf::kFloat}, {"count", count}, {"type", "VEC3"}, {"min", zero}, {"max", zero}});
}

} // namespace

Result<std::size_t> setGltfTangents(GltfDocument& document, std::span<const GltfCornerTangents> tangents)
{
    try {
        std::size_t added = 0;
        for (const Group& group : makeGroups(document, tangents))
            added += setGroup(document, group);
        return added;
    } catch (const GltfProblem& problem) {
        return inputError(document.source->path.string() + ": " + problem.error.message);
    } catch (const Error& error) {
        return error;
    }
}

bool dropGltfTangents(GltfDocument& document, std::size_t mesh, std::size_t primitive)
{
    Json& p = rootOf(document)["meshes"][mesh]["primitives"][primitive];
    if (p["attributes"].erase("TANGENT") == 0)
        return false;
    for (std::size_t t = 0; p.contains("targets") && t < p["targets"].size(); ++t) {
        Json& target = p["targets"][t];
        const auto tangents = target.find("TANGENT");
        if (tangents == target.end())
            continue;
        const Json& count = rootOf(document)["accessors"][tangents->get<std::size_t>()]["count"];
        const auto vertices = count.get<std::size_t>();
        target.erase("TANGENT");
        if (target.empty())
            fillEmptyTarget(document, vertices, target);
    }
    return true;
}

} // namespace cotan
