#include "scene/up.hpp"

namespace cotan {

namespace {

glm::vec3 turned(const glm::vec3& v) { return {v.x, v.z, -v.y}; }

} // namespace

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
