// Other vertices and other triangles for a primitive: what tangents and provoking vertices have in common.
#include <algorithm>
#include <cstring>

#include "edit_state.hpp"

namespace cotan::gltf_edit {

namespace {

using Sources = std::span<const std::uint32_t>;

std::size_t strideFor(std::size_t size) { return (size + 3) / 4 * 4; }

// A view of vertex data, each element on a multiple of four bytes.
std::size_t addVertexView(GltfDocument& document, const gltf::Run& elements, std::size_t size, Sources sources)
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

// The place of a vertex among the sparse values, or their number. The indices rise.
std::size_t sparsePlace(const gltf::Elements& elements, std::uint32_t vertex)
{
    std::size_t first = 0, end = elements.sparseIndices.count;
    while (first < end) {
        const std::size_t middle = first + (end - first) / 2;
        if (elements.sparseIndex(middle) < vertex)
            first = middle + 1;
        else
            end = middle;
    }
    const bool found = first < elements.sparseIndices.count && elements.sparseIndex(first) == vertex;
    return found ? first : elements.sparseIndices.count;
}

// Puts the sparse part for the new vertices into the accessor: copies of a replaced element are replaced as well.
void renewSparse(GltfDocument& document, const gltf::Elements& old, Json& accessor, Sources sources)
{
    const std::size_t size = gltf::elementSize(old.accessor);
    std::vector<std::uint32_t> places;
    std::vector<std::byte> values;
    for (std::uint32_t i = 0; i < sources.size(); ++i) {
        const std::size_t found = sparsePlace(old, sources[i]);
        if (found == old.sparseIndices.count)
            continue;
        places.push_back(i);
        const std::byte* const from = old.sparseValues.at(found);
        values.insert(values.end(), from, from + size);
    }
    if (places.empty()) { // glTF wants one at least
        accessor.erase("sparse");
        return;
    }
    Json& sparse = accessor["sparse"];
    auto [type, bytes] = smallestIndices(places, sources.size(), true);
    sparse["count"] = places.size();
    sparse["indices"]["bufferView"] = addView(document, std::move(bytes));
    sparse["indices"]["componentType"] = type;
    sparse["values"]["bufferView"] = addView(document, std::move(values));
    sparse["indices"].erase("byteOffset");
    sparse["values"].erase("byteOffset");
}

bool allAmong(std::size_t count, Sources sources)
{
    if (sources.size() < count)
        return false;
    std::vector<bool> among(count, false);
    for (const std::uint32_t s : sources)
        among[s] = true;
    return std::find(among.begin(), among.end(), false) == among.end();
}

std::size_t renewAccessor(GltfDocument& document, std::size_t index, Sources sources)
{
    Json accessor = rootOf(document)["accessors"][index]; // a copy: adding moves the original
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
    return addAccessor(document, std::move(accessor));
}

} // namespace

void renewVertices(GltfDocument& document, Json& primitive, Sources sources, Renewed& renewed)
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
}

void noteCopied(GltfDocument& document, const Json& primitive, const std::string& field)
{
    for (const std::string& name : unknownExtensions(primitive))
        document.notes.push_back(
            fmt::format("{}: vertices were copied; its extension {} is kept as it is", field, oneLine(name)));
}

void setTriangles(GltfDocument& document, Json& primitive, std::span<const std::uint32_t> indices,
                  std::size_t vertexCount)
{
    Json accessor = Json::object();
    if (primitive.contains("indices"))
        accessor = rootOf(document)["accessors"][primitive["indices"].get<std::size_t>()];
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
    if (gltf::valueOr(primitive, "mode", gltf::kTriangles) != gltf::kTriangles)
        primitive.erase("mode"); // a list now
}

} // namespace cotan::gltf_edit
