// Replaces vertices and triangles of primitives: sets TANGENT with as few copied vertices as possible, or removes it;
// numbers vertices so that every triangle has its own provoking vertex.
#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>

#include "core/one_line.hpp"
#include "cotan/tangents.hpp"
#include "edit_state.hpp"
#include "gltf_model.hpp"

namespace cotan {

using namespace gltf_edit;

namespace {

using Sources = std::span<const std::uint32_t>;

// Adds a view with copies of vertex elements, each at a multiple of four bytes.
std::size_t addVertexView(GltfDocument& document, const gltf::Run& elements, std::size_t size, Sources sources)
{
    const std::size_t stride = gltf::aligned(size);
    std::vector<std::byte> bytes(stride * sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i)
        std::memcpy(bytes.data() + i * stride, elements.at(sources[i]), size);
    return addView(document, std::move(bytes), stride, gltf::kArrayBuffer);
}

// Encodes indices below `count` in the smallest type, but not in bytes if `bytesToo` is false. The largest value of a
// type is the primitive restart value and is not used.
std::pair<int, std::vector<std::byte>> smallestIndices(std::span<const std::uint32_t> values, std::size_t count,
                                                       bool bytesToo)
{
    const int type = count <= 0xff && bytesToo ? gltf::kUnsignedByte
        : count <= 0xffff                      ? gltf::kUnsignedShort
                                               : gltf::kUnsignedInt;
    std::vector<std::byte> bytes(values.size() * gltf::componentSize(type));
    gltf::withType(type, [&]<class Index>(Index) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto value = static_cast<Index>(values[i]);
            std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
        }
    });
    return {type, std::move(bytes)};
}

// Replaces the accessor's sparse part by that of the new vertices: copies of a sparse element are sparse too.
void renewSparse(GltfDocument& document, const gltf::Elements& old, Json& accessor, Sources sources)
{
    const std::size_t size = gltf::elementSize(old.accessor);
    std::vector<std::uint32_t> newIndices;
    std::vector<std::byte> values;
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        const std::size_t found = old.sparseLowerBound(sources[i]);
        if (found == old.sparseIndices.count || old.sparseIndex(found) != sources[i])
            continue;
        newIndices.push_back(i);
        const std::byte* const from = old.sparseValues.at(found);
        values.insert(values.end(), from, from + size);
    }
    if (newIndices.empty()) { // glTF requires at least one
        accessor.erase("sparse");
        return;
    }
    Json& sparse = accessor["sparse"];
    auto [type, bytes] = smallestIndices(newIndices, sources.size(), true);
    sparse["count"] = newIndices.size();
    sparse["indices"]["bufferView"] = addView(document, std::move(bytes));
    sparse["indices"]["componentType"] = type;
    sparse["values"]["bufferView"] = addView(document, std::move(values));
    sparse["indices"].erase("byteOffset");
    sparse["values"].erase("byteOffset");
}

bool allAmong(std::size_t count, Sources sources)
{
    std::vector<bool> among(count, false);
    for (const std::uint32_t s : sources)
        among[s] = true;
    return std::find(among.begin(), among.end(), false) == among.end();
}

std::size_t renewAccessor(GltfDocument& document, std::size_t index, Sources sources)
{
    Json accessor = rootOf(document)["accessors"][index]; // a copy: adding items moves the original
    const gltf::Elements old = elementsOf(document, accessor);
    if (old.accessor.sparse)
        renewSparse(document, old, accessor, sources);
    if (old.dense.first) {
        accessor["bufferView"] = addVertexView(document, old.dense, gltf::elementSize(old.accessor), sources);
        accessor.erase("byteOffset");
    }
    accessor["count"] = sources.size();
    if (!allAmong(old.accessor.count, sources))
        gltf::renewBounds(accessor, elementsOf(document, accessor));
    return addItem(document, "accessors", std::move(accessor));
}

// Accessors made for new vertices: from the index of the old accessor to that of the new one.
using Renewed = std::map<std::size_t, std::size_t>;

