// Reads one primitive: attributes, morph targets, and any topology as triangles.
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "core/one_line.hpp"
#include "cotan/vector.hpp"
#include "gltf/json/lookup.hpp"
#include "gltf_model.hpp"

namespace cotan {

using gltf::Accessor, gltf::Choice, gltf::ElementType;

namespace {

void take(std::size_t& taken, std::size_t limit, std::size_t count, const char* what, const std::string& field)
{
    if (count > limit - taken)
        failGltf("{}: the limit is {} {} in total, this one adds {}", field, limit, what, count);
    taken += count;
}

// Vertices are counted before memory and time are spent on them; so are morph targets and sets of joints, because a few
// bytes of JSON can request any number of them.
void takeVertices(GltfModel& model, std::size_t count, const std::string& field)
{
    take(model.verticesTaken, model.limits.vertices, count, "vertices", field);
}

void takeTriangles(GltfModel& model, std::size_t count, const std::string& field)
{
    take(model.trianglesTaken, model.limits.triangles, count, "triangles", field);
}

// ---- accessors ------------------------------------------------------------------------------

const Accessor& accessorAt(const GltfModel& model, int accessor)
{
    return model.accessors[std::size_t(accessor)].accessor;
}

template<class T>
std::vector<T> makeArray(GltfModel& model, std::size_t count, const T& value, const std::string& field)
{
    takeGltfBytes(model, std::uint64_t(count) * sizeof(T), field);
    return std::vector<T>(count, value);
}

// Reads VEC3 (with w = 1) or VEC4 colours.
std::vector<glm::vec4> readColors(GltfModel& model, int accessor, const Choice& choice, const std::string& field)
{
    if (accessorAt(model, accessor).type != ElementType::vec3)
        return readGltfVectors<glm::vec4>(model, accessor, choice, field);
    std::vector<glm::vec4> colors;
    colors.reserve(choice.size());
    for (const glm::vec3& c : readGltfVectors<glm::vec3>(model, accessor, choice, field))
        colors.emplace_back(c, 1.0f);
    return colors;
}

std::vector<glm::uvec4> readJointSet(GltfModel& model, int accessor, const Choice& choice, const std::string& field)
{
    const Accessor& a = accessorAt(model, accessor);
    gltf::expectElements(a, ElementType::vec4, choice.count, {accessor, field});
    if (a.componentType != gltf::kUnsignedByte && a.componentType != gltf::kUnsignedShort)
        failGltf("{}: expected bytes or shorts in accessors[{}], found {}", field, accessor,
                 gltf::nameOfComponent(a.componentType));
    std::vector<glm::uvec4> joints = makeArray(model, choice.size(), glm::uvec4(0), field);
    if (!joints.empty())
        gltf::readNumbers(model.accessors[std::size_t(accessor)], choice, 4, &joints[0].x);
    return joints;
}

// Returns vertex indices. Throws GltfProblem if one is not below vertexCount or is the primitive restart value.
std::vector<std::uint32_t> readIndices(GltfModel& model, int accessor, std::size_t vertexCount,
                                       const std::string& field)
{
    const Accessor& a = accessorAt(model, accessor);
    gltf::expectIndices(a, {accessor, field});
    if (a.view < 0)
        failGltf("{}: expected accessors[{}] with a bufferView, found none", field, accessor);
    if (a.count > model.limits.triangles * 3)
        failGltf("{}: the limit is {} indices, found {}", field, model.limits.triangles * 3, a.count);
    std::vector<std::uint32_t> indices = makeArray(model, a.count, std::uint32_t(0), field);
    gltf::readNumbers(model.accessors[std::size_t(accessor)], a.count, 1, indices.data());
    const std::uint32_t restart = 0xFFFFFFFFu >> (32 - 8 * gltf::componentSize(a.componentType));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] == restart)
            failGltf("{}: index {} is {}, the primitive restart value, which glTF forbids", field, i, restart);
        if (indices[i] >= vertexCount)
            failGltf("{}: index {} is {}, but there are {} vertices", field, i, indices[i], vertexCount);
    }
    return indices;
}

// ---- attributes -----------------------------------------------------------------------------

