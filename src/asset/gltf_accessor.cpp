// Accessors to arrays: every offset, stride and count is checked once, then read without doubt.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <type_traits>

#include "gltf_model.hpp"

namespace cotan {

namespace {

std::size_t componentSize(int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    default: return 4;
    }
}

const char* componentName(int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return "signed bytes";
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return "bytes";
    case TINYGLTF_COMPONENT_TYPE_SHORT: return "signed shorts";
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return "shorts";
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return "unsigned integers";
    default: return "floats";
    }
}

const char* elementName(int type)
{
    switch (type) {
    case TINYGLTF_TYPE_SCALAR: return "SCALAR";
    case TINYGLTF_TYPE_VEC2: return "VEC2";
    case TINYGLTF_TYPE_VEC3: return "VEC3";
    case TINYGLTF_TYPE_VEC4: return "VEC4";
    case TINYGLTF_TYPE_MAT2: return "MAT2";
    case TINYGLTF_TYPE_MAT3: return "MAT3";
    default: return "MAT4";
    }
}

std::size_t componentCount(const tinygltf::Accessor& a)
{
    return static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type)));
}

// Columns of matrices of bytes and shorts are padded to four bytes.
std::size_t elementSize(const tinygltf::Accessor& a)
{
    const std::size_t size = componentSize(a.componentType);
    if (a.type == TINYGLTF_TYPE_MAT2 && size == 1)
        return 8;
    if (a.type == TINYGLTF_TYPE_MAT3 && size < 4)
        return size == 1 ? 12 : 24;
    return size * componentCount(a);
}

// A run of equally spaced elements.
struct Run {
    const std::byte* first = nullptr; // null: all zero
    std::size_t stride = 0;
    std::size_t count = 0;
};

// Checks that `count` elements lie in the view. All numbers come from the JSON and are below 2^53,
// strides at most 252, so nothing here overflows 64 bits.
Run runIn(const GltfModel& model, int view, std::size_t offset, std::size_t stride,
          std::size_t size, std::size_t count, const std::string& field)
{
    const std::span<const std::byte> bytes = gltfView(model, view);
    if (stride < size)
        failGltf("{}: expected a stride of at least {} bytes, found {}", field, size, stride);
    if (count > 0 && offset + stride * (count - 1) + size > bytes.size())
        failGltf("{}: {} elements end at byte {} of bufferViews[{}], which has {}", field, count,
                 offset + stride * (count - 1) + size, view, bytes.size());
    return {bytes.data() + std::min(offset, bytes.size()), stride, count};
}

Run denseRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    if (a.bufferView < 0)
        return {nullptr, 0, a.count};
    const std::size_t stride =
        model.tiny.bufferViews[static_cast<std::size_t>(a.bufferView)].byteStride;
    const std::size_t size = elementSize(a);
    return runIn(model, a.bufferView, a.byteOffset, stride > 0 ? stride : size, size, a.count,
                 field);
}

Run sparseIndexRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    const std::size_t size = componentSize(a.sparse.indices.componentType);
    return runIn(model, a.sparse.indices.bufferView,
                 static_cast<std::size_t>(a.sparse.indices.byteOffset), size, size,
                 static_cast<std::size_t>(a.sparse.count), field + ".sparse.indices");
}

Run sparseValueRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    const std::size_t size = elementSize(a);
    return runIn(model, a.sparse.values.bufferView,
                 static_cast<std::size_t>(a.sparse.values.byteOffset), size, size,
                 static_cast<std::size_t>(a.sparse.count), field + ".sparse.values");
}

std::uint32_t readIndex(const std::byte* at, int componentType)
{
    std::uint32_t value = 0;
    std::memcpy(&value, at, componentSize(componentType)); // little-endian, as the file
    return value;
}

void checkSparse(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    if (static_cast<std::size_t>(a.sparse.count) > a.count)
        failGltf("{}.sparse.count: expected at most {}, the accessor's count, found {}", field,
                 a.count, a.sparse.count);
    const Run run = sparseIndexRun(model, a, field);
    sparseValueRun(model, a, field);
    for (std::size_t i = 0; i < run.count; ++i) {
        const std::uint32_t at =
            readIndex(run.first + i * run.stride, a.sparse.indices.componentType);
        if (at >= a.count)
            failGltf("{}.sparse.indices[{}]: expected an index below {}, found {}", field, i,
                     a.count, at);
    }
}

void checkFinite(const Run& run, std::size_t components, const std::string& field)
{
    if (!run.first)
        return;
    for (std::size_t i = 0; i < run.count; ++i) {
        for (std::size_t c = 0; c < components; ++c) {
            float x = 0;
            std::memcpy(&x, run.first + i * run.stride + c * sizeof x, sizeof x);
            if (!std::isfinite(x))
                failGltf("{}: expected finite numbers, found {} in element {}", field, x, i);
        }
    }
}

