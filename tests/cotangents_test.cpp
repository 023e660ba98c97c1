// Cotangents averaged at vertices (the frame `smooth`).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "cotan/tangents.hpp"
#include "tangent_meshes.hpp"

namespace {

using namespace cotan::test;
using cotan::Cotangents;
using cotan::smoothCotangents;

Arrays splitBy(const cotan::VertexSplit& split, const Arrays& a)
{
    Arrays b;
    for (const std::uint32_t i : split.sources)
        b.add(a.positions[i], a.normals[i], a.texcoords[i]);
    b.indices = split.indices;
    return b;
}

bool finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

TEST(SmoothCotangents, areTheGradientsOfAFlatLayout)
{
    // Texcoords are linear in position: the gradients are the rows with y negated, whether stretched, sheared or
    // mirrored.
    const glm::vec2 layouts[][2] = {
        {{1, 0}, {0, 1}}, {{2, 0}, {0, 1}}, {{1, 0.7f}, {0, 1}}, {{-1, 0}, {0, 3}}, {{0.6f, 0.8f}, {-4, 3}},
    };
    for (const auto& rows : layouts) {
        const Arrays a = flatGrid(5, rows[0], rows[1]);
        const Cotangents found = smoothCotangents(a.view());
        ASSERT_EQ(found.u.size(), a.positions.size());
        for (std::size_t i = 0; i < found.u.size(); ++i) {
            // Uv differences of 1/5 with a rounding of 6e-8 * 4, and a few operations.
            ASSERT_LT(glm::length(found.u[i] - glm::vec3(rows[0].x, -rows[0].y, 0)), 1e-5f);
            ASSERT_LT(glm::length(found.v[i] - glm::vec3(rows[1].x, -rows[1].y, 0)), 1e-5f);
        }
    }
}

// Corners are processed 256 at a time (CornerLanes): fans of fewer and of more, around one shared vertex or with a
// vertex per corner. Thin corners among them are processed one by one. Uv are linear in position.
TEST(SmoothCotangents, areThoseOfTheLayoutForAnyNumberOfCorners)
{
    const glm::vec3 n(0, 0, 1);
    for (const std::uint32_t corners : {1u, 15u, 16u, 17u, 255u, 256u, 257u, 700u})
        for (const bool indexed : {true, false}) {
            Arrays a;
            const auto vertex = [&](glm::vec3 p) { return a.add(p, n, {2 * p.x + 0.5f * p.y, -p.y}); };
            const auto fan = [&](std::uint32_t count, glm::vec3 middle) {
                std::uint32_t at = indexed ? vertex(middle) : 0;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const float from = 6 * float(i) / float(count), to = 6 * float(i + 1) / float(count);
                    at = indexed ? at : vertex(middle);
                    const std::uint32_t b = vertex(middle + glm::vec3(std::cos(from), std::sin(from), 0)),
                                        c = vertex(middle + glm::vec3(std::cos(to), std::sin(to), 0));
                    a.indices.insert(a.indices.end(), {at, b, c});
                }
            };
            fan(corners, glm::vec3(0));
            fan(7000, {4, 0, 0}); // a thousandth of a radian each: thin
            fan(corners, {8, 0, 0});
            const Cotangents found = smoothCotangents(a.view());
            for (std::size_t i = 0; i < found.u.size(); ++i) {
                // The worst are thin triangles: uv of up to 20 rounded at 1e-6, over edges from 0.001 on.
                ASSERT_LT(glm::length(found.u[i] - glm::vec3(2, 0.5f, 0)), 2e-2f) << corners << ' ' << i;
                ASSERT_LT(glm::length(found.v[i] - glm::vec3(0, -1, 0)), 2e-2f) << corners << ' ' << i;
            }
        }
}

