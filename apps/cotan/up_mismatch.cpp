#include "up_mismatch.hpp"

#include <algorithm>

#include <glm/common.hpp>

namespace cotan::app {

namespace {

constexpr double kHardly = 0.5, kMore = 0.3; // fractions of the union of the volumes
constexpr float kThinnest = 0.01f;           // of the longest side

Bounds thickened(Bounds box)
{
    const glm::vec3 size = box.high - box.low;
    const float least = kThinnest * std::max({size.x, size.y, size.z});
    const glm::vec3 more = glm::max(glm::vec3(least) - size, glm::vec3(0)) * 0.5f;
    return {box.low - more, box.high + more};
}

double volumeOf(const Bounds& box)
{
    const glm::dvec3 size = glm::max(glm::dvec3(box.high) - glm::dvec3(box.low), glm::dvec3(0));
    return size.x * size.y * size.z;
}

// Intersection over union of two boxes, 0 to 1.
double shared(const Bounds& a, const Bounds& b)
{
    const double both = volumeOf({glm::max(a.low, b.low), glm::min(a.high, b.high)});
    const double all = volumeOf(a) + volumeOf(b) - both;
    return all > 0 ? both / all : 0;
}

} // namespace

Bounds rotatedZUp(const Bounds& box)
{
    return {{box.low.x, box.low.z, -box.high.y}, {box.high.x, box.high.z, -box.low.y}};
}

UpMismatch findUpMismatch(const Bounds& first, const Bounds& second)
{
    if (first.empty() || second.empty())
        return UpMismatch::none;
    const Bounds a = thickened(first), b = thickened(second);
    const double now = shared(a, b), ofFirst = shared(rotatedZUp(a), b), ofSecond = shared(a, rotatedZUp(b));
    const double best = std::max(ofFirst, ofSecond);
    if (now >= kHardly || best < now + kMore)
        return UpMismatch::none;
    if (std::min(ofFirst, ofSecond) > 0.9 * best)
        return UpMismatch::either;
    return ofFirst > ofSecond ? UpMismatch::first : UpMismatch::second;
}

} // namespace cotan::app