// Accessors that serve as nothing but texture coordinates: there a NaN is replaced, not refused.
std::set<int> texcoordAccessors(const tinygltf::Model& model)
{
    std::set<int> texcoords;
    std::set<int> others;
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            for (const auto& [name, accessor] : primitive.attributes)
                (name.starts_with("TEXCOORD_") ? texcoords : others).insert(accessor);
    for (const int accessor : others)
        texcoords.erase(accessor);
    return texcoords;
}

// ---- conversion -----------------------------------------------------------------------------

template<class Out, class Stored> Out convert(Stored value, bool normalized)
{
    if constexpr (std::is_same_v<Stored, float> || !std::is_same_v<Out, float>)
        return static_cast<Out>(value);
    else if (!normalized)
        return static_cast<float>(value);
    else
        return std::max(static_cast<float>(value)
                            / static_cast<float>(std::numeric_limits<Stored>::max()),
                        -1.0f);
}

// Converts one element after the other; `place` says where the i-th goes, null: nowhere.
template<class Stored, class Out, class Place>
void convertRun(const Run& run, std::size_t components, bool normalized, const Place& place)
{
    for (std::size_t i = 0; i < run.count; ++i) {
        Out* const to = place(i);
        if (!to)
            continue;
        const std::byte* const from = run.first + i * run.stride;
        for (std::size_t c = 0; c < components; ++c) {
            Stored stored;
            std::memcpy(&stored, from + c * sizeof stored, sizeof stored);
            to[c] = convert<Out>(stored, normalized);
        }
    }
}

template<class Out, class Place>
void convertAny(const Run& run, const tinygltf::Accessor& a, std::size_t components,
                const Place& place)
{
    switch (a.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return convertRun<std::int8_t, Out>(run, components, a.normalized, place);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return convertRun<std::uint8_t, Out>(run, components, a.normalized, place);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return convertRun<std::int16_t, Out>(run, components, a.normalized, place);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return convertRun<std::uint16_t, Out>(run, components, a.normalized, place);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return convertRun<std::uint32_t, Out>(run, components, a.normalized, place);
    default: return convertRun<float, Out>(run, components, a.normalized, place);
    }
}

// The accessor's first `count` elements into an array whose elements have room for `room` numbers.
template<class Out>
void readElements(const GltfModel& model, const tinygltf::Accessor& a, std::size_t room, Out* out,
                  std::size_t count, const std::string& field)
{
    const std::size_t components = componentCount(a);
    Run run = denseRun(model, a, field);
    run.count = std::min(run.count, count);
    if (run.first)
        convertAny<Out>(run, a, components, [&](std::size_t i) { return out + i * room; });
    if (!a.sparse.isSparse)
        return;
    const Run indices = sparseIndexRun(model, a, field);
    convertAny<Out>(sparseValueRun(model, a, field), a, components, [&](std::size_t i) {
        const std::uint32_t at =
            readIndex(indices.first + i * indices.stride, a.sparse.indices.componentType);
        return at < count ? out + at * room : nullptr;
    });
}

const tinygltf::Accessor& expectElements(const GltfModel& model, int accessor, int type,
                                         std::size_t count, const std::string& field)
{
    const tinygltf::Accessor& a = model.tiny.accessors[static_cast<std::size_t>(accessor)];
    if (a.type != type)
        failGltf("{}: expected accessors[{}] of type {}, found {}", field, accessor,
                 elementName(type), elementName(a.type));
    if (a.count != count)
        failGltf("{}: expected accessors[{}] with {} elements, found {}", field, accessor, count,
                 a.count);
    return a;
}

template<class Vector>
std::vector<Vector> readVectors(const GltfModel& model, int accessor, int type, std::size_t count,
                                const std::string& field)
{
    const tinygltf::Accessor& a = expectElements(model, accessor, type, count, field);
    if (a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        failGltf("{}: expected floats, bytes or shorts in accessors[{}], found {}", field, accessor,
                 componentName(a.componentType));
    std::vector<Vector> out(a.count, Vector(0));
    if (a.count > 0)
        readElements(model, a, static_cast<std::size_t>(Vector::length()), &out[0].x, a.count,
                     field);
    return out;
}

} // namespace

std::span<const std::byte> gltfView(const GltfModel& model, int view)
{
    const tinygltf::BufferView& v = model.tiny.bufferViews[static_cast<std::size_t>(view)];
    return model.file.buffers[static_cast<std::size_t>(v.buffer)].subspan(v.byteOffset,
                                                                          v.byteLength);
}

