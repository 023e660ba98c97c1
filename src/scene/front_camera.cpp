#include "cotan/scene/front_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "cotan/scene/bounds.hpp"

namespace cotan {

namespace {

using glm::dvec3;

constexpr double kFieldOfView = 0.523599; // 30 degrees
constexpr double kFilled = 0.92;          // of the picture, so that 4 % stay free on each side
constexpr float kFlat = 0.05f;            // depth over width or height

} // namespace

Camera frontCamera(const Scene& scene, int width, int height)
{
    Camera camera;
    camera.name = "front";
    camera.verticalFieldOfView = float(kFieldOfView);
    const Bounds box = bounds(scene);
    if (box.empty())
        return camera;
    const glm::vec3 size = box.high - box.low;
    const bool flat = size.z < kFlat * std::max(size.x, size.y);
    const dvec3 back = flat ? dvec3(0, 0, 1) : glm::normalize(dvec3(0.36, 0.24, 1));
    const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), back)), up = glm::cross(back, right);
    const dvec3 middle = dvec3(box.low) * 0.5 + dvec3(box.high) * 0.5;

    // A point at x, y, z of these axes is inside while |x - eye.x| <= tanX (eye.z - z): each point moves four planes.
    const double tanY = std::tan(kFieldOfView / 2) * kFilled;
    const double tanX = tanY * (width > 0 && height > 0 ? double(width) / height : 1.0);
    const double least = -std::numeric_limits<double>::infinity();
    double east = least, west = least, north = least, south = least, nearest = least;
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
        const dvec3 p = dvec3(glm::dmat4(toWorld) * glm::dvec4(dvec3(point), 1)) - middle;
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return;
        const double x = glm::dot(p, right), y = glm::dot(p, up), z = glm::dot(p, back);
        east = std::max(east, x + tanX * z);
        west = std::max(west, -x + tanX * z);
        north = std::max(north, y + tanY * z);
        south = std::max(south, -y + tanY * z);
        nearest = std::max(nearest, z);
    });
    double distance = std::max((east + west) / (2 * tanX), (north + south) / (2 * tanY));
    const double magnitude = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)});
    if (!(distance - nearest > 1e-3 * magnitude)) // a point, or nearly: a distance that rounding does not swallow
        distance = nearest + std::max(1e-3 * magnitude, distance > nearest ? distance - nearest : 1.0);
    const dvec3 aim = middle + right * ((east - west) / 2) + up * ((north - south) / 2);
    const glm::vec3 eye(aim + back * distance);
    if (!std::isfinite(distance) || !std::isfinite(eye.x + eye.y + eye.z))
        return camera;
    camera.target = glm::vec3(aim);
    camera.eye = eye;
    return camera;
}

} // namespace cotan