// Gives a primitive new vertices, bit-exact copies of old ones with all attributes and morph targets. Adds notes about
// unknown extensions that may hold per-vertex data. sources: the old vertex of each new one. renewed: accessors shared
// by several primitives are made once.
void renewVertices(GltfDocument& document, Json& primitive, const std::string& field, Sources sources, Renewed& renewed)
{
    const auto renewAll = [&](Json& attributes) {
        for (Json& index : attributes) {
            const auto old = index.get<std::size_t>();
            if (!renewed.contains(old))
                renewed[old] = renewAccessor(document, old, sources);
            index = renewed[old];
        }
    };
    renewAll(primitive["attributes"]);
    if (primitive.contains("targets"))
        for (Json& target : primitive["targets"])
            renewAll(target);
    for (const std::string& name : unknownExtensions(primitive))
        document.notes.push_back(
            fmt::format("{}: vertices were copied; its extension {} is unchanged", field, oneLine(name)));
}

// Makes the primitive a triangle list with these indices, which are below vertexCount.
void setTriangles(GltfDocument& document, Json& primitive, std::span<const std::uint32_t> indices,
                  std::size_t vertexCount)
{
    Json accessor = Json::object();
    if (primitive.contains("indices"))
        accessor = rootOf(document)["accessors"][primitive["indices"].get<std::size_t>()];
    // Byte indices only if the file had them: they are slow on some hardware.
    const bool hadBytes = gltf::valueOr(accessor, "componentType", 0) == gltf::kUnsignedByte;
    auto [type, bytes] = smallestIndices(indices, vertexCount, hadBytes);
    for (const char* const gone : {"byteOffset", "sparse", "min", "max"})
        accessor.erase(gone);
    accessor["bufferView"] = addView(document, std::move(bytes), 0, gltf::kElementArrayBuffer);
    accessor["componentType"] = type;
    accessor["count"] = indices.size();
    accessor["type"] = "SCALAR";
    primitive["indices"] = addItem(document, "accessors", std::move(accessor));
    if (gltf::valueOr(primitive, "mode", gltf::kTriangles) != gltf::kTriangles)
        primitive.erase("mode"); // lists are the default
}

// ---- tangents -------------------------------------------------------------------------------

// Primitives that share all attributes other than TANGENT, and therefore their vertices.
struct Group {
    std::vector<const GltfCornerTangents*> members;
    std::vector<std::vector<std::uint32_t>> triangles; // one list per member
    std::size_t vertexCount = 0;
};

Json& primitiveOf(GltfDocument& document, const GltfCornerTangents& t)
{
    return rootOf(document)["meshes"][t.mesh]["primitives"][t.primitive];
}

// Attributes other than TANGENT and morph targets, as text; equal for primitives that share vertices.
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
                failGltf("{}: expected {}, without which glTF does not define TANGENT", field, needed);
        const auto [entry, isNew] = known.emplace(sharedKey(primitive), groups.size());
        if (isNew)
            groups.emplace_back().vertexCount =
                rootOf(document)["accessors"][attributes["POSITION"].get<std::size_t>()]["count"];
        Group& group = groups[entry->second];
        group.members.push_back(&t);
        group.triangles.push_back(readTriangles(document, gltf::readPrimitive(primitive)));
        if (group.triangles.back().size() != t.corners.size())
            throw GltfProblem{usageError(fmt::format("{}: expected {} corner tangents, found {}", field,
                                                     group.triangles.back().size(), t.corners.size()))};
    }
    return groups;
}

bool sameOrder(const GltfDocument& document, const Json& primitive, std::span<const std::uint32_t> indices)
{
    if (primitive.value("mode", 4) != 4)
        return false;
    const std::vector<std::uint32_t> before = readTriangles(document, gltf::readPrimitive(primitive));
    return std::equal(before.begin(), before.end(), indices.begin(), indices.end());
}

// Returns the number of added vertices.
std::size_t setGroup(GltfDocument& document, const Group& group)
{
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec4> corners;
    for (std::size_t m = 0; m < group.members.size(); ++m) {
        indices.insert(indices.end(), group.triangles[m].begin(), group.triangles[m].end());
        std::ranges::transform(group.members[m]->corners, std::back_inserter(corners), withUnitTangent);
    }
    const VertexSplit split = splitVertices(group.vertexCount, indices, corners);
    const std::size_t count = split.sources.size();
    const bool copied = count > group.vertexCount;
    // Vertices without triangles get a unit vector, as glTF requires.
    std::vector<glm::vec4> values(count, glm::vec4(1, 0, 0, 1));
    for (std::size_t i = 0; i < corners.size(); ++i)
        values[split.indices[i]] = corners[i];
    const std::size_t tangents = addElements(document, values, "VEC4", sizeof(glm::vec4));

    Renewed renewed{{tangents, tangents}}; // made for the new vertices already
    std::size_t first = 0;
    for (std::size_t m = 0; m < group.members.size(); ++m) {
        Json& primitive = primitiveOf(document, *group.members[m]);
        const std::size_t length = group.triangles[m].size();
        const auto own = std::span(split.indices).subspan(first, length);
        first += length;
        if (!sameOrder(document, primitive, own))
            setTriangles(document, primitive, own, count);
        primitive["attributes"]["TANGENT"] = tangents;
        if (copied)
            renewVertices(document, primitive, primitiveField(group.members[m]->mesh, group.members[m]->primitive),
                          split.sources, renewed);
    }
    return count - group.vertexCount;
}

