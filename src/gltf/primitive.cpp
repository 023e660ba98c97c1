// Reads one primitive: attributes, morph targets, and any topology made into triangles.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh.hpp"
#include "vertices.hpp"

namespace cotan {

namespace {

// The accessor of an attribute, -1 if there is none.
int find(const std::map<std::string, int>& attributes, const std::string& name)
{
    const auto found = attributes.find(name);
    return found == attributes.end() ? -1 : found->second;
}

std::size_t accessorCount(const GltfModel& model, int accessor)
{
    return model.tiny.accessors[static_cast<std::size_t>(accessor)].count;
}

// Vertices are counted before memory and time are taken for them; so are morph targets and sets of
// joints, because a few bytes of JSON can ask for any number of them.
void takeVertices(GltfModel& model, std::size_t count, const std::string& field)
{
    const std::size_t left = model.limits.vertices - model.verticesTaken;
    if (count > left)
        failGltf("{}: the limit is {} vertices in all, this one brings {}", field,
                 model.limits.vertices, count);
    model.verticesTaken += count;
}

void takeTriangles(GltfModel& model, std::size_t count, const std::string& field)
{
    const std::size_t left = model.limits.triangles - model.trianglesTaken;
    if (count > left)
        failGltf("{}: the limit is {} triangles in all, this one brings {}", field,
                 model.limits.triangles, count);
    model.trianglesTaken += count;
}

void replaceUnusable(std::vector<glm::vec2>& texcoords, const std::string& field,
                     GltfWarnings& warnings)
{
    std::size_t bad = 0;
    for (glm::vec2& uv : texcoords) {
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            uv = glm::vec2(0);
            ++bad;
        }
    }
    if (bad > 0)
        warnings.add(field, "not a finite number, replaced by 0", bad, "vertices");
}

void readTexcoords(GltfModel& model, const tinygltf::Primitive& source, const GltfChoice& choice,
                   GltfPrimitive& out)
{
    for (const auto& [name, accessor] : source.attributes) {
        if (!name.starts_with("TEXCOORD_"))
            continue;
        const std::string field = out.field + "." + name;
        if (name != "TEXCOORD_0" && name != "TEXCOORD_1") {
            model.warnings.add(out.field, oneLine(name) + " is ignored: two uv sets are read");
            continue;
        }
        std::vector<glm::vec2>& set = out.texcoords[name == "TEXCOORD_0" ? 0 : 1];
        set = readGltfVec2(model, accessor, choice, field);
        replaceUnusable(set, field, model.warnings);
    }
}

void readJoints(GltfModel& model, const tinygltf::Primitive& source, const GltfChoice& choice,
                GltfPrimitive& out)
{
    for (int set = 0;; ++set) {
        const int joints = find(source.attributes, fmt::format("JOINTS_{}", set));
        const int weights = find(source.attributes, fmt::format("WEIGHTS_{}", set));
        if (joints < 0 && weights < 0)
            return;
        if (joints < 0 || weights < 0)
            failGltf("{}: expected JOINTS_{} and WEIGHTS_{} together", out.field, set, set);
        if (set > 0)
            takeVertices(model, choice.size(), out.field);
        out.joints.push_back(
            readGltfJoints(model, joints, choice, fmt::format("{}.JOINTS_{}", out.field, set)));
        out.weights.push_back(
            readGltfVec4(model, weights, choice, fmt::format("{}.WEIGHTS_{}", out.field, set)));
    }
}

void readAttributes(GltfModel& model, const tinygltf::Primitive& source, const GltfChoice& choice,
                    GltfPrimitive& out)
{
    if (const int a = find(source.attributes, "NORMAL"); a >= 0)
        out.normals = readGltfVec3(model, a, choice, out.field + ".NORMAL");
    if (const int a = find(source.attributes, "TANGENT"); a >= 0)
        out.tangents = readGltfVec4(model, a, choice, out.field + ".TANGENT");
    if (const int a = find(source.attributes, "COLOR_0"); a >= 0)
        out.colors = readGltfColors(model, a, choice, out.field + ".COLOR_0");
    readTexcoords(model, source, choice, out);
    readJoints(model, source, choice, out);
    if (find(source.attributes, "TANGENT") >= 0 && find(source.attributes, "NORMAL") < 0) {
        out.tangents.clear();
        model.warnings.add(out.field, "TANGENT without NORMAL, ignored");
    }
}

// ---- morph targets --------------------------------------------------------------------------

template<class Vector>
void addScaled(std::vector<Vector>& to, const std::vector<glm::vec3>& delta, float weight)
{
    if (to.empty() || weight == 0)
        return;
    for (std::size_t i = 0; i < to.size(); ++i) {
        to[i].x += weight * delta[i].x;
        to[i].y += weight * delta[i].y;
        to[i].z += weight * delta[i].z;
    }
}

// Targets of weight zero are read all the same, so that damage in them is found.
void morph(GltfModel& model, const tinygltf::Primitive& source, const std::vector<double>& weights,
           const GltfChoice& choice, GltfPrimitive& out)
{
    const std::size_t kept = model.bytesTaken;
    for (std::size_t t = 0; t < source.targets.size(); ++t) {
        const std::string field = fmt::format("{}.targets[{}]", out.field, t);
        takeVertices(model, choice.size(), field);
        const float weight = t < weights.size() ? static_cast<float>(weights[t]) : 0.0f;
        if (const int a = find(source.targets[t], "POSITION"); a >= 0)
            addScaled(out.positions, readGltfVec3(model, a, choice, field + ".POSITION"), weight);
        if (const int a = find(source.targets[t], "NORMAL"); a >= 0)
            addScaled(out.normals, readGltfVec3(model, a, choice, field + ".NORMAL"), weight);
        if (const int a = find(source.targets[t], "TANGENT"); a >= 0)
            addScaled(out.tangents, readGltfVec3(model, a, choice, field + ".TANGENT"), weight);
        model.bytesTaken = kept; // the differences are not held
    }
}

// ---- topology -------------------------------------------------------------------------------

// The corners of triangle i of a strip or fan, with the winding that the specification gives it.
std::array<std::size_t, 3> corners(int mode, std::size_t i)
{
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
        return {i, i + 1 + i % 2, i + 2 - i % 2};
    return {i + 1, i + 2, 0};
}

// Strips use triangles without area to jump; they are left out.
std::vector<std::uint32_t> unroll(int mode, const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> triangles;
    triangles.reserve(order.size() * 3);
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {
        const auto [a, b, c] = corners(mode, i);
        if (order[a] == order[b] || order[b] == order[c] || order[c] == order[a])
            continue;
        triangles.insert(triangles.end(), {order[a], order[b], order[c]});
    }
    return triangles;
}

// What a corner of a mesh with flat normals holds at most.
struct Corner {
    glm::vec3 position, normal;
    glm::vec2 texcoords[2];
    glm::vec4 color;
};

std::vector<std::uint32_t> readTriangles(GltfModel& model, const tinygltf::Primitive& source,
                                         std::size_t vertices, const GltfPrimitive& out)
{
    std::vector<std::uint32_t> order;
    if (source.indices >= 0) {
        order = readGltfIndices(model, source.indices, vertices, out.field + ".indices");
    } else {
        takeGltfBytes(model, vertices * sizeof order[0], out.field);
        order.resize(vertices);
        std::iota(order.begin(), order.end(), 0u);
    }
    if (source.mode == TINYGLTF_MODE_TRIANGLES) {
        if (order.size() % 3 != 0)
            model.warnings.add(out.field,
                               "the number of corners is not a multiple of 3; the "
                               "last triangle is left out");
        order.resize(order.size() / 3 * 3);
    } else if (source.mode == TINYGLTF_MODE_TRIANGLE_STRIP
               || source.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
        takeTriangles(model, order.size(), out.field); // before the array grows by three
        model.trianglesTaken -= order.size();
        takeGltfBytes(model, 3 * order.size() * sizeof order[0], out.field);
        order = unroll(source.mode, order);
    } else {
        model.warnings.add(out.field, "points and lines are not drawn");
        order.clear();
    }
    takeTriangles(model, order.size() / 3, out.field);
    return order;
}

} // namespace

