// Compares the built-in shapes with geometry.
#include "cotan/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <tuple>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace {

using cotan::Mesh;

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = 180 / kPi;

struct Named {
    const char* name;
    Mesh mesh;
};

std::vector<Named> allShapes()
{
    return {
        {"plane", cotan::makePlane(2, 3, 2)}, {"cube", cotan::makeCube(2, 1)},
        {"sphere", cotan::makeSphere(2, 16)}, {"torus", cotan::makeTorus(2, 0.5f, 16, 3, 1)},
        {"teapot", cotan::makeTeapot(5)},     {"patch", cotan::makePatch(2, 0.5f, false, 2)},
    };
}

using Corners = std::array<std::uint32_t, 3>;

void eachTriangle(const Mesh& mesh, const std::function<void(const Corners&)>& f)
{
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        f({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
}

glm::dvec3 faceVector(const Mesh& mesh, const Corners& c)
{
    const glm::dvec3 p(mesh.positions[c[0]]);
    return glm::cross(glm::dvec3(mesh.positions[c[1]]) - p, glm::dvec3(mesh.positions[c[2]]) - p);
}

double signedUvArea(const Mesh& mesh, const Corners& c)
{
    const glm::dvec2 t(mesh.texcoords[0][c[0]]);
    const glm::dvec2 a = glm::dvec2(mesh.texcoords[0][c[1]]) - t;
    const glm::dvec2 b = glm::dvec2(mesh.texcoords[0][c[2]]) - t;
    return a.x * b.y - a.y * b.x;
}

double angleBetween(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegrees;
}

double volume(const Mesh& mesh)
{
    double sum = 0;
    eachTriangle(mesh,
                 [&](const Corners& c) { sum += glm::dot(glm::dvec3(mesh.positions[c[0]]), faceVector(mesh, c)) / 6; });
    return sum;
}

// Counts of a mesh whose vertices are merged by position. Edges are undirected.
struct Topology {
    long vertices, edges, faces;
    bool closed; // every edge is used once in each direction

    long eulerCharacteristic() const { return vertices - edges + faces; }
};

Topology topology(const Mesh& mesh)
{
    std::map<std::tuple<float, float, float>, int> ids;
    const auto id = [&](std::uint32_t i) {
        const glm::vec3 p = mesh.positions[i];
        return ids.emplace(std::make_tuple(p.x, p.y, p.z), int(ids.size())).first->second;
    };
    std::map<std::pair<int, int>, int> directed;
    eachTriangle(mesh, [&](const Corners& c) {
        for (std::size_t k = 0; k < 3; ++k)
            ++directed[{id(c[k]), id(c[(k + 1) % 3])}];
    });
    Topology t{long(ids.size()), 0, long(mesh.triangleCount()), true};
    for (const auto& [edge, count] : directed) {
        const bool paired = directed.count({edge.second, edge.first}) == 1;
        t.closed = t.closed && count == 1 && paired;
        t.edges += !paired || edge.first < edge.second;
    }
    return t;
}

TEST(Shapes, attributesAreCompleteAndIndicesInRange)
{
    for (const auto& [name, mesh] : allShapes()) {
        EXPECT_EQ(mesh.normals.size(), mesh.vertexCount()) << name;
        EXPECT_EQ(mesh.texcoords[0].size(), mesh.vertexCount()) << name;
        EXPECT_EQ(mesh.indices.size() % 3, 0u) << name;
        EXPECT_LT(*std::max_element(mesh.indices.begin(), mesh.indices.end()), mesh.vertexCount());
        EXPECT_TRUE(mesh.tangents.empty()) << name;
    }
}

TEST(Shapes, normalsAreUnit)
{
    for (const auto& [name, mesh] : allShapes())
        for (const glm::vec3& n : mesh.normals)
            ASSERT_NEAR(glm::length(n), 1, 1e-6) << name; // three floats rounded to 6e-8
}

TEST(Shapes, trianglesFaceTheWayTheirNormalsDo)
{
    for (const auto& [name, mesh] : allShapes())
        eachTriangle(mesh, [&, &name = name, &mesh = mesh](const Corners& c) {
            const glm::dvec3 face = faceVector(mesh, c);
            ASSERT_GT(glm::length(face), 0) << name;
            const glm::vec3 sum = mesh.normals[c[0]] + mesh.normals[c[1]] + mesh.normals[c[2]];
            ASSERT_GT(glm::dot(face, glm::dvec3(sum)), 0) << name;
        });
}

TEST(Shapes, imagesAreNotMirroredSeenFromOutside)
{
    // Counter-clockwise from outside and v downwards: the signed uv area is negative.
    for (const auto& [name, mesh] : allShapes())
        eachTriangle(
            mesh, [&, &name = name, &mesh = mesh](const Corners& c) { ASSERT_LT(signedUvArea(mesh, c), 0) << name; });
    const Mesh mirrored = cotan::makePatch(2, 0.5f, true, 2);
    eachTriangle(mirrored, [&](const Corners& c) { ASSERT_GT(signedUvArea(mirrored, c), 0); });
}

TEST(Shapes, sphereIsClosedWithoutHandles)
{
    const Topology t = topology(cotan::makeSphere(1, 24));
    EXPECT_TRUE(t.closed);
    EXPECT_EQ(t.eulerCharacteristic(), 2);
}

// Each triangle at a pole has its own vertex there, with u in the centre of its column.
TEST(Shapes, polesHaveAVertexInTheMiddleOfEveryColumn)
{
    constexpr std::size_t kColumns = 8;
    const Mesh mesh = cotan::makeSphere(1, kColumns);
    std::vector<float> top, bottom;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i)
        if (std::abs(mesh.positions[i].y) == 1)
            (mesh.positions[i].y > 0 ? top : bottom).push_back(mesh.texcoords[0][i].x);
    ASSERT_EQ(top.size(), kColumns);
    EXPECT_EQ(top, bottom);
    for (std::size_t i = 0; i < kColumns; ++i)
        EXPECT_FLOAT_EQ(top[i], (float(i) + 0.5f) / kColumns);
}

TEST(Shapes, torusIsClosedWithOneHandle)
{
    const Topology t = topology(cotan::makeTorus(1, 0.25f, 24, 1, 1));
    EXPECT_TRUE(t.closed);
    EXPECT_EQ(t.eulerCharacteristic(), 0);
}

TEST(Shapes, cubeIsClosedWithoutHandles)
{
    const Topology t = topology(cotan::makeCube(1, 1));
    EXPECT_TRUE(t.closed);
    EXPECT_EQ(t.vertices, 8);
    EXPECT_EQ(t.eulerCharacteristic(), 2);
}

TEST(Shapes, volumesApproachTheExactOnes)
{
    // A polyhedron inscribed with n cells around a circle has a volume too small by O(1/n^2): 2 pi^2/(3 n^2) = 1e-4 for
    // the great circle at n = 256, and four times that for the coarser section.
    EXPECT_NEAR(volume(cotan::makeCube(3, 1)), 27, 1e-5);
    EXPECT_NEAR(volume(cotan::makeSphere(2, 256)) / (4 * kPi / 3 * 8), 1, 1e-3);
    EXPECT_NEAR(volume(cotan::makeTorus(2, 0.5f, 256, 1, 1)) / (2 * kPi * kPi * 2 * 0.25), 1, 1e-3);
}

TEST(Shapes, sphereNormalsPointFromTheCentre)
{
    const Mesh mesh = cotan::makeSphere(3, 20);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i)
        // 1e-6: rounding of numbers up to 3
        ASSERT_LT(glm::length(mesh.positions[i] - mesh.normals[i] * 3.0f), 1e-6f);
}

