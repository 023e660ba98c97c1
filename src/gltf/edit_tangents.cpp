// TANGENT of primitives: set, with as few vertices copied as possible, or dropped.
#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

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
    return document.root["meshes"][t.mesh]["primitives"][t.primitive];
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
                document.root["accessors"][attributes["POSITION"].get<std::size_t>()]["count"];
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

// ---- attributes -----------------------------------------------------------------------------

std::size_t strideFor(std::size_t size) { return (size + 3) / 4 * 4; }

// A view of vertex data, each element on a multiple of four bytes.
std::size_t addVertexView(GltfDocument& document, const gltf::Run& elements, std::size_t size,
                          std::span<const std::uint32_t> sources)
{
    const std::size_t stride = strideFor(size);
    std::vector<std::byte> bytes(stride * sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i)
        std::memcpy(bytes.data() + i * stride, elements.at(sources[i]), size);
    return addView(document, std::move(bytes), stride, gltf::kArrayBuffer);
}

template<class Index> std::vector<std::byte> asBytes(std::span<const std::uint32_t> values)
{
    std::vector<std::byte> bytes(values.size() * sizeof(Index));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto value = static_cast<Index>(values[i]);
        std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
    }
    return bytes;
}

// Indices in the smallest type, but not bytes where `bytesToo` is false; the largest value of a
// type restarts primitives and is not used.
std::pair<int, std::vector<std::byte>> smallestIndices(std::span<const std::uint32_t> values, std::size_t count,
                                                       bool bytesToo)
{
    if (count <= 0xff && bytesToo)
        return {gltf::kUnsignedByte, asBytes<std::uint8_t>(values)};
    if (count <= 0xffff)
        return {gltf::kUnsignedShort, asBytes<std::uint16_t>(values)};
    return {gltf::kUnsignedInt, asBytes<std::uint32_t>(values)};
}

// The sparse part for the new vertices: copies of a replaced element are replaced as well.
Json splitSparse(GltfDocument& document, const gltf::Elements& old, Json sparse,
                 const std::vector<std::uint32_t>& sources)
{
    std::map<std::uint32_t, std::size_t> valueOf;
    for (std::size_t i = 0; i < old.sparseIndices.count; ++i)
        valueOf[old.sparseIndex(i)] = i;
    const std::size_t size = gltf::elementSize(old.accessor);
    std::vector<std::uint32_t> places;
    std::vector<std::byte> values;
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        const auto found = valueOf.find(sources[i]);
        if (found == valueOf.end())
            continue;
        places.push_back(i);
        const std::byte* const from = old.sparseValues.at(found->second);
        values.insert(values.end(), from, from + size);
    }
    auto [type, bytes] = smallestIndices(places, sources.size(), true);
    sparse["count"] = places.size();
    sparse["indices"]["bufferView"] = addView(document, std::move(bytes));
    sparse["indices"]["componentType"] = type;
    sparse["values"]["bufferView"] = addView(document, std::move(values));
    sparse["indices"].erase("byteOffset");
    sparse["values"].erase("byteOffset");
    return sparse;
}

