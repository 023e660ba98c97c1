// Rays that should hit are never lost, whatever their directions and their neighbours in a packet.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "bake_scene.hpp"
#include "truth/random.hpp"

namespace cotan {
namespace {

// A closed surface around the origin: rings from pole to pole, computed in double as modellers do, so that components
// that should be zero are 6e-17. `radius` returns the distance of a vertex.
template<class Radius> Mesh around(int columns, int rows, const Radius& radius)
{
    Mesh mesh;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const double a = 2 * std::numbers::pi * (i % columns) / columns, b = std::numbers::pi * j / rows;
            const glm::dvec3 d(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
            const bool pole = j == 0 || j == rows;
            mesh.positions.push_back(glm::vec3((pole ? glm::dvec3(0, 0, d.z) : d) * radius(pole ? 0 : i % columns, j)));
            mesh.normals.push_back(glm::vec3(d));
            mesh.texcoords[0].emplace_back(double(i) / columns, double(j) / rows);
        }
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto a = std::uint32_t(j * (columns + 1) + i), b = a + 1, c = a + std::uint32_t(columns) + 1,
                       d = c + 1;
            if (j > 0)
                mesh.indices.insert(mesh.indices.end(), {a, c, b});
            if (j < rows - 1)
                mesh.indices.insert(mesh.indices.end(), {b, c, d});
        }
    return mesh;
}

Baked bakeOnto(const Mesh& low, const Mesh& high, BakeSearch search)
{
    BakeOptions options;
    options.width = options.height = 64;
    options.search = search;
    const Scene lowScene = sceneOfMeshes({low}), highScene = sceneOfMeshes({high});
    const auto surface = makeLowSurface(lowScene, -1, options.frame, TangentOrigin::generated);
    const auto detailed = HighSurface::make({highScene}, 0);
    EXPECT_TRUE(surface && detailed);
    const auto baked = bake(*surface, *detailed, options);
    EXPECT_TRUE(baked);
    return *baked;
}

TEST(BakeRays, tinyNormalComponentsOfEitherSignLoseNoTexel)
{
    // One triangle under a grid; two of its normals are tilted by `lean`. -1e-18 lost texels; 0 and -1e-16 never did.
    for (const float lean : {-1e-18f, 1e-18f, -1e-19f, -1e-30f, -1e-42f, -0.0f, -1e-16f}) {
        Mesh low, high;
        low.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        low.normals = {{lean, 0, 1}, {lean, 0, 1}, glm::normalize(glm::vec3(-0.2f, 0, 1))};
        low.texcoords[0] = {{0, 1}, {1, 1}, {0, 0}};
        low.indices = {0, 1, 2};
        constexpr int kCells = 20;
        for (int j = 0; j <= kCells; ++j)
            for (int i = 0; i <= kCells; ++i) {
                high.positions.emplace_back(float(i) / 10 - 0.5f, float(j) / 10 - 0.5f, 0.02f);
                high.normals.emplace_back(0, 0, 1);
            }
        for (int j = 0; j < kCells; ++j)
            for (int i = 0; i < kCells; ++i) {
                const auto a = std::uint32_t(j * (kCells + 1) + i), b = a + 1, d = a + kCells + 1, c = d + 1;
                high.indices.insert(high.indices.end(), {a, b, c, a, c, d});
            }
        for (const BakeSearch search : {BakeSearch::first, BakeSearch::nearest}) {
            const BakeStatistics s = bakeOnto(low, high, search).statistics;
            EXPECT_EQ(s.missed, 0u) << lean;
            EXPECT_GE(s.covered, 64u * 64u / 2 - 64u) << lean;
        }
    }
}

TEST(BakeRays, aSphereUnderOneTwoPercentLargerHasNoHoles)
{
    const Mesh low = around(32, 16, [](int, int) { return 1.0; }), high = around(32, 16, [](int, int) { return 1.02; });
    for (const BakeSearch search : {BakeSearch::first, BakeSearch::nearest})
        EXPECT_EQ(bakeOnto(low, high, search).statistics.missed, 0u);
}

Scene placed(const Mesh& mesh, const glm::mat4& toWorld)
{
    Scene scene = sceneOfMeshes({mesh});
    scene.instances[0].toWorld = toWorld;
    return scene;
}

// Moves the vertices instead of the instance: normals take the inverse transpose, and mirroring reverses the winding.
Scene moved(Mesh mesh, const glm::mat4& toWorld)
{
    const glm::mat3 linear(toWorld);
    for (glm::vec3& p : mesh.positions)
        p = glm::vec3(toWorld * glm::vec4(p, 1));
    for (glm::vec3& n : mesh.normals)
        n = glm::normalize(glm::inverse(glm::transpose(linear)) * n);
    if (glm::determinant(linear) < 0)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return sceneOfMeshes({mesh});
}

TEST(BakeRays, aTransformedInstanceBakesLikeTransformedVertices)
{
    const Mesh low = around(12, 8, [](int, int) { return 1.0; }),
               high = around(40, 24, [](int i, int j) { return 1.02 + 0.01 * std::sin(i * 0.9) * std::sin(j * 1.3); });
    glm::mat4 stretched(1), mirrored(1), sheared(1), far(1);
    stretched[0][0] = 3, stretched[1][1] = 0.5f;
    mirrored[0][0] = -1.5f, mirrored[2][2] = 0.7f;
    sheared[1][0] = 0.4f, sheared[2][1] = -0.3f;
    far[3] = {50, -20, 30, 1};
    const auto bakeBoth = [](const Scene& lowScene, const Scene& highScene) {
        BakeOptions options;
        options.width = options.height = 48;
        options.kind = BakeKind::objectNormal;
        const auto surface = makeLowSurface(lowScene, -1, options.frame, TangentOrigin::generated);
        const auto detailed = HighSurface::make({highScene}, 0);
        EXPECT_TRUE(surface && detailed);
        return *bake(*surface, *detailed, options);
    };
    for (const glm::mat4& m : {stretched, mirrored, sheared, far}) {
        const Baked a = bakeBoth(placed(low, m), placed(high, m)), b = bakeBoth(moved(low, m), moved(high, m));
        ASSERT_EQ(a.values.size(), b.values.size());
        EXPECT_GT(a.statistics.covered, 1000u);
        EXPECT_EQ(a.statistics.missed, b.statistics.missed);
        std::size_t apart = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i)
            apart += glm::length(a.values[i] - b.values[i]) > 1e-3f; // floats at 60 from the origin: 4e-6 of a texel
        EXPECT_LE(apart, a.values.size() / 500);                     // rays that graze an edge may meet either side
    }
}