void readTexcoords(GltfModel& model, const gltf::Primitive& source, const Choice& choice, GltfPrimitive& out)
{
    for (const auto& [name, accessor] : source.attributes) {
        if (!name.starts_with("TEXCOORD_"))
            continue;
        const std::string field = out.field + "." + name;
        if (name != "TEXCOORD_0" && name != "TEXCOORD_1") {
            model.warnings.add(out.field, oneLine(name) + " is ignored: only two uv sets are supported");
            continue;
        }
        std::vector<glm::vec2>& set = out.mesh.texcoords[name == "TEXCOORD_0" ? 0 : 1];
        set = readGltfVectors<glm::vec2>(model, accessor, choice, field);
        std::size_t bad = 0;
        for (glm::vec2& uv : set)
            if (!isFinite(uv)) {
                uv = glm::vec2(0);
                ++bad;
            }
        model.warnings.add(field, "not a finite number; replaced by 0", bad, "vertices");
    }
}

void readJoints(GltfModel& model, const gltf::Primitive& source, const Choice& choice, GltfPrimitive& out)
{
    for (int set = 0;; ++set) {
        const int joints = gltf::accessorOf(source.attributes, fmt::format("JOINTS_{}", set));
        const int weights = gltf::accessorOf(source.attributes, fmt::format("WEIGHTS_{}", set));
        if (joints < 0 && weights < 0)
            return;
        if (joints < 0 || weights < 0)
            failGltf("{}: expected JOINTS_{} and WEIGHTS_{} together", out.field, set, set);
        if (set > 0)
            takeVertices(model, choice.size(), out.field);
        out.joints.push_back(readJointSet(model, joints, choice, fmt::format("{}.JOINTS_{}", out.field, set)));
        out.weights.push_back(
            readGltfVectors<glm::vec4>(model, weights, choice, fmt::format("{}.WEIGHTS_{}", out.field, set)));
    }
}

void readAttributes(GltfModel& model, const gltf::Primitive& source, const Choice& choice, GltfPrimitive& out)
{
    if (const int a = gltf::accessorOf(source.attributes, "NORMAL"); a >= 0)
        out.mesh.normals = readGltfVectors<glm::vec3>(model, a, choice, out.field + ".NORMAL");
    if (const int a = gltf::accessorOf(source.attributes, "TANGENT"); a >= 0)
        out.mesh.tangents = readGltfVectors<glm::vec4>(model, a, choice, out.field + ".TANGENT");
    if (const int a = gltf::accessorOf(source.attributes, "COLOR_0"); a >= 0)
        out.mesh.colors = readColors(model, a, choice, out.field + ".COLOR_0");
    readTexcoords(model, source, choice, out);
    readJoints(model, source, choice, out);
    if (gltf::accessorOf(source.attributes, "TANGENT") >= 0 && gltf::accessorOf(source.attributes, "NORMAL") < 0) {
        out.mesh.tangents.clear();
        model.warnings.add(out.field, "TANGENT without NORMAL, ignored");
    }
}

// ---- morph targets --------------------------------------------------------------------------

template<class Vector> void addScaled(std::vector<Vector>& to, const std::vector<glm::vec3>& delta, float weight)
{
    if (weight == 0)
        return;
    for (std::size_t i = 0; i < to.size(); ++i) {
        to[i].x += weight * delta[i].x;
        to[i].y += weight * delta[i].y;
        to[i].z += weight * delta[i].z;
    }
}

// Targets of weight zero are read too, so that damage in them is found.
void morph(GltfModel& model, const gltf::Primitive& source, const std::vector<double>& weights, const Choice& choice,
           GltfPrimitive& out)
{
    const std::uint64_t kept = model.bytesTaken;
    for (std::size_t t = 0; t < source.targets.size(); ++t) {
        const std::string field = fmt::format("{}.targets[{}]", out.field, t);
        takeVertices(model, choice.size(), field);
        const float weight = t < weights.size() ? float(weights[t]) : 0.0f;
        const auto add = [&](const std::string& name, auto& to) {
            if (const int a = gltf::accessorOf(source.targets[t], name); a >= 0)
                addScaled(to, readGltfVectors<glm::vec3>(model, a, choice, field + "." + name), weight);
        };
        add("POSITION", out.mesh.positions);
        add("NORMAL", out.mesh.normals);
        add("TANGENT", out.mesh.tangents);
        model.bytesTaken = kept; // the differences are freed
    }
}

// ---- topology -------------------------------------------------------------------------------

std::vector<std::uint32_t> unroll(int mode, const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> triangles;
    triangles.reserve(order.size() * 3);
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {
        // Winding as the specification defines it for strips and fans.
        const auto [a, b, c] = mode == gltf::kTriangleStrip ? std::array{i, i + 1 + i % 2, i + 2 - i % 2}
                                                            : std::array{i + 1, i + 2, std::size_t(0)};
        if (order[a] == order[b] || order[b] == order[c] || order[c] == order[a])
            continue;
        triangles.insert(triangles.end(), {order[a], order[b], order[c]});
    }
    return triangles;
}

