// Accessors of a file to arrays: every offset, stride and count is checked once, then read without doubt.
#include <set>

#include "gltf_model.hpp"

namespace cotan {

using gltf::Accessor, gltf::Choice, gltf::Elements, gltf::ElementType;

namespace {

const Accessor& accessorAt(const GltfModel& model, int accessor)
{
    return model.accessors[static_cast<std::size_t>(accessor)].accessor;
}

// Accessors that serve as nothing but texture coordinates: there a NaN is replaced, not refused.
std::set<int> texcoordAccessors(const gltf::Structure& structure)
{
    std::set<int> texcoords;
    std::set<int> others;
    for (const gltf::Mesh& mesh : structure.meshes)
        for (const gltf::Primitive& primitive : mesh.primitives)
            for (const auto& [name, accessor] : primitive.attributes)
                (name.starts_with("TEXCOORD_") ? texcoords : others).insert(accessor);
    for (const int accessor : others)
        texcoords.erase(accessor);
    return texcoords;
}

void findViews(GltfModel& model)
{
    std::size_t i = 0;
    model.views = gltf::readAll(&model.file.json, "bufferViews", [&](const gltf::Json& json) {
        const gltf::BufferView v = gltf::readBufferView(json);
        const std::span<const std::byte> buffer = model.file.buffers[v.buffer];
        if (v.offset + v.length > buffer.size())
            failGltf("bufferViews[{}]: it ends at byte {} of buffers[{}], which has {}", i, v.offset + v.length,
                     v.buffer, buffer.size());
        ++i;
        return gltf::ViewBytes{buffer.subspan(v.offset, v.length), v.stride};
    });
}

template<class T>
std::vector<T> makeArray(GltfModel& model, std::size_t count, const T& value, const std::string& field)
{
    takeGltfBytes(model, count * sizeof(T), field);
    return std::vector<T>(count, value);
}

} // namespace

void findGltfAccessors(GltfModel& model)
{
    findViews(model);
    const std::set<int> texcoords = texcoordAccessors(model.structure);
    // Accessors without a view are zeros that cost the file nothing, and many may share one view:
    // what they add up to bounds memory and time. Counts are below 2^53 and elements at most 64
    // bytes, so one of them overflows nothing.
    const std::size_t most = gltfAllowance(model);
    std::size_t total = 0, i = 0;
    model.accessors = gltf::readAll(&model.file.json, "accessors", [&](const gltf::Json& json) {
        const std::string field = fmt::format("accessors[{}]", i);
        const Accessor a = gltf::readAccessor(json);
        Elements elements = gltf::findElements(
            a, [&](std::size_t view) { return model.views[view]; }, field);
        total += a.count * gltf::elementSize(a);
        if (total > most)
            failGltf("{}: the accessors take {} bytes with it, the limit is {} for a file of {}", field, total, most,
                     model.file.size);
        gltf::checkSparse(elements, field);
        if (!texcoords.contains(static_cast<int>(i++)))
            gltf::checkFinite(elements, field);
        return elements;
    });
}

std::vector<glm::vec4> readGltfColors(GltfModel& model, int accessor, const Choice& choice, const std::string& field)
{
    if (accessorAt(model, accessor).type != ElementType::vec3)
        return readGltfVectors<glm::vec4>(model, accessor, choice, field);
    std::vector<glm::vec4> colors;
    colors.reserve(choice.size());
    for (const glm::vec3& c : readGltfVectors<glm::vec3>(model, accessor, choice, field))
        colors.emplace_back(c, 1.0f);
    return colors;
}

std::vector<glm::uvec4> readGltfJoints(GltfModel& model, int accessor, const Choice& choice, const std::string& field)
{
    const Accessor& a = accessorAt(model, accessor);
    gltf::expectElements(a, ElementType::vec4, choice.count, {accessor, field});
    if (a.componentType != gltf::kUnsignedByte && a.componentType != gltf::kUnsignedShort)
        failGltf("{}: expected bytes or shorts in accessors[{}], found {}", field, accessor,
                 gltf::nameOfComponent(a.componentType));
    std::vector<glm::uvec4> joints = makeArray(model, choice.size(), glm::uvec4(0), field);
    if (!joints.empty())
        gltf::readIntegers(model.accessors[std::size_t(accessor)], choice, 4, &joints[0].x);
    return joints;
}

std::vector<glm::mat4> readGltfMatrices(GltfModel& model, int accessor, std::size_t count, const std::string& field)
{
    const Accessor& a = accessorAt(model, accessor);
    if (a.type != ElementType::mat4 || a.componentType != gltf::kFloat)
        failGltf("{}: expected MAT4 of floats in accessors[{}], found {} of {}", field, accessor, gltf::nameOf(a.type),
                 gltf::nameOfComponent(a.componentType));
    if (a.count < count)
        failGltf("{}: expected {} matrices in accessors[{}], found {}", field, count, accessor, a.count);
    std::vector<glm::mat4> matrices = makeArray(model, count, glm::mat4(0), field);
    if (count > 0)
        gltf::readFloats(model.accessors[std::size_t(accessor)], count, 16, &matrices[0][0].x);
    return matrices;
}

std::vector<std::uint32_t> readGltfIndices(GltfModel& model, int accessor, std::size_t vertexCount,
                                           const std::string& field)
{
    const Accessor& a = accessorAt(model, accessor);
    gltf::expectIndices(a, {accessor, field});
    if (a.view < 0)
        failGltf("{}: expected accessors[{}] with a bufferView, found none", field, accessor);
    if (a.count > model.limits.triangles * 3)
        failGltf("{}: the limit is {} indices, found {}", field, model.limits.triangles * 3, a.count);
    std::vector<std::uint32_t> indices = makeArray(model, a.count, std::uint32_t(0), field);
    gltf::readIntegers(model.accessors[std::size_t(accessor)], a.count, 1, indices.data());
    const std::uint32_t restart = 0xFFFFFFFFu >> (32 - 8 * gltf::componentSize(a.componentType));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] == restart)
            failGltf("{}: index {} is {}, the primitive restart value, which glTF forbids", field, i, restart);
        if (indices[i] >= vertexCount)
            failGltf("{}: index {} is {}, but there are {} vertices", field, i, indices[i], vertexCount);
    }
    return indices;
}

} // namespace cotan
