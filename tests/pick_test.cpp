// The surface under a pixel.
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "camera.hpp"
#include "cotan/inspect.hpp"
#include "cotan/scene.hpp"
#include "scene/geometry.hpp"

namespace cotan {
namespace {

Scene sphere()
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(makeSphere(1, 64));
    scene.instances.push_back({"sphere", 0, glm::mat4(1)});
    return scene;
}

constexpr glm::ivec2 kSize{200, 100};

TEST(Pick, hitProjectsToThePixel)
{
    const Scene scene = builtinScene();
    const Camera camera = scene.cameras[0];
    int found = 0;
    for (int y = 5; y < kSize.y; y += 10)
        for (int x = 5; x < kSize.x; x += 10) {
            const glm::vec2 centre{float(x) + 0.5f, float(y) + 0.5f};
            const auto hit = pick(scene, camera, kSize, centre);
            if (!hit)
                continue;
            ++found;
            const glm::vec3 seen = viewer::projectToImage(camera, hit->position, kSize);
            EXPECT_NEAR(seen.x, centre.x, 1e-3f);
            EXPECT_NEAR(seen.y, centre.y, 1e-3f);
            EXPECT_NEAR(seen.z, hit->depth, 1e-4f * hit->depth);
            glm::dvec3 point{0}; // the same point, from the triangle
            const Mesh& mesh = scene.meshes[std::size_t(hit->mesh)];
            for (std::size_t k = 0; k < 3; ++k)
                point += hit->barycentric[int(k)] * glm::dvec3(mesh.positions[mesh.indices[3 * hit->triangle + k]]);
            const glm::mat4& toWorld = scene.instances[std::size_t(hit->instance)].toWorld;
            EXPECT_LT(glm::length(glm::vec3(toWorld * glm::vec4(point, 1)) - hit->position), 1e-3f);
        }
    EXPECT_GT(found, 60);
}

TEST(Pick, nearestVisibleSurfaceIsPicked)
{
    Scene scene = sphere();
    Camera camera;
    camera.eye = {0, 0.01f, 5};
    const auto front = pick(scene, camera, kSize, {100, 50});
    ASSERT_TRUE(front);
    EXPECT_NEAR(front->depth, 4, 0.01f);
    camera.eye = {0, 0.01f, 0.1f}; // inside
    EXPECT_FALSE(pick(scene, camera, kSize, {100, 50}));
    scene.materials[0].doubleSided = true;
    EXPECT_TRUE(pick(scene, camera, kSize, {100, 50}));
}

TEST(Pick, aMirroredInstanceIsSeenFromOutside)
{
    Scene scene = sphere();
    scene.instances[0].toWorld = glm::scale(glm::mat4(1), glm::vec3(-2, 2, 2));
    Camera camera;
    camera.eye = {0, 0.01f, 5};
    const auto hit = pick(scene, camera, kSize, {100, 50});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->depth, 3, 0.01f);
}

TEST(Pick, orthographicRaysAreParallel)
{
    const Scene scene = sphere();
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.orthographic = true;
    camera.verticalExtent = 2.5f;
    EXPECT_TRUE(pick(scene, camera, kSize, {100, 89.0f}));  // 39 of 50 pixels: 0.975 units from the centre
    EXPECT_FALSE(pick(scene, camera, kSize, {100, 91.0f})); // 1.025
}

TEST(Pick, emptySpaceAndEmptyImagesHaveNoHit)
{
    EXPECT_FALSE(pick({}, {}, kSize, {1, 1}));
    EXPECT_FALSE(pick(sphere(), {}, {0, 0}, {0, 0}));
    EXPECT_FALSE(pick(sphere(), {}, kSize, {0.5f, 0.5f}));
}

} // namespace
} // namespace cotan
