// Tangents of both kinds (`mikktspace` and `vertex`) and splitting of vertices.
#include "cotan/tangents.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;
using cotan::MeshView;

using Generator = std::vector<glm::vec4> (*)(const MeshView&);

struct Kind {
    const char* name;
    Generator generate;
};

// Properties that hold for both kinds of tangents.
class Tangents : public testing::TestWithParam<Kind> {
protected:
    std::vector<glm::vec4> tangents(const Arrays& a) const { return GetParam().generate(a.view()); }

    // Expects this tangent at every corner. 1e-6: rounding of a few float operations.
    void expectAll(const Arrays& a, glm::vec3 t, float w) const
    {
        const std::vector<glm::vec4> found = tangents(a);
        ASSERT_EQ(found.size(), a.indices.size());
        for (const glm::vec4& x : found) {
            ASSERT_LT(glm::length(glm::vec3(x) - t), 1e-6f) << x.x << ' ' << x.y << ' ' << x.z;
            ASSERT_EQ(x.w, w);
        }
    }

    // Expects what holds for any input: finite unit tangents (or zero, where those of mikktspace cancel out), w = +-1.
    void expectSound(const Arrays& a) const
    {
        const std::vector<glm::vec4> found = tangents(a);
        ASSERT_EQ(found.size(), a.indices.size());
        for (const glm::vec4& x : found) {
            if (glm::vec3(x) != glm::vec3(0) || GetParam().generate == cotan::vertexTangents) {
                ASSERT_NEAR(glm::length(glm::vec3(x)), 1, 1e-5);
            }
            ASSERT_EQ(std::abs(x.w), 1);
        }
    }
};

INSTANTIATE_TEST_SUITE_P(
    Kinds, Tangents,
    testing::Values(Kind{"mikktspace", [](const cotan::MeshView& mesh) { return cotan::mikktspaceTangents(mesh); }},
                    Kind{"areaWeighted", [](const cotan::MeshView& m) { return cotan::areaWeightedTangents(m); }},
                    Kind{"vertex", cotan::vertexTangents}),
    [](const auto& kind) { return std::string(kind.param.name); });

TEST_P(Tangents, followIncreasingU) { expectAll(flatGrid(4, {1, 0}, {0, 1}), {1, 0, 0}, 1); }

TEST_P(Tangents, bitangentPointsUpInTheImage)
{
    const Arrays a = flatGrid(1, {1, 0}, {0, 1});
    const glm::vec4 t = tangents(a)[0];
    const glm::vec3 up = glm::cross(a.normals[0], glm::vec3(t)) * t.w;
    EXPECT_LT(glm::length(up - glm::vec3(0, 1, 0)), 1e-6f); // v increases along -y in this grid
}

TEST_P(Tangents, mirroredUFlipsTangentAndHandedness) { expectAll(flatGrid(4, {-1, 0}, {0, 1}), {-1, 0, 0}, -1); }

TEST_P(Tangents, mirroredVFlipsHandednessOnly) { expectAll(flatGrid(4, {1, 0}, {0, -1}), {1, 0, 0}, -1); }

TEST_P(Tangents, followTheRotationOfTheTexcoords)
{
    for (int degrees = 0; degrees < 360; degrees += 30) {
        const float a = float(degrees) * std::numbers::pi_v<float> / 180;
        const float c = std::cos(a), s = std::sin(a);
        // u increases along (c, s) in the grid's (x, y), whose y points down.
        expectAll(flatGrid(3, {c, s}, {-s, c}), {c, -s, 0}, 1);
    }
}

TEST_P(Tangents, followLinesOfConstantVUnderShear)
{
    // dP/du follows lines of constant v: here along x, however u is sheared.
    expectAll(flatGrid(3, {1, 0.8f}, {0, 1}), {1, 0, 0}, 1);
}

TEST_P(Tangents, uniformScaleChangesNothing)
{
    const Arrays plain = sphereGrid(8);
    const std::vector<glm::vec4> expected = tangents(plain);
    for (const float scale : {1.0f / 1024, 4.0f, 65536.0f}) { // powers of two: the results are exact
        Arrays scaled = plain;
        for (glm::vec3& p : scaled.positions)
            p *= scale;
        const std::vector<glm::vec4> found = tangents(scaled);
        if (std::string_view(GetParam().name) != "areaWeighted") {
            EXPECT_EQ(found, expected) << scale;
        }
        for (std::size_t c = 0; c < found.size();
             ++c) // its sums are normalised in double precision where they are large
            EXPECT_LT(glm::length(found[c] - expected[c]), 3e-7f) << scale;
    }
}

