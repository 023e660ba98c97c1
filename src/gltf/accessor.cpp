// Accessors to arrays: every offset, stride and count is checked once, then read without doubt.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <type_traits>

#include "model.hpp"
#include "runs.hpp"

namespace cotan {

namespace {

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

void checkSparse(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field)
{
    if (static_cast<std::size_t>(a.sparse.count) > a.count)
        failGltf("{}.sparse.count: expected at most {}, the accessor's count, found {}", field,
                 a.count, a.sparse.count);
    const GltfRun run = sparseIndexRun(model, a, field);
    sparseValueRun(model, a, field);
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < run.count; ++i) {
        const std::uint32_t at =
            readIndex(run.first + i * run.stride, a.sparse.indices.componentType);
        if (at >= a.count)
            failGltf("{}.sparse.indices[{}]: expected an index below {}, found {}", field, i,
                     a.count, at);
        if (i > 0 && at <= before)
            failGltf("{}.sparse.indices[{}]: expected an index above {}, the one before, found {}",
                     field, i, before, at);
        before = at;
    }
}

void checkFinite(const GltfRun& run, std::size_t components, const std::string& field)
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

// An element of a run, and where its numbers go.
struct Move {
    std::size_t from = 0;
    std::size_t to = 0; // in elements of the array
};

// Converts `count` elements; move(i): the i-th of them. room: numbers that an element of `out` has.
template<class Stored, class Out, class MoveOf>
void convertRun(const GltfRun& run, std::size_t components, bool normalized, std::size_t count,
                const MoveOf& move, Out* out, std::size_t room)
{
    for (std::size_t i = 0; i < count; ++i) {
        const Move m = move(i);
        const std::byte* const from = run.first + m.from * run.stride;
        for (std::size_t c = 0; c < components; ++c) {
            Stored stored;
            std::memcpy(&stored, from + c * sizeof stored, sizeof stored);
            out[m.to * room + c] = convert<Out>(stored, normalized);
        }
    }
}

template<class Out, class MoveOf>
void convertAny(const GltfRun& run, const tinygltf::Accessor& a, std::size_t count, const MoveOf& move,
                Out* out, std::size_t room)
{
    const auto as = [&](auto stored) {
        convertRun<decltype(stored), Out>(run, componentCount(a), a.normalized, count, move, out,
                                          room);
    };
    switch (a.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return as(std::int8_t());
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return as(std::uint8_t());
    case TINYGLTF_COMPONENT_TYPE_SHORT: return as(std::int16_t());
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return as(std::uint16_t());
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return as(std::uint32_t());
    default: return as(float());
    }
}

// Which sparse values go where, of those that are chosen. The indices rise: checkSparse.
std::vector<Move> sparseMoves(const GltfRun& indices, int componentType, const GltfChoice& choice)
{
    const auto indexAt = [&](std::size_t i) {
        return readIndex(indices.first + i * indices.stride, componentType);
    };
    std::vector<Move> moves;
    if (choice.all) {
        for (std::size_t i = 0; i < indices.count && indexAt(i) < choice.count; ++i)
            moves.push_back({i, indexAt(i)});
        return moves;
    }
    for (std::size_t i = 0, at = 0; i < choice.chosen.size() && at < indices.count; ++i) {
        std::size_t end = indices.count;
        while (at < end) { // the first that is not below
            const std::size_t middle = at + (end - at) / 2;
            if (indexAt(middle) < choice.chosen[i])
                at = middle + 1;
            else
                end = middle;
        }
        if (at < indices.count && indexAt(at) == choice.chosen[i])
            moves.push_back({at, i});
    }
    return moves;
}

// The chosen elements into an array whose elements have room for `room` numbers.
template<class Out>
void readElements(const GltfModel& model, const tinygltf::Accessor& a, std::size_t room, Out* out,
                  const GltfChoice& choice, const std::string& field)
{
    const GltfRun run = denseRun(model, a, field);
    const auto dense = [&](std::size_t i) { return Move{choice.all ? i : choice.chosen[i], i}; };
    if (run.first)
        convertAny(run, a, choice.size(), dense, out, room);
    if (!a.sparse.isSparse)
        return;
    const std::vector<Move> moves = sparseMoves(sparseIndexRun(model, a, field),
                                                a.sparse.indices.componentType, choice);
    convertAny(sparseValueRun(model, a, field), a, moves.size(),
               [&](std::size_t i) { return moves[i]; }, out, room);
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

template<class T>
std::vector<T> makeArray(GltfModel& model, std::size_t count, const T& value,
                         const std::string& field)
{
    takeGltfBytes(model, count * sizeof(T), field);
    return std::vector<T>(count, value);
}

template<class Vector>
std::vector<Vector> readVectors(GltfModel& model, int accessor, int type, const GltfChoice& choice,
                                const std::string& field)
{
    const tinygltf::Accessor& a = expectElements(model, accessor, type, choice.count, field);
    if (a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        failGltf("{}: expected floats, bytes or shorts in accessors[{}], found {}", field, accessor,
                 componentName(a.componentType));
    std::vector<Vector> out = makeArray(model, choice.size(), Vector(0), field);
    if (!out.empty())
        readElements(model, a, static_cast<std::size_t>(Vector::length()), &out[0].x, choice,
                     field);
    return out;
}

} // namespace

void takeGltfBytes(GltfModel& model, std::size_t bytes, const std::string& field)
{
    const std::size_t most = gltfAllowance(model);
    if (bytes > most - std::min(model.bytesTaken, most))
        failGltf("{}: the geometry takes {} bytes with it, the limit is {} for a file of {}", field,
                 model.bytesTaken + bytes, most, model.file.size);
    model.bytesTaken += bytes;
}

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
    // Accessors without a view are zeros that cost the file nothing, and many may share one view:
    // what they add up to bounds memory and time. Counts are below 2^53 and elements at most 64
    // bytes, so one of them overflows nothing.
    const std::size_t most = gltfAllowance(model);
    std::size_t total = 0;
    for (std::size_t i = 0; i < model.tiny.accessors.size(); ++i) {
        const tinygltf::Accessor& a = model.tiny.accessors[i];
        const std::string field = fmt::format("accessors[{}]", i);
        const GltfRun run = denseRun(model, a, field);
        total += a.count * elementSize(a);
        if (total > most)
            failGltf("{}: the accessors take {} bytes with it, the limit is {} for a file of {}",
                     field, total, most, model.file.size);
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

std::vector<glm::vec2> readGltfVec2(GltfModel& model, int accessor, const GltfChoice& choice,
                                    const std::string& field)
{
    return readVectors<glm::vec2>(model, accessor, TINYGLTF_TYPE_VEC2, choice, field);
}

std::vector<glm::vec3> readGltfVec3(GltfModel& model, int accessor, const GltfChoice& choice,
                                    const std::string& field)
{
    return readVectors<glm::vec3>(model, accessor, TINYGLTF_TYPE_VEC3, choice, field);
}

std::vector<glm::vec4> readGltfVec4(GltfModel& model, int accessor, const GltfChoice& choice,
                                    const std::string& field)
{
    return readVectors<glm::vec4>(model, accessor, TINYGLTF_TYPE_VEC4, choice, field);
}

std::vector<glm::vec4> readGltfColors(GltfModel& model, int accessor, const GltfChoice& choice,
                                      const std::string& field)
{
    const int type = model.tiny.accessors[static_cast<std::size_t>(accessor)].type;
    if (type != TINYGLTF_TYPE_VEC3)
        return readGltfVec4(model, accessor, choice, field);
    std::vector<glm::vec4> colors;
    colors.reserve(choice.size());
    for (const glm::vec3& c : readGltfVec3(model, accessor, choice, field))
        colors.emplace_back(c, 1.0f);
    return colors;
}

std::vector<glm::uvec4> readGltfJoints(GltfModel& model, int accessor, const GltfChoice& choice,
                                       const std::string& field)
{
    const tinygltf::Accessor& a =
        expectElements(model, accessor, TINYGLTF_TYPE_VEC4, choice.count, field);
    if (a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
        && a.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        failGltf("{}: expected bytes or shorts in accessors[{}], found {}", field, accessor,
                 componentName(a.componentType));
    std::vector<glm::uvec4> joints = makeArray(model, choice.size(), glm::uvec4(0), field);
    if (!joints.empty())
        readElements(model, a, 4, &joints[0].x, choice, field);
    return joints;
}

std::vector<glm::mat4> readGltfMatrices(GltfModel& model, int accessor, std::size_t count,
                                        const std::string& field)
{
    const tinygltf::Accessor& a = model.tiny.accessors[static_cast<std::size_t>(accessor)];
    if (a.type != TINYGLTF_TYPE_MAT4 || a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        failGltf("{}: expected MAT4 of floats in accessors[{}], found {} of {}", field, accessor,
                 elementName(a.type), componentName(a.componentType));
    if (a.count < count)
        failGltf("{}: expected {} matrices in accessors[{}], found {}", field, count, accessor,
                 a.count);
    std::vector<glm::mat4> matrices = makeArray(model, count, glm::mat4(0), field);
    if (count > 0)
        readElements(model, a, 16, &matrices[0][0].x, count, field);
    return matrices;
}

std::vector<std::uint32_t> readGltfIndices(GltfModel& model, int accessor,
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
    std::vector<std::uint32_t> indices = makeArray(model, a.count, std::uint32_t(0), field);
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
