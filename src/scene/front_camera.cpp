#include "cotan/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"
#include "scene/bounds.hpp"
#include "scene/camera_axes.hpp"

namespace cotan {

namespace {

using glm::dvec3;

constexpr double kFieldOfView = 0.523599; // 30 degrees
constexpr double kRadians = std::numbers::pi / 180;
constexpr double kFilled = 0.92; // of the picture, so that 4 % stay free on each side
constexpr float kFlat = 0.05f;   // depth over width or height

// The axes of a camera, and what it goes around.
struct Stand {
    dvec3 middle, right, up, back;
};

// A point as it is seen along one axis: its place, and how far before the eye it is.
struct Seen {
    double place = 0, before = 1;
};

// Moves the eye sideways until what is seen furthest to both sides is equally far from the middle, and likewise up and
// down. What was inside the picture stays there.
void centre(const Scene& scene, const Stand& stand, double distance, double& x, double& y)
{
    for (int round = 0; round < 4; ++round) {
        std::array<Seen, 4> furthest; // east, west, north, south
        std::array<double, 4> slope;
        slope.fill(-std::numeric_limits<double>::infinity());
        forEachFramedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
            const dvec3 p = dvec3(glm::dmat4(toWorld) * glm::dvec4(dvec3(point), 1)) - stand.middle;
            const double before = distance - glm::dot(p, stand.back);
            const double right = glm::dot(p, stand.right), up = glm::dot(p, stand.up);
            if (!(before > 0) || !std::isfinite(right) || !std::isfinite(up))
                return;
            const std::array<double, 4> here{(right - x) / before, (x - right) / before, (up - y) / before,
                                             (y - up) / before};
            for (std::size_t i = 0; i < 4; ++i)
                if (here[i] > slope[i]) {
                    slope[i] = here[i];
                    furthest[i] = {i < 2 ? right : up, before};
                }
        });
        if (!std::isfinite(slope[0]))
            return;
        const auto between = [](const Seen& a, const Seen& b) {
            return (a.place * b.before + b.place * a.before) / (a.before + b.before);
        };
        x = between(furthest[0], furthest[1]);
        y = between(furthest[2], furthest[3]);
    }
}

// From where `back` points to, with that direction up. A scene without finite points: where a camera stands by itself.
Camera filledFrom(const char* name, const Scene& scene, const Bounds& box, const dvec3& back, const glm::vec3& upward,
                  int width, int height)
{
    Camera camera;
    camera.name = name;
    camera.verticalFieldOfView = float(kFieldOfView);
    if (box.empty())
        return camera;
    camera.up = upward;
    const CameraAxes axes = axesAlong(-back, dvec3(upward));
    const dvec3 right = axes.right, up = axes.up;
    const dvec3 middle = dvec3(box.low) * 0.5 + dvec3(box.high) * 0.5;

    // A point at x, y, z of these axes is inside while |x - eye.x| <= tanX (eye.z - z): each point moves four planes.
    const double tanY = std::tan(kFieldOfView / 2) * kFilled;
    const double tanX = tanY * (width > 0 && height > 0 ? double(width) / height : 1.0);
    const double least = -std::numeric_limits<double>::infinity();
    double east = least, west = least, north = least, south = least, nearest = least;
    forEachFramedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
        const dvec3 p = dvec3(glm::dmat4(toWorld) * glm::dvec4(dvec3(point), 1)) - middle;
        if (!isFinite(p))
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
    double x = (east - west) / 2, y = (north - south) / 2;
    centre(scene, {middle, right, up, back}, distance, x, y);
    const dvec3 aim = middle + right * x + up * y;
    const glm::vec3 eye(aim + back * distance);
    if (!std::isfinite(distance) || !std::isfinite(eye.x + eye.y + eye.z))
        return camera;
    camera.target = glm::vec3(aim);
    camera.eye = eye;
    return camera;
}

// Without rounding at multiples of 90 degrees: sides are seen straight on.
double sineOf(double degrees)
{
    const double quarters = degrees / 90;
    if (quarters == std::floor(quarters))
        return std::array<double, 4>{0, 1, 0, -1}[std::size_t(std::fmod(std::fmod(quarters, 4) + 4, 4))];
    return std::sin(degrees * kRadians);
}

} // namespace

Camera frontCamera(const Scene& scene, int width, int height)
{
    const Bounds box = framedBounds(scene);
    const glm::vec3 size = box.high - box.low;
    const bool flat = size.z < kFlat * std::max(size.x, size.y);
    const dvec3 back = flat ? dvec3(0, 0, 1) : glm::normalize(dvec3(0.36, 0.24, 1));
    return filledFrom("front", scene, box, back, {0, 1, 0}, width, height);
}

Camera orbitCamera(const Scene& scene, double azimuth, double elevation, int width, int height)
{
    const double sinA = sineOf(azimuth), cosA = sineOf(azimuth + 90);
    const double sinE = sineOf(elevation), cosE = sineOf(elevation + 90);
    const glm::vec3 up = cosE == 0 ? glm::vec3(dvec3(-sinA, 0, -cosA) * sinE) : glm::vec3(0, 1, 0);
    return filledFrom("orbit", scene, framedBounds(scene), {sinA * cosE, sinE, cosA * cosE}, up, width, height);
}

} // namespace cotan
