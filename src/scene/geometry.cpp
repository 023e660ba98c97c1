#include "scene/geometry.hpp"

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

// Whether two linear maps differ by what all frames go along with, so that one surface stands for both.
bool alikeForFrames(const glm::dmat3& a, const glm::dmat3& b)
{
    const glm::dmat3 ga = glm::transpose(a) * a, gb = glm::transpose(b) * b;
    const double ta = ga[0][0] + ga[1][1] + ga[2][2], tb = gb[0][0] + gb[1][1] + gb[2][2];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(ga[i][j] * tb - gb[i][j] * ta) <= 1e-5 * ta * tb))
                return false;
    return true;
}

glm::vec3 turned(const glm::vec3& v) { return {v.x, v.z, -v.y}; }

} // namespace

Status checkVertexAttributes(const Scene& scene, Frame frame)
{
    if (!readsVertices(frame))
        return Done{};
    for (const Instance& instance : scene.instances) {
        const Mesh* mesh = meshPlacedBy(scene, instance);
        if (!mesh || mesh->triangleCount() == 0 || mesh->material < 0
            || std::size_t(mesh->material) >= scene.materials.size())
            continue;
        const std::size_t vertices = mesh->vertexCount();
        const bool hasUv =
            mesh->texcoords[uvSetOf(scene.materials[std::size_t(mesh->material)].normalMap)].size() >= vertices;
        const bool has = readsTangents(frame)
            ? mesh->tangents.size() >= vertices
            : mesh->cotangentsU.size() >= vertices && mesh->cotangentsV.size() >= vertices;
        if (vertices > 0 && hasUv && !has)
            return usageError((scene.name.empty() ? "scene" : scene.name) + ": mesh '" + mesh->name + "': expected "
                              + (readsTangents(frame) ? "tangents" : "cotangents") + " for the frame "
                              + std::string(name(frame)) + "; found none (deriveVertexFrames makes them)");
    }
    return Done{};
}

bool drawsNormalMaps(const Scene& scene)
{
    return std::ranges::any_of(scene.instances, [&](const Instance& i) {
        const Mesh* mesh = meshPlacedBy(scene, i);
        if (!mesh || mesh->triangleCount() == 0)
            return false;
        const Texture& map = scene.materials[std::size_t(mesh->material)].normalMap;
        return map.present() && !mesh->texcoords[map.texcoord == 1 ? 1 : 0].empty();
    });
}

void addPlacing(std::vector<glm::dmat3>& known, const glm::dmat3& linear)
{
    if (std::ranges::none_of(known, [&](const glm::dmat3& k) { return alikeForFrames(k, linear); }))
        known.push_back(linear);
}

void placeUnshown(std::vector<std::vector<glm::dmat3>>& placings)
{
    for (auto& known : placings)
        if (known.empty())
            known.push_back(glm::dmat3(1));
}

void turnZUp(Scene& scene)
{
    const glm::mat4 kTurn(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
    for (Instance& instance : scene.instances)
        instance.toWorld = kTurn * instance.toWorld;
    for (Light& light : scene.lights) {
        light.position = turned(light.position);
        light.direction = turned(light.direction);
    }
    for (Camera& camera : scene.cameras) {
        camera.eye = turned(camera.eye);
        camera.target = turned(camera.target);
        camera.up = turned(camera.up);
    }
    for (glm::vec3& point : scene.reach)
        point = turned(point);
}

} // namespace cotan
