#include "camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"
#include "scene/geometry.hpp"

namespace cotan::viewer {

namespace {

constexpr float kMinDistance = 1e-6f, kMaxDistance = 1e12f; // distance of the eye from the pivot, world units
constexpr float kMaxElevation = 1.56f;                      // maximum elevation, radians: 89.4 degrees

struct Axes {
    glm::vec3 right, up, forward;
    float distance;
};

Axes axesOf(const Camera& camera)
{
    const CameraAxes axes = cameraAxes(camera);
    return {glm::vec3(axes.right), glm::vec3(axes.up), glm::vec3(axes.forward),
            glm::length(camera.target - camera.eye)};
}

glm::vec3 directionAt(float azimuth, float elevation)
{
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

// Azimuth and elevation of a direction. Vertical directions get the azimuth of `up` or of its opposite.
std::pair<float, float> anglesOf(const glm::vec3& direction, const glm::vec3& up)
{
    const bool vertical = std::abs(direction.x) + std::abs(direction.z) < 1e-4f;
    const glm::vec3 level = vertical ? (direction.y > 0 ? -up : up) : direction;
    return {std::atan2(level.x, level.z), std::asin(std::clamp(direction.y, -1.0f, 1.0f))};
}

// Applies a change only if the result is a usable camera.
void change(Camera& camera, const Camera& to)
{
    const float distance = glm::length(to.eye - to.target);
    const bool upValid = glm::length(glm::cross(to.target - to.eye, to.up)) > 1e-5f * distance;
    if (isFinite(to.eye) && isFinite(to.target) && distance >= kMinDistance && distance <= kMaxDistance && upValid
        && to.verticalExtent > kMinDistance && to.verticalExtent < kMaxDistance)
        camera = to;
}

} // namespace

float unitsOfPixel(const Camera& camera, float depth, glm::ivec2 size)
{
    const float height =
        camera.orthographic ? camera.verticalExtent : 2 * depth * std::tan(camera.verticalFieldOfView / 2);
    return height / float(std::max(size.y, 1));
}

void orbit(Camera& camera, float right, float upward)
{
    const glm::vec3 back = camera.eye - camera.target;
    const float distance = glm::length(back);
    const auto [azimuth, elevation] = anglesOf(back / distance, camera.up);
    Camera to = camera;
    to.up = {0, 1, 0};
    to.eye = camera.target
        + directionAt(azimuth + right, std::clamp(elevation + upward, -kMaxElevation, kMaxElevation)) * distance;
    change(camera, to);
}

void turnAbout(Camera& camera, const glm::vec3& point, float right)
{
    const float c = std::cos(right), s = std::sin(right);
    const auto turned = [&](const glm::vec3& v) { return glm::vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
    Camera to = camera;
    to.eye = point + turned(camera.eye - point);
    to.target = point + turned(camera.target - point);
    to.up = turned(camera.up);
    change(camera, to);
}

void pan(Camera& camera, glm::vec2 delta, glm::ivec2 size)
{
    const Axes axes = axesOf(camera);
    const glm::vec2 by = delta * unitsOfPixel(camera, axes.distance, size);
    Camera to = camera;
    const glm::vec3 move = axes.up * by.y - axes.right * by.x;
    to.eye += move;
    to.target += move;
    change(camera, to);
}

void zoomTo(Camera& camera, float factor, glm::vec2 pointer, glm::ivec2 size)
{
    if (!(factor > 0) || !std::isfinite(factor))
        return;
    const Axes axes = axesOf(camera);
    const glm::vec2 from = (pointer - glm::vec2(size) * 0.5f) * unitsOfPixel(camera, axes.distance, size);
    const glm::vec3 shift = (axes.right * from.x - axes.up * from.y) * (1 - factor);
    Camera to = camera;
    to.target += shift;
    to.eye = to.target - axes.forward * axes.distance * (camera.orthographic ? 1.0f : factor);
    to.verticalExtent *= camera.orthographic ? factor : 1.0f;
    change(camera, to);
}

void look(Camera& camera, float right, float upward)
{
    const glm::vec3 forward = camera.target - camera.eye;
    const float distance = glm::length(forward);
    const auto [azimuth, elevation] = anglesOf(forward / distance, -camera.up);
    Camera to = camera;
    to.up = {0, 1, 0};
    to.target = camera.eye
        + directionAt(azimuth - right, std::clamp(elevation + upward, -kMaxElevation, kMaxElevation)) * distance;
    change(camera, to);
}

void fly(Camera& camera, glm::vec3 by)
{
    const Axes axes = axesOf(camera);
    const glm::vec3 move = axes.right * by.x + axes.up * by.y + axes.forward * by.z;
    Camera to = camera;
    to.eye += move;
    to.target += move;
    change(camera, to);
}

void setPivot(Camera& camera, const glm::vec3& point)
{
    const Axes axes = axesOf(camera);
    Camera to = camera;
    if (camera.orthographic) { // keep the direction and move the eye
        to.target = point;
        to.eye = point - axes.forward * axes.distance;
    } else {
        to.target = point;
    }
    change(camera, to);
}

bool viewFrom(Camera& camera, const std::string& side)
{
    struct Direction {
        const char* name;
        glm::vec3 from, up;
    };
    static const std::array<Direction, 6> sides = {{{"front", {0, 0, 1}, {0, 1, 0}},
                                                    {"back", {0, 0, -1}, {0, 1, 0}},
                                                    {"left", {-1, 0, 0}, {0, 1, 0}},
                                                    {"right", {1, 0, 0}, {0, 1, 0}},
                                                    {"top", {0, 1, 0}, {0, 0, -1}},
                                                    {"bottom", {0, -1, 0}, {0, 0, 1}}}};
    for (const Direction& known : sides)
        if (side == known.name) {
            Camera to = camera;
            to.eye = camera.target + known.from * glm::length(camera.eye - camera.target);
            to.up = known.up;
            change(camera, to);
            return true;
        }
    return false;
}

void setOrthographic(Camera& camera, bool orthographic)
{
    if (camera.orthographic == orthographic)
        return;
    Camera to = camera;
    const Axes axes = axesOf(camera);
    const float lens = std::tan(camera.verticalFieldOfView / 2);
    if (orthographic)
        to.verticalExtent = 2 * axes.distance * lens;
    else
        to.eye = camera.target - axes.forward * camera.verticalExtent / (2 * lens);
    to.orthographic = orthographic;
    change(camera, to);
}

glm::vec3 projectToImage(const Camera& camera, const glm::vec3& point, glm::ivec2 size)
{
    const Axes axes = axesOf(camera);
    const glm::vec3 to = point - camera.eye;
    const float depth = glm::dot(to, axes.forward);
    const float units = unitsOfPixel(camera, depth, size);
    const bool behind = !camera.orthographic && depth <= 0;
    const glm::vec2 middle = glm::vec2(size) * 0.5f;
    if (behind || !(units > 0))
        return {middle.x, middle.y, behind ? depth : 0.0f};
    return {middle.x + glm::dot(to, axes.right) / units, middle.y - glm::dot(to, axes.up) / units,
            camera.orthographic ? 1.0f : depth};
}

} // namespace cotan::viewer
