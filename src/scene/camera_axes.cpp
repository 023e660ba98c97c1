#include "scene/camera_axes.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"

namespace cotan {

namespace {

constexpr double kShortest = 1e-30; // of a vector that has a direction
constexpr double kParallel = 1e-6;  // sine of an angle below which `up` is along forward

} // namespace

CameraAxes axesAlong(const glm::dvec3& forward, const glm::dvec3& up)
{
    const glm::dvec3 other = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    glm::dvec3 side = glm::cross(forward, unitOr(up, other, kShortest));
    if (glm::length(side) < kParallel)
        side = glm::cross(forward, other);
    CameraAxes axes;
    axes.forward = forward;
    axes.right = side / glm::length(side);
    axes.up = glm::cross(axes.right, forward);
    return axes;
}

CameraAxes cameraAxes(const Camera& camera)
{
    const glm::dvec3 eye = isFinite(camera.eye) ? glm::dvec3(camera.eye) : glm::dvec3(0);
    CameraAxes axes = axesAlong(unitOr(glm::dvec3(camera.target) - eye, {0, 0, -1}, kShortest), glm::dvec3(camera.up));
    axes.eye = eye;
    return axes;
}

} // namespace cotan
