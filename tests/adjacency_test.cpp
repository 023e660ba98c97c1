// Adjacency built at load time, for frames that gather from neighbouring triangles.
#include <algorithm>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "cotan/gpu_meshes.hpp"
#include "cotan/portable.hpp"
#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;
using cotan::Adjacency;
using cotan::makeAdjacency;
using cotan::makeNormalAdjacency;

// Smooth cotangents gathered over the adjacency in double, weighted with the angle from std::acos.
cotan::Cotangents gathered(const Arrays& a, const Adjacency& adjacency)
{
    cotan::Cotangents out{std::vector<glm::vec3>(a.positions.size()), std::vector<glm::vec3>(a.positions.size())};
    for (std::uint32_t g = 0; g < adjacency.groups(); ++g) {
        const glm::dvec3 n(a.normals[adjacency.vertices[adjacency.vertexBegin[g]]]);
        glm::dvec3 u(0), v(0);
        double weight = 0;
        for (std::uint32_t i = adjacency.cornerBegin[g]; i < adjacency.cornerBegin[g + 1]; ++i) {
            const std::uint32_t c = adjacency.corners[i], f = c / 3 * 3;
            const std::uint32_t v0 = a.indices[c], v1 = a.indices[f + (c + 1 - f) % 3],
                                v2 = a.indices[f + (c + 2 - f) % 3];
            const glm::dvec3 e1 = glm::dvec3(a.positions[v1]) - glm::dvec3(a.positions[v0]),
                             e2 = glm::dvec3(a.positions[v2]) - glm::dvec3(a.positions[v0]);
            const auto frame =
                cotan::f64::cotan_frame_gradient(n, e1, e2, glm::dvec2(a.texcoords[v1]) - glm::dvec2(a.texcoords[v0]),
                                                 glm::dvec2(a.texcoords[v2]) - glm::dvec2(a.texcoords[v0]));
            const double angle = degreesBetween(e1 - n * glm::dot(n, e1), e2 - n * glm::dot(n, e2));
            u += frame.t * angle;
            v += frame.b * angle;
            weight += angle;
        }
        for (std::uint32_t i = adjacency.vertexBegin[g]; i < adjacency.vertexBegin[g + 1]; ++i) {
            out.u[adjacency.vertices[i]] = weight > 0 ? u / weight : glm::dvec3(0);
            out.v[adjacency.vertices[i]] = weight > 0 ? v / weight : glm::dvec3(0);
        }
    }
    return out;
}

// Returns the largest difference of a gradient, relative to the longer gradient of its vertex.
double maxRelativeError(const cotan::Cotangents& a, const cotan::Cotangents& b)
{
    double maximum = a.u.size() == b.u.size() ? 0 : 1e9;
    for (std::size_t i = 0; i < a.u.size() && i < b.u.size(); ++i) {
        const double length = std::max({glm::length(b.u[i]), glm::length(b.v[i]), 1e-9f});
        maximum = std::max(maximum, std::max(glm::length(a.u[i] - b.u[i]), glm::length(a.v[i] - b.v[i])) / length);
    }
    return maximum;
}

// A sheet of an ordinary and a mirrored half; vertices on the line between them are split.
Arrays mirroredSeam(std::uint32_t n)
{
    Arrays a = gridOf(n, [](float x, float y) {
        return Vertex{{x, -y, 0.3f * x * y}, {0, 0, 1}, {std::abs(x - 0.5f), y}};
    });
    const cotan::VertexSplit split = cotan::splitMirrored(a.view());
    Arrays out;
    out.indices = split.indices;
    for (const std::uint32_t s : split.sources)
        out.add(a.positions[s], a.normals[s], a.texcoords[s]);
    return out;
}

