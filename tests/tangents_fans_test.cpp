// Compares tangents and cotangents of small irregular meshes with their definitions in double: weights, mirrored sides,
// edges of more than two triangles.
#include <algorithm>
#include <cmath>
#include <random>

#include <glm/gtc/matrix_access.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;

// The edges of a triangle that start at one of its corners.
struct CornerEdges {
    glm::dvec3 p1, p2;
    glm::dvec2 t1, t2;
    glm::dvec3 n; // normal of the corner's vertex

    CornerEdges(const Arrays& a, std::size_t corner) : n(a.normals[a.indices[corner]])
    {
        const std::size_t f = corner / 3 * 3, k = corner % 3;
        const std::uint32_t i = a.indices[corner], j = a.indices[f + (k + 1) % 3], l = a.indices[f + (k + 2) % 3];
        p1 = glm::dvec3(a.positions[j]) - glm::dvec3(a.positions[i]);
        p2 = glm::dvec3(a.positions[l]) - glm::dvec3(a.positions[i]);
        t1 = glm::dvec2(a.texcoords[j]) - glm::dvec2(a.texcoords[i]);
        t2 = glm::dvec2(a.texcoords[l]) - glm::dvec2(a.texcoords[i]);
    }

    glm::dvec3 flattened(glm::dvec3 v) const { return v - n * glm::dot(n, v); }

    // Unit direction in which u increases and v is constant.
    glm::dvec3 alongU() const
    {
        const glm::dmat2 uv(t1, t2);
        const glm::dvec2 weights = glm::inverse(uv) * glm::dvec2(1, 0); // of p1 and p2
        return glm::normalize(p1 * weights.x + p2 * weights.y);
    }

    // The covector perpendicular to n that changes by d1 along p1 and by d2 along p2.
    glm::dvec3 gradient(double d1, double d2) const
    {
        const glm::dmat3 rows = glm::transpose(glm::dmat3(p1, p2, n));
        return glm::inverse(rows) * glm::dvec3(d1, d2, 0);
    }

    double angle() const { return std::acos(glm::dot(glm::normalize(flattened(p1)), glm::normalize(flattened(p2)))); }
};

// Five irregular triangles around vertex 0 with different angles, lengths, heights and texcoords. The normal is tilted.
Arrays irregularFan(std::mt19937& random, bool mirrored)
{
    std::uniform_real_distribution<float> any(-1, 1);
    const float azimuths[] = {0.0f, 0.35f, 1.9f, 2.4f, 4.1f, 5.6f};
    const glm::vec3 n = glm::normalize(glm::vec3(0.4f * any(random), 0.4f * any(random), 1));
    Arrays a;
    a.add({0, 0, 0}, n, {0.5f, 0.5f});
    for (const float azimuth : azimuths) {
        const float radius = 1 + 0.7f * any(random);
        const glm::vec2 p(radius * std::cos(azimuth), radius * std::sin(azimuth));
        const glm::vec2 t = p * (1 + 0.3f * any(random));
        a.add({p, 0.3f * any(random)}, n, {0.5f + (mirrored ? -t.x : t.x), 0.5f - t.y});
    }
    for (std::uint32_t k = 1; k < 6; ++k)
        a.indices.insert(a.indices.end(), {0, k, k + 1});
    return a;
}

