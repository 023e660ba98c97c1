// Elements of a document's accessors: bytes added, geometry read.
#include <numeric>

#include "cotan/vector.hpp"
#include "edit_state.hpp"
#include "scene/texture_sample.hpp"
#include "vertices.hpp"

namespace cotan {

namespace gltf_edit {

std::span<const std::byte> viewBytes(const GltfDocument& document, std::size_t view)
{
    const std::vector<gltf::ViewBytes>& old = document.source->views;
    return view < old.size() ? old[view].bytes : document.added[view - old.size()];
}

gltf::Elements elementsOf(const GltfDocument& document, const Json& accessor)
{
    const auto bytesOf = [&](std::size_t view) {
        return gltf::ViewBytes{viewBytes(document, view),
                               gltf::valueOr(rootOf(document)["bufferViews"][view], "byteStride", std::size_t(0))};
    };
    return gltf::findElements(gltf::readAccessor(accessor), bytesOf, "accessor");
}

std::vector<std::uint32_t> readTriangles(const GltfDocument& document, const gltf::Primitive& primitive)
{
    const Json& accessors = rootOf(document)["accessors"];
    const int positions = gltf::accessorOf(primitive.attributes, "POSITION");
    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
        const gltf::Elements indices = elementsOf(document, accessors[std::size_t(primitive.indices)]);
        order.resize(indices.accessor.count);
        gltf::readIntegers(indices, order.size(), 1, order.data());
    } else if (positions >= 0) {
        order.resize(accessors[std::size_t(positions)]["count"].get<std::size_t>());
        std::iota(order.begin(), order.end(), 0u);
    }
    return gltfTriangles(primitive.mode, std::move(order));
}

std::size_t addView(GltfDocument& document, std::vector<std::byte> bytes, std::size_t stride, int target)
{
    Json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
    if (stride > 0)
        view["byteStride"] = stride;
    if (target > 0)
        view["target"] = target;
    document.added.push_back(std::move(bytes));
    rootOf(document)["bufferViews"].push_back(std::move(view));
    return rootOf(document)["bufferViews"].size() - 1;
}

std::size_t addAccessor(GltfDocument& document, Json accessor)
{
    rootOf(document)["accessors"].push_back(std::move(accessor));
    return rootOf(document)["accessors"].size() - 1;
}

} // namespace gltf_edit

namespace {

// The attribute of the chosen vertices; empty where the primitive lacks it.
template<class Vector>
std::vector<Vector> readAttribute(const GltfDocument& document, const gltf::Primitive& primitive,
                                  const std::string& name, const gltf::Choice& choice, const std::string& field)
{
    const int accessor = gltf::accessorOf(primitive.attributes, name);
    if (accessor < 0)
        return {};
    return gltf::readVectors<Vector>(
        gltf_edit::elementsOf(document, rootOf(document)["accessors"][std::size_t(accessor)]), choice,
        {accessor, field + "." + name});
}

// The uv as a map reads them.
void readTexcoords(const GltfDocument& document, const gltf::Primitive& primitive, const gltf::TextureUse& map,
                   const gltf::Choice& choice, const std::string& field, GltfGeometry& out)
{
    out.texcoordSet = map.texcoord;
    out.texcoords =
        readAttribute<glm::vec2>(document, primitive, fmt::format("TEXCOORD_{}", map.texcoord), choice, field);
    for (glm::vec2& uv : out.texcoords) {
        if (!isFinite(uv))
            uv = glm::vec2(0);
        if (map.moves())
            uv = moveUv(map.uRow, map.vRow, uv);
    }
}

GltfGeometry readGeometry(const GltfDocument& document, const Json& source, const std::string& field, NormalSlot slot,
                          std::optional<std::size_t> material)
{
    gltf::Primitive primitive = gltf::readPrimitive(source);
    if (material)
        primitive.material = int(*material);
    const gltf::TextureUse map = primitive.material < 0
        ? gltf::TextureUse{}
        : normalMapOf(rootOf(document), std::size_t(primitive.material), slot);
    const int positions = gltf::accessorOf(primitive.attributes, "POSITION");
    GltfGeometry out;
    if (positions < 0) // what it may hold else has not been checked
        return out;
    out.indices = gltf_edit::readTriangles(document, primitive);
    const auto count = rootOf(document)["accessors"][std::size_t(positions)]["count"].get<std::size_t>();
    const std::vector<std::uint32_t> vertices = takeUsedVertices(out.indices, count);
    const gltf::Choice choice(count, vertices);
    out.positions = readAttribute<glm::vec3>(document, primitive, "POSITION", choice, field);
    out.normals = readAttribute<glm::vec3>(document, primitive, "NORMAL", choice, field);
    out.tangents = readAttribute<glm::vec4>(document, primitive, "TANGENT", choice, field);
    readTexcoords(document, primitive, map, choice, field, out);
    return out;
}

} // namespace

Result<GltfGeometry> gltfGeometry(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                                  NormalSlot slot, std::optional<std::size_t> material)
{
    return caughtGltf(document.source->path, [&] {
        return readGeometry(document, rootOf(document)["meshes"][mesh]["primitives"][primitive],
                            primitiveField(mesh, primitive), slot, material);
    });
}

} // namespace cotan
