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

constexpr int kFloat = 5126;

std::string fieldOf(std::size_t mesh, std::size_t primitive)
{
    return fmt::format("meshes[{}].primitives[{}]", mesh, primitive);
}

// Primitives that share all attributes, and so their vertices.
struct Group {
    std::vector<const GltfCornerTangents*> members;
    std::vector<std::vector<std::uint32_t>> triangles; // of each member
    std::size_t vertexCount = 0;
};

OrderedJson& primitiveOf(GltfDocument& document, const GltfCornerTangents& t)
{
    return document.root["meshes"][t.mesh]["primitives"][t.primitive];
}

// What two primitives have in common if they share vertices, as text.
std::string sharedKey(const OrderedJson& primitive)
{
    OrderedJson attributes = primitive["attributes"];
    attributes.erase("TANGENT");
    OrderedJson targets = primitive.value("targets", OrderedJson::array());
    return nlohmann::json(attributes).dump() + nlohmann::json(targets).dump();
}

std::vector<Group> makeGroups(GltfDocument& document, std::span<const GltfCornerTangents> tangents)
{
    std::map<std::string, std::size_t> known;
    std::vector<Group> groups;
    for (const GltfCornerTangents& t : tangents) {
        const OrderedJson& primitive = primitiveOf(document, t);
        const std::string field = fieldOf(t.mesh, t.primitive);
        refuseCompressed(primitive, field);
        const OrderedJson& attributes = primitive["attributes"];
        for (const char* const needed : {"POSITION", "NORMAL"})
            if (!attributes.contains(needed))
                failGltf("{}: expected {}, without which glTF gives TANGENT no meaning", field,
                         needed);
        const auto [place, isNew] = known.emplace(sharedKey(primitive), groups.size());
        if (isNew)
            groups.emplace_back().vertexCount =
                document.root["accessors"][attributes["POSITION"].get<std::size_t>()]["count"];
        Group& group = groups[place->second];
        group.members.push_back(&t);
        group.triangles.push_back(readTriangles(document, primitive));
        if (group.triangles.back().size() != t.corners.size())
            throw Error{ErrorKind::usage,
                        fmt::format("{}: expected {} corner tangents, found {}", field,
                                    group.triangles.back().size(), t.corners.size())};
    }
    return groups;
}

// ---- attributes -----------------------------------------------------------------------------

std::size_t strideFor(std::size_t size) { return (size + 3) / 4 * 4; }

// A view of vertex data, each element on a multiple of four bytes.
std::size_t addVertexView(GltfDocument& document, const std::vector<std::byte>& elements,
                          std::size_t size, std::span<const std::uint32_t> sources)
{
    const std::size_t stride = strideFor(size);
    std::vector<std::byte> bytes(stride * sources.size());
    for (std::size_t i = 0; i < sources.size(); ++i)
        std::memcpy(bytes.data() + i * stride, elements.data() + sources[i] * size, size);
    return addView(document, std::move(bytes), stride, kArrayBuffer);
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
std::pair<int, std::vector<std::byte>> smallestIndices(std::span<const std::uint32_t> values,
                                                       std::size_t count, bool bytesToo)
{
    if (count <= 0xff && bytesToo)
        return {5121, asBytes<std::uint8_t>(values)};
    if (count <= 0xffff)
        return {5123, asBytes<std::uint16_t>(values)};
    return {5125, asBytes<std::uint32_t>(values)};
}

// The sparse part for the new vertices: copies of a replaced element are replaced as well.
OrderedJson splitSparse(GltfDocument& document, const OrderedJson& accessor,
                        const std::vector<std::uint32_t>& sources)
{
    const SparseElements old = sparseElements(document, accessor);
    std::map<std::uint32_t, std::size_t> valueOf;
    for (std::size_t i = 0; i < old.places.size(); ++i)
        valueOf[old.places[i]] = i;
    const std::size_t size = elementSize(accessor);
    std::vector<std::uint32_t> places;
    std::vector<std::byte> values;
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        const auto found = valueOf.find(sources[i]);
        if (found == valueOf.end())
            continue;
        places.push_back(i);
        const std::byte* const from = old.values.data() + found->second * size;
        values.insert(values.end(), from, from + size);
    }
    auto [type, bytes] = smallestIndices(places, sources.size(), true);
    OrderedJson sparse = accessor["sparse"];
    sparse["count"] = places.size();
    sparse["indices"]["bufferView"] = addView(document, std::move(bytes));
    sparse["indices"]["componentType"] = type;
    sparse["values"]["bufferView"] = addView(document, std::move(values));
    sparse["indices"].erase("byteOffset");
    sparse["values"].erase("byteOffset");
    return sparse;
}