TEST(IrregularFan, everyMethodWeighsTrianglesAsDefined)
{
    std::mt19937 random(5);
    for (int round = 0; round < 60; ++round) {
        const bool mirrored = round % 2 == 1;
        const Arrays a = irregularFan(random, mirrored);
        glm::dvec3 byAngle(0), alike(0), gradU(0), gradV(0);
        double angles = 0;
        for (std::size_t c = 0; c < a.indices.size(); c += 3) {
            const CornerEdges e(a, c);
            const double angle = e.angle();
            byAngle += glm::normalize(e.flattened(e.alongU())) * angle;
            alike += e.alongU();
            gradU += e.gradient(e.t1.x, e.t2.x) * angle;
            gradV += e.gradient(e.t1.y, e.t2.y) * angle;
            angles += angle;
        }
        const CornerEdges first(a, 0);
        alike = first.flattened(alike);
        const auto mikktspace = cotan::mikktspaceTangents(a.view());
        const auto vertex = cotan::vertexTangents(a.view());
        const cotan::Cotangents smooth = cotan::smoothCotangents(a.view());
        // Rounding of about twelve float operations, and an arc cosine with an error of 5e-7.
        for (std::size_t c = 0; c < a.indices.size(); c += 3) {
            ASSERT_LT(glm::length(glm::dvec3(glm::vec3(mikktspace[c])) - glm::normalize(byAngle)), 3e-6) << round;
            ASSERT_LT(glm::length(glm::dvec3(glm::vec3(vertex[c])) - glm::normalize(alike)), 3e-6) << round;
            ASSERT_EQ(mikktspace[c].w, mirrored ? -1 : 1);
            ASSERT_EQ(vertex[c].w, mirrored ? -1 : 1);
        }
        ASSERT_LT(glm::length(glm::dvec3(smooth.u[0]) - gradU / angles), 1e-5 * glm::length(gradU)) << round;
        ASSERT_LT(glm::length(glm::dvec3(smooth.v[0]) - gradV / angles), 1e-5 * glm::length(gradV)) << round;
    }
}

// ---- mirrored and unmirrored at one vertex ---------------------------------------------------

// An unmirrored and a mirrored triangle with these angles in degrees at vertex 0, which share the edge to vertex 1. u
// increases along x in the unmirrored one, and along -x twice as fast in the mirrored one.
Arrays bothSides(float unmirrored, float mirrored)
{
    const float up = 90 * std::numbers::pi_v<float> / 180;
    const float right = up - unmirrored * std::numbers::pi_v<float> / 180,
                left = up + mirrored * std::numbers::pi_v<float> / 180;
    const glm::vec3 n(0, 0, 1);
    Arrays a;
    a.add({0, 0, 0}, n, {0, 0});
    a.add({0, 1, 0}, n, {0, -1});
    a.add({std::cos(right), std::sin(right), 0}, n, {std::cos(right), -std::sin(right)});
    a.add({std::cos(left), std::sin(left), 0}, n, {-2 * std::cos(left), -std::sin(left)});
    a.indices = {0, 2, 1, 0, 1, 3};
    return a;
}

TEST(MirroredSides, aSharedVertexTakesTheGradientsOfTheLargerAngle)
{
    for (const auto& [unmirrored, mirrored] : {std::pair(80.0f, 60.0f), std::pair(60.0f, 80.0f)}) {
        const cotan::Cotangents found = cotan::smoothCotangents(bothSides(unmirrored, mirrored).view());
        for (const std::size_t vertex : {0, 1}) { // at vertex 1 the angles are 50 and 60, or 60 and 50 degrees
            const bool isUnmirrored = vertex == 0 ? unmirrored > mirrored : unmirrored < mirrored;
            EXPECT_LT(glm::length(found.u[vertex] - glm::vec3(isUnmirrored ? 1 : -2, 0, 0)), 1e-5f)
                << vertex << ' ' << unmirrored;
            EXPECT_LT(glm::length(found.v[vertex] - glm::vec3(0, -1, 0)), 1e-5f) << vertex << ' ' << unmirrored;
        }
        EXPECT_LT(glm::length(found.u[2] - glm::vec3(1, 0, 0)), 1e-5f);
        EXPECT_LT(glm::length(found.u[3] - glm::vec3(-2, 0, 0)), 1e-5f);
    }
}