// ---- provoking vertices ---------------------------------------------------------------------

// Everything that determines a primitive's shape, as text. Primitives with equal text keep sharing it.
std::string drawnBy(const Json& primitive)
{
    Json drawn = Json::object();
    for (const char* const part : {"attributes", "indices", "mode", "targets"})
        drawn[part] = primitive.contains(part) ? primitive[part] : Json();
    return nlohmann::json(drawn).dump();
}

// Gives the primitive the vertices and triangles of `like`.
void drawAs(Json& primitive, const Json& like)
{
    for (const char* const part : {"attributes", "indices", "targets"})
        if (like.contains(part))
            primitive[part] = like[part];
    primitive.erase("mode");
}

// Returns zero counts, without a change, if the primitive has no triangles.
GltfProvoked provoke(GltfDocument& document, std::size_t m, std::size_t p, ProvokingVertex provoking)
{
    Json& primitive = rootOf(document)["meshes"][m]["primitives"][p];
    if (!primitive["attributes"].contains("POSITION"))
        return {};
    const auto position = primitive["attributes"]["POSITION"].get<std::size_t>();
    const auto count = rootOf(document)["accessors"][position]["count"].get<std::size_t>();
    std::vector<std::uint32_t> corners = readTriangles(document, gltf::readPrimitive(primitive));
    if (corners.empty())
        return {};
    const std::vector<std::uint32_t> used = takeUsedVertices(corners, count);
    ProvokingMesh own = provokingMesh(corners, used.size(), provoking);
    for (std::uint32_t& source : own.sources)
        source = used[source];
    setTriangles(document, primitive, own.indices, own.sources.size());
    Renewed renewed; // not shared: vertex k belongs to this primitive's triangle k
    renewVertices(document, primitive, primitiveField(m, p), own.sources, renewed);
    return {m, p, corners.size() / 3, used.size(), own.sources.size()};
}

} // namespace

Result<std::size_t> setGltfTangents(GltfDocument& document, std::span<const GltfCornerTangents> tangents)
{
    return caughtGltf(document.source->path, [&] {
        std::size_t added = 0;
        for (const Group& group : makeGroups(document, tangents))
            added += setGroup(document, group);
        return added;
    });
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
        const auto count = rootOf(document)["accessors"][tangents->get<std::size_t>()]["count"].get<std::size_t>();
        target.erase("TANGENT");
        if (!target.empty())
            continue;
        // glTF requires an attribute in every target: an empty target becomes explicit zero offsets.
        const Json zero = {0, 0, 0};
        target["POSITION"] = addItem(
            document, "accessors",
            {{"componentType", gltf::kFloat}, {"count", count}, {"type", "VEC3"}, {"min", zero}, {"max", zero}});
    }
    return true;
}

Result<std::vector<GltfProvoked>> setGltfProvoking(GltfDocument& document, ProvokingVertex provoking)
{
    return caughtGltf(document.source->path, [&] {
        std::vector<GltfProvoked> all;
        std::map<std::string, Json> done; // from the old shape of a primitive (drawnBy) to the edited primitive
        (void)forEachPrimitive(rootOf(document), [&](std::size_t m, std::size_t p) -> Status {
            Json& primitive = rootOf(document)["meshes"][m]["primitives"][p];
            const std::string drawn = drawnBy(primitive);
            if (const auto found = done.find(drawn); found != done.end()) {
                drawAs(primitive, found->second);
            } else if (const GltfProvoked row = provoke(document, m, p, provoking); row.triangles > 0) {
                done[drawn] = primitive;
                all.push_back(row);
            }
            return Done{};
        });
        return all;
    });
}

} // namespace cotan
