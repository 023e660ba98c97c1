#include "nodes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace cotan {

namespace {

const tinygltf::Node& nodeAt(const GltfModel& model, int node)
{
    return model.tiny.nodes[static_cast<std::size_t>(node)];
}

std::string nodeField(int node) { return fmt::format("nodes[{}]", node); }

glm::dvec3 vec3Or(const std::vector<double>& values, double otherwise)
{
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : glm::dvec3(otherwise);
}

// x y z w as glTF stores it; the identity where it has no length.
glm::dquat rotation(const glm::dvec4& xyzw)
{
    const double length = glm::length(xyzw);
    if (!(length > 0))
        return glm::dquat(1, 0, 0, 0);
    return glm::dquat(xyzw.w / length, xyzw.x / length, xyzw.y / length, xyzw.z / length);
}

glm::dmat4 compose(const glm::dvec3& translation, const glm::dquat& turn, const glm::dvec3& scale)
{
    const glm::dmat3 r = glm::mat3_cast(turn);
    return {glm::dvec4(r[0] * scale.x, 0), glm::dvec4(r[1] * scale.y, 0),
            glm::dvec4(r[2] * scale.z, 0), glm::dvec4(translation, 1)};
}

glm::dmat4 fromMatrix(const std::vector<double>& values, const std::string& field)
{
    // Exporters that compose in float leave rounding in the last row.
    constexpr double kRounding = 1e-4;
    glm::dmat4 m;
    for (int i = 0; i < 16; ++i)
        m[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
    if (std::abs(m[0].w) + std::abs(m[1].w) + std::abs(m[2].w) + std::abs(m[3].w - 1) > kRounding)
        failGltf("{}.matrix: expected the last row 0 0 0 1, found {:g} {:g} {:g} {:g}", field,
                 m[0].w, m[1].w, m[2].w, m[3].w);
    m[0].w = m[1].w = m[2].w = 0;
    m[3].w = 1;
    return m;
}

glm::dmat4 localMatrix(GltfModel& model, int node)
{
    const tinygltf::Node& n = nodeAt(model, node);
    if (!n.matrix.empty())
        return fromMatrix(n.matrix, nodeField(node));
    glm::dquat turn(1, 0, 0, 0);
    if (n.rotation.size() == 4) {
        const glm::dvec4 xyzw(n.rotation[0], n.rotation[1], n.rotation[2], n.rotation[3]);
        if (std::abs(glm::length(xyzw) - 1) > 0.01)
            model.warnings.add(nodeField(node) + ".rotation", "not a unit quaternion, normalised");
        turn = rotation(xyzw);
    }
    return compose(vec3Or(n.translation, 0), turn, vec3Or(n.scale, 1));
}

// Parents of all nodes, -1 for roots.
std::vector<int> findParents(const GltfModel& model)
{
    std::vector<int> parents(model.tiny.nodes.size(), -1);
    for (int i = 0; i < static_cast<int>(parents.size()); ++i) {
        for (const int child : nodeAt(model, i).children) {
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0)
                failGltf("nodes[{}]: expected one parent, found nodes[{}] and nodes[{}]", child,
                         parent, i);
            parent = i;
        }
    }
    return parents;
}

// The nodes below the given ones and themselves, parents first, in the order of the file. A list
// instead of recursion: a chain of a million nodes is a valid file.
std::vector<int> withDescendants(const GltfModel& model, const std::vector<int>& roots)
{
    std::vector<int> found;
    std::vector<bool> seen(model.tiny.nodes.size(), false);
    std::vector<int> open(roots.rbegin(), roots.rend());
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        if (seen[static_cast<std::size_t>(node)])
            continue;
        seen[static_cast<std::size_t>(node)] = true;
        found.push_back(node);
        const std::vector<int>& children = nodeAt(model, node).children;
        open.insert(open.end(), children.rbegin(), children.rend());
    }
    return found;
}

std::vector<int> rootsOf(const std::vector<int>& parents)
{
    std::vector<int> roots;
    for (int i = 0; i < static_cast<int>(parents.size()); ++i)
        if (parents[static_cast<std::size_t>(i)] < 0)
            roots.push_back(i);
    return roots;
}

