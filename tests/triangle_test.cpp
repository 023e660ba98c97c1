// U and V of triangles, packed forms, and provoking vertices.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "cotan/gpu_meshes.hpp"
#include "cotan/portable.hpp"
#include "cotan/triangle.hpp"
#include "tangent_meshes.hpp"
#include "truth/random.hpp"

namespace cotan {

namespace {

using Vec = glm::dvec3;

double degreesBetween(Vec a, Vec b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 57.29577951308232;
}

// A triangle that is no sliver in space or in uv; n is on either side of it.
struct RandomTriangle {
    Vec dp1, dp2, n, m;
    glm::dvec2 duv1, duv2;
};

RandomTriangle randomTriangle(Random& random)
{
    const auto vector = [&] { return Vec(random.range(-1, 1), random.range(-1, 1), random.range(-1, 1)); };
    for (;;) {
        RandomTriangle t;
        t.dp1 = vector();
        t.dp2 = vector();
        t.duv1 = {random.range(-1, 1), random.range(-1, 1)};
        t.duv2 = {random.range(-1, 1), random.range(-1, 1)};
        t.m = glm::normalize(Vec(random.range(-0.7, 0.7), random.range(-0.7, 0.7), 1));
        const Vec face = glm::cross(t.dp1, t.dp2);
        if (glm::length(face) < 0.1 || std::abs(t.duv1.x * t.duv2.y - t.duv1.y * t.duv2.x) < 0.1)
            continue;
        t.n = glm::normalize(glm::normalize(face) + 0.6 * vector());
        if (glm::dot(t.n, glm::normalize(face)) < 0.5)
            continue;
        t.n *= random.range(-1, 1) < 0 ? -1.0 : 1.0;
        return t;
    }
}

f32::cotan_triangle vectorsOf(const RandomTriangle& t)
{
    return f32::cotan_triangle_of_edges(t.dp1, t.dp2, t.duv1, t.duv2, t.n);
}

// The frame of `cotangent` for a triangle: its cotangents are perpendicular to n, as those of `smooth` at vertices.
f64::cotan_frame frameOf(const RandomTriangle& t)
{
    return f64::cotan_frame_cotangent(t.n, t.dp1, t.dp2, t.duv1, t.duv2);
}

std::uint32_t below(Random& random, std::uint32_t end) { return static_cast<std::uint32_t>(random.bits() % end); }

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

} // namespace

TEST(Triangle, scaledTrianglesGiveTheNormalsOfCotangent)
{
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const RandomTriangle t = randomTriangle(random);
        const f32::cotan_triangle v = vectorsOf(t);
        const Vec expected = f64::cotan_apply(frameOf(t), t.m);
        // The length of n cancels out.
        const Vec found = f32::cotan_perturb_triangle_scaled(t.n * 3.0, v.u, v.v, t.m);
        ASSERT_LT(degreesBetween(found, expected), 1e-4); // rounding of float
    }
}

TEST(Triangle, scalesSlopesByTheCosineOfTheTiltToOne)
{
    Random random(2);
    for (int i = 0; i < 20000; ++i) {
        const RandomTriangle t = randomTriangle(random);
        const f64::cotan_triangle v = f64::cotan_triangle_of_edges(t.dp1, t.dp2, t.duv1, t.duv2, t.n);
        const f64::cotan_frame triangle = f64::cotan_frame_of_triangle(t.n, v.u, v.v), pixel = frameOf(t);
        const double factor = glm::length(triangle.t) / glm::length(pixel.t);
        const double lean = std::abs(glm::dot(t.n, glm::normalize(glm::cross(t.dp1, t.dp2))));
        ASSERT_LE(factor, 1 + 1e-12);
        ASSERT_GE(factor, lean - 1e-12);
        // Both have the same factor, and the same directions.
        ASSERT_LT(glm::length(triangle.t - pixel.t * factor), 1e-12);
        ASSERT_LT(glm::length(triangle.b - pixel.b * factor), 1e-12);
    }
}