// Uses a table of all vertices, for primitives that use a large fraction of them.
std::vector<std::uint32_t> byTable(std::vector<std::uint32_t>& corners, std::size_t count)
{
    std::vector<std::uint32_t> newIndex(count, 0);
    for (const std::uint32_t corner : corners)
        newIndex[corner] = 1;
    std::vector<std::uint32_t> used;
    for (std::uint32_t vertex = 0; vertex < count; ++vertex)
        if (newIndex[vertex]) {
            newIndex[vertex] = std::uint32_t(used.size());
            used.push_back(vertex);
        }
    for (std::uint32_t& corner : corners)
        corner = newIndex[corner];
    return used;
}

std::vector<std::uint32_t> bySearch(std::vector<std::uint32_t>& corners)
{
    std::vector<std::uint32_t> used = corners;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t& corner : corners)
        corner = std::uint32_t(std::ranges::lower_bound(used, corner) - used.begin());
    return used;
}

std::vector<std::uint32_t> readTriangles(GltfModel& model, const gltf::Primitive& source, std::size_t vertices,
                                         const GltfPrimitive& out)
{
    std::vector<std::uint32_t> order;
    if (source.indices >= 0) {
        order = readIndices(model, source.indices, vertices, out.field + ".indices");
    } else {
        order = makeArray(model, vertices, std::uint32_t(0), out.field);
        std::iota(order.begin(), order.end(), 0u);
    }
    if (source.mode == gltf::kTriangles) {
        if (order.size() % 3 != 0)
            model.warnings.add(out.field,
                               "the number of corners is not a multiple of 3; the incomplete triangle is ignored");
    } else if (source.mode == gltf::kTriangleStrip || source.mode == gltf::kTriangleFan) {
        takeTriangles(model, order.size(), out.field); // before the array grows to three times its size
        model.trianglesTaken -= order.size();
        takeGltfBytes(model, 3 * std::uint64_t(order.size()) * sizeof order[0], out.field);
    } else {
        model.warnings.add(out.field, "points and lines are not drawn");
    }
    order = gltfTriangles(source.mode, std::move(order));
    takeTriangles(model, order.size() / 3, out.field);
    return order;
}

} // namespace

std::vector<std::uint32_t> gltfTriangles(int mode, std::vector<std::uint32_t> order)
{
    if (mode == gltf::kTriangleStrip || mode == gltf::kTriangleFan)
        return unroll(mode, order);
    order.resize(mode == gltf::kTriangles ? order.size() / 3 * 3 : 0);
    return order;
}

std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count)
{
    constexpr std::size_t kFewUsed = 8; // vertices per corner, about where both methods are equally fast
    return count / kFewUsed < corners.size() ? byTable(corners, count) : bySearch(corners);
}

std::optional<GltfPrimitive> readGltfPrimitive(GltfModel& model, int mesh, std::size_t primitive,
                                               const std::vector<double>& morphWeights)
{
    const gltf::Mesh& parent = model.structure.meshes[std::size_t(mesh)];
    const gltf::Primitive& source = parent.primitives[primitive];
    GltfPrimitive out;
    out.field = primitiveField(std::size_t(mesh), primitive);
    out.mesh.name = parent.name.empty() ? fmt::format("mesh {}", mesh) : parent.name;
    if (parent.primitives.size() > 1)
        out.mesh.name += fmt::format("/{}", primitive);
    out.mesh.material = source.material;

    const int positions = gltf::accessorOf(source.attributes, "POSITION");
    if (positions < 0) {
        model.warnings.add(out.field, "no POSITION, nothing to draw");
        return std::nullopt;
    }
    const std::size_t count = accessorAt(model, positions).count;
    out.mesh.indices = readTriangles(model, source, count, out);
    const std::vector<std::uint32_t> used = takeUsedVertices(out.mesh.indices, count);
    const Choice choice(count, used);
    takeVertices(model, choice.size(), out.field);
    out.mesh.positions = readGltfVectors<glm::vec3>(model, positions, choice, out.field + ".POSITION");
    readAttributes(model, source, choice, out);
    morph(model, source, morphWeights, choice, out);
    if (out.mesh.indices.empty())
        return std::nullopt;
    if (out.mesh.normals.empty()) { // flat normals need a vertex per corner
        takeVertices(model, out.mesh.indices.size(), out.field);
        // Maximum size of a corner: position and normal, two sets of uv, a colour.
        constexpr std::size_t kCornerBytes = 2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4);
        takeGltfBytes(model, std::uint64_t(out.mesh.indices.size()) * kCornerBytes, out.field);
    }
    return out;
}

} // namespace cotan