bool isFinite(const glm::mat4& m)
{
    for (int i = 0; i < 16; ++i)
        if (!std::isfinite(m[i / 4][i % 4]))
            return false;
    return true;
}

std::vector<glm::dmat4> worldMatrices(GltfModel& model, const std::vector<int>& parents)
{
    const std::vector<int> order = withDescendants(model, rootsOf(parents));
    std::vector<bool> reached(parents.size(), false);
    std::vector<glm::dmat4> world(parents.size(), glm::dmat4(1));
    for (const int node : order) {
        const auto i = static_cast<std::size_t>(node);
        const glm::dmat4 local = localMatrix(model, node);
        world[i] = parents[i] < 0 ? local : world[static_cast<std::size_t>(parents[i])] * local;
        reached[i] = true;
        if (!isFinite(glm::mat4(world[i])))
            failGltf("nodes[{}]: its transform is beyond the range of float", node);
    }
    // With one parent each, what no root leads to can only be a ring.
    const auto ring = std::find(reached.begin(), reached.end(), false);
    if (ring != reached.end())
        failGltf("nodes[{}]: it is its own descendant", ring - reached.begin());
    return world;
}

std::vector<int> shownRoots(GltfModel& model, const std::vector<int>& parents)
{
    if (model.tiny.scenes.empty())
        return rootsOf(parents);
    const std::size_t scene =
        model.tiny.defaultScene < 0 ? 0 : static_cast<std::size_t>(model.tiny.defaultScene);
    for (const int node : model.tiny.scenes[scene].nodes)
        if (parents[static_cast<std::size_t>(node)] >= 0)
            model.warnings.add(fmt::format("scenes[{}]", scene),
                               "it lists nodes that are not roots");
    return model.tiny.scenes[scene].nodes;
}

void warnIfFlat(GltfModel& model, const glm::dmat4& world, int node)
{
    // Relative to the lengths of the axes: small objects are not flat ones.
    constexpr double kFlat = 1e-9;
    const glm::dmat3 m(world);
    const double axes = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    if (!(std::abs(glm::determinant(m)) > kFlat * axes))
        model.warnings.add(nodeField(node), "its transform is singular (a scale of zero)");
}

// ---- instancing -----------------------------------------------------------------------------

// The accessor that the extension names, -1 if it does not.
int instanceAccessor(const tinygltf::Value& extension, const char* name)
{
    const tinygltf::Value& attributes = extension.Get("attributes");
    return attributes.Has(name) ? attributes.Get(name).GetNumberAsInt() : -1;
}

std::vector<glm::dmat4> instanceMatrices(GltfModel& model, const tinygltf::Value& extension,
                                         const std::string& field)
{
    const int translations = instanceAccessor(extension, "TRANSLATION");
    const int rotations = instanceAccessor(extension, "ROTATION");
    const int scales = instanceAccessor(extension, "SCALE");
    const int any = std::max({translations, rotations, scales});
    if (any < 0)
        return {glm::dmat4(1)};
    const std::size_t count = model.tiny.accessors[static_cast<std::size_t>(any)].count;
    if (count > model.limits.nodes)
        failGltf("{}: the limit is {} instances, found {}", field, model.limits.nodes, count);
    std::vector<glm::vec3> t(count, glm::vec3(0));
    std::vector<glm::vec4> r(count, glm::vec4(0, 0, 0, 1));
    std::vector<glm::vec3> s(count, glm::vec3(1));
    if (translations >= 0)
        t = readGltfVec3(model, translations, count, field + ".TRANSLATION");
    if (rotations >= 0)
        r = readGltfVec4(model, rotations, count, field + ".ROTATION");
    if (scales >= 0)
        s = readGltfVec3(model, scales, count, field + ".SCALE");
    std::vector<glm::dmat4> matrices;
    matrices.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        matrices.push_back(compose(t[i], rotation(glm::dvec4(r[i])), s[i]));
    return matrices;
}

} // namespace