// The maximum relative error of the gradients at interior vertices of the sphere.
double sphereError(std::uint32_t n)
{
    const Arrays a = sphereGrid(n);
    const Cotangents found = smoothCotangents(a.view());
    const double perRadian = 3 / (2 * std::numbers::pi); // u and v per radian
    double worst = 0;
    for (std::uint32_t j = 1; j < n; ++j)
        for (std::uint32_t i = 1; i < n; ++i) {
            const std::size_t k = j * (n + 1) + i;
            const glm::dvec3 p(a.positions[k]);
            const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), p));
            const double ring = std::sqrt(1 - p.y * p.y);
            const glm::dvec3 gradU = east * (perRadian / ring);
            const glm::dvec3 gradV = glm::cross(east, p) * perRadian; // towards the south pole
            const double errorU = glm::length(glm::dvec3(found.u[k]) - gradU) * ring;
            const double errorV = glm::length(glm::dvec3(found.v[k]) - gradV);
            worst = std::max(worst, std::max(errorU, errorV) / perRadian);
        }
    return worst;
}

TEST(SmoothCotangents, convergeToTheGradientsOfASphereInSecondOrder)
{
    const double coarse = sphereError(16), fine = sphereError(32);
    EXPECT_LT(fine, 0.01);
    EXPECT_LT(fine, coarse / 3); // second order divides by four
}

TEST(SmoothCotangents, haveNoJumpAcrossInteriorEdges)
{
    // Corners that share position, normal and texcoord get bitwise equal results, indexed or not, so that the
    // interpolated gradients agree along every shared edge.
    const Arrays a = sphereGrid(8), b = unindexed(a);
    const Cotangents shared = smoothCotangents(a.view()), single = smoothCotangents(b.view());
    for (std::size_t c = 0; c < a.indices.size(); ++c) {
        ASSERT_EQ(single.u[c], shared.u[a.indices[c]]);
        ASSERT_EQ(single.v[c], shared.v[a.indices[c]]);
    }
}

TEST(SmoothCotangents, scaleInverselyWithPositions)
{
    const Arrays plain = sphereGrid(8);
    Arrays scaled = plain;
    for (glm::vec3& p : scaled.positions)
        p *= 8.0f;
    const Cotangents a = smoothCotangents(plain.view()), b = smoothCotangents(scaled.view());
    for (std::size_t i = 0; i < a.u.size(); ++i) {
        ASSERT_EQ(b.u[i] * 8.0f, a.u[i]); // powers of two are exact
        ASSERT_EQ(b.v[i] * 8.0f, a.v[i]);
    }
}

TEST(SmoothCotangents, arePerpendicularToTheNormal)
{
    const Arrays a = sphereGrid(8);
    const Cotangents found = smoothCotangents(a.view());
    for (std::size_t i = 0; i < found.u.size(); ++i) {
        ASSERT_NEAR(glm::dot(glm::normalize(found.u[i]), a.normals[i]), 0, 1e-5);
        ASSERT_NEAR(glm::dot(glm::normalize(found.v[i]), a.normals[i]), 0, 1e-5);
    }
}

TEST(SmoothCotangents, degenerateTrianglesAddNothing)
{
    const Arrays plain = sphereGrid(6);
    Arrays more = plain;
    more.indices.insert(more.indices.end(), {8, 8, 9, 8, 9, 8, 10, 10, 10}); // no area in space
    const std::uint32_t far = more.add({3, 1, 2}, {0, 0, 1}, plain.texcoords[8]);
    const std::uint32_t same = more.add(plain.positions[9], plain.normals[9], plain.texcoords[9]);
    more.indices.insert(more.indices.end(), {8, same, far}); // no area in uv
    const Cotangents a = smoothCotangents(plain.view()), b = smoothCotangents(more.view());
    for (std::size_t i = 0; i < plain.positions.size(); ++i) {
        ASSERT_EQ(b.u[i], a.u[i]);
        ASSERT_EQ(b.v[i], a.v[i]);
    }
    EXPECT_EQ(b.u[far], glm::vec3(0));
    EXPECT_EQ(b.u[same], a.u[9]); // an equal vertex shares the gradients
}

