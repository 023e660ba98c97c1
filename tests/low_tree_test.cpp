// Nearest points and rays among random triangles, against an exhaustive search in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "bake/low_tree.hpp"

namespace cotan {
namespace {

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    std::vector<std::int64_t> shown;
};

// Triangles of one size and needles a tenth as wide; `shown` cycles through -1, 0 and 1.
Triangles randomTriangles(std::mt19937& random, std::size_t count)
{
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto vector = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
    Triangles t;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 a = vector(), b = a + 0.4f * vector();
        const glm::vec3 c = i % 5 == 0 ? b + 0.04f * vector() : a + 0.4f * vector();
        for (const glm::vec3 p : {a, b, c}) {
            t.indices.push_back(std::uint32_t(t.positions.size()));
            t.positions.push_back(p);
        }
        t.shown.push_back(int(i % 3) - 1);
    }
    return t;
}

struct Corners {
    glm::dvec3 a, b, c;
};

Corners cornersOf(const Triangles& t, std::size_t triangle)
{
    const auto at = [&](std::size_t i) { return glm::dvec3(t.positions[t.indices[3 * triangle + i]]); };
    return {at(0), at(1), at(2)};
}

glm::dvec3 nearestOnSegment(glm::dvec3 a, glm::dvec3 b, glm::dvec3 p)
{
    const double length2 = glm::dot(b - a, b - a);
    return a + (length2 > 0 ? glm::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0.0) * (b - a);
}

// Distance to the triangle: to its plane if the foot is inside all edges, otherwise to the nearest edge.
double distanceTo(const Corners& t, glm::dvec3 p)
{
    const glm::dvec3 n = glm::cross(t.b - t.a, t.c - t.a);
    if (glm::length(n) > 1e-9) {
        const glm::dvec3 foot = p - n * (glm::dot(p - t.a, n) / glm::dot(n, n));
        const auto inside = [&](glm::dvec3 a, glm::dvec3 b) { return glm::dot(glm::cross(b - a, foot - a), n) >= 0; };
        if (inside(t.a, t.b) && inside(t.b, t.c) && inside(t.c, t.a))
            return glm::distance(p, foot);
    }
    return std::min({glm::distance(p, nearestOnSegment(t.a, t.b, p)), glm::distance(p, nearestOnSegment(t.b, t.c, p)),
                     glm::distance(p, nearestOnSegment(t.c, t.a, p))});
}

TEST(LowTree, nearestPointEqualsLinearSearch)
{
    std::mt19937 random(5);
    const Triangles t = randomTriangles(random, 60);
    const auto tree = LowTree::make(t.positions, t.indices, t.shown, 1);
    ASSERT_TRUE(tree) << tree.error().message;
    std::uniform_real_distribution<float> unit(-1.5f, 1.5f);
    std::size_t corners = 0, edges = 0, inside = 0, none = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 p(unit(random), unit(random), unit(random));
        const float radius = i % 4 == 0 ? 0.2f : 10.0f;
        const auto accepts = [&](std::uint32_t f) { return i % 2 == 0 || f % 2 == 0; };
        double nearestDistance = std::numeric_limits<double>::infinity();
        for (std::uint32_t f = 0; f < 60; ++f)
            if (accepts(f))
                nearestDistance = std::min(nearestDistance, distanceTo(cornersOf(t, f), p));
        const LowTree::Nearest found = tree->nearest(p, radius, accepts);
        if (std::abs(nearestDistance - radius) < 1e-5)
            continue; // rounding decides whether the triangle is near enough
        ASSERT_EQ(found.found, nearestDistance < radius) << i;
        if (!found.found) {
            ++none;
            continue;
        }
        // A float keeps 24 bits of coordinates below 2.
        EXPECT_NEAR(found.distance, nearestDistance, 2e-6) << i;
        EXPECT_TRUE(accepts(found.triangle)) << i;
        const Corners of = cornersOf(t, found.triangle);
        EXPECT_NEAR(distanceTo(of, p), nearestDistance, 2e-6) << i;
        const double b1 = found.b1, b2 = found.b2, b0 = 1 - b1 - b2;
        EXPECT_TRUE(b0 >= -1e-6 && b1 >= 0 && b2 >= 0) << b0 << ' ' << b1 << ' ' << b2;
        EXPECT_LT(glm::distance(of.a * b0 + of.b * b1 + of.c * b2, glm::dvec3(found.point)), 2e-6) << i;
        EXPECT_NEAR(glm::distance(glm::dvec3(found.point), glm::dvec3(p)), nearestDistance, 2e-6) << i;
        const int zeros = (b0 < 1e-6) + (b1 < 1e-6) + (b2 < 1e-6);
        ++(zeros == 2 ? corners : zeros == 1 ? edges : inside);
    }
    EXPECT_GT(std::min({corners, edges, inside, none}), 50u); // each region of a triangle is tested
}

