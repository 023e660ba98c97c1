// Small meshes for GPUs, worked out by hand from the documentation in cotan/gpu_meshes.hpp: which triangles share a
// meshlet, and which copy of a vertex a triangle uses.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "cotan/gpu_meshes.hpp"
#include "tangent_meshes.hpp"

namespace {

using Numbers = std::vector<std::uint32_t>;

TEST(RingMeshlets, takeTrianglesWhileTheyFit)
{
    // Ten separate triangles: sizes of the meshlets for at most 9, 10 and 11 vertices, and for 2 triangles.
    const cotan::test::Arrays apart = cotan::test::unindexed(cotan::test::flatGrid(4, {1, 0}, {0, 1}));
    cotan::test::Arrays ten = apart;
    ten.indices.resize(30);
    const auto counts = [&](std::uint32_t vertices, std::uint32_t triangles) {
        Numbers found;
        for (const cotan::RingMeshlet& m : cotan::ringMeshlets(ten.view(), vertices, triangles).meshlets) {
            EXPECT_EQ(m.vertexCount, 3 * m.triangleCount);
            found.push_back(m.triangleCount);
        }
        return found;
    };
    EXPECT_EQ(counts(9, 100), (Numbers{3, 3, 3, 1}));
    EXPECT_EQ(counts(8, 100), (Numbers{2, 2, 2, 2, 2}));
    EXPECT_EQ(counts(11, 100), (Numbers{3, 3, 3, 1}));
    EXPECT_EQ(counts(12, 100), (Numbers{4, 4, 2}));
    EXPECT_EQ(counts(256, 4), (Numbers{4, 4, 2}));
    EXPECT_EQ(counts(256, 5), (Numbers{5, 5}));
    EXPECT_EQ(counts(30, 10), (Numbers{10}));
}

TEST(RingMeshlets, countAVertexOnceHoweverOftenATriangleNamesIt)
{
    for (const auto& [second, fits] : {std::pair(Numbers{3, 3, 3}, true),
                                       {{3, 3, 2}, true},
                                       {{3, 2, 3}, true},
                                       {{2, 3, 3}, true},
                                       {{0, 1, 3}, true},
                                       {{3, 4, 4}, false},
                                       {{4, 3, 4}, false},
                                       {{4, 4, 3}, false},
                                       {{3, 4, 0}, false}}) {
        cotan::test::Arrays a = cotan::test::flatGrid(4, {1, 0}, {0, 1});
        a.indices = {0, 1, 2};
        a.indices.insert(a.indices.end(), second.begin(), second.end());
        const cotan::RingMeshlets cut = cotan::ringMeshlets(a.view(), 4, 10);
        ASSERT_EQ(cut.meshlets.size(), fits ? 1u : 2u) << second[0] << second[1] << second[2];
        EXPECT_EQ(cut.meshlets[0].vertexCount, fits ? 4u : 3u);
    }
}

TEST(Provoking, theVertexWithTheFewestRemainingTrianglesGoesFirst)
{
    // The same triangle four times, then one with a new vertex. 2 has the fewest triangles left; then 0 precedes 1;
    // then no vertex is left, so the first corner is copied, and the last triangle uses that copy.
    const Numbers indices{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 3, 0, 1};
    const auto first = cotan::provokingMesh(indices, 4, cotan::ProvokingVertex::first),
               last = cotan::provokingMesh(indices, 4, cotan::ProvokingVertex::last);
    EXPECT_EQ(first.sources, (Numbers{2, 0, 1, 0, 3}));
    EXPECT_EQ(first.corners, (Numbers{2, 0, 1, 0, 1, 2, 1, 2, 0, 0, 1, 2, 3, 0, 1}));
    EXPECT_EQ(first.indices, (Numbers{0, 1, 2, 1, 2, 0, 2, 0, 1, 3, 2, 0, 4, 3, 2}));
    EXPECT_EQ(last.sources, first.sources);
    EXPECT_EQ(last.corners, first.corners);
    EXPECT_EQ(last.indices, (Numbers{1, 2, 0, 2, 0, 1, 0, 1, 2, 2, 0, 3, 3, 2, 4}));
    // Vertices that provoke no triangle follow in the order of first use.
    const auto pair = cotan::provokingMesh(Numbers{0, 1, 2, 2, 1, 3}, 4, cotan::ProvokingVertex::first);
    EXPECT_EQ(pair.sources, (Numbers{0, 2, 1, 3}));
    EXPECT_EQ(pair.indices, (Numbers{0, 2, 1, 1, 2, 3}));
}

} // namespace