TEST_P(Tangents, scaleOfTexcoordsChangesNothing)
{
    const Arrays plain = sphereGrid(8);
    Arrays scaled = plain;
    for (glm::vec2& t : scaled.texcoords)
        t *= 16.0f;
    EXPECT_EQ(tangents(scaled), tangents(plain));
}

TEST_P(Tangents, doNotDependOnTheIndexing)
{
    const Arrays plain = sphereGrid(8);
    EXPECT_EQ(tangents(unindexed(plain)), tangents(plain));
}

TEST_P(Tangents, doNotDependOnTheOrderOfTriangles)
{
    const Arrays plain = sphereGrid(8);
    Arrays reversed = plain;
    std::reverse(reversed.indices.begin(), reversed.indices.end()); // reverses the winding, restored below
    for (std::size_t i = 0; i < reversed.indices.size(); i += 3)
        std::swap(reversed.indices[i], reversed.indices[i + 2]);
    const std::vector<glm::vec4> a = tangents(plain), b = tangents(reversed);
    for (std::size_t f = 0; f < a.size() / 3; ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec4 other = b[a.size() - 3 - 3 * f + k];
            ASSERT_LT(glm::length(a[3 * f + k] - other), 1e-6f); // sums in another order
        }
}

TEST_P(Tangents, negativeZeroEqualsPositiveZero)
{
    Arrays a = unindexed(flatGrid(2, {1, 0}, {0, 1}));
    const std::vector<glm::vec4> expected = tangents(a);
    for (std::size_t i = 0; i < a.positions.size(); i += 2)
        a.positions[i].z = -0.0f;
    EXPECT_EQ(tangents(a), expected);
}

TEST_P(Tangents, arePerpendicularToTheNormal)
{
    const Arrays a = sphereGrid(10);
    const std::vector<glm::vec4> found = tangents(a);
    for (std::size_t c = 0; c < found.size(); ++c)
        ASSERT_NEAR(glm::dot(glm::vec3(found[c]), a.normals[a.indices[c]]), 0, 1e-6);
}

TEST_P(Tangents, pointEastOnASphere)
{
    // An angle-weighted or plain mean over the triangles around a vertex differs by less than the rotation of "east"
    // over one cell: 120/64 degrees times the sine of the latitude.
    const Arrays a = sphereGrid(64);
    const std::vector<glm::vec4> found = tangents(a);
    for (std::size_t c = 0; c < found.size(); ++c) {
        const glm::dvec3 n(a.normals[a.indices[c]]);
        const glm::dvec3 east = glm::cross(glm::dvec3(0, 1, 0), n);
        ASSERT_LT(degreesBetween(glm::dvec3(glm::vec3(found[c])), east), 1.7);
        ASSERT_EQ(found[c].w, 1);
    }
}

TEST_P(Tangents, mirrorLineKeepsBothSides)
{
    // u = |x - 1/2|: each corner on the line x = 1/2 belongs to one of its sides.
    const Arrays a = gridOf(4, [](float x, float y) { return Vertex{{x, -y, 0}, {0, 0, 1}, {std::abs(x - 0.5f), y}}; });
    const std::vector<glm::vec4> found = tangents(a);
    for (std::size_t f = 0; f < found.size(); f += 3) {
        float middle = 0;
        for (std::size_t k = 0; k < 3; ++k)
            middle += a.positions[a.indices[f + k]].x / 3;
        const float side = middle < 0.5f ? -1 : 1;
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_LT(glm::length(found[f + k] - glm::vec4(side, 0, 0, side)), 1e-6f);
    }
}

TEST_P(Tangents, triangleWithEqualPositionsInherits)
{
    Arrays a = flatGrid(1, {1, 0}, {0, 1});
    a.indices.insert(a.indices.end(), {0, 1, 1});
    expectAll(a, {1, 0, 0}, 1);
}