TEST(Triangle, fusedEqualsTotal)
{
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const RandomTriangle t = randomTriangle(random);
        const f32::cotan_triangle v = vectorsOf(t);
        const Vec expected = f64::cotan_apply(f64::cotan_frame_of_triangle(t.n, v.u, v.v), t.m);
        ASSERT_LT(degreesBetween(f32::cotan_perturb_triangle(t.n * 0.05, v.u, v.v, t.m), expected), 1e-4);
        const f32::cotan_triangle sound = f32::cotan_triangle_of_sound_edges(t.dp1, t.dp2, t.duv1, t.duv2, t.n);
        ASSERT_LT(glm::length(sound.u - v.u) + glm::length(sound.v - v.v), 1e-5);
    }
}

TEST(Triangle, doesNotDependOnTheFirstVertexOrTheWinding)
{
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const RandomTriangle t = randomTriangle(random);
        const f32::cotan_triangle v = vectorsOf(t);
        const f32::cotan_triangle rotated =
            f32::cotan_triangle_of_edges(t.dp2 - t.dp1, -t.dp1, t.duv2 - t.duv1, -t.duv1, t.n);
        const f32::cotan_triangle wound = f32::cotan_triangle_of_edges(t.dp2, t.dp1, t.duv2, t.duv1, t.n);
        ASSERT_LT(glm::length(rotated.u - v.u) + glm::length(rotated.v - v.v), 1e-5);
        ASSERT_LT(glm::length(wound.u - v.u) + glm::length(wound.v - v.v), 1e-6);
    }
}

TEST(Triangle, followsAnyTransformExactly)
{
    // Rows of a shear with a non-uniform scale, without and with a mirror.
    for (const double side : {1.0, -1.0}) {
        const Vec row0(side * 2, 0.3, 0), row1(0, 0.5, 0.2), row2(0.4, 0, 1.5);
        const Vec c0 = glm::cross(row1, row2), c1 = glm::cross(row2, row0), c2 = glm::cross(row0, row1);
        const auto moved = [&](Vec p) { return Vec(glm::dot(row0, p), glm::dot(row1, p), glm::dot(row2, p)); };
        // The inverse transpose, up to a positive factor.
        const auto covector = [&](Vec n) { return side * Vec(glm::dot(c0, n), glm::dot(c1, n), glm::dot(c2, n)); };
        Random random(5);
        int changed = 0;
        for (int i = 0; i < 5000; ++i) {
            const RandomTriangle t = randomTriangle(random);
            const f64::cotan_triangle object = f64::cotan_triangle_of_edges(t.dp1, t.dp2, t.duv1, t.duv2, t.n);
            const f64::cotan_triangle world = f64::cotan_triangle_transformed(object, row0, row1, row2, side);
            const f64::cotan_triangle expected =
                f64::cotan_triangle_of_edges(moved(t.dp1), moved(t.dp2), t.duv1, t.duv2, covector(t.n));
            // A strongly tilted normal can end up on the other side of a sheared triangle.
            const double before = glm::dot(t.n, glm::cross(t.dp1, t.dp2));
            const double after = side * glm::dot(covector(t.n), glm::cross(moved(t.dp1), moved(t.dp2)));
            if (before * after < 0 && ++changed)
                continue;
            ASSERT_LT(glm::length(world.u - expected.u) + glm::length(world.v - expected.v), 1e-12);
        }
        EXPECT_LT(changed, 500);
    }
}

TEST(Triangle, negatedZGivesTheBumpsOfBackFaces)
{
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
        const RandomTriangle t = randomTriangle(random);
        const f32::cotan_triangle v = vectorsOf(t);
        // The result of `cotangent` for the negated normal.
        const Vec expected = f64::cotan_apply(f64::cotan_frame_cotangent(-t.n, t.dp1, t.dp2, t.duv1, t.duv2), t.m);
        const Vec found = f32::cotan_perturb_triangle_scaled(t.n, v.u, v.v, Vec(t.m.x, t.m.y, -t.m.z));
        ASSERT_LT(degreesBetween(found, expected), 1e-4);
    }
}