// Every vertex is in exactly one group, and every corner with an orientation is in exactly one.
void expectSound(const Arrays& a, const Adjacency& adjacency)
{
    ASSERT_EQ(adjacency.cornerBegin.size(), adjacency.vertexBegin.size());
    ASSERT_TRUE(std::is_sorted(adjacency.vertexBegin.begin(), adjacency.vertexBegin.end()));
    ASSERT_TRUE(std::is_sorted(adjacency.cornerBegin.begin(), adjacency.cornerBegin.end()));
    ASSERT_EQ(adjacency.vertexBegin.back(), adjacency.vertices.size());
    ASSERT_EQ(adjacency.cornerBegin.back(), adjacency.corners.size());
    std::vector<std::uint32_t> vertices = adjacency.vertices, all(a.positions.size());
    std::iota(all.begin(), all.end(), 0u);
    std::sort(vertices.begin(), vertices.end());
    EXPECT_EQ(vertices, all);
    std::vector<std::uint32_t> corners = adjacency.corners;
    std::sort(corners.begin(), corners.end());
    EXPECT_EQ(std::adjacent_find(corners.begin(), corners.end()), corners.end());
    ASSERT_LE(adjacency.firstMirrored, adjacency.groups());
}

// A few float roundings of coordinates near 1 over edges of 1/24, plus the error of the float arc cosine.
constexpr double kRounding = 2e-5;

TEST(Adjacency, gathersTheCornersThatSmoothCotangentsAverage)
{
    for (const Arrays& a : {sphereGrid(24), unindexed(sphereGrid(24))}) {
        const Adjacency adjacency = makeAdjacency(a.view());
        expectSound(a, adjacency);
        EXPECT_EQ(adjacency.groups(), 25u * 25u); // equal vertices share a group: no corner is read once per copy
        EXPECT_EQ(adjacency.corners.size(), a.indices.size());
        EXPECT_EQ(adjacency.firstMirrored, adjacency.groups());
        EXPECT_LT(maxRelativeError(gathered(a, adjacency), smoothCotangents(a.view())), kRounding);
    }
}

TEST(Adjacency, keepsMirroredTrianglesApartWhereTheyMeet)
{
    const Arrays a = mirroredSeam(8);
    const Adjacency adjacency = makeAdjacency(a.view());
    expectSound(a, adjacency);
    EXPECT_EQ(adjacency.groups(), 81u + 9u); // the line is there twice: once per side
    EXPECT_EQ(adjacency.firstMirrored, 45u);
    EXPECT_EQ(adjacency.corners.size(), a.indices.size());
    EXPECT_LT(maxRelativeError(gathered(a, adjacency), smoothCotangents(a.view())), kRounding);
    // On the sheet, u runs to the right in one half and to the left in the other. Seen from outside with v down,
    // triangles are unmirrored where u runs to the right.
    for (std::uint32_t g = 0; g < adjacency.groups(); ++g)
        for (std::uint32_t i = adjacency.cornerBegin[g]; i < adjacency.cornerBegin[g + 1]; ++i) {
            const std::uint32_t f = adjacency.corners[i] / 3;
            float middle = 0;
            for (std::uint32_t k = 0; k < 3; ++k)
                middle += a.positions[a.indices[3 * f + k]].x / 3;
            EXPECT_EQ(g >= adjacency.firstMirrored, middle < 0.5f);
        }
}

TEST(Adjacency, givesTheLargerAngleToAVertexThatBothSidesIndex)
{
    Arrays a;
    const std::uint32_t v = a.add({0, 0, 0}, {0, 0, 1}, {0, 0});
    const std::uint32_t r = a.add({1, 0, 0}, {0, 0, 1}, {1, 0}), up = a.add({0.1f, 1, 0}, {0, 0, 1}, {0.1f, -1}),
                        left = a.add({-0.3f, 1, 0}, {0, 0, 1}, {0.3f, -1});
    a.indices = {v, r, up, v, up, left}; // 84 degrees unmirrored, 22 mirrored
    const Adjacency adjacency = makeAdjacency(a.view());
    expectSound(a, adjacency);
    EXPECT_LT(maxRelativeError(gathered(a, adjacency), smoothCotangents(a.view())), kRounding);
    EXPECT_EQ(adjacency.corners.size(), 3u + 1u); // the mirrored corners of `v` and `up` are left out
}