TEST_P(Tangents, triangleWithoutUvAreaTakesItsNeighbours)
{
    // The first row of vertices has the texcoords of the second: the upper cells have no area in uv. All their corners
    // except the topmost touch a sound triangle.
    Arrays a = flatGrid(2, {1, 0}, {0, 1});
    for (std::size_t i = 0; i < 3; ++i)
        a.texcoords[i] = a.texcoords[i + 3];
    const std::vector<glm::vec4> found = tangents(a);
    for (std::size_t c = 0; c < found.size(); ++c) {
        if (a.indices[c] >= 3) {
            EXPECT_LT(glm::length(found[c] - glm::vec4(1, 0, 0, 1)), 1e-6f) << c;
        }
    }
    expectSound(a);
}

TEST_P(Tangents, constantTexcoordsGiveSomeUnitTangentInThePlane)
{
    const Arrays a = flatGrid(2, {0, 0}, {0, 0});
    expectSound(a);
    for (const glm::vec4& t : tangents(a)) {
        EXPECT_EQ(t.z, 0);
        EXPECT_EQ(t.w, 1);
    }
}

TEST_P(Tangents, oppositeDirectionsAreNotAveragedToNothing)
{
    // Two triangles are folded onto each other at the edge x = 0. Their dP/du, seen along the shared normal, are
    // opposite, and each keeps its own. meshoptimizer averages them to nothing where they meet.
    const bool cancel = std::string_view(GetParam().name) == "areaWeighted";
    Arrays a;
    const glm::vec3 n(0, 0, 1);
    const std::uint32_t p = a.add({0, 0, 0}, n, {0, 0}), q = a.add({0, -1, 0}, n, {0, 1});
    const std::uint32_t r = a.add({1, 0, 0.5f}, n, {1, 0}), s = a.add({1, 0, -0.5f}, n, {-1, 0});
    a.indices = {p, q, r, q, p, s};
    const std::vector<glm::vec4> found = tangents(a);
    for (std::size_t c = 0; c < 6; ++c) {
        const glm::vec3 own(c < 3 ? 1 : -1, 0, 0), expected = cancel && c % 3 != 2 ? glm::vec3(0) : own;
        EXPECT_LT(glm::length(glm::vec3(found[c]) - expected), 1e-6f) << c;
    }
}

TEST_P(Tangents, areSoundForBrokenInput)
{
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {inf, -inf, nan, 1e38f, 1e-38f, 0.0f}) {
        for (int which = 0; which < 3; ++which) {
            Arrays a = sphereGrid(4);
            for (std::size_t i = 0; i < a.positions.size(); i += 3) {
                if (which == 0)
                    a.positions[i] = glm::vec3(bad);
                if (which == 1)
                    a.normals[i] = glm::vec3(bad);
                if (which == 2)
                    a.texcoords[i] = glm::vec2(bad);
            }
            expectSound(a);
        }
    }
}

TEST_P(Tangents, areSoundForRandomTriangles)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<int> coordinate(-1, 1);
    std::uniform_int_distribution<std::uint32_t> vertex(0, 29);
    const auto any = [&] { return float(coordinate(random)); };
    for (int round = 0; round < 300; ++round) {
        Arrays a; // few different values, so that many coincide
        for (int i = 0; i < 30; ++i)
            a.add({any(), any(), any()}, {any(), any(), any()}, {any(), any()});
        for (int i = 0; i < 3 * 40; ++i)
            a.indices.push_back(vertex(random));
        expectSound(a);
    }
}

TEST_P(Tangents, nothingInNothingOut) { EXPECT_TRUE(GetParam().generate({}).empty()); }

TEST_P(Tangents, mismatchedArraysGiveNothing)
{
    const Arrays good = flatGrid(1, {1, 0}, {0, 1});
    Arrays a = good;
    a.indices[4] = 4;
    EXPECT_TRUE(tangents(a).empty()) << "index out of range";
    a = good;
    a.indices.pop_back();
    EXPECT_TRUE(tangents(a).empty()) << "half a triangle";
    a = good;
    a.normals.pop_back();
    EXPECT_TRUE(tangents(a).empty()) << "a normal missing";
    a = good;
    a.texcoords.clear();
    EXPECT_TRUE(tangents(a).empty()) << "no texcoords";
}