std::optional<GltfPrimitive> readGltfPrimitive(GltfModel& model, int mesh, std::size_t primitive,
                                               const std::vector<double>& morphWeights)
{
    const tinygltf::Mesh& parent = model.tiny.meshes[static_cast<std::size_t>(mesh)];
    const tinygltf::Primitive& source = parent.primitives[primitive];
    GltfPrimitive out;
    out.field = fmt::format("meshes[{}].primitives[{}]", mesh, primitive);
    out.name = parent.name.empty() ? fmt::format("mesh {}", mesh) : parent.name;
    if (parent.primitives.size() > 1)
        out.name += fmt::format("/{}", primitive);
    out.material = source.material;

    const int positions = find(source.attributes, "POSITION");
    if (positions < 0) {
        model.warnings.add(out.field, "no POSITION, nothing to draw");
        return std::nullopt;
    }
    const std::size_t count = accessorCount(model, positions);
    out.triangles = readTriangles(model, source, count, out);
    const std::vector<std::uint32_t> used = takeUsedVertices(out.triangles, count);
    const GltfChoice choice(count, used);
    takeVertices(model, choice.size(), out.field);
    out.positions = readGltfVec3(model, positions, choice, out.field + ".POSITION");
    readAttributes(model, source, choice, out);
    morph(model, source, morphWeights, choice, out);
    if (out.triangles.empty())
        return std::nullopt;
    if (out.normals.empty()) { // flat normals need a vertex a corner
        takeVertices(model, out.triangles.size(), out.field);
        takeGltfBytes(model, out.triangles.size() * sizeof(Corner), out.field);
    }
    return out;
}

} // namespace cotan