// Seen along its normal, vertex 0 lies outside the polygon of its neighbours: three triangles span 178 degrees there,
// and a nearly vertical one folds back over the same 178. Texture coordinates wind once around the vertex.
Arrays foldedFan(double azimuth)
{
    Arrays a;
    a.add({0, 0, 0}, {0, 0, 1}, {0, 0});
    for (const auto& [seen, height, charted] : {std::tuple(0.0, -1.0f, 0.0), std::tuple(60.0, 0.1f, 90.0),
                                                std::tuple(120.0, -0.1f, 180.0), std::tuple(178.0, -1.0f, 270.0)}) {
        const double at = glm::radians(seen) + azimuth, uv = glm::radians(charted);
        a.add({float(std::cos(at)), float(std::sin(at)), height}, {0, 0, 1},
              {float(std::cos(uv)), float(-std::sin(uv))});
    }
    a.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    return a;
}

TEST(MirroredSides, edgeOnTrianglesDoNotFlipTheirVertex)
{
    // The angles of both sides are equal. Rounding would decide if the openness of the triangles did not.
    for (int degrees = 0; degrees < 360; ++degrees) {
        const Arrays a = foldedFan(glm::radians(double(degrees)));
        const cotan::Cotangents found = cotan::smoothCotangents(a.view());
        EXPECT_LT(glm::cross(found.u[0], found.v[0]).z, 0) << degrees; // v increases downwards
    }
}

TEST(MirroredSides, areSplitAtEverySharedVertex)
{
    Arrays a = bothSides(80, 60);
    const cotan::VertexSplit split = cotan::splitMirrored(a.view());
    EXPECT_EQ(split.sources, (std::vector<std::uint32_t>{0, 1, 2, 3, 0, 1}));
    EXPECT_EQ(split.indices, (std::vector<std::uint32_t>{0, 2, 1, 4, 5, 3})); // the side met first keeps its vertices
    // Degenerate triangles use the unmirrored copy of a vertex that has both, and the only one of other vertices.
    a.indices = {0, 1, 3, 0, 2, 1, 0, 3, 3, 3, 0, 3, 2, 2, 0};
    const cotan::VertexSplit degenerate = cotan::splitMirrored(a.view());
    EXPECT_EQ(degenerate.sources.size(), 6u);
    EXPECT_EQ(degenerate.indices[0], 0u); // mirrored
    EXPECT_NE(degenerate.indices[3], 0u); // unmirrored: the copy
    EXPECT_EQ(degenerate.indices[6], degenerate.indices[3]);
    EXPECT_EQ(degenerate.indices[7], 3u);
    EXPECT_EQ(degenerate.indices[14], degenerate.indices[3]);
    EXPECT_TRUE(cotan::splitMirrored({}).sources.empty());
}

TEST(MirroredSides, aMirrorLineIsSplitOncePerVertex)
{
    // u = |x - 1/2| on 6 x 6 cells: 7 of the 49 vertices are on the mirror line. A mesh that is all mirrored is not
    // split.
    const Arrays a = gridOf(6, [](float x, float y) {
        return Vertex{{x, -y, 0.1f * x * y}, {0, 0, 1}, {std::abs(x - 0.5f), y}};
    });
    const cotan::VertexSplit split = cotan::splitMirrored(a.view());
    EXPECT_EQ(split.sources.size(), 56u);
    for (std::size_t c = 0; c < a.indices.size(); ++c)
        EXPECT_EQ(split.sources[split.indices[c]], a.indices[c]);
    const Arrays mirrored = flatGrid(6, {-1, 0}, {0, 1});
    EXPECT_EQ(cotan::splitMirrored(mirrored.view()).sources.size(), 49u);
}

TEST(MirroredSides, degenerateCornersTakeTheSideOfTheirVertex)
{
    Arrays a = bothSides(80, 60);
    a.indices.insert(a.indices.end(),
                     {0, 2, 2, 3, 3, 0}); // degenerate; vertex 2 is unmirrored only, 3 mirrored only, 0 both
    const std::vector<glm::vec4> found = cotan::vertexTangents(a.view());
    for (const std::size_t c : {6, 7, 8, 11})
        EXPECT_LT(glm::length(found[c] - glm::vec4(1, 0, 0, 1)), 1e-6f) << c;
    for (const std::size_t c : {9, 10})
        EXPECT_LT(glm::length(found[c] - glm::vec4(-1, 0, 0, -1)), 1e-6f) << c;
}