TEST(Shapes, torusNormalsPointFromTheRing)
{
    const Mesh mesh = cotan::makeTorus(2, 0.5f, 20, 1, 1);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::vec3 p = mesh.positions[i];
        const glm::vec3 ring = glm::normalize(glm::vec3(p.x, 0, p.z)) * 2.0f;
        ASSERT_LT(glm::length(p - ring - mesh.normals[i] * 0.5f), 1e-6f); // rounding of 2.5f
    }
}

TEST(Shapes, planeRepeatsItsTexture)
{
    const Mesh mesh = cotan::makePlane(4, 2, 8);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        EXPECT_EQ(mesh.positions[i].y, 0);
        EXPECT_EQ(mesh.normals[i], glm::vec3(0, 1, 0));
        EXPECT_EQ(mesh.texcoords[0][i], glm::vec2(mesh.positions[i].x + 2, mesh.positions[i].z + 2) * 2.0f);
    }
}

TEST(Shapes, patchTexcoordsAreTheInverseLayout)
{
    const float stretch = 4, shear = 0.5f;
    const Mesh mesh = cotan::makePatch(stretch, shear, false, 3);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::vec2 uv = mesh.texcoords[0][i];
        // L uv = p, with p from the top left corner, to the right and down.
        const glm::vec2 p{stretch * uv.x + shear * uv.y, uv.y};
        EXPECT_NEAR(p.x, mesh.positions[i].x + 0.5f, 1e-6f);
        EXPECT_NEAR(p.y, 0.5f - mesh.positions[i].y, 1e-6f);
        EXPECT_EQ(mesh.normals[i], glm::vec3(0, 0, 1));
    }
}

// Maximum angle in degrees between the stored normals and those of central differences, on a grid of n x n cells whose
// vertices start at `first`.
double normalError(const Mesh& mesh, std::size_t first, std::size_t n)
{
    double worst = 0;
    const auto at = [&](std::size_t i, std::size_t j) { return first + j * (n + 1) + i; };
    for (std::size_t j = 1; j < n; ++j)
        for (std::size_t i = 1; i < n; ++i) {
            const glm::dvec3 du = glm::dvec3(mesh.positions[at(i + 1, j)] - mesh.positions[at(i - 1, j)]);
            const glm::dvec3 dv = glm::dvec3(mesh.positions[at(i, j + 1)] - mesh.positions[at(i, j - 1)]);
            worst = std::max(worst, angleBetween(glm::cross(dv, du), glm::dvec3(mesh.normals[at(i, j)])));
        }
    return worst;
}