TEST(Triangle, neverGivesNaN)
{
    const float odd[] = {0, 1, -1, 1e-38f, 1e38f, kNan, kInfinity, 0.3f};
    Random random(7);
    const auto any = [&] { return odd[below(random, 8)]; };
    const glm::vec3 n(0, 0, 1), m(0.3f, -0.2f, 0.9f);
    for (int i = 0; i < 200000; ++i) {
        const glm::vec3 dp1(any(), any(), any()), dp2(any(), any(), any()), side(any(), any(), any());
        const glm::vec2 duv1(any(), any()), duv2(any(), any());
        const f32::cotan_triangle t = f32::cotan_triangle_of_edges(dp1, dp2, duv1, duv2, side);
        const float length = std::max(glm::length(t.u), glm::length(t.v));
        ASSERT_TRUE(length == 0 || std::abs(length - 1) < 1e-5f);
        const glm::vec3 p = f32::cotan_perturb_triangle(n, t.u, t.v, m);
        ASSERT_NEAR(glm::length(p), 1, 1e-5);
        // The same for arbitrary U and V.
        const glm::vec3 q = f32::cotan_apply(f32::cotan_frame_of_triangle(side, dp1, dp2), m);
        ASSERT_NEAR(glm::length(q), 1, 1e-5);
        const f32::cotan_triangle moved = f32::cotan_triangle_transformed(t, dp1, dp2, side, 1.0f);
        ASSERT_TRUE(std::isfinite(moved.u.x + moved.u.y + moved.u.z + moved.v.x + moved.v.y + moved.v.z));
    }
}

TEST(Triangle, degenerateTrianglesHaveNoFrame)
{
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), zero(0);
    const glm::vec2 u(1, 0), v(0, 1), none(0);
    const auto isNone = [](const f32::cotan_triangle& t) { return t.u == glm::vec3(0) && t.v == glm::vec3(0); };
    EXPECT_FALSE(isNone(f32::cotan_triangle_of_edges(x, y, u, v, z)));
    EXPECT_TRUE(isNone(f32::cotan_triangle_of_edges(x, x * 2.0f, u, v, z)));
    EXPECT_TRUE(isNone(f32::cotan_triangle_of_edges(x, zero, u, v, z)));
    EXPECT_TRUE(isNone(f32::cotan_triangle_of_edges(x, y, none, none, z)));
    EXPECT_TRUE(isNone(f32::cotan_triangle_of_edges(x, glm::vec3(kNan), u, v, z)));
    // Without normals the winding decides: the side where it is counter-clockwise is outside, here +z.
    const f32::cotan_triangle wound = f32::cotan_triangle_of_edges(x, y, u, v, zero);
    EXPECT_LT(glm::length(glm::cross(z, wound.u) - x), 1e-6f);
}

TEST(Triangle, arraysGiveTheVectorsOfEachTriangle)
{
    const test::Arrays mesh = test::flatGrid(40, {2, 0.5f}, {-0.25f, 1});
    for (const int threads : {1, 3}) {
        const auto triangles = triangleVectors(mesh.view(), threads);
        ASSERT_EQ(triangles.size(), mesh.indices.size() / 3);
        for (const TriangleVectors& t : triangles) {
            // uv = (2x + y/2, -x/4 + y), y down: gradients (2, -1/2) and (-1/4, -1).
            const float longest = std::sqrt(4.25f);
            EXPECT_LT(glm::length(glm::cross(glm::vec3(0, 0, 1), t.u) - glm::vec3(2, -0.5f, 0) / longest), 1e-5f);
            EXPECT_LT(glm::length(glm::cross(glm::vec3(0, 0, 1), t.v) - glm::vec3(-0.25f, -1, 0) / longest), 1e-5f);
        }
    }
    test::Arrays bad = mesh;
    bad.indices[5] = 1u << 30;
    EXPECT_TRUE(triangleVectors(bad.view()).empty());
}

// ---- small forms --------------------------------------------------------------------------------