TEST(MirroredSides, areFoundWithoutNormals)
{
    Arrays a = bothSides(80, 60);
    std::fill(a.normals.begin(), a.normals.end(), glm::vec3(0));
    const std::vector<glm::vec4> found = cotan::vertexTangents(a.view());
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_LT(glm::length(found[c] - glm::vec4(1, 0, 0, 1)), 1e-6f) << c;
        EXPECT_LT(glm::length(found[c + 3] - glm::vec4(-1, 0, 0, -1)), 1e-6f) << c;
    }
}

// ---- MikkTSpace's groups ---------------------------------------------------------------------

// Pages that share the edge from vertex 0 to vertex 1, all unmirrored and in the plane: pages on the right traverse the
// edge in one direction, those on the left in the other. `order`: 'r' or 'l' for each page.
Arrays book(const std::string& order)
{
    const glm::vec3 n(0, 0, 1);
    Arrays a;
    a.add({0, 0, 0}, n, {0, 0});
    a.add({0, 1, 0}, n, {0, -1});
    for (std::size_t k = 0; k < order.size(); ++k) {
        const float reach = 1 + 0.125f * float(k), lean = 0.75f / (1 + float(k));
        const float side = order[k] == 'r' ? 1.0f : -1.0f;
        const std::uint32_t tip = a.add({side * reach, 0.4f + lean, 0}, n, {side, -0.4f});
        if (order[k] == 'r')
            a.indices.insert(a.indices.end(), {0, tip, 1});
        else
            a.indices.insert(a.indices.end(), {0, 1, tip});
    }
    return a;
}

glm::dvec3 pageSum(const Arrays& a, std::size_t page)
{
    const CornerEdges e(a, 3 * page);
    return e.alongU() * e.angle();
}

// The k-th page of one side forms a group with the k-th of the other; remaining pages stay alone. The pairs follow by
// hand from the rule in mikktspace.h: of the sorted edges between two vertices, each is paired with the next free one
// of the opposite direction. Vertex 0 is corner 0 of every page.
void expectPairs(const std::string& order, const std::vector<std::pair<std::size_t, std::size_t>>& pairs)
{
    const Arrays a = book(order);
    const std::vector<glm::vec4> found = cotan::mikktspaceTangents(a.view());
    std::vector<glm::dvec3> expected;
    for (std::size_t k = 0; k < order.size(); ++k)
        expected.push_back(pageSum(a, k));
    for (const auto& [i, j] : pairs)
        expected[i] = expected[j] = expected[i] + expected[j];
    for (std::size_t k = 0; k < order.size(); ++k) {
        EXPECT_LT(glm::length(glm::dvec3(glm::vec3(found[3 * k])) - glm::normalize(expected[k])), 3e-6)
            << order << ", page " << k;
        EXPECT_EQ(found[3 * k].w, 1);
    }
}

TEST(MikktspaceNonManifoldEdge, pairsInOrderAndLeavesTheRemainder)
{
    expectPairs("rl", {{0, 1}});
    expectPairs("rll", {{0, 1}});
    expectPairs("llr", {{0, 2}});
    expectPairs("lrl", {{0, 1}});
    expectPairs("rrl", {{0, 2}});
    expectPairs("rrr", {});
    expectPairs("rrll", {{0, 2}, {1, 3}});
    expectPairs("rlrl", {{0, 1}, {2, 3}});
    expectPairs("lrrl", {{0, 1}, {3, 2}});
}