TEST(SmoothCotangents, mirroredSidesDoNotCancelOnceSplit)
{
    Arrays a = gridOf(4, [](float x, float y) { return Vertex{{x, -y, 0}, {0, 0, 1}, {std::abs(x - 0.5f), y}}; });
    const Arrays b = splitBy(cotan::splitMirrored(a.view()), a);
    const Cotangents found = smoothCotangents(b.view());
    for (std::size_t f = 0; f < b.indices.size(); f += 3) {
        float middle = 0;
        for (std::size_t k = 0; k < 3; ++k)
            middle += b.positions[b.indices[f + k]].x / 3;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 u = found.u[b.indices[f + k]];
            ASSERT_LT(glm::length(u - glm::vec3(middle < 0.5f ? -1 : 1, 0, 0)), 1e-6f);
        }
    }
    // Without splitting, a vertex on the line still gets the gradient of one side, not the sum of both.
    for (const glm::vec3& u : smoothCotangents(a.view()).u)
        EXPECT_NEAR(glm::length(u), 1, 1e-6);
}

// Seams anywhere and triangles in any order: at a vertex either side may come first and keep the original vertex.
TEST(SplitSmoothCotangents, equalTheTwoStepsInAnyOrderOfTriangles)
{
    std::mt19937 dice(5);
    std::size_t copies = 0, keptMirrored = 0;
    for (int round = 0; round < 30; ++round) {
        const float seam = float(1 + dice() % 5) / 6;
        Arrays a = gridOf(6, [&](float x, float y) {
            return Vertex{{x, -y, 0.1f * x * y}, {0, 0, 1}, {std::abs(x - seam) * (1 + y), y}};
        });
        std::vector<std::size_t> order(a.indices.size() / 3);
        std::iota(order.begin(), order.end(), std::size_t(0));
        std::shuffle(order.begin(), order.end(), dice);
        const std::vector<std::uint32_t> old = a.indices;
        for (std::size_t f = 0; f < order.size(); ++f)
            std::copy_n(old.begin() + std::ptrdiff_t(3 * order[f]), 3, a.indices.begin() + std::ptrdiff_t(3 * f));
        const cotan::VertexSplit split = cotan::splitMirrored(a.view());
        const Cotangents expected = smoothCotangents(splitBy(split, a).view());
        const cotan::SplitCotangents found = cotan::splitSmoothCotangents(a.view());
        EXPECT_EQ(found.split.sources, split.sources);
        EXPECT_EQ(found.split.indices, split.indices);
        ASSERT_EQ(found.cotangents.u.size(), split.sources.size());
        ASSERT_EQ(found.cotangents.v.size(), split.sources.size());
        for (std::size_t i = 0; i < split.sources.size(); ++i) {
            ASSERT_LT(glm::length(found.cotangents.u[i] - expected.u[i]), 1e-5f) << round << ' ' << i;
            ASSERT_LT(glm::length(found.cotangents.v[i] - expected.v[i]), 1e-5f) << round << ' ' << i;
        }
        for (std::size_t i = a.positions.size(); i < split.sources.size(); ++i) {
            ++copies;
            keptMirrored += found.cotangents.u[split.sources[i]].x < 0;
        }
    }
    EXPECT_GT(copies, 100u);
    EXPECT_GT(keptMirrored, copies / 4);
    EXPECT_LT(keptMirrored, 3 * copies / 4);
}

TEST(SmoothCotangents, areFiniteForBrokenInput)
{
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {inf, -inf, nan, 1e38f, 1e-38f, 0.0f})
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
            const Cotangents found = smoothCotangents(a.view());
            ASSERT_EQ(found.u.size(), a.positions.size());
            for (std::size_t i = 0; i < found.u.size(); ++i)
                ASSERT_TRUE(finite(found.u[i]) && finite(found.v[i])) << bad << ' ' << which;
        }
}

TEST(SmoothCotangents, inconsistentArraysGiveNothing)
{
    Arrays a = flatGrid(1, {1, 0}, {0, 1});
    a.indices[0] = 99;
    EXPECT_TRUE(smoothCotangents(a.view()).u.empty());
    EXPECT_TRUE(smoothCotangents({}).u.empty());
}

} // namespace