TEST(Pack, twelveByteTrianglesErrByThreeHundredthsOfADegree)
{
    Random random(8);
    double largest = 0;
    for (int i = 0; i < 50000; ++i) {
        const RandomTriangle t = randomTriangle(random);
        const f32::cotan_triangle v = vectorsOf(t);
        const auto packed = packTriangles(std::array{TriangleVectors{v.u, v.v}});
        const f32::cotan_packed_triangle p{packed[0][0], packed[0][1], packed[0][2]};
        const Vec exact = f32::cotan_perturb_triangle(t.n, v.u, v.v, t.m);
        const Vec found =
            f32::cotan_perturb_triangle(t.n, f32::cotan_unpack_triangle_u(p), f32::cotan_unpack_triangle_v(p), t.m);
        largest = std::max(largest, degreesBetween(exact, found));
    }
    // Half an ulp of a half float is 2^-12 of a number: 0.014 degrees for one component, and six contribute.
    EXPECT_LT(largest, 0.03);
    EXPECT_GT(largest, 0.002); // rounding has an effect
}

TEST(Pack, smoothIsAccurateInEightAndInFourBytes)
{
    Random random(9);
    double largest8 = 0, largest4 = 0, sum4 = 0;
    constexpr int kCount = 50000;
    for (int i = 0; i < kCount; ++i) {
        const RandomTriangle t = randomTriangle(random);
        const glm::vec3 n(t.n);
        const f64::cotan_frame f = f64::cotan_frame_cotangent(Vec(n), t.dp1, t.dp2, t.duv1, t.duv2);
        // The common scale of both does not matter.
        const Cotangents stored{{glm::vec3(f.t * 7.0)}, {glm::vec3(f.b * 7.0)}};
        const auto normalOf = [&](const f32::cotan_covectors& c) {
            return Vec(f64::cotan_perturb_smooth(Vec(n), c.t, c.b, t.m));
        };
        const Vec exact = f64::cotan_perturb_smooth(Vec(n), f.t, f.b, t.m);
        const auto q = packSmooth8(std::array{n}, stored).at(0);
        const glm::vec4 fetched = glm::vec4(q[0], q[1], q[2], q[3]) / 32767.0f; // SNORM16
        largest8 = std::max(largest8, degreesBetween(exact, normalOf(f32::cotan_unpack_smooth8(n, fetched))));
        const std::uint32_t word = packSmooth4(std::array{n}, stored).at(0);
        const double error = degreesBetween(exact, normalOf(f32::cotan_unpack_smooth4(n, word)));
        largest4 = std::max(largest4, error);
        sum4 += error;
    }
    EXPECT_LT(largest8, 0.003); // four steps of 1/65534: 0.0035 at worst
    EXPECT_LT(largest4, 0.2);   // steps of 1/511 and 1/255 of the largest number, halved
    EXPECT_LT(sum4 / kCount, 0.05);
}

TEST(Pack, invalidCotangentsPackToZero)
{
    const std::array normals{glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0)};
    const Cotangents none{{glm::vec3(0), glm::vec3(kNan), glm::vec3(kInfinity)},
                          {glm::vec3(0), glm::vec3(0), glm::vec3(1)}};
    for (const std::uint32_t word : packSmooth4(normals, none)) {
        const f32::cotan_covectors c = f32::cotan_unpack_smooth4(normals[0], word);
        EXPECT_EQ(c.t, glm::vec3(0));
        EXPECT_EQ(c.b, glm::vec3(0));
    }
    for (const auto& q : packSmooth8(normals, none))
        EXPECT_EQ(q, (std::array<std::int16_t, 4>{0, 0, 0, 0}));
    EXPECT_TRUE(packSmooth4(normals, Cotangents{}).empty());
    EXPECT_TRUE(packSmooth8(normals, Cotangents{}).empty());
}

