// Meshlets with the ring around them: the frames that a mesh shader computes from them, by the shader's own code.
#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "cotan/gpu_meshes.hpp"
#include "cotan/portable.hpp"
#include "cotan/triangle.hpp"
#include "tangent_meshes.hpp"

namespace cotan::f32 {
#define COTAN_FUNCTION inline
#include "cotan/corner.h"
#undef COTAN_FUNCTION
} // namespace cotan::f32

namespace {

using namespace cotan::test;
using cotan::RingMeshlets;
using cotan::ringMeshlets;

// Like ringFrame of examples/triangle/ring.glsl.
cotan::f32::cotan_covectors ringFrame(const Arrays& a, const RingMeshlets& cut, std::uint32_t slot, glm::vec3 n)
{
    cotan::f32::cotan_covectors sum{glm::vec3(0), glm::vec3(0)};
    for (std::uint32_t i = cut.ringBegin[slot]; i < cut.ringBegin[slot + 1]; ++i) {
        const std::uint32_t c = cut.corners[i], k = c % 3, first = c - k;
        const std::uint32_t v0 = a.indices[c], v1 = a.indices[first + (k + 1) % 3], v2 = a.indices[first + (k + 2) % 3];
        const auto one =
            cotan::f32::cotan_smooth_corner(n, a.positions[v1] - a.positions[v0], a.positions[v2] - a.positions[v0],
                                            a.texcoords[v1] - a.texcoords[v0], a.texcoords[v2] - a.texcoords[v0]);
        sum.t += one.t;
        sum.b += one.b;
    }
    return cotan::f32::cotan_smooth_of_sum(sum);
}

// Maximum difference between the frames of work groups and smoothCotangents at any vertex; the longer vector has length
// 1.
double maxFrameError(const Arrays& a, const RingMeshlets& cut)
{
    const cotan::Cotangents expected = cotan::unitCotangents(cotan::smoothCotangents(a.view()));
    double largest = cut.vertices.empty() ? 1e9 : 0;
    for (std::uint32_t slot = 0; slot < cut.vertices.size(); ++slot) {
        const std::uint32_t v = cut.vertices[slot];
        const auto frame = ringFrame(a, cut, slot, a.normals[v]);
        largest = std::max(
            {largest, double(glm::length(frame.t - expected.u[v])), double(glm::length(frame.b - expected.v[v]))});
    }
    return largest;
}

// Expects all triangles in order, within the limits, and each vertex listed once per meshlet.
void expectComplete(const Arrays& a, const RingMeshlets& cut, std::uint32_t maxVertices, std::uint32_t maxTriangles)
{
    std::vector<std::uint32_t> indices;
    ASSERT_EQ(cut.ringBegin.size(), cut.vertices.size() + 1);
    ASSERT_EQ(cut.ringBegin.back(), cut.corners.size());
    for (const cotan::RingMeshlet& m : cut.meshlets) {
        ASSERT_LE(m.vertexCount, maxVertices);
        ASSERT_LE(m.triangleCount, maxTriangles);
        ASSERT_GT(m.triangleCount, 0u);
        ASSERT_LE(m.firstVertex + m.vertexCount, cut.vertices.size());
        const auto begin = cut.vertices.begin() + m.firstVertex;
        EXPECT_EQ(std::set<std::uint32_t>(begin, begin + m.vertexCount).size(), m.vertexCount);
        for (std::uint32_t t = 0; t < m.triangleCount; ++t)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t slot = cut.triangles[m.firstTriangle + t] >> (8 * k) & 255u;
                ASSERT_LT(slot, m.vertexCount);
                indices.push_back(begin[slot]);
            }
    }
    EXPECT_EQ(indices, a.indices);
}

// A few float roundings at edges of 1/24 between coordinates of 1, as for Adjacency.
constexpr double kRounding = 2e-5;

