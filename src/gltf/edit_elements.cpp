// Elements of accessors, read and added by their bytes.
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <type_traits>

#include "edit_state.hpp"
#include "vertices.hpp"

namespace cotan {

namespace gltf_edit {

namespace {

enum : int { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125 };

std::size_t componentSize(int type)
{
    return type == kByte || type == kUnsignedByte ? 1
        : type == kShort || type == kUnsignedShort ? 2
                                                   : 4;
}

std::size_t componentCount(const std::string& type)
{
    if (type == "SCALAR")
        return 1;
    const auto n = static_cast<std::size_t>(type.back() - '0');
    return type.starts_with("MAT") ? n * n : n;
}

// `count` elements of `size` bytes, `stride` apart, from `offset` of a view.
std::vector<std::byte> packed(std::span<const std::byte> view, std::size_t offset,
                              std::size_t stride, std::size_t size, std::size_t count)
{
    std::vector<std::byte> bytes(size * count);
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(bytes.data() + i * size, view.data() + offset + i * stride, size);
    return bytes;
}

std::uint32_t indexAt(const std::byte* at, std::size_t size)
{
    std::uint32_t index = 0;
    std::memcpy(&index, at, size); // little-endian, as the file
    return index;
}

std::vector<std::byte> allElements(const GltfDocument& document, const OrderedJson& accessor)
{
    std::vector<std::byte> bytes = baseElements(document, accessor);
    const SparseElements sparse = sparseElements(document, accessor);
    const std::size_t size = elementSize(accessor);
    for (std::size_t i = 0; i < sparse.places.size(); ++i)
        std::memcpy(bytes.data() + sparse.places[i] * size, sparse.values.data() + i * size, size);
    return bytes;
}

template<class Stored> float toFloat(const std::byte* at, bool normalized)
{
    Stored stored;
    std::memcpy(&stored, at, sizeof stored);
    const auto value = static_cast<float>(stored);
    if (std::is_same_v<Stored, float> || !normalized)
        return value;
    return std::max(value / static_cast<float>(std::numeric_limits<Stored>::max()), -1.0f);
}

float component(const std::byte* at, int type, bool normalized)
{
    switch (type) {
    case kByte: return toFloat<std::int8_t>(at, normalized);
    case kUnsignedByte: return toFloat<std::uint8_t>(at, normalized);
    case kShort: return toFloat<std::int16_t>(at, normalized);
    case kUnsignedShort: return toFloat<std::uint16_t>(at, normalized);
    case kUnsignedInt: return toFloat<std::uint32_t>(at, normalized);
    default: return toFloat<float>(at, normalized);
    }
}

// Elements of an accessor where they lie. first: null where there is no view.
struct Elements {
    const std::byte* first = nullptr;
    std::size_t stride = 0;

    const std::byte* at(std::size_t i) const { return first + i * stride; }
};

// part: an accessor, or the indices or values of a sparse one, which are always packed.
Elements elementsAt(const GltfDocument& document, const OrderedJson& part, std::size_t size, bool packed)
{
    if (!part.contains("bufferView"))
        return {};
    const auto view = part["bufferView"].get<std::size_t>();
    const std::size_t stride = packed ? 0 : sizeOr(document.root["bufferViews"][view], "byteStride", 0);
    return {viewBytes(document, view).data() + sizeOr(part, "byteOffset", 0), stride > 0 ? stride : size};
}

// The sparse values of an accessor; the reader has checked that their indices rise.
struct SparseValues {
    std::size_t count = 0, indexSize = 0;
    Elements indices, values;

    SparseValues(const GltfDocument& document, const OrderedJson& accessor)
    {
        if (!accessor.contains("sparse"))
            return;
        const OrderedJson& sparse = accessor["sparse"];
        count = sparse["count"].get<std::size_t>();
        indexSize = componentSize(sparse["indices"]["componentType"].get<int>());
        indices = elementsAt(document, sparse["indices"], indexSize, /*packed*/ true);
        values = elementsAt(document, sparse["values"], elementSize(accessor), /*packed*/ true);
    }

