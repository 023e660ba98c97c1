// Distances at which rays start, on a square with a few points above, worked out by hand: both sides of each bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "bake/ray_starts.hpp"
#include "bake_scene.hpp"

namespace cotan {
namespace {

// Triangles that share vertices, all of one instance. `normals` may have any length.
LowSurface lowOf(std::vector<glm::vec3> positions, std::vector<glm::vec3> normals, std::vector<std::uint32_t> indices)
{
    LowSurface low;
    low.positions = std::move(positions);
    low.normals = std::move(normals);
    low.indices = std::move(indices);
    low.texcoords.resize(low.positions.size());
    low.triangleInstance.assign(low.triangleCount(), 0);
    return low;
}

// The square from (0, 0) to (side, side) in z = 0, facing up; corners (0, 0), (side, 0), (side, side), (0, side).
LowSurface squareOf(float side)
{
    return lowOf({{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}, std::vector(4, glm::vec3(0, 0, 1)),
                 {0, 1, 2, 0, 2, 3});
}

// The margin by which all vertices start outside: 0.002 of the diagonal.
float marginOf(float diagonal) { return 0.002f * diagonal; }
float startOf(float distance, float diagonal) { return 1.05f * distance + marginOf(diagonal); }

const float kRoot2 = std::sqrt(2.0f);

// A triangle too small to be subdivided, at `at`, perpendicular to `face`; its corners have the normal `normal`.
Mesh speck(glm::vec3 at, glm::vec3 normal = {0, 0, 1}, glm::vec3 face = {0, 0, 1})
{
    const glm::vec3 n = glm::normalize(face);
    const glm::vec3 a = glm::normalize(glm::cross(glm::vec3(0, 1, 0), n)), b = glm::cross(n, a);
    constexpr float kSize = 1e-4f;
    Mesh mesh;
    for (const glm::vec2 c : {glm::vec2(1, 0), {-0.5f, 0.866f}, {-0.5f, -0.866f}}) {
        mesh.positions.push_back(at + kSize * (c.x * a + c.y * b));
        mesh.normals.push_back(normal);
    }
    mesh.indices = {0, 1, 2};
    return mesh;
}

RayStarts startsOf(const LowSurface& low, const std::vector<Mesh>& high, const BakeOptions& options = {},
                   const LowRest& rest = {})
{
    const auto surface = HighSurface::make({sceneOfMeshes(high)}, 1, !options.matched.empty());
    EXPECT_TRUE(surface);
    const auto starts = makeRayStarts(low, *surface, options, rest);
    EXPECT_TRUE(starts) << (starts ? "" : starts.error().message);
    return starts ? *starts : RayStarts{};
}

// A speck of size 1e-4 is as far away as its centre, up to its own size.
void expectDistances(const RayStarts& starts, const std::vector<float>& expected, const char* what)
{
    ASSERT_GE(starts.distances.size(), expected.size()) << what;
    for (std::size_t v = 0; v < expected.size(); ++v)
        EXPECT_NEAR(starts.distances[v], expected[v], 2e-3f * expected[v] + 2e-5f) << what << ", vertex " << v;
}

TEST(RayStarts, aPointRaisesTheCornersOfItsTriangleUpToTheLimit)
{
    const float none = marginOf(kRoot2);
    BakeOptions limited;
    limited.maxDistance = 0.05f;
    const struct {
        float height;
        BakeOptions options;
        float expected;
    } cases[] = {
        {0.14f, {}, startOf(0.14f, kRoot2)}, // below the default limit: 0.1 * sqrt(2) = 0.1414
        {0.143f, {}, none},
        {0.04f, limited, startOf(0.04f, kRoot2)},
        {0.049f, limited, 0.05f}, // never beyond the limit, whatever is added
        {0.051f, limited, none},
        {-0.04f, {}, none}, // behind the surface: rays reach it from the margin
        {0, {}, none},
    };
    for (const auto& c : cases) {
        // Above the triangle of the first three corners only.
        const RayStarts starts = startsOf(squareOf(1), {speck({0.6f, 0.3f, c.height})}, c.options);
        expectDistances(starts, {c.expected, c.expected, c.expected, none}, "height");
        EXPECT_EQ(starts.farthest, *std::max_element(starts.distances.begin(), starts.distances.end()));
        EXPECT_NEAR(starts.limit, c.options.maxDistance > 0 ? 0.05f : 0.1f * kRoot2, 1e-6f);
        EXPECT_NEAR(starts.skip, 1e-4f * kRoot2, 1e-8f);
        EXPECT_FALSE(starts.directionsDiffer);
        EXPECT_TRUE(starts.tree.has_value());
    }
    BakeOptions extruded;
    extruded.extrusion = 0.3f;
    const RayStarts starts = startsOf(squareOf(1), {speck({0.6f, 0.3f, 0.04f})}, extruded);
    EXPECT_EQ(starts.distances, std::vector<float>(4, 0.3f));
    EXPECT_EQ(starts.obstructed, std::vector<std::uint8_t>(2, 0));
    EXPECT_EQ(starts.farthest, 0.3f);
    EXPECT_FALSE(starts.tree.has_value());
}

// A unit vector in the xz plane whose cosine with z is `cosine`.
glm::vec3 leaning(float cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

TEST(RayStarts, onlyPointsThatFaceLikeTheTriangleCount)
{
    const float none = marginOf(kRoot2), found = startOf(0.1f, kRoot2);
    LowSurface wound = squareOf(1); // normals, not winding, define the outside
    for (std::size_t i = 0; i < 6; i += 3)
        std::swap(wound.indices[i + 1], wound.indices[i + 2]);
    for (const LowSurface& low : {squareOf(1), wound})
        for (const auto& [normal, expected] : {std::pair(leaning(0.11f), found),
                                               {leaning(0.09f), none},
                                               {{0, 0, -1}, none},
                                               {{0, 0, 0}, none}}) // an unknown normal faces nothing
            expectDistances(startsOf(low, {speck({0.6f, 0.3f, 0.1f}, normal)}), {expected, expected, expected, none},
                            "facing");
}

TEST(RayStarts, aPointBesideTheSurfaceCountsUpToALimitingAngle)
{
    // Beyond the edge x = 1, the nearest point is on it. The direction needs a cosine of at least 0.35 with the normal.
    const float none = marginOf(kRoot2);
    for (const auto& [cosine, counts] : {std::pair(0.36f, true), {0.34f, false}}) {
        const float gap = 0.1f;
        const glm::vec3 at = glm::vec3(1, 0.5f, 0) + gap * leaning(cosine);
        // Corners move until their own plane is at the speck's distance: division by the cosine.
        const float expected = counts ? startOf(gap / cosine, kRoot2) : none;
        const RayStarts starts = startsOf(squareOf(1), {speck(at)});
        ASSERT_EQ(starts.distances.size(), 4u);
        for (const std::size_t v : {1u, 2u})
            EXPECT_NEAR(starts.distances[v], expected, 0.01f * expected) << cosine; // specks have 0.1 % of the distance
        EXPECT_NEAR(starts.distances[0], none, 1e-5f);                              // not on that edge
        EXPECT_NEAR(starts.distances[3], none, 1e-5f);
    }
}

TEST(RayStarts, leaningCornersMoveFurtherUpToALimit)
{
    // Normals at cosines 0.2, 0.5 and 1 to the direction of a point above the middle; the divisor is at least 0.3.
    const glm::vec3 back(-leaning(0.2f).x, 0, 0.2f); // keeps the mean nearly upright
    const LowSurface low = lowOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {back, leaning(0.5f), {0, 0, 1}}, {0, 1, 2});
    const float height = 0.04f;
    expectDistances(startsOf(low, {speck({0.33f, 0.33f, height})}),
                    {startOf(height / 0.3f, kRoot2), startOf(height / 0.5f, kRoot2), startOf(height, kRoot2)},
                    "leaning");
}

// A square of side 1 beside many tiny triangles: its edges are long in comparison.
LowSurface squareBesideSmallTriangles()
{
    LowSurface low = squareOf(1);
    for (int i = 0; i < 98; ++i) {
        const auto base = std::uint32_t(low.positions.size());
        const glm::vec3 at(float(i) / 98, 1.001f, 0);
        for (const glm::vec3 gap : {glm::vec3(0), {1e-3f, 0, 0}, {0, 1e-3f, 0}}) {
            low.positions.push_back(at + gap);
            low.normals.push_back({0, 0, 1});
            low.texcoords.push_back({});
        }
        low.indices.insert(low.indices.end(), {base, base + 1, base + 2});
        low.triangleInstance.push_back(0);
    }
    return low;
}

TEST(RayStarts, isolatedVerticesAndThoseWithShortEdgesTraceTheirOwnRay)
{
    // `onRay` above the first corner is found only by that vertex's ray, because its normals face sideways and match no
    // triangle. `point` is elsewhere above the same triangle.
    const Mesh onRay = speck({0, 0, 0.08f}, leaning(0.05f)), point = speck({0.6f, 0.3f, 0.01f});
    const LowSurface alone = squareOf(1), beside = squareBesideSmallTriangles();
    const float none = marginOf(kRoot2), ray = startOf(0.08f, kRoot2), low = startOf(0.01f, kRoot2);
    expectDistances(startsOf(alone, {onRay}), {ray, none, none, none}, "nothing else");
    expectDistances(startsOf(alone, {onRay, point}), {ray, low, low, none}, "all edges are short");
    expectDistances(startsOf(beside, {onRay}), {ray, none, none, none}, "long edges, nothing belongs");
    expectDistances(startsOf(beside, {onRay, point}), {low, low, low, none}, "long edges, something belongs");
    // The outermost front face within the limit counts.
    const Mesh beyond = speck({0, 0, 0.15f}, leaning(0.05f)), lower = speck({0, 0, 0.03f}, leaning(0.05f));
    expectDistances(startsOf(alone, {beyond}), {none, none, none, none}, "further than the limit");
    expectDistances(startsOf(alone, {beyond, onRay, lower}), {ray, none, none, none}, "the outermost");
    for (const auto& [cosine, expected] : {std::pair(0.11f, ray), {0.09f, none}})
        expectDistances(startsOf(alone, {speck({0, 0, 0.08f}, leaning(0.05f), leaning(cosine))}),
                        {expected, none, none, none}, "facing aside");
}

TEST(RayStarts, aRayPassesFifteenBackfacingLayers)
{
    const float none = marginOf(kRoot2), found = startOf(0.03f, kRoot2);
    for (const auto& [layers, expected] : {std::pair(1, found), {15, found}, {16, none}}) {
        std::vector<Mesh> high{speck({0, 0, 0.03f}, leaning(0.05f))};
        for (int i = 0; i < layers; ++i)
            high.push_back(speck({0, 0, 0.05f + 0.004f * float(i)}, {0, 0, -1}, {0, 0, -1}));
        const RayStarts starts = startsOf(squareOf(1), high);
        EXPECT_NEAR(starts.distances.at(0), expected, 5e-4f) << layers; // each layer costs 1e-5 of the diagonal
    }
}

// A large triangle is sampled at the points i, j of a regular subdivision of its edges; the highest sample between z =
// 0 and the limit counts.
TEST(RayStarts, largeTrianglesAreSubdividedToTheSizeOfLowOnes)
{
    // A square of 10: triangles count as 1.5 sqrt(50) = 10.6 wide, the limit is 1.414. Edges of the large triangle are
    // up to 50.6 long, so 5 parts: z = -20 + 10 i + 5.6 j. Edges up to 1280.0 give the maximum, 64 parts.
    for (const auto& [cuts, bottom, first, second] :
         {std::array{5.0f, -20.0f, 10.0f, 5.6f}, {64.0f, -408.8f, 20.0f, 9.0f}}) {
        const glm::vec3 corner(1, 1, bottom);
        Mesh large;
        large.positions = {corner, corner + glm::vec3(8, 0, cuts * first), corner + glm::vec3(8, 8, cuts * second)};
        large.normals.assign(3, {0, 0, 1});
        large.indices = {0, 1, 2};
        float highest = 0;
        for (int i = 0; i <= int(cuts); ++i)
            for (int j = 0; j <= int(cuts) - i; ++j)
                if (const float z = bottom + first * float(i) + second * float(j); z <= 1.414f)
                    highest = std::max(highest, z);
        ASSERT_NEAR(highest, 1.2f, 1e-4f);
        const RayStarts starts = startsOf(squareOf(10), {large});
        const float found = startOf(highest, 10 * kRoot2), none = marginOf(10 * kRoot2);
        expectDistances(starts, {found, found, found, none}, "cuts"); // x > y: above the first triangle
    }
    Mesh unknown; // normals that cancel out match no triangle
    unknown.positions = {{1, 1, -20}, {9, 1, 30}, {9, 9, 8}};
    unknown.normals.assign(3, {0, 0, 0});
    unknown.indices = {0, 1, 2};
    expectDistances(startsOf(squareOf(10), {unknown}), std::vector(4, marginOf(10 * kRoot2)), "no normals");
}

// ---- directions -----------------------------------------------------------------------------

// Two triangles along an edge from y = 0 to 1, each with its own vertices there. Their normals are tilted by `half`
// degrees to opposite sides of z; their angles at the origin are 60 and 30 degrees.
LowSurface ridge(float half)
{
    const float a = glm::radians(half), third = glm::radians(60.0f), sixth = glm::radians(30.0f);
    const glm::vec3 right(std::cos(a), 0, -std::sin(a)), left(-std::cos(a), 0, -std::sin(a)), up(0, 1, 0);
    const glm::vec3 n1(std::sin(a), 0, std::cos(a)), n2(-std::sin(a), 0, std::cos(a));
    return lowOf({{0, 0, 0},
                  std::sin(third) * right + std::cos(third) * up,
                  up,
                  {0, 0, 0},
                  up,
                  std::sin(sixth) * left + std::cos(sixth) * up},
                 {n1, n1, n1, n2, n2, n2}, {0, 1, 2, 3, 4, 5});
}

TEST(RayStarts, directionsAreAngleWeightedMeansUnlessTheseLeanTooFar)
{
    const std::vector<Mesh> away{speck({0, 0, 50})};
    const LowSurface low = ridge(40);
    const RayStarts starts = startsOf(low, away);
    const glm::vec3 mean = glm::normalize(low.normals[0] * 60.0f + low.normals[3] * 30.0f);
    for (const std::size_t v : {0u, 3u})
        EXPECT_LT(glm::length(starts.directions.at(v) - mean), 1e-6f);
    for (const std::size_t v : {1u, 5u}) // not shared
        EXPECT_EQ(starts.directions.at(v), low.normals[v]);
    EXPECT_TRUE(starts.directionsDiffer);
    // With weights 2 and 1 the cosine between the mean and the second normal is (2 c + 1) / sqrt(5 + 4 c), where c is
    // the cosine between the normals. It is 0.2 at c = -0.306, 107.8 degrees.
    const auto cosineFor = [](double half) {
        const double c = std::cos(glm::radians(2 * half));
        return (2 * c + 1) / std::sqrt(5 + 4 * c);
    };
    ASSERT_GT(cosineFor(53.5), 0.2);
    ASSERT_LT(cosineFor(54.5), 0.2);
    for (const auto& [half, leans] : {std::pair(53.5f, false), {54.5f, true}}) {
        const LowSurface steep = ridge(half);
        const RayStarts found = startsOf(steep, away);
        EXPECT_EQ(found.directions.at(3) == steep.normals[3], leans) << half;
        EXPECT_NE(found.directions.at(0), steep.normals[0]) << half; // the mean is closer to the larger weight
    }
    LowSurface apart = ridge(40); // two instances share nothing
    apart.triangleInstance = {0, 1};
    const RayStarts own = startsOf(apart, away);
    EXPECT_EQ(own.directions, apart.normals);
    EXPECT_FALSE(own.directionsDiffer);
}

TEST(RayStarts, verticesAtOnePositionShareADistanceWithinAnInstance)
{
    LowSurface low = squareOf(1); // each triangle has its own vertices
    low = lowOf(
        {low.positions[0], low.positions[1], low.positions[2], low.positions[0], low.positions[2], low.positions[3]},
        std::vector(6, glm::vec3(0, 0, 1)), {0, 1, 2, 3, 4, 5});
    const float none = marginOf(kRoot2), found = startOf(0.1f, kRoot2);
    const std::vector<Mesh> high{speck({0.6f, 0.3f, 0.1f})};
    expectDistances(startsOf(low, high), {found, found, found, found, found, none}, "one instance");
    low.triangleInstance = {0, 1};
    expectDistances(startsOf(low, high), {found, found, found, none, none, none}, "two instances");
}

// ---- occluders ------------------------------------------------------------------------------

LowRest restOf(const LowSurface& surface, glm::vec3 move, std::uint32_t instance)
{
    LowRest rest;
    for (const glm::vec3& p : surface.positions)
        rest.positions.push_back(p + move);
    rest.normals = surface.normals;
    rest.indices = surface.indices;
    rest.triangleInstance.assign(surface.triangleCount(), instance);
    return rest;
}

TEST(RayStarts, detailNearerToTheRestBelongsToItUnlessMatchedElsewhere)
{
    const glm::vec3 up(0, 0, 0.05f);
    const LowRest rest = restOf(squareOf(1), up, 1);
    const float diagonal = glm::length(glm::vec3(1, 1, 0.05f)), none = marginOf(diagonal);
    const std::vector<Mesh> high{speck({0.6f, 0.3f, 0.06f}), speck({0.6f, 0.3f, 0.09f})};
    expectDistances(startsOf(squareOf(1), high, {}, rest), {none, none, none, none}, "nearer to the rest");
    const std::vector<Mesh> lower{speck({0.6f, 0.3f, 0.02f})};
    const float near = startOf(0.02f, diagonal);
    expectDistances(startsOf(squareOf(1), lower, {}, rest), {near, near, near, none}, "nearer to the surface");
    BakeOptions options;
    options.matched = {0, 1}; // the square shows the first mesh, the rest the second
    const float first = startOf(0.06f, diagonal), second = startOf(0.09f, diagonal);
    expectDistances(startsOf(squareOf(1), high, options, rest), {first, first, first, none}, "matched");
    options.matched = {1, 0};
    expectDistances(startsOf(squareOf(1), high, options, rest), {second, second, second, none}, "matched otherwise");
    options.matched = {-1, 1}; // the square shows all: the second is nearer to the rest
    expectDistances(startsOf(squareOf(1), high, options, rest), {first, first, first, none}, "matched to all");
    const float limit = startsOf(squareOf(1), high, {}, restOf(squareOf(1), {0, 0, 3}, 0)).limit;
    EXPECT_NEAR(limit, 0.1f * glm::length(glm::vec3(1, 1, 3)), 1e-5f); // of the box around both
}

TEST(RayStarts, raysStartInFrontOfObstacles)
{
    // Above a triangle in z = 0 is one in z = 1 facing up (its back is seen), and then one in z = 2 facing down.
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<glm::vec3> positions;
    for (const float z : {0.0f, 1.0f, 2.0f})
        for (const glm::vec3& p : corners)
            positions.push_back(p + glm::vec3(0, 0, z));
    const std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 5, 6, 8, 7};
    const auto tree = LowTree::make(positions, indices, {}, 1);
    const auto otherDetail = LowTree::make(positions, indices, {0, 1, 0}, 1),
               all = LowTree::make(positions, indices, {0, -1, 0}, 1);
    ASSERT_TRUE(tree && otherDetail && all);
    const glm::vec3 up(0, 0, 1), at(0.25f, 0.25f, 0);
    const auto open = [&](const LowTree& t, glm::vec3 from, float skip, float maximum) {
        return openDistance(t, 0, from, up, skip, maximum);
    };
    EXPECT_EQ(open(*tree, at, 0.01f, 0.9f), 0.9f);       // nothing within that distance
    EXPECT_NEAR(open(*tree, at, 0.01f, 5), 0.5f, 1e-6f); // halfway to a back face
    EXPECT_NEAR(open(*tree, at, 1.5f, 5), 2, 1e-6f);     // the nearer one is skipped; the next faces the point
    EXPECT_EQ(open(*tree, at, 0.01f, 0.01f), 0.01f);     // the maximum is not beyond the skipped one
    EXPECT_EQ(open(*tree, at, 2.5f, 2.25f), 2.25f);
    EXPECT_NEAR(open(*otherDetail, at, 0.01f, 5), 2, 1e-6f);      // those that show other detail do not occlude
    EXPECT_NEAR(open(*all, at, 0.01f, 5), 0.5f, 1e-6f);           // those that show all detail do
    EXPECT_EQ(open(*tree, at + glm::vec3(2, 0, 0), 0.01f, 5), 5); // beside all triangles
    const std::vector<std::uint32_t> instances{2, 0, 1};
    const std::vector<std::int64_t> matched{5, -1, 7};
    EXPECT_EQ(highGroups(instances, matched), (std::vector<std::int64_t>{7, 5, -1}));
    EXPECT_TRUE(highGroups(instances, {}).empty());
}

TEST(RayStarts, aTriangleIsObstructedIfOneOfItsRaysStartsBehindAnother)
{
    // Rays of both triangles start 0.1 away. Small triangles at 0.03: above each corner of the first, above its middle,
    // and above neither.
    const std::vector<Mesh> high{speck({0.6f, 0.3f, 0.1f}), speck({0.3f, 0.6f, 0.1f})};
    const struct {
        glm::vec2 at;
        std::array<int, 2> obstructed;
    } cases[] = {{{0.995f, 0.004f}, {1, 0}}, {{0.66f, 0.33f}, {1, 0}},   {{0.33f, 0.66f}, {0, 1}},
                 {{1.5f, 0.5f}, {0, 0}},     {{0.004f, 0.995f}, {0, 1}}, {{0.005f, 0.005f}, {1, 1}},
                 {{0.995f, 0.995f}, {1, 1}}};
    for (const auto& c : cases) {
        LowSurface low = squareOf(1);
        const float half = 0.03f;
        for (const glm::vec2 gap : {glm::vec2(-half, -half), {half, -half}, {half, half}, {-half, half}}) {
            low.positions.emplace_back(c.at + gap, 0.03f);
            low.normals.push_back({0, 0, 1});
            low.texcoords.push_back({});
        }
        low.indices.insert(low.indices.end(), {4, 5, 6, 4, 6, 7});
        low.triangleInstance.insert(low.triangleInstance.end(), 2, 0);
        const RayStarts starts = startsOf(low, high);
        EXPECT_EQ(starts.obstructed,
                  (std::vector<std::uint8_t>{std::uint8_t(c.obstructed[0]), std::uint8_t(c.obstructed[1]), 0, 0}))
            << c.at.x << " " << c.at.y;
    }
}

} // namespace
} // namespace cotan