// The accessor for the new vertices. All old ones are among them, so min and max stay.
std::size_t splitAccessor(GltfDocument& document, std::size_t index,
                          const std::vector<std::uint32_t>& sources)
{
    OrderedJson accessor = document.root["accessors"][index]; // a copy: adding moves the original
    if (accessor.contains("sparse"))
        accessor["sparse"] = splitSparse(document, accessor, sources);
    if (accessor.contains("bufferView")) {
        accessor["bufferView"] = addVertexView(document, baseElements(document, accessor),
                                               elementSize(accessor), sources);
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
    const std::size_t view =
        addView(document, std::move(bytes), sizeof(glm::vec4), kArrayBuffer);
    return addAccessor(document, {{"bufferView", view},
                                  {"componentType", kFloat},
                                  {"count", values.size()},
                                  {"type", "VEC4"}});
}

void setTriangles(GltfDocument& document, OrderedJson& primitive,
                  std::span<const std::uint32_t> indices, std::size_t vertexCount)
{
    // Bytes only where the file had them: some hardware is slow with them.
    const bool hadBytes = primitive.contains("indices")
        && document.root["accessors"][primitive["indices"].get<std::size_t>()]["componentType"]
            == 5121;
    auto [type, bytes] = smallestIndices(indices, vertexCount, hadBytes);
    OrderedJson accessor = OrderedJson::object();
    if (primitive.contains("indices"))
        accessor = document.root["accessors"][primitive["indices"].get<std::size_t>()];
    for (const char* const gone : {"byteOffset", "sparse", "min", "max"})
        accessor.erase(gone);
    accessor["bufferView"] = addView(document, std::move(bytes), 0, kElementArrayBuffer);
    accessor["componentType"] = type;
    accessor["count"] = indices.size();
    accessor["type"] = "SCALAR";
    primitive["indices"] = addAccessor(document, std::move(accessor));
}

bool sameOrder(const GltfDocument& document, const OrderedJson& primitive,
               std::span<const std::uint32_t> indices)
{
    if (primitive.value("mode", 4) != 4)
        return false;
    const std::vector<std::uint32_t> before = readTriangles(document, primitive);
    return std::equal(before.begin(), before.end(), indices.begin(), indices.end());
}

// Replaces every accessor that a map of attributes names; each is copied once.
void splitAttributes(GltfDocument& document, OrderedJson& attributes,
                     const std::vector<std::uint32_t>& sources,
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
void splitTargets(GltfDocument& document, OrderedJson& primitive,
                  const std::vector<std::uint32_t>& sources,
                  std::map<std::size_t, std::size_t>& copies)
{
    if (!primitive.contains("targets"))
        return;
    for (OrderedJson& target : primitive["targets"])
        for (OrderedJson& index : target) {
            const auto old = index.get<std::size_t>();
            if (!copies.contains(old))
                copies[old] = splitAccessor(document, old, sources);
            index = copies[old];
        }
}

void noteExtensions(GltfDocument& document, const OrderedJson& primitive, const std::string& field)
{
    for (const std::string& name : unknownExtensions(primitive))
        document.notes.push_back(fmt::format(
            "{}: vertices were copied; its extension {} is kept as it is", field, oneLine(name)));
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
        OrderedJson& primitive = primitiveOf(document, *group.members[m]);
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
            noteExtensions(document, primitive,
                           fieldOf(group.members[m]->mesh, group.members[m]->primitive));
        }
    }
    return count - group.vertexCount;
}

// glTF wants a target to have some attribute: one without any becomes an explicit "no change".
void fillEmptyTarget(GltfDocument& document, const OrderedJson& primitive, OrderedJson& target)
{
    const auto positions = primitive["attributes"]["POSITION"].get<std::size_t>();
    const OrderedJson zero = {0, 0, 0};
    target["POSITION"] = addAccessor(
        document, {{"componentType", kFloat},
                   {"count", document.root["accessors"][positions]["count"]},
                   {"type", "VEC3"},
                   {"min", zero},
                   {"max", zero}});
}

} // namespace

Result<std::size_t> setGltfTangents(GltfDocument& document,
                                    std::span<const GltfCornerTangents> tangents)
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

Result<bool> dropGltfTangents(GltfDocument& document, std::size_t mesh, std::size_t primitive)
{
    OrderedJson& p = document.root["meshes"][mesh]["primitives"][primitive];
    try {
        if (!p["attributes"].contains("TANGENT"))
            return false;
        refuseCompressed(p, fieldOf(mesh, primitive));
    } catch (const GltfProblem& problem) {
        return inputError(document.source->path.string() + ": " + problem.message);
    }
    p["attributes"].erase("TANGENT");
    if (p.contains("targets"))
        for (OrderedJson& target : p["targets"])
            if (target.erase("TANGENT") > 0 && target.empty())
                fillEmptyTarget(document, p, target);
    return true;
}

} // namespace cotan
