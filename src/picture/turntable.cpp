#include "cotan/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cotan/vector.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

constexpr std::size_t kSlices = 32; // of the height
constexpr int kAround = 32;         // points per circle

glm::dvec3 middleOf(const Bounds& box) { return glm::dvec3(box.low) * 0.5 + glm::dvec3(box.high) * 0.5; }

} // namespace

std::vector<glm::vec3> sweptPoints(const Scene& scene)
{
    std::vector<glm::vec3> points;
    const Bounds box = framedBounds(scene);
    if (box.empty())
        return points;
    const glm::dvec3 middle = middleOf(box);
    const double low = box.low.y, height = double(box.high.y) - low;
    // Each circle is as wide as all vertices of the slices above and below it. The visible volume is convex: if it
    // contains all vertices at all angles, it contains the triangles, too.
    std::array<double, kSlices> widest{};
    forEachFramedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
        const glm::dvec3 p = glm::dvec3(glm::dmat4(toWorld) * glm::dvec4(glm::dvec3(point), 1));
        if (!isFinite(p))
            return;
        const double fraction = height > 0 ? (p.y - low) / height : 0;
        const std::size_t slice = std::min(std::size_t(std::max(fraction, 0.0) * kSlices), kSlices - 1);
        widest[slice] = std::max(widest[slice], std::hypot(p.x - middle.x, p.z - middle.z));
    });
    const double outside = 1 / std::cos(std::numbers::pi / kAround); // the polygon encloses the circle
    for (std::size_t edge = 0; edge <= kSlices; ++edge) {
        const double radius =
            outside * std::max(edge > 0 ? widest[edge - 1] : 0.0, edge < kSlices ? widest[edge] : 0.0);
        for (int i = 0; i < kAround; ++i) {
            const double angle = 2 * std::numbers::pi * i / kAround;
            points.emplace_back(middle.x + radius * std::sin(angle), low + height * double(edge) / kSlices,
                                middle.z + radius * std::cos(angle));
        }
    }
    return points;
}

Turntable::Turntable(const Scene& scene)
{
    for (const Instance& instance : scene.instances)
        transforms_.push_back(instance.toWorld);
    if (const Bounds box = framedBounds(scene); !box.empty())
        middle_ = middleOf(box);
}

void Turntable::turn(Scene& scene, double degrees) const
{
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    glm::dmat4 turn(1); // columns
    turn[0] = {c, 0, -s, 0};
    turn[2] = {s, 0, c, 0};
    turn[3] = {middle_.x - c * middle_.x - s * middle_.z, 0, middle_.z + s * middle_.x - c * middle_.z, 1};
    for (std::size_t i = 0; i < scene.instances.size() && i < transforms_.size(); ++i)
        scene.instances[i].toWorld = degrees == 0 ? transforms_[i] : glm::mat4(turn * glm::dmat4(transforms_[i]));
}

} // namespace cotan