void checkGltfAccessors(const GltfModel& model)
{
    for (std::size_t i = 0; i < model.tiny.bufferViews.size(); ++i) {
        const tinygltf::BufferView& v = model.tiny.bufferViews[i];
        const std::size_t size = model.file.buffers[static_cast<std::size_t>(v.buffer)].size();
        if (v.byteOffset + v.byteLength > size)
            failGltf("bufferViews[{}]: it ends at byte {} of buffers[{}], which has {}", i,
                     v.byteOffset + v.byteLength, v.buffer, size);
    }
    const std::set<int> texcoords = texcoordAccessors(model.tiny);
    // Many accessors may share one view: what they add up to bounds the time.
    const std::size_t most = model.limits.vertices * 10;
    std::size_t total = 0;
    for (std::size_t i = 0; i < model.tiny.accessors.size(); ++i) {
        const tinygltf::Accessor& a = model.tiny.accessors[i];
        const std::string field = fmt::format("accessors[{}]", i);
        const Run run = denseRun(model, a, field);
        total += a.bufferView < 0 ? 0 : a.count;
        total += a.sparse.isSparse ? static_cast<std::size_t>(a.sparse.count) : 0;
        if (total > most)
            failGltf("accessors: the limit is {} elements in all", most);
        if (a.sparse.isSparse)
            checkSparse(model, a, field);
        if (a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT
            || texcoords.contains(static_cast<int>(i)))
            continue;
        checkFinite(run, componentCount(a), field);
        if (a.sparse.isSparse)
            checkFinite(sparseValueRun(model, a, field), componentCount(a), field);
    }
}

std::vector<glm::vec2> readGltfVec2(const GltfModel& model, int accessor, std::size_t count,
                                    const std::string& field)
{
    return readVectors<glm::vec2>(model, accessor, TINYGLTF_TYPE_VEC2, count, field);
}

std::vector<glm::vec3> readGltfVec3(const GltfModel& model, int accessor, std::size_t count,
                                    const std::string& field)
{
    return readVectors<glm::vec3>(model, accessor, TINYGLTF_TYPE_VEC3, count, field);
}

std::vector<glm::vec4> readGltfVec4(const GltfModel& model, int accessor, std::size_t count,
                                    const std::string& field)
{
    return readVectors<glm::vec4>(model, accessor, TINYGLTF_TYPE_VEC4, count, field);
}

std::vector<glm::vec4> readGltfColors(const GltfModel& model, int accessor, std::size_t count,
                                      const std::string& field)
{
    const int type = model.tiny.accessors[static_cast<std::size_t>(accessor)].type;
    if (type != TINYGLTF_TYPE_VEC3)
        return readGltfVec4(model, accessor, count, field);
    std::vector<glm::vec4> colors;
    colors.reserve(count);
    for (const glm::vec3& c : readGltfVec3(model, accessor, count, field))
        colors.emplace_back(c, 1.0f);
    return colors;
}

std::vector<glm::uvec4> readGltfJoints(const GltfModel& model, int accessor, std::size_t count,
                                       const std::string& field)
{
    const tinygltf::Accessor& a = expectElements(model, accessor, TINYGLTF_TYPE_VEC4, count, field);
    if (a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
        && a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        failGltf("{}: expected bytes or shorts in accessors[{}], found {}", field, accessor,
                 componentName(a.componentType));
    std::vector<glm::uvec4> joints(a.count, glm::uvec4(0));
    if (a.count > 0)
        readElements(model, a, 4, &joints[0].x, a.count, field);
    return joints;
}

std::vector<glm::mat4> readGltfMatrices(const GltfModel& model, int accessor, std::size_t count,
                                        const std::string& field)
{
    const tinygltf::Accessor& a = model.tiny.accessors[static_cast<std::size_t>(accessor)];
    if (a.type != TINYGLTF_TYPE_MAT4 || a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        failGltf("{}: expected MAT4 of floats in accessors[{}], found {} of {}", field, accessor,
                 elementName(a.type), componentName(a.componentType));
    if (a.count < count)
        failGltf("{}: expected {} matrices in accessors[{}], found {}", field, count, accessor,
                 a.count);
    std::vector<glm::mat4> matrices(count, glm::mat4(0));
    if (count > 0)
        readElements(model, a, 16, &matrices[0][0].x, count, field);
    return matrices;
}

std::vector<std::uint32_t> readGltfIndices(const GltfModel& model, int accessor,
                                           std::size_t vertexCount, const std::string& field)
{
    const tinygltf::Accessor& a = model.tiny.accessors[static_cast<std::size_t>(accessor)];
    expectElements(model, accessor, TINYGLTF_TYPE_SCALAR, a.count, field);
    const std::size_t size = componentSize(a.componentType);
    if (a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
        && a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
        && a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        failGltf("{}: expected unsigned integers in accessors[{}], found {}", field, accessor,
                 componentName(a.componentType));
    if (a.count > model.limits.triangles * 3)
        failGltf("{}: the limit is {} indices, found {}", field, model.limits.triangles * 3,
                 a.count);
    std::vector<std::uint32_t> indices(a.count, 0);
    readElements(model, a, 1, indices.data(), a.count, field);
    const std::uint32_t restart = 0xFFFFFFFFu >> (32 - 8 * size);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] == restart)
            failGltf("{}: index {} is {}, the primitive restart value, which glTF forbids", field,
                     i, restart);
        if (indices[i] >= vertexCount)
            failGltf("{}: index {} is {}, but there are {} vertices", field, i, indices[i],
                     vertexCount);
    }
    return indices;
}

} // namespace cotan