TEST(RingMeshlets, makeSmoothCotangentsOnASphereIndexedOrNot)
{
    for (const Arrays& a : {sphereGrid(24), unindexed(sphereGrid(24))})
        for (const auto& [vertices, triangles] : {std::array{64u, 124u}, {3u, 1u}, {256u, 1000u}, {17u, 9u}}) {
            const RingMeshlets cut = ringMeshlets(a.view(), vertices, triangles);
            expectComplete(a, cut, vertices, triangles);
            EXPECT_LT(maxFrameError(a, cut), kRounding) << vertices;
        }
}

TEST(RingMeshlets, reachTheTrianglesOfOtherMeshlets)
{
    const Arrays a = sphereGrid(24);
    const RingMeshlets cut = ringMeshlets(a.view());
    ASSERT_GT(cut.meshlets.size(), 8u);
    // An interior vertex has six corners in every meshlet that lists it.
    for (std::size_t i = 0; i < cut.vertices.size(); ++i) {
        const std::uint32_t x = cut.vertices[i] % 25, y = cut.vertices[i] / 25;
        if (x > 0 && x < 24 && y > 0 && y < 24) {
            EXPECT_EQ(cut.ringBegin[i + 1] - cut.ringBegin[i], 6u);
        }
    }
    RingMeshlets torn = cut; // without the ring, frames at meshlet borders differ
    for (std::size_t i = 0; i < cut.vertices.size(); ++i)
        torn.ringBegin[i + 1] = std::min(torn.ringBegin[i + 1], cut.ringBegin[i] + 3);
    EXPECT_GT(maxFrameError(a, torn), 100 * kRounding);
}

TEST(RingMeshlets, keepMirroredHalvesApartAndLeaveDegenerateTrianglesOut)
{
    Arrays seam = gridOf(8, [](float x, float y) {
        return Vertex{{x, -y, 0.3f * x * y}, {0, 0, 1}, {std::abs(x - 0.5f), y}};
    });
    const cotan::VertexSplit split = cotan::splitMirrored(seam.view());
    Arrays a;
    a.indices = split.indices;
    for (const std::uint32_t s : split.sources)
        a.add(seam.positions[s], seam.normals[s], seam.texcoords[s]);
    const std::uint32_t p = a.add({6, 5, 5}, {0, 0, 1}, {1, 0}), q = a.add({7, 5, 5}, {0, 0, 1}, {0, 1});
    for (const std::uint32_t i : {p, p, q, p, p, p, 0u, 0u, 1u})
        a.indices.push_back(i);
    const RingMeshlets cut = ringMeshlets(a.view());
    expectComplete(a, cut, 64, 124);
    EXPECT_LT(maxFrameError(a, cut), kRounding);
}

TEST(RingMeshlets, areEmptyForInvalidInput)
{
    Arrays a = sphereGrid(2);
    EXPECT_TRUE(ringMeshlets(a.view(), 2, 124).meshlets.empty());
    EXPECT_TRUE(ringMeshlets(a.view(), 257, 124).meshlets.empty());
    EXPECT_TRUE(ringMeshlets(a.view(), 64, 0).meshlets.empty());
    EXPECT_TRUE(ringMeshlets(Arrays().view()).meshlets.empty());
    a.indices[3] = 9;
    EXPECT_TRUE(ringMeshlets(a.view()).meshlets.empty());
}

// Overflow, underflow and non-finite numbers give no frame instead of a broken one.
TEST(SmoothCorner, isFiniteForAnyInput)
{
    const float big = 1e30f, tiny = 1e-30f, nan = std::numeric_limits<float>::quiet_NaN();
    for (const float scale : {1.0f, big, tiny, nan, 0.0f})
        for (const float uvScale : {1.0f, big, tiny, nan, 0.0f}) {
            const auto c =
                cotan::f32::cotan_smooth_corner({0, 0, 1}, glm::vec3(1, 0, 0.2f) * scale, glm::vec3(0.3f, 1, 0) * scale,
                                                glm::vec2(1, 0.1f) * uvScale, glm::vec2(0, 1) * uvScale);
            const auto f = cotan::f32::cotan_smooth_of_sum(c);
            for (int i = 0; i < 3; ++i)
                EXPECT_TRUE(std::isfinite(f.t[i]) && std::isfinite(f.b[i])) << scale << " " << uvScale;
        }
}

} // namespace