    // The value that replaces an element; null if none does.
    const std::byte* find(std::uint32_t element) const
    {
        std::size_t low = 0, high = count;
        while (low < high) {
            const std::size_t middle = low + (high - low) / 2;
            if (indexAt(indices.at(middle), indexSize) < element)
                low = middle + 1;
            else
                high = middle;
        }
        return low < count && indexAt(indices.at(low), indexSize) == element ? values.at(low) : nullptr;
    }
};

// The attribute of these vertices; empty where the primitive lacks it.
template<class Vector>
std::vector<Vector> readVectors(const GltfDocument& document, const OrderedJson& primitive,
                                const std::string& attribute, std::span<const std::uint32_t> vertices)
{
    const OrderedJson& attributes = primitive["attributes"];
    if (!attributes.contains(attribute))
        return {};
    const OrderedJson& a = document.root["accessors"][attributes[attribute].get<std::size_t>()];
    const int type = a["componentType"];
    const bool normalized = a.value("normalized", false);
    const std::size_t step = componentSize(type);
    const Elements base = elementsAt(document, a, elementSize(a), /*packed*/ false);
    const SparseValues sparse(document, a);
    std::vector<Vector> out(vertices.size(), Vector(0));
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::byte* const replaced = sparse.find(vertices[i]);
        const std::byte* const from = replaced || !base.first ? replaced : base.at(vertices[i]);
        for (int c = 0; from && c < Vector::length(); ++c)
            out[i][c] = component(from + std::size_t(c) * step, type, normalized);
    }
    return out;
}

// The reader's order of corners: see gltf_primitive.cpp. Triangles of a strip or fan that join two
// equal vertices serve to jump and are left out.
std::vector<std::uint32_t> unroll(bool fan, const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {
        const std::uint32_t a = order[fan ? i + 1 : i];
        const std::uint32_t b = order[fan ? i + 2 : i + 1 + i % 2];
        const std::uint32_t c = order[fan ? 0 : i + 2 - i % 2];
        if (a != b && b != c && c != a)
            triangles.insert(triangles.end(), {a, b, c});
    }
    return triangles;
}

const OrderedJson* find(const OrderedJson& object, std::initializer_list<const char*> path)
{
    const OrderedJson* at = &object;
    for (const char* const member : path) {
        const auto found = at->find(member);
        if (found == at->end())
            return nullptr;
        at = &*found;
    }
    return at;
}

// The uv as the material's normal map reads them; uv set 0 where there is no normal map.
void readTexcoords(const GltfDocument& document, const OrderedJson& primitive,
                   std::span<const std::uint32_t> vertices, GltfGeometry& out)
{
    const OrderedJson* map = nullptr;
    if (primitive.contains("material"))
        map = find(document.root["materials"][primitive["material"].get<std::size_t>()],
                   {"normalTexture"});
    const OrderedJson* const transform =
        map ? find(*map, {"extensions", "KHR_texture_transform"}) : nullptr;
    out.texcoordSet = map ? map->value("texCoord", 0) : 0;
    if (transform)
        out.texcoordSet = transform->value("texCoord", out.texcoordSet);
    out.texcoords = readVectors<glm::vec2>(document, primitive,
                                           fmt::format("TEXCOORD_{}", out.texcoordSet), vertices);
    for (glm::vec2& uv : out.texcoords)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            uv = glm::vec2(0);
    if (!transform)
        return;
    const auto pair = [&](const char* name, double fallback) {
        const OrderedJson* const p = find(*transform, {name});
        return p ? glm::dvec2((*p)[0].get<double>(), (*p)[1].get<double>()) : glm::dvec2(fallback);
    };
    const glm::dvec2 offset = pair("offset", 0), scale = pair("scale", 1);
    const double turn = transform->value("rotation", 0.0), c = std::cos(turn), s = std::sin(turn);
    for (glm::vec2& uv : out.texcoords) { // scale, then turn, then shift
        const glm::dvec2 scaled = glm::dvec2(uv) * scale;
        uv = glm::vec2(c * scaled.x + s * scaled.y + offset.x,
                       -s * scaled.x + c * scaled.y + offset.y);
    }
}

} // namespace

std::span<const std::byte> viewBytes(const GltfDocument& document, std::size_t view)
{
    const std::size_t old = countOf(document.source->root, "bufferViews");
    if (view >= old)
        return document.added[view - old];
    const OrderedJson& v = document.source->root["bufferViews"][view];
    return document.source->file.buffers[v["buffer"].get<std::size_t>()].subspan(
        sizeOr(v, "byteOffset", 0), v["byteLength"].get<std::size_t>());
}

std::size_t elementSize(const OrderedJson& accessor)
{
    const std::size_t size = componentSize(accessor["componentType"].get<int>());
    const auto& type = accessor["type"].get_ref<const std::string&>();
    if (type == "MAT2" && size == 1)
        return 8; // columns begin at multiples of four bytes
    if (type == "MAT3" && size < 4)
        return size == 1 ? 12 : 24;
    return size * componentCount(type);
}

std::vector<std::byte> baseElements(const GltfDocument& document, const OrderedJson& accessor)
{
    const std::size_t size = elementSize(accessor), count = accessor["count"].get<std::size_t>();
    if (!accessor.contains("bufferView"))
        return std::vector<std::byte>(size * count);
    const auto view = accessor["bufferView"].get<std::size_t>();
    const std::size_t stride = sizeOr(document.root["bufferViews"][view], "byteStride", 0);
    return packed(viewBytes(document, view), sizeOr(accessor, "byteOffset", 0),
                  stride > 0 ? stride : size, size, count);
}

SparseElements sparseElements(const GltfDocument& document, const OrderedJson& accessor)
{
    if (!accessor.contains("sparse"))
        return {};
    const OrderedJson& sparse = accessor["sparse"];
    const auto count = sparse["count"].get<std::size_t>();
    const auto part = [&](const char* name, std::size_t size) {
        const OrderedJson& p = sparse[name];
        return packed(viewBytes(document, p["bufferView"].get<std::size_t>()),
                      sizeOr(p, "byteOffset", 0), size, size, count);
    };
    const std::size_t indexSize = componentSize(sparse["indices"]["componentType"].get<int>());
    const std::vector<std::byte> indices = part("indices", indexSize);
    SparseElements out{std::vector<std::uint32_t>(count), part("values", elementSize(accessor))};
    for (std::size_t i = 0; i < count; ++i)
        out.places[i] = indexAt(indices.data() + i * indexSize, indexSize);
    return out;
}

std::vector<std::uint32_t> readIndices(const GltfDocument& document, const OrderedJson& accessor)
{
    const std::size_t size = elementSize(accessor);
    const std::vector<std::byte> bytes = allElements(document, accessor);
    std::vector<std::uint32_t> indices(bytes.size() / size);
    for (std::size_t i = 0; i < indices.size(); ++i)
        indices[i] = indexAt(bytes.data() + i * size, size);
    return indices;
}

std::vector<std::uint32_t> readTriangles(const GltfDocument& document, const OrderedJson& primitive)
{
    const OrderedJson& accessors = document.root["accessors"];
    std::vector<std::uint32_t> order;
    if (primitive.contains("indices")) {
        order = readIndices(document, accessors[primitive["indices"].get<std::size_t>()]);
    } else if (primitive["attributes"].contains("POSITION")) {
        const OrderedJson& a = accessors[primitive["attributes"]["POSITION"].get<std::size_t>()];
        order.resize(a["count"].get<std::size_t>());
        std::iota(order.begin(), order.end(), 0u);
    }
    const int mode = primitive.value("mode", 4);
    if (mode == 5 || mode == 6)
        return unroll(mode == 6, order);
    order.resize(mode == 4 ? order.size() / 3 * 3 : 0);
    return order;
}

std::size_t addView(GltfDocument& document, std::vector<std::byte> bytes, std::size_t stride,
                    int target)
{
    OrderedJson view = {{"buffer", 0}, {"byteLength", bytes.size()}};
    if (stride > 0)
        view["byteStride"] = stride;
    if (target > 0)
        view["target"] = target;
    document.added.push_back(std::move(bytes));
    document.root["bufferViews"].push_back(std::move(view));
    return document.root["bufferViews"].size() - 1;
}

std::size_t addAccessor(GltfDocument& document, OrderedJson accessor)
{
    document.root["accessors"].push_back(std::move(accessor));
    return document.root["accessors"].size() - 1;
}

void refuseCompressed(const OrderedJson& primitive, const std::string& field)
{
    const auto extensions = primitive.find("extensions");
    if (extensions != primitive.end() && extensions->contains("KHR_draco_mesh_compression"))
        failGltf("{}: its geometry is compressed (KHR_draco_mesh_compression); expected plain "
                 "buffers",
                 field);
}

} // namespace gltf_edit

Result<GltfGeometry> gltfGeometry(const GltfDocument& document, std::size_t mesh,
                                  std::size_t primitive)
{
    using namespace gltf_edit;
    const OrderedJson& p = document.root["meshes"][mesh]["primitives"][primitive];
    try {
        refuseCompressed(p, fmt::format("meshes[{}].primitives[{}]", mesh, primitive));
    } catch (const GltfProblem& problem) {
        return inputError(document.source->path.string() + ": " + problem.message);
    }
    GltfGeometry out;
    if (!p["attributes"].contains("POSITION")) // what it may hold else has not been checked
        return out;
    out.indices = readTriangles(document, p);
    const auto accessor = p["attributes"]["POSITION"].get<std::size_t>();
    const std::vector<std::uint32_t> vertices = takeUsedVertices(
        out.indices, document.root["accessors"][accessor]["count"].get<std::size_t>());
    out.positions = readVectors<glm::vec3>(document, p, "POSITION", vertices);
    out.normals = readVectors<glm::vec3>(document, p, "NORMAL", vertices);
    out.tangents = readVectors<glm::vec4>(document, p, "TANGENT", vertices);
    readTexcoords(document, p, vertices, out);
    return out;
}

} // namespace cotan