TEST(Adjacency, omitsTrianglesWithoutAreaButKeepsTheirVertices)
{
    Arrays a = sphereGrid(4);
    const std::size_t sound = a.indices.size();
    const std::uint32_t lone = a.add({5, 5, 5}, {0, 0, 1}, {0, 0});
    const std::uint32_t p = a.add({6, 5, 5}, {0, 0, 1}, {1, 0}), q = a.add({7, 5, 5}, {0, 0, 1}, {0, 1}); // collinear
    const std::uint32_t s = a.add({6, 6, 5}, {0, 0, 1}, {1, 0});                                          // no uv area
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::uint32_t none = a.add({nan, 6, 5}, {0, 0, 1}, {0, 1}), unused = a.add({9, 9, 9}, {0, 0, 0}, {0, 0});
    for (const std::uint32_t i : {lone, p, q, lone, p, s, lone, lone, p, lone, s, none, 0u, 0u, 1u})
        a.indices.push_back(i);
    const Adjacency adjacency = makeAdjacency(a.view());
    expectSound(a, adjacency);
    EXPECT_EQ(adjacency.groups(), a.positions.size());
    EXPECT_EQ(adjacency.corners.size(), sound);
    EXPECT_EQ(adjacency.vertices.back(), unused);
    EXPECT_LT(maxRelativeError(gathered(a, adjacency), smoothCotangents(a.view())), kRounding);
}

TEST(Adjacency, isEmptyForInconsistentArrays)
{
    Arrays a = sphereGrid(2);
    a.indices[3] = 9;
    EXPECT_TRUE(makeAdjacency(a.view()).vertexBegin.empty());
    EXPECT_EQ(makeAdjacency(a.view()).groups(), 0u);
    a = sphereGrid(2);
    a.normals.pop_back();
    EXPECT_TRUE(makeAdjacency(a.view()).vertexBegin.empty());
    EXPECT_EQ(makeAdjacency(Arrays().view()).groups(), 0u);
}

TEST(NormalAdjacency, crossesUvSeamsAndStopsAtNormalSeams)
{
    // The vertices of the seam are there twice because texcoords are mirrored, but their normals form one group.
    const Arrays a = mirroredSeam(8);
    const Adjacency adjacency = makeNormalAdjacency(a.view());
    expectSound(a, adjacency);
    EXPECT_EQ(a.positions.size(), 90u);
    EXPECT_EQ(adjacency.groups(), 81u);
    EXPECT_EQ(adjacency.firstMirrored, 81u);
    EXPECT_EQ(adjacency.corners.size(), a.indices.size());
    Arrays roof = a; // two sides of a ridge
    for (std::size_t i = 0; i < roof.positions.size(); ++i)
        if (i >= 81 || roof.positions[i].x < 0.5f)
            roof.normals[i] = {0.6f, 0, 0.8f};
    EXPECT_EQ(makeNormalAdjacency(roof.view()).groups(), 90u);
}

TEST(NormalAdjacency, putsTrianglesWoundAgainstTheirNormalsLast)
{
    Arrays a = sphereGrid(4);
    EXPECT_EQ(makeNormalAdjacency(a.view()).firstMirrored, 25u);
    std::reverse(a.indices.begin(), a.indices.end());
    const Adjacency adjacency = makeNormalAdjacency(a.view());
    EXPECT_EQ(adjacency.firstMirrored, 0u);
    EXPECT_EQ(adjacency.corners.size(), a.indices.size());
    a.indices.resize(4);
    EXPECT_EQ(makeNormalAdjacency(a.view()).groups(), 0u);
}

TEST(Adjacency, takesLinearTimeForUnsharedVerticesAndAtAPole)
{
    // All 200,000 corners at one point with equal attributes: one group that contains each corner once. Quadratic time
    // would be minutes.
    Arrays a;
    const std::uint32_t n = 200000;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double x = 6.28 * i / n, y = 6.28 * (i + 1.0) / n;
        a.indices.push_back(a.add({0, 0, 0}, {0, 0, 1}, {0, 0}));
        for (const double angle : {x, y})
            a.indices.push_back(a.add({float(std::cos(angle)), float(std::sin(angle)), 0}, {0, 0, 1},
                                      {float(std::cos(angle)), -float(std::sin(angle))}));
    }
    const Adjacency adjacency = makeAdjacency(a.view());
    EXPECT_EQ(adjacency.vertexBegin[1], n);
    EXPECT_EQ(adjacency.cornerBegin[1], n);
    expectSound(a, adjacency);
}

} // namespace