TEST_P(Tangents, manyTrianglesAtOneVertexOrEdgeStayLinear)
{
    // Quadratic work would be 10^11 steps here and exceed the time limit of the suite.
    const std::uint32_t n = 300000;
    Arrays fan, book, closedBook;
    fan.add({0, 0, 0}, {0, 0, 1}, {0, 0});
    for (std::uint32_t i = 0; i <= n; ++i) {
        const float t = 6.28f * float(i) / float(n);
        const glm::vec2 p(std::cos(t), std::sin(t));
        fan.add({p, 0}, {0, 0, 1}, p);
        book.add({p, 0}, {0, 0, 1}, p);
    }
    book.add({0, 0, -1}, {0, 0, 1}, {0, 2});
    book.add({0, 0, 1}, {0, 0, 1}, {0, 3});
    closedBook = book;
    for (std::uint32_t i = 0; i < n; ++i) {
        fan.indices.insert(fan.indices.end(), {0, i + 1, i + 2});
        book.indices.insert(book.indices.end(), {n + 1, n + 2, i}); // all edges have the same direction
        closedBook.indices.insert(closedBook.indices.end(), {i % 2 ? n + 1 : n + 2, i % 2 ? n + 2 : n + 1, i});
    }
    expectSound(fan);
    expectSound(book);
    expectSound(closedBook);
}

TEST(MikktspaceTangents, weighByTheAngleAtTheCorner)
{
    // At the origin a corner of 90 degrees with u along x meets, across the shared edge along y, a corner of 45 degrees
    // whose dP/du is rotated by the shear of its texcoords.
    Arrays a;
    const glm::vec3 n(0, 0, 1);
    const std::uint32_t o = a.add({0, 0, 0}, n, {0, 0}), up = a.add({0, 1, 0}, n, {0, -1});
    const std::uint32_t right = a.add({1, 0, 0}, n, {1, 0}), left = a.add({-1, 1, 0}, n, {-1, 0});
    a.indices = {o, right, up, o, up, left};
    // Second triangle: P(u,v) with P(0,-1) = (0,1) and P(-1,0) = (-1,1): dP/du = (1,-1).
    const glm::vec3 expected = glm::normalize(90.0f * glm::vec3(1, 0, 0) + 45.0f * glm::normalize(glm::vec3(1, -1, 0)));
    const std::vector<glm::vec4> found = cotan::mikktspaceTangents(a.view());
    EXPECT_LT(glm::length(glm::vec3(found[0]) - expected), 1e-6f);
    EXPECT_EQ(found[0], found[3]);
}