// The accessor for the new vertices. All old ones are among them, so min and max stay.
std::size_t splitAccessor(GltfDocument& document, std::size_t index, const std::vector<std::uint32_t>& sources)
{
    Json accessor = document.root["accessors"][index]; // a copy: adding moves the original
    const gltf::Elements old = elementsOf(document, accessor);
    if (old.accessor.sparse)
        accessor["sparse"] = splitSparse(document, old, accessor["sparse"], sources);
    if (old.dense.first) {
        accessor["bufferView"] = addVertexView(document, old.dense, gltf::elementSize(old.accessor), sources);
        accessor.erase("byteOffset");
    }
    accessor["count"] = sources.size();
    return addAccessor(document, std::move(accessor));
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

void setTriangles(GltfDocument& document, Json& primitive, std::span<const std::uint32_t> indices,
                  std::size_t vertexCount)
{
    Json accessor = Json::object();
    if (primitive.contains("indices"))
        accessor = document.root["accessors"][primitive["indices"].get<std::size_t>()];
    // Bytes only where the file had them: some hardware is slow with them.
    const bool hadBytes = gltf::valueOr(accessor, "componentType", 0) == gltf::kUnsignedByte;
    auto [type, bytes] = smallestIndices(indices, vertexCount, hadBytes);
    for (const char* const gone : {"byteOffset", "sparse", "min", "max"})
        accessor.erase(gone);
    accessor["bufferView"] = addView(document, std::move(bytes), 0, gltf::kElementArrayBuffer);
    accessor["componentType"] = type;
    accessor["count"] = indices.size();
    accessor["type"] = "SCALAR";
    primitive["indices"] = addAccessor(document, std::move(accessor));
}

bool sameOrder(const GltfDocument& document, const Json& primitive, std::span<const std::uint32_t> indices)
{
    if (primitive.value("mode", 4) != 4)
        return false;
    const std::vector<std::uint32_t> before = readTriangles(document, gltf::readPrimitive(primitive));
    return std::equal(before.begin(), before.end(), indices.begin(), indices.end());
}

// Replaces every accessor that a map of attributes names; each is copied once.
void splitAttributes(GltfDocument& document, Json& attributes, const std::vector<std::uint32_t>& sources,
                     std::map<std::size_t, std::size_t>& copies)
{
    for (auto& [name, index] : attributes.items()) {
        if (name == "TANGENT")
            continue;
        const auto old = index.get<std::size_t>();
        if (!copies.contains(old))
            copies[old] = splitAccessor(document, old, sources);
        index = copies[old];
    }
}

// The tangents of a target are differences and go with the vertices, unlike TANGENT itself.
void splitTargets(GltfDocument& document, Json& primitive, const std::vector<std::uint32_t>& sources,
                  std::map<std::size_t, std::size_t>& copies)
{
    if (!primitive.contains("targets"))
        return;
    for (Json& target : primitive["targets"])
        for (Json& index : target) {
            const auto old = index.get<std::size_t>();
            if (!copies.contains(old))
                copies[old] = splitAccessor(document, old, sources);
            index = copies[old];
        }
}

void noteExtensions(GltfDocument& document, const Json& primitive, const std::string& field)
{
    for (const std::string& name : unknownExtensions(primitive))
        document.notes.push_back(
            fmt::format("{}: vertices were copied; its extension {} is kept as it is", field, oneLine(name)));
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

    std::map<std::size_t, std::size_t> copies;
    std::size_t first = 0;
    for (std::size_t m = 0; m < group.members.size(); ++m) {
        Json& primitive = primitiveOf(document, *group.members[m]);
        const std::size_t length = group.triangles[m].size();
        const auto own = std::span(split.indices).subspan(first, length);
        first += length;
        if (!sameOrder(document, primitive, own)) {
            setTriangles(document, primitive, own, count);
            if (primitive.value("mode", 4) != 4)
                primitive.erase("mode"); // a list now
        }
        primitive["attributes"]["TANGENT"] = tangents;
        if (copied) {
            splitAttributes(document, primitive["attributes"], split.sources, copies);
            splitTargets(document, primitive, split.sources, copies);
            noteExtensions(document, primitive, primitiveField(group.members[m]->mesh, group.members[m]->primitive));
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
        return inputError(document.source->path.string() + ": " + problem.message);
    } catch (const Error& error) {
        return error;
    }
}

bool dropGltfTangents(GltfDocument& document, std::size_t mesh, std::size_t primitive)
{
    Json& p = document.root["meshes"][mesh]["primitives"][primitive];
    if (p["attributes"].erase("TANGENT") == 0)
        return false;
    for (std::size_t t = 0; p.contains("targets") && t < p["targets"].size(); ++t) {
        Json& target = p["targets"][t];
        const auto tangents = target.find("TANGENT");
        if (tangents == target.end())
            continue;
        const Json& count = document.root["accessors"][tangents->get<std::size_t>()]["count"];
        const auto vertices = count.get<std::size_t>();
        target.erase("TANGENT");
        if (target.empty())
            fillEmptyTarget(document, vertices, target);
    }
    return true;
}

} // namespace cotan
