// Thousands of coincident surfaces: what a bake finds among them, and that it tests only few.
#include <gtest/gtest.h>

#include "bake/low_tree.hpp"
#include "bake_cases.hpp"
#include "cotan/bake.hpp"

namespace cotan {
namespace {

constexpr int kCopies = 5000;

// A square in the plane z = height whose uv cover the map.
Mesh square(float height)
{
    Mesh mesh;
    mesh.positions = {{0, 0, height}, {1, 0, height}, {1, 1, height}, {0, 1, height}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Mesh repeated(Mesh mesh)
{
    const std::vector<std::uint32_t> once = mesh.indices;
    for (int i = 1; i < kCopies; ++i)
        mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
    return mesh;
}

Result<BakedModel> bakeOf(const Mesh& low, const Mesh& high)
{
    BakeModelOptions options;
    options.bake.width = options.bake.height = 64;
    options.bake.kind = BakeKind::height;
    HighModel model;
    model.scenes = {sceneOfMeshes({high})};
    return bakeModel(sceneOfMeshes({low}), std::move(model), options);
}

TEST(BakeCrowded, aPointQueryVisitsFewOfManyEqualTriangles)
{
    const Mesh mesh = repeated(square(0));
    const auto tree = LowTree::make(mesh.positions, mesh.indices, {}, 1);
    ASSERT_TRUE(tree);
    const auto nearest = tree->nearest({0.6f, 0.3f, 0.1f}, 1, [](std::uint32_t) { return true; });
    EXPECT_TRUE(nearest.found);
    EXPECT_EQ(nearest.triangle, 0u);
    EXPECT_NEAR(nearest.distance, 0.1f, 1e-6f);
    EXPECT_LT(nearest.visited, 10u);
}

TEST(BakeCrowded, equalTrianglesAreMergedUnlessKeptByInstance)
{
    const Scene scene = sceneOfMeshes({repeated(square(0))});
    const auto surface = HighSurface::make({scene}, 1), byInstance = HighSurface::make({scene}, 1, /*byInstance*/ true);
    ASSERT_TRUE(surface && byInstance);
    const Ray ray{{0.6f, 0.3f, 1}, {0, 0, -1}, 0, 2};
    EXPECT_EQ(surface->countHits(ray), 1u);
    EXPECT_EQ(byInstance->countHits(ray), std::size_t(kCopies));
    EXPECT_EQ(surface->trace(ray).triangle, 0u);
}

TEST(BakeCrowded, equalTrianglesBakeLikeOne)
{
    const auto one = bakeOf(square(0), square(0.05f)), many = bakeOf(repeated(square(0)), repeated(square(0.05f)));
    ASSERT_TRUE(one && many);
    EXPECT_EQ(one->maps[0].image.data, many->maps[0].image.data);
    EXPECT_EQ(one->maps[0].statistics.twice, 0u);
    EXPECT_EQ(many->maps[0].statistics.twice, many->maps[0].statistics.covered);
}

TEST(BakeCrowded, thousandsOfDifferentTrianglesOnARayAreRefused)
{
    const Mesh mesh = crowd(kCopies);
    const auto high = bakeOf(square(0), mesh);
    ASSERT_FALSE(high);
    EXPECT_NE(high.error().message.find("high: a ray crosses about"), std::string::npos) << high.error().message;
    const auto low = bakeOf(mesh, square(0));
    ASSERT_FALSE(low);
    EXPECT_NE(low.error().message.find("low: "), std::string::npos) << low.error().message;
}

} // namespace
} // namespace cotan