TEST(Pack, aTangentInTwoBytesIsWithinAHundredthOfADegree)
{
    Random random(10);
    double largest = 0;
    for (int i = 0; i < 100000; ++i) {
        // Some normals are close to the seams of the basis.
        const glm::vec3 n = i % 7 == 0 ? glm::vec3(0, 0, -1)
            : i % 7 == 1               ? glm::normalize(glm::vec3(random.range(-1, 1), 1, i % 2 ? 1e-7 : -1e-7))
                                       : glm::vec3(randomTriangle(random).n);
        const glm::vec3 any(random.range(-1, 1), random.range(-1, 1), random.range(-1, 1));
        const Vec exact = glm::normalize(glm::cross(Vec(n), Vec(any)));
        if (!(glm::length(glm::cross(n, any)) > 0.01f))
            continue;
        const float w = i % 2 ? 1.0f : -1.0f;
        const auto word = packTangents2(std::array{n}, std::array{glm::vec4(glm::vec3(exact), w)}).at(0);
        const glm::vec4 found = f32::cotan_unpack_tangent2(n, word);
        ASSERT_EQ(found.w, w);
        largest = std::max(largest, degreesBetween(exact, Vec(found.x, found.y, found.z)));
    }
    // 32768 steps around the square; in the middle of a side a step is 4/32768 of 2 radians, the error half of it.
    EXPECT_LT(largest, 0.0075);
}

TEST(Pack, theBasisOfANormalIsOrthonormalEverywhere)
{
    Random random(11);
    for (int i = 0; i < 100000; ++i) {
        glm::vec3 n(random.range(-1, 1), random.range(-1, 1), i % 3 ? random.range(-1, 1) : random.range(-1e-6, 1e-6));
        if (!(glm::length(n) > 0.01f))
            continue;
        n = glm::normalize(n);
        const f32::cotan_basis b = f32::cotan_basis_of_normal(n);
        // Duff et al. report at most 1e-6 in float.
        ASSERT_NEAR(glm::dot(b.x, b.x), 1, 2e-6);
        ASSERT_NEAR(glm::dot(b.y, b.y), 1, 2e-6);
        ASSERT_LT(glm::length(glm::cross(b.x, b.y) - n), 2e-6);
    }
}