// Distance to the triangle along a unit ray, infinity if it misses (plane, then the side of each edge).
double rayDistance(const Corners& t, glm::dvec3 origin, glm::dvec3 direction, double& margin)
{
    const glm::dvec3 n = glm::cross(t.b - t.a, t.c - t.a);
    const double across = glm::dot(n, direction);
    if (glm::length(n) < 1e-9 || across == 0)
        return std::numeric_limits<double>::infinity();
    const double distance = glm::dot(t.a - origin, n) / across;
    const glm::dvec3 p = origin + distance * direction;
    const auto side = [&](glm::dvec3 a, glm::dvec3 b) {
        return glm::dot(glm::cross(b - a, p - a), n) / glm::dot(n, n);
    };
    const double least = std::min({side(t.a, t.b), side(t.b, t.c), side(t.c, t.a)});
    margin = std::min(margin, std::abs(least));
    return least >= 0 ? distance : std::numeric_limits<double>::infinity();
}

TEST(LowTree, firstHitEqualsLinearSearch)
{
    std::mt19937 random(6);
    const Triangles t = randomTriangles(random, 200);
    const auto tree = LowTree::make(t.positions, t.indices, t.shown, 1);
    ASSERT_TRUE(tree) << tree.error().message;
    std::uniform_real_distribution<float> unit(-1, 1);
    std::size_t met = 0, missed = 0, beside = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::vec3 origin = 2.0f * glm::normalize(glm::vec3(unit(random), unit(random), unit(random)));
        const Ray ray{origin, glm::normalize(0.8f * glm::vec3(unit(random), unit(random), unit(random)) - origin), 0.5f,
                      2.5f};
        const std::uint32_t fromTriangle = std::uint32_t(i) % 200;
        double nearest = std::numeric_limits<double>::infinity(), nearestBeside = nearest, margin = 1;
        for (std::uint32_t f = 0; f < 200; ++f) {
            const double distance = rayDistance(cornersOf(t, f), ray.origin, ray.direction, margin);
            margin = std::min({margin, std::abs(distance - ray.nearest), std::abs(distance - ray.farthest)});
            if (distance < ray.nearest || distance > ray.farthest)
                continue;
            nearest = std::min(nearest, distance);
            if (t.shown[fromTriangle] < 0 || t.shown[f] < 0 || t.shown[fromTriangle] == t.shown[f])
                nearestBeside = std::min(nearestBeside, distance);
        }
        if (margin < 1e-4)
            continue; // an edge or an end of the ray: rounding decides
        const LowTree::TreeHit first = tree->first(ray), besides = tree->firstBeside(fromTriangle, ray);
        ASSERT_EQ(first.found, std::isfinite(nearest)) << i;
        ASSERT_EQ(besides.found, std::isfinite(nearestBeside)) << i;
        ++(first.found ? met : missed);
        if (first.found) {
            EXPECT_NEAR(first.distance, nearest, 1e-5) << i;
            const Corners of = cornersOf(t, first.triangle);
            const double b1 = first.b1, b2 = first.b2;
            EXPECT_LT(glm::distance(of.a * (1 - b1 - b2) + of.b * b1 + of.c * b2,
                                    glm::dvec3(ray.origin) + nearest * glm::dvec3(ray.direction)),
                      1e-4)
                << i; // needles are 0.02 wide
        }
        if (besides.found) {
            EXPECT_NEAR(besides.distance, nearestBeside, 1e-5) << i;
            beside += besides.triangle != first.triangle;
        }
    }
    EXPECT_GT(std::min({met, missed, beside}), 50u);
}

TEST(LowTree, faceNormalsAreUnitAndZeroWithoutArea)
{
    const auto tree = LowTree::make({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {1, 0, 0}}, {0, 1, 2, 2, 1, 0, 0, 1, 3}, {}, 1);
    ASSERT_TRUE(tree) << tree.error().message;
    EXPECT_EQ(tree->face(0), glm::vec3(0, 0, 1));
    EXPECT_EQ(tree->face(1), glm::vec3(0, 0, -1));
    EXPECT_EQ(tree->face(2), glm::vec3(0));
}

} // namespace
} // namespace cotan