TEST(MikktspaceNonManifoldEdge, pairsManyTrianglesInTheSameOrder)
{
    // More corners at a vertex than are compared one by one: ten pages to the right, and eleven to the left.
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t k = 0; k < 10; ++k)
        pairs.emplace_back(k, 10 + k);
    expectPairs(std::string(10, 'r') + std::string(11, 'l'), pairs);
    pairs.clear();
    for (std::size_t k = 0; k < 20; k += 2)
        pairs.emplace_back(k, k + 1);
    expectPairs("rlrlrlrlrlrlrlrlrlrlr", pairs);
}

// Two triangles with one between them that has no area in uv: 0 1 2, then 1 3 2, then 3 4 2. The last one is mirrored.
TEST(MikktspaceWithoutUvArea, trianglesJoinTheFirstGroupThatReachesThem)
{
    const glm::vec3 n(0, 0, 1);
    Arrays a;
    a.add({-1, 0.2f, 0}, n, {-1, 0});
    a.add({0, 0, 0}, n, {0, 0});
    a.add({0, 1, 0}, n, {0, -1});
    a.add({1, 0.3f, 0}, n, {0, -0.5f}); // on the line through 1 and 2
    a.add({1.5f, 1, 0}, n, {-1, -1});   // u decreases again
    a.indices = {0, 1, 2, 1, 3, 2, 3, 4, 2};
    const std::vector<glm::vec4> plain = cotan::mikktspaceTangents(a.view());
    EXPECT_EQ(plain[0].w, 1);
    EXPECT_EQ(plain[7].w, -1);
    EXPECT_EQ(plain[3], plain[1]); // the middle triangle has the first one's at 1 and 2
    EXPECT_EQ(plain[5], plain[2]);
    EXPECT_NE(plain[5], plain[8]);
    a.indices = {3, 4, 2, 1, 3, 2, 0, 1, 2};
    const std::vector<glm::vec4> reordered = cotan::mikktspaceTangents(a.view());
    EXPECT_EQ(reordered[0].w, -1);
    EXPECT_EQ(reordered[4], reordered[0]); // the middle triangle has the mirrored one's at 3 and 2
    EXPECT_EQ(reordered[5], reordered[2]);
    EXPECT_NE(reordered[5], reordered[8]);
}

// A triangle with two equal positions inherits the tangents of the first sound triangle at each of its vertices.
TEST(MikktspaceTangents, ofDegenerateTrianglesComeFromTheFirstSoundOne)
{
    Arrays a = bothSides(80, 60);
    a.indices = {3, 3, 0, 0, 1, 3, 0, 2, 1}; // first the degenerate one, then the mirrored one
    const std::vector<glm::vec4> found = cotan::mikktspaceTangents(a.view());
    EXPECT_EQ(found[0], found[5]);
    EXPECT_EQ(found[2], found[3]);
    EXPECT_EQ(found[2].w, -1);
    EXPECT_NE(found[2], found[6]);
}

TEST(SplitVertices, refusesMismatchedArraysAndTreatsZerosAsEqual)
{
    const std::vector<std::uint32_t> indices = {0, 1, 2, 2, 1, 0};
    std::vector<glm::vec4> corners(6, glm::vec4(0, 1, 2, 1));
    EXPECT_TRUE(cotan::splitVertices(2, indices, corners).sources.empty()); // index 2 of two
    EXPECT_TRUE(cotan::splitVertices(3, indices, std::span(corners).first(5)).sources.empty());
    EXPECT_EQ(cotan::splitVertices(3, indices, corners).sources.size(), 3u);
    corners[5].x = -0.0f;
    EXPECT_EQ(cotan::splitVertices(3, indices, corners).sources.size(), 3u);
    for (int k = 0; k < 4; ++k) { // a difference in any component splits a vertex
        std::vector<glm::vec4> other = corners;
        other[4][k] += 0.5f;
        const cotan::VertexSplit split = cotan::splitVertices(4, indices, other); // vertex 3 has no corner
        EXPECT_EQ(split.sources, (std::vector<std::uint32_t>{0, 1, 2, 3, 1})) << k;
        EXPECT_EQ(split.indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 4, 0})) << k;
    }
}

} // namespace
