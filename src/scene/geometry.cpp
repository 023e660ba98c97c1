#include "scene/geometry.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cotan/vector.hpp"
#include "scene/camera_axes.hpp"
#include "scene/texture_uv.hpp"

namespace cotan {

namespace {

constexpr float kVerticalFieldOfView = 0.785398f; // 45 degrees
constexpr float kMargin = 0.94f;                  // of the half picture that the box may fill
constexpr float kFlatness = 0.05f;                // depth over width or height below which a box is a picture
const glm::vec3 kFrontRightAbove{0.40f, 0.35f, 1.0f};

// The smallest distance along `back` from the centre at which every corner of the box is inside
// the picture with the margin.
float distanceToSee(glm::vec3 halfSize, glm::vec3 back, float tanX, float tanY)
{
    const CameraAxes axes = axesAlong(-glm::dvec3(back), glm::dvec3(0, 1, 0));
    const glm::vec3 right(axes.right), up(axes.up);
    float distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = halfSize * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const float beside = std::max(std::abs(glm::dot(p, right)) / tanX, std::abs(glm::dot(p, up)) / tanY);
        distance = std::max(distance, glm::dot(p, back) + beside / kMargin);
    }
    return distance;
}

} // namespace

Camera fitCamera(const Bounds& box, int width, int height)
{
    Camera camera;
    camera.name = "fit";
    camera.verticalFieldOfView = kVerticalFieldOfView;
    if (box.empty() || !isFinite(box.low) || !isFinite(box.high))
        return camera;

    // Halved before they are subtracted, so that the largest floats do not overflow.
    const glm::vec3 centre = box.low * 0.5f + box.high * 0.5f;
    const glm::vec3 halfSize = box.high * 0.5f - box.low * 0.5f;
    const bool flat = halfSize.z < kFlatness * std::max(halfSize.x, halfSize.y);
    const glm::vec3 back = flat ? glm::vec3(0, 0, 1) : glm::normalize(kFrontRightAbove);

    const float aspect = width > 0 && height > 0 ? float(width) / float(height) : 1.0f;
    const float tanY = std::tan(kVerticalFieldOfView / 2);
    float distance = distanceToSee(halfSize, back, tanY * aspect, tanY);
    if (!(distance > 0)) { // a single point: any distance that rounding does not swallow shows it
        const glm::vec3 size = glm::abs(centre);
        distance = std::max(1.0f, std::max({size.x, size.y, size.z}) * 1e-3f);
    }
    const glm::vec3 eye = centre + back * distance;
    if (!isFinite(eye)) // a box of nearly the largest floats
        return camera;
    camera.target = centre;
    camera.eye = eye;
    return camera;
}

Camera turnedAbout(Camera camera, double angle)
{
    const glm::vec3 d = camera.eye - camera.target;
    const float c = float(std::cos(angle)), s = float(std::sin(angle));
    camera.eye = camera.target + glm::vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
    return camera;
}

std::vector<Light> defaultLights()
{
    Light key;
    key.kind = LightKind::directional;
    key.direction = glm::normalize(glm::vec3(0.5f, -0.9f, -0.75f));
    return {key};
}

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
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& i) {
        const Mesh* mesh = meshPlacedBy(scene, i);
        if (!mesh || mesh->triangleCount() == 0)
            return false;
        const Texture& map = scene.materials[std::size_t(mesh->material)].normalMap;
        return map.present() && !mesh->texcoords[map.texcoord == 1 ? 1 : 0].empty();
    });
}

} // namespace cotan