// mikktspace.c gives (1,0,0) where no triangle at the vertex has a direction, and zero where directions cancel out.
TEST(MikktspaceTangents, equalThoseOfMikktspaceWithoutADirection)
{
    Arrays line = flatGrid(2, {1, 0}, {0, 0});
    for (glm::vec3& n : line.normals)
        n = {1, 0, 0}; // not even perpendicular
    for (const glm::vec4& t : cotan::mikktspaceTangents(line.view()))
        EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));

    // Two triangles at the origin with opposite dP/du, each of 60 degrees, and between them one without area in uv,
    // which is averaged with both.
    Arrays fan;
    const glm::vec3 n(0, 0, 1);
    const std::uint32_t o = fan.add({0, 0, 0}, n, {0, 0}), e = fan.add({1, 0, 0}, n, {1, 0});
    const std::uint32_t p = fan.add({0.5f, 0.9f, 0}, n, {0, -1}), q = fan.add({-0.5f, 0.9f, 0}, n, {0, 1});
    const std::uint32_t w = fan.add({-1, 0, 0}, n, {1, 0});
    fan.indices = {o, e, p, o, p, q, o, q, w};
    const std::vector<glm::vec4> found = cotan::mikktspaceTangents(fan.view());
    EXPECT_EQ(found[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(found[3], glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(found[6], glm::vec4(-1, 0, 0, 1));
}

TEST(VertexTangents, weighAllTrianglesEqually)
{
    Arrays a;
    const glm::vec3 n(0, 0, 1);
    const std::uint32_t o = a.add({0, 0, 0}, n, {0, 0}), up = a.add({0, 1, 0}, n, {0, -1});
    const std::uint32_t right = a.add({1, 0, 0}, n, {1, 0}), left = a.add({-1, 1, 0}, n, {-1, 0});
    a.indices = {o, right, up, o, up, left};
    const glm::vec3 expected = glm::normalize(glm::vec3(1, 0, 0) + glm::normalize(glm::vec3(1, -1, 0)));
    const std::vector<glm::vec4> found = cotan::vertexTangents(a.view());
    EXPECT_LT(glm::length(glm::vec3(found[0]) - expected), 1e-6f);
    EXPECT_EQ(found[0], found[3]);
}

TEST(MikktspaceTangents, groupsThatOnlyShareAVertexStayApart)
{
    // Two triangles of one orientation meet in a point, without a common edge. `vertex` averages them, MikkTSpace does
    // not.
    Arrays a;
    const glm::vec3 n(0, 0, 1);
    const std::uint32_t o = a.add({0, 0, 0}, n, {0, 0});
    a.add({1, 0, 0}, n, {1, 0});
    a.add({0, 1, 0}, n, {0, -1});
    a.add({-1, 0, 0}, n, {0, 1}); // u rotated by 90 degrees
    a.add({0, -1, 0}, n, {1, 0});
    a.indices = {o, 1, 2, o, 3, 4};
    const std::vector<glm::vec4> apart = cotan::mikktspaceTangents(a.view());
    EXPECT_LT(glm::length(apart[0] - glm::vec4(1, 0, 0, 1)), 1e-6f);
    EXPECT_LT(glm::length(apart[3] - glm::vec4(0, -1, 0, 1)), 1e-6f);
    const std::vector<glm::vec4> together = cotan::vertexTangents(a.view());
    EXPECT_LT(glm::length(glm::vec3(together[0]) - glm::normalize(glm::vec3(1, -1, 0))), 1e-6f);
}

TEST(SplitVertices, leavesEqualCornersTogether)
{
    const Arrays a = sphereGrid(6);
    const std::vector<glm::vec4> corners = cotan::vertexTangents(a.view());
    const cotan::VertexSplit split = cotan::splitVertices(a.positions.size(), a.indices, corners);
    EXPECT_EQ(split.indices, a.indices);
    EXPECT_EQ(split.sources.size(), a.positions.size());
}

TEST(SplitVertices, everyCornerFindsItsValueAndItsVertex)
{
    std::mt19937 random(3);
    std::uniform_int_distribution<int> value(0, 2);
    const Arrays a = flatGrid(9, {1, 0}, {0, 1});
    std::vector<glm::vec4> corners;
    for (std::size_t i = 0; i < a.indices.size(); ++i)
        corners.emplace_back(value(random), 0, 0, 1);
    const cotan::VertexSplit split = cotan::splitVertices(a.positions.size(), a.indices, corners);
    ASSERT_EQ(split.indices.size(), a.indices.size());
    std::vector<glm::vec4> stored(split.sources.size(), glm::vec4(-1));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        ASSERT_LT(split.indices[i], split.sources.size());
        EXPECT_EQ(split.sources[split.indices[i]], a.indices[i]);
        glm::vec4& slot = stored[split.indices[i]];
        EXPECT_TRUE(slot == glm::vec4(-1) || slot == corners[i]);
        slot = corners[i];
    }
    EXPECT_LE(split.sources.size(), 3 * a.positions.size()); // at most three values per vertex
}

// Large enough for several threads and mirrored along a line. The second round adds triangles without uv area, for
// which the order in which groups are found matters.
TEST(Mikktspace, doesNotDependOnTheNumberOfThreads)
{
    for (const float flatBelow : {0.0f, 0.2f}) {
        const Arrays a = gridOf(160, [&](float x, float y) {
            const float u = y < flatBelow ? 0 : std::abs(x - 0.5f);
            return Vertex{{x, -y, 0.1f * std::sin(9 * x * y)}, {0, 0, 1}, {u, y}};
        });
        const auto one = cotan::mikktspaceTangents(a.view(), 1);
        for (const int threads : {2, 5, 0})
            EXPECT_EQ(cotan::mikktspaceTangents(a.view(), threads), one) << threads;
    }
}

TEST(SplitMirrored, separatesTheSidesOfAMirrorLineOnly)
{
    const Arrays a = gridOf(4, [](float x, float y) { return Vertex{{x, -y, 0}, {0, 0, 1}, {std::abs(x - 0.5f), y}}; });
    const cotan::VertexSplit split = cotan::splitMirrored(a.view());
    ASSERT_EQ(split.sources.size(), a.positions.size() + 5); // five vertices on the line
    for (std::size_t i = a.positions.size(); i < split.sources.size(); ++i)
        EXPECT_EQ(a.positions[split.sources[i]].x, 0.5f);
    EXPECT_EQ(cotan::splitMirrored(sphereGrid(4).view()).sources.size(), 25u);
}

} // namespace