TEST(Pack, unitCotangentsScaleTheLongerOneToOne)
{
    const Cotangents c{{{3, 0, 0}, {0, 0, 0}, {0, 1e-30f, 0}, {0, 0, 1e30f}},
                       {{0, 4, 0}, {0, 0, 0}, {1e-31f, 0, 0}, {1, 0, 0}}};
    const Cotangents unit = unitCotangents(c);
    EXPECT_LT(glm::length(unit.u[0] - glm::vec3(0.75f, 0, 0)), 1e-6f);
    EXPECT_LT(glm::length(unit.v[0] - glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_EQ(unit.u[1], glm::vec3(0));
    EXPECT_LT(glm::length(unit.u[2] - glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(glm::length(unit.u[3] - glm::vec3(0, 0, 1)), 1e-6f);
}

// ---- provoking vertices -------------------------------------------------------------------------

namespace {

// Expects what holds for every result: the same triangles with the same winding, and a provoking vertex for each.
void expectSound(const ProvokingMesh& mesh, std::span<const std::uint32_t> indices, ProvokingVertex provoking)
{
    const std::size_t triangles = indices.size() / 3, slot = provoking == ProvokingVertex::first ? 0 : 2;
    ASSERT_EQ(mesh.indices.size(), indices.size());
    ASSERT_EQ(mesh.corners.size(), indices.size());
    ASSERT_GE(mesh.sources.size(), triangles);
    for (std::size_t f = 0; f < triangles; ++f) {
        ASSERT_EQ(mesh.indices[3 * f + slot], f); // the index of its triangle
        std::array<std::uint32_t, 3> found{}, expected{};
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_LT(mesh.indices[3 * f + k], mesh.sources.size());
            found[k] = mesh.sources[mesh.indices[3 * f + k]];
            expected[k] = indices[3 * f + k];
        }
        // The same three vertices, up to a cyclic rotation.
        bool same = false;
        for (int rotation = 0; rotation < 3; ++rotation) {
            same = same || found == expected;
            std::rotate(expected.begin(), expected.begin() + 1, expected.end());
        }
        ASSERT_TRUE(same) << "triangle " << f;
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(mesh.corners[3 * f + k], found[(slot + k) % 3]);
    }
}

// Triangles of a torus of n x n vertices: closed, with every vertex in six triangles.
std::vector<std::uint32_t> torusIndices(std::uint32_t n)
{
    std::vector<std::uint32_t> indices;
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t p = j * n + i, q = j * n + (i + 1) % n, s = (j + 1) % n * n + i,
                                r = (j + 1) % n * n + (i + 1) % n;
            indices.insert(indices.end(), {p, s, r, p, r, q});
        }
    return indices;
}

} // namespace

TEST(Provoking, everyTriangleOwnsItsFirstOrLastVertex)
{
    const auto indices = torusIndices(20);
    for (const auto provoking : {ProvokingVertex::first, ProvokingVertex::last})
        expectSound(provokingMesh(indices, 400, provoking), indices, provoking);
}

TEST(Provoking, aClosedMeshGetsAboutAsManyVerticesAsTriangles)
{
    const std::uint32_t n = 50;
    const auto mesh = provokingMesh(torusIndices(n), n * n, ProvokingVertex::first);
    const std::size_t triangles = 2 * n * n; // twice the number of vertices
    EXPECT_GE(mesh.sources.size(), triangles);
    EXPECT_LE(mesh.sources.size(), triangles + triangles / 100);
}

TEST(Provoking, unsharedVerticesAreNotDuplicated)
{
    std::vector<std::uint32_t> indices(300);
    std::iota(indices.begin(), indices.end(), 0u);
    const auto mesh = provokingMesh(indices, 300, ProvokingVertex::last);
    expectSound(mesh, indices, ProvokingVertex::last);
    EXPECT_EQ(mesh.sources.size(), 300u);
}

TEST(Provoking, equalAndDegenerateTrianglesAreKept)
{
    // Four equal triangles, a needle and a point; vertex 9 is unused.
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 3, 3, 4, 5, 5, 5};
    for (const auto provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
        const auto mesh = provokingMesh(indices, 10, provoking);
        expectSound(mesh, indices, provoking);
        EXPECT_EQ(std::count(mesh.sources.begin(), mesh.sources.end(), 9u), 0);
    }
}

TEST(Provoking, randomSoupsAreSound)
{
    Random random(12);
    for (int round = 0; round < 200; ++round) {
        const std::uint32_t vertices = 1 + below(random, 30);
        std::vector<std::uint32_t> indices(3 * below(random, 60));
        for (std::uint32_t& i : indices)
            i = below(random, vertices);
        const auto provoking = round % 2 ? ProvokingVertex::first : ProvokingVertex::last;
        expectSound(provokingMesh(indices, vertices, provoking), indices, provoking);
    }
}

TEST(Provoking, badIndicesGiveNothing)
{
    EXPECT_TRUE(provokingMesh(std::array{0u, 1u, 3u}, 3, ProvokingVertex::first).indices.empty());
    EXPECT_TRUE(provokingMesh(std::array{0u, 1u}, 3, ProvokingVertex::first).indices.empty());
    EXPECT_TRUE(provokingMesh({}, 0, ProvokingVertex::first).sources.empty());
}

TEST(Provoking, stripsAndFansKeepTheirWinding)
{
    using List = std::vector<std::uint32_t>;
    EXPECT_EQ(trianglesOfStrip(std::array{0u, 1u, 2u, 3u, 4u}), (List{0, 1, 2, 2, 1, 3, 2, 3, 4}));
    EXPECT_EQ(trianglesOfFan(std::array{0u, 1u, 2u, 3u, 4u}), (List{0, 1, 2, 0, 2, 3, 0, 3, 4}));
    // A restart begins with the first winding again; the restart index of one-byte indices is 255.
    EXPECT_EQ(trianglesOfStrip(std::array{0u, 1u, 2u, 255u, 3u, 4u, 5u, 6u}, 255), (List{0, 1, 2, 3, 4, 5, 5, 4, 6}));
    EXPECT_EQ(trianglesOfFan(std::array{0u, 1u, 255u, 255u, 3u, 4u, 5u}, 255), (List{3, 4, 5}));
    // Two strips joined by repeated vertices; the second begins at an odd index, so its winding is reversed.
    EXPECT_EQ(trianglesOfStrip(std::array{0u, 1u, 2u, 2u, 3u, 3u, 4u, 5u}), (List{0, 1, 2, 4, 3, 5}));
    EXPECT_TRUE(trianglesOfStrip({}).empty());
}

} // namespace cotan
