// Visibility of surface points from the faces and corners of a cube, against rays tested with all triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "judgement_cases.hpp"
#include "lint_parts.hpp"

namespace cotan {
namespace {

using namespace test;

// A speck above the centre of a floor hides an area of it a tenth as wide as the largest pixel.
TEST(Visibility, reducesTheResolutionToThePixelLimit)
{
    std::vector<Corner> speck = rectangle({0.495, 0.495}, {0.01, 0.01}, {0, 0}, {1, 1});
    for (Corner& corner : speck)
        corner.position.z = 0.4f;
    const MappedSurface surface = surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}) + speck);
    std::vector<MeshPoint> points;
    for (int i = 0; i < 4096; ++i) // along the diagonal
        points.push_back({0, {0.3 + 0.4 * i / 4096, 0, 0.7 - 0.4 * i / 4096}});
    const auto hidden = [&](double maxPixels) {
        const std::vector<double> seen = lint::visibility(surface, points, false, maxPixels);
        return std::count_if(seen.begin(), seen.end(), [](double directions) { return directions < 5; });
    };
    EXPECT_GT(hidden(lint::kMaxPixels), 0);
    EXPECT_GT(hidden(1), 3 * hidden(lint::kMaxPixels));
}

// A floor under a roof of equal size: the centre of the floor is visible only from below.
TEST(Visibility, countsTheDirectionsThatSeeAPoint)
{
    std::vector<Corner> roof = rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1});
    for (Corner& corner : roof)
        corner.position.z = 0.1f;
    const MappedSurface surface = surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}) + roof);
    const MeshPoint ofFloor{0, {0.5, 0, 0.5}}, ofRoof{2, {0.5, 0, 0.5}};
    EXPECT_EQ(lint::visibility(surface, {ofFloor, ofRoof}, false), (std::vector<double>{0, 5}));
    EXPECT_EQ(lint::visibility(surface, {ofFloor, ofRoof}, true), (std::vector<double>{5, 5}));
    EXPECT_EQ(lint::visibility(surface, {ofFloor}, false), (std::vector<double>{1})); // hidden by itself: all alike
}

// ---- against rays ------------------------------------------------------------------------------

// Unit directions to the 6 faces and 8 corners of a cube, slightly rotated.
std::vector<glm::dvec3> cubeDirections()
{
    std::vector<glm::dvec3> directions;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 direction(0);
            direction[axis] = side;
            directions.push_back(direction);
        }
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0})
                directions.push_back({x, y, z});
    for (glm::dvec3& direction : directions)
        direction = glm::normalize(direction + glm::dvec3(0.05, 0.03, -0.04));
    return directions;
}

constexpr double kFlat = 0.05; // cosine up to which a face is too grazing to count

TEST(Visibility, countsTheDirectionsInFrontOfASingleTriangle)
{
    std::mt19937 random(5);
    const auto number = [&] { return float(random()) / float(1u << 31) - 1; };
    const auto any = [&] {
        const float x = number(), y = number();
        return glm::vec3(x, y, number());
    };
    std::set<double> counts;
    for (int i = 0; i < 300; ++i) {
        std::vector<Corner> corners = {{any(), {0, 0}}, {any(), {1, 0}}, {any(), {0, 1}}};
        glm::dvec3 face = glm::normalize(glm::cross(glm::dvec3(corners[1].position) - glm::dvec3(corners[0].position),
                                                    glm::dvec3(corners[2].position) - glm::dvec3(corners[0].position)));
        if (i % 2 == 0) // wound against its normals, which define outside
            face = -face;
        for (Corner& c : corners)
            c.normal = glm::normalize(glm::vec3(face) + 0.25f * any());
        double outside = 0, both = 0;
        bool close = false;
        for (const glm::dvec3& direction : cubeDirections()) {
            const double cosine = glm::dot(face, direction);
            outside += cosine > kFlat;
            both += std::abs(cosine) > kFlat;
            close = close || std::abs(std::abs(cosine) - kFlat) < 1e-5;
        }
        if (close)
            continue;
        const MappedSurface surface = surfaceOf(corners);
        const std::vector<MeshPoint> middle = {{0, glm::dvec3(1.0 / 3)}};
        EXPECT_EQ(lint::visibility(surface, middle, false), std::vector<double>{outside}) << i;
        EXPECT_EQ(lint::visibility(surface, middle, true), std::vector<double>{both}) << i;
        counts.insert(outside);
    }
    EXPECT_GT(counts.size(), 3u);
}

TEST(Visibility, isOneIfTheExtentIsZeroOrInfinite)
{
    const std::vector<MeshPoint> points(3);
    const std::vector<double> ones(3, 1);
    std::vector<Corner> point(3, {{1, 2, 3}, {0, 0}}), endless = rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1});
    endless[4].position.x = INFINITY;
    EXPECT_EQ(lint::visibility(surfaceOf(point), points, false), ones);
    EXPECT_EQ(lint::visibility(surfaceOf(endless), points, false), ones);
}