// Whether a patch of the teapot contains a pole.
bool patchHasPole(std::size_t patch) { return (patch >= 20 && patch < 24) || patch >= 28; }

TEST(Teapot, standsOnTheGroundAndIsOneHigh)
{
    const Mesh mesh = cotan::makeTeapot(8);
    float low = 1, high = 0;
    for (const glm::vec3& p : mesh.positions) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    EXPECT_EQ(low, 0);
    EXPECT_EQ(high, 1);
}

TEST(Teapot, verticesAreSharedInsideAPatch)
{
    // 24 patches have (n+1)^2 vertices; 8 have a pole, with n vertices instead of n+1.
    const int n = 6;
    const Mesh mesh = cotan::makeTeapot(n);
    EXPECT_EQ(mesh.vertexCount(), std::size_t(24 * (n + 1) * (n + 1) + 8 * ((n + 1) * n + n)));
    EXPECT_EQ(mesh.triangleCount(), std::size_t(24 * 2 * n * n + 8 * (2 * n * n - n)));
}

TEST(Teapot, normalsEqualDifferences)
{
    // Central differences are of second order: half the step reduces the error about fourfold. Poles are tested below.
    const auto worst = [](std::size_t n) {
        const Mesh mesh = cotan::makeTeapot(int(n));
        double error = 0;
        std::size_t first = 0;
        for (std::size_t patch = 0; patch < 32; ++patch) {
            if (!patchHasPole(patch))
                error = std::max(error, normalError(mesh, first, n));
            first += patchHasPole(patch) ? (n + 1) * n + n : (n + 1) * (n + 1);
        }
        return error;
    };
    const double coarse = worst(32), fine = worst(64);
    EXPECT_LT(fine, 1);
    EXPECT_LT(fine, coarse / 3);
}

TEST(Teapot, polesHaveTheLimitNormal)
{
    const Mesh mesh = cotan::makeTeapot(7);
    int top = 0, bottom = 0;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::vec3 p = mesh.positions[i];
        if (p.x != 0 || p.z != 0)
            continue;
        const glm::vec3 expected(0, p.y > 0.5f ? 1 : -1, 0);
        EXPECT_LT(glm::length(mesh.normals[i] - expected), 1e-6f);
        ++(p.y > 0.5f ? top : bottom);
    }
    EXPECT_EQ(top, 4 * 7); // four patches meet, each with one vertex per column
    EXPECT_EQ(bottom, 4 * 7);
}

TEST(Teapot, normalsAgreeBetweenPatchesOfTheBody)
{
    // Patches 1-12 (here 0-11) are the body, four around, and join smoothly. Shared vertices are equal to the bit.
    // Control points have three digits, which bends the joint by up to 0.1 degrees.
    const std::size_t n = 8, perPatch = (n + 1) * (n + 1);
    const Mesh mesh = cotan::makeTeapot(int(n));
    for (std::size_t patch = 0; patch < 12; ++patch) {
        const std::size_t next = patch / 4 * 4 + (patch + 1) % 4;
        for (std::size_t row = 0; row <= n; ++row) {
            const std::size_t a = patch * perPatch + row * (n + 1);    // u = 0: last column
            const std::size_t b = next * perPatch + row * (n + 1) + n; // u = 1: first column
            ASSERT_EQ(mesh.positions[a], mesh.positions[b]) << patch;
            ASSERT_LT(angleBetween(glm::dvec3(mesh.normals[a]), glm::dvec3(mesh.normals[b])), 0.1);
        }
    }
}

TEST(Teapot, textureRunsDownTheBodyAndAroundIt)
{
    const std::size_t n = 8, perPatch = (n + 1) * (n + 1);
    const Mesh mesh = cotan::makeTeapot(int(n));
    for (std::size_t i = 4 * perPatch; i < 12 * perPatch; ++i) {
        const glm::vec2 uv = mesh.texcoords[0][i];
        if (uv.y < 1) { // the vertex below, in the same column
            EXPECT_LT(mesh.positions[i + n + 1].y, mesh.positions[i].y);
        }
        if (uv.x < 1) { // the next vertex of the row: counter-clockwise seen from above
            const glm::vec3 p = mesh.positions[i], q = mesh.positions[i + 1];
            EXPECT_GT(p.z * q.x - p.x * q.z, 0);
        }
    }
}

TEST(Teapot, pointsItsSpoutAlongPlusX)
{
    float right = 0, left = 0;
    for (const glm::vec3& p : cotan::makeTeapot(8).positions) {
        right = std::max(right, p.x);
        left = std::min(left, p.x);
    }
    EXPECT_GT(right, -left); // the spout reaches farther than the handle
    EXPECT_GT(right, 1);
}

} // namespace