GltfNodes readGltfNodes(GltfModel& model)
{
    GltfNodes nodes;
    const std::vector<int> parents = findParents(model);
    nodes.world = worldMatrices(model, parents);
    nodes.visible = withDescendants(model, shownRoots(model, parents));
    return nodes;
}

std::vector<glm::mat4> gltfPlacements(GltfModel& model, const GltfNodes& nodes, int node)
{
    const glm::dmat4& world = nodes.world[static_cast<std::size_t>(node)];
    const auto& extensions = nodeAt(model, node).extensions;
    const auto instancing = extensions.find("EXT_mesh_gpu_instancing");
    const std::string field = nodeField(node) + ".extensions.EXT_mesh_gpu_instancing";
    std::vector<glm::dmat4> matrices{glm::dmat4(1)};
    if (instancing != extensions.end())
        matrices = instanceMatrices(model, instancing->second, field);
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

// ---- lights and cameras ---------------------------------------------------------------------

namespace {

// A unit vector along an axis of a transform, or `otherwise` where its scale is zero.
glm::vec3 axis(const glm::dvec4& column, const glm::vec3& otherwise)
{
    const double length = glm::length(glm::dvec3(column));
    return length > 0 ? glm::vec3(glm::dvec3(column) / length) : otherwise;
}

Light makeLight(const tinygltf::Light& source, const glm::dmat4& world)
{
    Light light;
    light.kind = source.type == "directional" ? LightKind::directional
        : source.type == "point"              ? LightKind::point
                                              : LightKind::spot;
    if (source.color.size() == 3)
        light.color = glm::vec3(source.color[0], source.color[1], source.color[2]);
    light.intensity = static_cast<float>(source.intensity);
    light.position = glm::vec3(world[3]);
    light.direction = -axis(world[2], {0, 0, 1}); // lights shine along their node's -z
    light.range = static_cast<float>(source.range);
    const double outer = std::clamp(source.spot.outerConeAngle, 0.0, 1.5707963267948966);
    light.outerCone = static_cast<float>(outer);
    light.innerCone = static_cast<float>(std::clamp(source.spot.innerConeAngle, 0.0, outer));
    return light;
}

Camera makeCamera(const tinygltf::Camera& source, const glm::dmat4& world)
{
    Camera camera;
    camera.name = source.name;
    camera.orthographic = source.type == "orthographic";
    // Sizes that show nothing, or more than half a sphere, are brought to the nearest usable one.
    if (camera.orthographic)
        camera.verticalExtent =
            static_cast<float>(std::max(2 * std::abs(source.orthographic.ymag), 1e-6));
    else
        camera.verticalFieldOfView =
            static_cast<float>(std::clamp(source.perspective.yfov, 0.001, 3.1));
    camera.eye = glm::vec3(world[3]);
    camera.target = camera.eye - axis(world[2], {0, 0, 1}); // cameras look along -z
    camera.up = axis(world[1], {0, 1, 0});
    return camera;
}

} // namespace

std::vector<Light> readGltfLights(const GltfModel& model, const GltfNodes& nodes)
{
    std::vector<Light> lights;
    for (const int node : nodes.visible) {
        const auto& extensions = nodeAt(model, node).extensions;
        const auto punctual = extensions.find("KHR_lights_punctual");
        if (punctual == extensions.end())
            continue;
        const int light = punctual->second.Get("light").GetNumberAsInt();
        lights.push_back(makeLight(model.tiny.lights[static_cast<std::size_t>(light)],
                                   nodes.world[static_cast<std::size_t>(node)]));
    }
    return lights;
}

std::vector<Camera> readGltfCameras(const GltfModel& model, const GltfNodes& nodes)
{
    std::vector<Camera> cameras;
    for (const int node : nodes.visible) {
        const int camera = nodeAt(model, node).camera;
        if (camera < 0)
            continue;
        cameras.push_back(makeCamera(model.tiny.cameras[static_cast<std::size_t>(camera)],
                                     nodes.world[static_cast<std::size_t>(node)]));
        if (cameras.back().name.empty())
            cameras.back().name = nodeAt(model, node).name;
    }
    return cameras;
}

} // namespace cotan
