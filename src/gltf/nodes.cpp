// The node hierarchy, instances, lights and cameras.
#include "gltf_model.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "cotan/vector.hpp"

namespace cotan {

namespace {

const gltf::Node& nodeAt(const GltfModel& model, int node) { return model.structure.nodes[std::size_t(node)]; }

std::string nodeField(int node) { return fmt::format("nodes[{}]", node); }

// Sets the last row to its exact value: exporters that multiply in float leave rounding errors there.
glm::dmat4 affine(glm::dmat4 m, const std::string& field)
{
    constexpr double kRounding = 1e-4;
    if (std::abs(m[0].w) + std::abs(m[1].w) + std::abs(m[2].w) + std::abs(m[3].w - 1) > kRounding)
        failGltf("{}.matrix: expected the last row 0 0 0 1, found {:g} {:g} {:g} {:g}", field, m[0].w, m[1].w, m[2].w,
                 m[3].w);
    m[0].w = m[1].w = m[2].w = 0;
    m[3].w = 1;
    return m;
}

glm::dmat4 localOf(GltfModel& model, int node)
{
    const gltf::Node& n = nodeAt(model, node);
    if (!n.matrix && std::abs(glm::length(n.rotation) - 1) > 0.01)
        model.warnings.add(nodeField(node) + ".rotation", "not a unit quaternion; normalised");
    return affine(gltf::localMatrix(n), nodeField(node));
}

// The parent of each node; -1 for roots.
std::vector<int> findParents(const GltfModel& model)
{
    std::vector<int> parents(model.structure.nodes.size(), -1);
    for (int i = 0; i < int(parents.size()); ++i)
        for (const int child : nodeAt(model, i).children) {
            int& parent = parents[std::size_t(child)];
            if (parent >= 0)
                failGltf("nodes[{}]: expected one parent, found nodes[{}] and nodes[{}]", child, parent, i);
            parent = i;
        }
    return parents;
}

// The given nodes and all their descendants, parents first, in file order. Uses an explicit stack instead of recursion:
// a chain of a million nodes is a valid file.
std::vector<int> withDescendants(const GltfModel& model, const std::vector<int>& roots)
{
    std::vector<int> found;
    std::vector<bool> seen(model.structure.nodes.size(), false);
    std::vector<int> open(roots.rbegin(), roots.rend());
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        if (seen[std::size_t(node)])
            continue;
        seen[std::size_t(node)] = true;
        found.push_back(node);
        const std::vector<int>& children = nodeAt(model, node).children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return found;
}

std::vector<int> rootsOf(const std::vector<int>& parents)
{
    std::vector<int> roots;
    for (int i = 0; i < int(parents.size()); ++i)
        if (parents[std::size_t(i)] < 0)
            roots.push_back(i);
    return roots;
}

std::vector<glm::dmat4> worldMatrices(GltfModel& model, const std::vector<int>& parents)
{
    std::vector<bool> reached(parents.size(), false);
    std::vector<glm::dmat4> world(parents.size(), glm::dmat4(1));
    for (const int node : withDescendants(model, rootsOf(parents))) {
        const auto i = std::size_t(node);
        const glm::dmat4 local = localOf(model, node);
        world[i] = parents[i] < 0 ? local : world[std::size_t(parents[i])] * local;
        reached[i] = true;
        if (!isFinite(glm::mat4(world[i])))
            failGltf("nodes[{}]: its transform is beyond the range of float", node);
    }
    // Every node has at most one parent, so a node that no root reaches is on a cycle.
    const auto cycle = std::find(reached.begin(), reached.end(), false);
    if (cycle != reached.end())
        failGltf("nodes[{}]: it is its own descendant", cycle - reached.begin());
    return world;
}

std::vector<int> shownRoots(GltfModel& model, const std::vector<int>& parents)
{
    const gltf::Structure& structure = model.structure;
    if (structure.scenes.empty())
        return rootsOf(parents);
    const auto scene = std::size_t(std::max(structure.defaultScene, 0));
    for (const int node : structure.scenes[scene])
        if (parents[std::size_t(node)] >= 0)
            model.warnings.add(fmt::format("scenes[{}]", scene), "it lists nodes that are not roots");
    return structure.scenes[scene];
}

void warnIfFlat(GltfModel& model, const glm::dmat4& world, int node)
{
    // Relative to the axis lengths, since small objects are not flat.
    constexpr double kFlat = 1e-9;
    const glm::dmat3 m(world);
    const double axes = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    if (!(std::abs(glm::determinant(m)) > kFlat * axes))
        model.warnings.add(nodeField(node), "its transform is singular (a scale of zero)");
}

std::vector<glm::dmat4> instanceMatrices(GltfModel& model, const gltf::Attributes& instances, const std::string& field)
{
    const int translations = gltf::accessorOf(instances, "TRANSLATION");
    const int rotations = gltf::accessorOf(instances, "ROTATION");
    const int scales = gltf::accessorOf(instances, "SCALE");
    const int any = std::max({translations, rotations, scales});
    if (any < 0)
        return {glm::dmat4(1)};
    const std::size_t count = model.accessors[std::size_t(any)].accessor.count;
    if (count > model.limits.nodes)
        failGltf("{}: the limit is {} instances, found {}", field, model.limits.nodes, count);
    const auto read = [&]<class Vector>(int accessor, const char* name, const Vector& otherwise) {
        return accessor < 0 ? std::vector<Vector>(count, otherwise)
                            : readGltfVectors<Vector>(model, accessor, count, field + name);
    };
    const auto t = read(translations, ".TRANSLATION", glm::vec3(0));
    const auto r = read(rotations, ".ROTATION", glm::vec4(0, 0, 0, 1));
    const auto s = read(scales, ".SCALE", glm::vec3(1));
    std::vector<glm::dmat4> matrices;
    matrices.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        matrices.push_back(gltf::composed(t[i], r[i], s[i]));
    return matrices;
}

// The unit vector along an axis of a transform, or `otherwise` if its scale is zero.
glm::vec3 axis(const glm::dvec4& column, const glm::vec3& otherwise)
{
    const double length = glm::length(glm::dvec3(column));
    return length > 0 ? glm::vec3(glm::dvec3(column) / length) : otherwise;
}

} // namespace

GltfNodes readGltfNodes(GltfModel& model)
{
    const std::vector<int> parents = findParents(model);
    return {worldMatrices(model, parents), withDescendants(model, shownRoots(model, parents))};
}

std::vector<glm::mat4> gltfPlacements(GltfModel& model, const GltfNodes& nodes, int node)
{
    const glm::dmat4& world = nodes.world[std::size_t(node)];
    const std::string field = nodeField(node) + ".extensions.EXT_mesh_gpu_instancing";
    const std::vector<glm::dmat4> matrices = instanceMatrices(model, nodeAt(model, node).instances, field);
    std::vector<glm::mat4> placements;
    placements.reserve(matrices.size());
    for (const glm::dmat4& m : matrices) {
        warnIfFlat(model, world * m, node);
        placements.emplace_back(world * m);
        if (!isFinite(placements.back()))
            failGltf("{}: a transform is beyond the range of float", field);
    }
    return placements;
}

void addGltfLightsAndCameras(const GltfModel& model, const GltfNodes& nodes, Scene& scene)
{
    for (const int node : nodes.visible) {
        const gltf::Node& n = nodeAt(model, node);
        const glm::dmat4& world = nodes.world[std::size_t(node)];
        const glm::vec3 position(world[3]), ahead = -axis(world[2], {0, 0, 1}); // lights and cameras look along -z
        if (n.light >= 0) {
            Light& light = scene.lights.emplace_back(model.structure.lights[std::size_t(n.light)]);
            light.position = position;
            light.direction = ahead;
        }
        if (n.camera >= 0) {
            Camera& camera = scene.cameras.emplace_back(model.structure.cameras[std::size_t(n.camera)]);
            camera.eye = position;
            camera.target = position + ahead;
            camera.up = axis(world[1], {0, 1, 0});
            if (camera.name.empty())
                camera.name = n.name;
        }
    }
}

} // namespace cotan