// A component of a kind found in files and in sums of rounded numbers.
float oddComponent(Random& random)
{
    const float sign = random.unit() < 0.5 ? -1.0f : 1.0f;
    switch (int(random.unit() * 6)) {
    case 0: return sign * 0.0f;
    case 1: return sign * std::numeric_limits<float>::denorm_min() * float(1 + int(random.unit() * 1000));
    case 2: return sign * std::numeric_limits<float>::min();
    case 3: return sign * float(std::pow(10.0, -10 - 20 * random.unit()));
    default: return sign * float(random.unit());
    }
}

TEST(BakeRays, everyRayThroughTheMiddleOfARandomClosedSurfaceHitsIt)
{
    Random random(71);
    std::size_t missed = 0, probed = 0;
    for (int surface = 0; surface < 24; ++surface) {
        const int columns = 3 + int(random.unit() * 40), rows = 3 + int(random.unit() * 30);
        std::vector<double> radii(std::size_t((columns + 1) * (rows + 1)));
        for (double& r : radii)
            r = surface % 3 == 0 ? 1 : 0.7 + 0.6 * random.unit();
        const auto high = HighSurface::make(
            {sceneOfMeshes(
                {around(columns, rows, [&](int i, int j) { return radii[std::size_t(j * (columns + 1) + i)]; })})},
            1);
        ASSERT_TRUE(high);
        for (int packet = 0; packet < 400; ++packet) {
            Probes probes;
            probes.count = 1 + std::size_t(random.unit() * 15.999);
            probes.only.fill(Probes::kAny);
            const bool alike = packet % 2 == 0; // equal directions, except for tiny components
            const glm::vec3 common(oddComponent(random), oddComponent(random), 1);
            for (std::size_t i = 0; i < probes.count; ++i) {
                glm::vec3 d =
                    alike ? common : glm::vec3(oddComponent(random), oddComponent(random), oddComponent(random));
                if (alike && random.unit() < 0.5)
                    d.x = oddComponent(random) * 1e-18f;
                if (!(glm::dot(d, d) > 1e-6f))
                    d.z = packet % 3 == 0 ? -1.0f : 1.0f;
                // Any three points of a surface of three columns and rows are at least 0.17 from the origin.
                probes.direction.set(i, d / std::sqrt(glm::dot(d, d)));
                probes.point.set(i, glm::vec3(random.direction() * (0.05 * random.unit())));
                if (packet % 5 == 0)
                    probes.point.set(i, glm::vec3(0));
                probes.before[i] = probes.reach[i] = 3;
            }
            Hits outermost, nearest;
            Lanes<int> any{};
            high->outermost(probes, HighNormals::smooth, outermost);
            high->nearest(probes, 1e-5f, HighNormals::smooth, nearest);
            high->anyBetween(probes, any);
            for (std::size_t i = 0; i < probes.count; ++i) {
                missed += !outermost.found(i) + !nearest.found(i) + !any[i];
                missed += !high->trace({probes.point.at(i), probes.direction.at(i), 0, 3}).found;
                probed += 4;
            }
        }
    }
    EXPECT_EQ(missed, 0u) << "of " << probed;
}

} // namespace
} // namespace cotan