// A point and a line above the centre of a floor, each as a triangle: they hide nothing of the floor.
TEST(Visibility, trianglesWithoutAreaHideNothing)
{
    const std::vector<Corner> none = {{{0.5f, 0.5f, 0.4f}, {0, 0}}, {{0.5f, 0.5f, 0.4f}, {1, 0}},
                                      {{0.5f, 0.5f, 0.4f}, {0, 1}}, {{0.4f, 0.5f, 0.4f}, {0, 0}},
                                      {{0.5f, 0.5f, 0.4f}, {1, 0}}, {{0.6f, 0.5f, 0.4f}, {0, 1}}};
    std::vector<MeshPoint> points;
    for (int i = 0; i < 1000; ++i) // along the diagonal
        points.push_back({0, {0.1 + 0.8 * i / 1000, 0, 0.9 - 0.8 * i / 1000}});
    for (const double n : lint::visibility(surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}) + none), points, true))
        ASSERT_EQ(n, 10); // from the faces and corners of the cube on both sides
}

// Distance along the ray to the triangle, in units of the length of `direction`; infinite if it misses.
double hitDistance(glm::dvec3 from, glm::dvec3 direction, const glm::dvec3 (&p)[3])
{
    const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], across = glm::cross(direction, e2);
    const double volume = glm::dot(e1, across);
    if (std::abs(volume) < 1e-12)
        return INFINITY;
    const glm::dvec3 to = from - p[0], q = glm::cross(to, e1);
    const double u = glm::dot(to, across) / volume, v = glm::dot(direction, q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 ? glm::dot(e2, q) / volume : INFINITY;
}

// A floor, two roofs that cover parts of it, a wall and a slope, no two alike. Points are left out if their rays pass
// an edge within three pixels or hit something within the blur of a pixel.
TEST(Visibility, agreesWithRaysThroughAllTriangles)
{
    const auto plate = [](glm::vec3 at, glm::vec3 a, glm::vec3 b) {
        auto corners = rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1});
        for (Corner& c : corners) {
            c.position = at + a * c.position.x + b * c.position.y;
            c.normal = glm::normalize(glm::cross(a, b));
        }
        return corners;
    };
    const MappedSurface s =
        surfaceOf(plate({0, 0, 0}, {2, 0, 0}, {0, 1.5f, 0}) + plate({0.1f, 0.2f, 0.5f}, {0.8f, 0, 0}, {0, 0.9f, 0.1f})
                  + plate({1.1f, 0.1f, 0.9f}, {0, 1.2f, 0}, {0.7f, 0, 0.2f}) // its outer side faces down
                  + plate({1.05f, 0.3f, 0.1f}, {0, 1, 0}, {0, 0.1f, 0.7f})
                  + plate({0.2f, 1.2f, 0.1f}, {1.5f, 0, 0.2f}, {0, 0.2f, 1}));
    std::vector<MeshPoint> points;
    for (std::size_t f = 0; f < s.triangleCount(); ++f)
        for (int i = 1; i < 15; ++i)
            for (int k = 1; i + k < 15; ++k)
                points.push_back({f, {1 - (i + k) / 15.0, i / 15.0, k / 15.0}});
    glm::dvec3 low(1e9), high(-1e9);
    for (std::size_t c = 0; c < 3 * s.triangleCount(); ++c) {
        low = glm::min(low, s.position(c));
        high = glm::max(high, s.position(c));
    }
    const double pixel = glm::length(high - low) * 1.01 / std::floor(8 * std::sqrt(double(points.size())));
    for (const bool bothSides : {false, true}) {
        const std::vector<double> seen = lint::visibility(s, points, bothSides);
        const auto normal = [&](std::size_t f) { return glm::normalize(glm::dvec3(s.normal(3 * f))); };
        std::size_t compared = 0, hidden = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::size_t own = points[i].triangle;
            const glm::dvec3 by = points[i].barycentric;
            const glm::dvec3 at =
                s.position(3 * own) * by.x + s.position(3 * own + 1) * by.y + s.position(3 * own + 2) * by.z;
            double expected = 0;
            bool clear = true;
            for (const glm::dvec3& direction : cubeDirections()) {
                const double facing = glm::dot(normal(own), direction), cosine = bothSides ? std::abs(facing) : facing;
                if (!(cosine > kFlat))
                    continue;
                const double blurred = pixel * 4 * (1 + std::sqrt(1 - cosine * cosine) / cosine);
                const glm::dvec3 side = glm::normalize(glm::cross(direction, glm::dvec3(0.3, -0.5, 0.8))),
                                 up = glm::cross(direction, side);
                int stopped = 0, rays = 0;
                for (int x = -1; x <= 1; ++x)
                    for (int y = -1; y <= 1; ++y, ++rays) {
                        double first = INFINITY;
                        for (std::size_t f = 0; f < s.triangleCount(); ++f) {
                            const glm::dvec3 p[3] = {s.position(3 * f), s.position(3 * f + 1), s.position(3 * f + 2)};
                            const bool drawn = bothSides || glm::dot(normal(f), direction) > 0;
                            if (f / 2 == own / 2 || !drawn)
                                continue;
                            const double hit =
                                hitDistance(at + (side * double(x) + up * double(y)) * 2.5 * pixel, direction, p);
                            clear = clear && std::abs(hit) > blurred;
                            first = hit > 0 ? std::min(first, hit) : first;
                        }
                        stopped += std::isfinite(first);
                    }
                clear = clear && (stopped == 0 || stopped == rays);
                expected += stopped == 0;
                hidden += stopped == rays;
            }
            if (!clear)
                continue;
            ++compared;
            EXPECT_EQ(seen[i], expected) << "point " << i << " of triangle " << own;
        }
        EXPECT_GT(compared, points.size() / 8);
        EXPECT_GT(hidden, points.size() / 8);
    }
}

} // namespace
} // namespace cotan
