// Rotating a z-up scene to y-up, joining its parts, and limits on the pixels that it covers.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <string>

#include "scene/geometry.hpp"
#include "scene/parts.hpp"

namespace cotan {
namespace {

TEST(SceneUp, rotatesInstancesCamerasAndLightsFromZUpToYUp)
{
    Scene scene;
    scene.instances.push_back({"", 0, glm::mat4(1)});
    scene.cameras.emplace_back();
    scene.cameras[0].up = {0, 0, 1};
    scene.cameras[0].eye = {1, 2, 3};
    scene.lights.emplace_back();
    scene.lights[0].direction = {0, 0, -1};
    scene.reach = {{4, 5, 6}};
    rotateZUpToYUp(scene);
    EXPECT_EQ(glm::vec3(scene.instances[0].toWorld * glm::vec4(1, 2, 3, 1)), glm::vec3(1, 3, -2));
    EXPECT_EQ(scene.cameras[0].up, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.cameras[0].eye, glm::vec3(1, 3, -2));
    EXPECT_EQ(scene.lights[0].direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(scene.reach[0], glm::vec3(4, 6, -5));
}

// Two meshes, of materials 0 and 1, of the same right triangle in the plane z = 0.
Scene triangleScene()
{
    Scene scene;
    scene.materials.resize(2);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.tangents.assign(3, {1, 0, 0, 1});
    mesh.texcoords[0] = {{0, 0}, {1, 0}, {0, 1}};
    mesh.indices = {0, 1, 2};
    scene.meshes = {mesh, mesh};
    scene.meshes[1].material = 1;
    return scene;
}

TEST(SceneParts, ofOneMaterialAreJoinedInWorldSpace)
{
    Scene scene = triangleScene();
    glm::mat4 moved(1), mirrored(1);
    moved[3] = {5, 6, 7, 1};
    mirrored[0] = {-2, 0, 0, 0};
    scene.instances = {{"a", 0, moved}, {"b", 1, glm::mat4(1)}, {"c", 0, mirrored}};
    Scene few = scene;
    joinParts(few, 3); // already within the limit
    EXPECT_EQ(few.instances.size(), 3u);
    joinParts(scene, 2);
    ASSERT_EQ(scene.instances.size(), 2u); // one for each material
    ASSERT_EQ(scene.meshes.size(), 2u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.material, 0);
    EXPECT_EQ(mesh.positions,
              (std::vector<glm::vec3>{{5, 6, 7}, {6, 6, 7}, {5, 7, 7}, {0, 0, 0}, {-2, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 4})); // still counter-clockwise seen from +z
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(6, {0, 0, 1}));
    EXPECT_EQ(mesh.tangents[1], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(mesh.tangents[4], glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(mesh.texcoords[0][4], glm::vec2(1, 0));
    EXPECT_EQ(scene.meshes[1].material, 1);
    EXPECT_EQ(scene.meshes[1].positions.size(), 3u);
}

TEST(SceneParts, identicalOpaquePartsAreDrawnOnce)
{
    Scene scene = triangleScene(); // meshes 0 and 1 differ in their material
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[3].texcoords[0][2].x += 1; // a different appearance at the same position
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[4].tangents[1].w = -1; // also different
    scene.materials[1].alphaMode = AlphaMode::blend;
    glm::mat4 moved(1);
    moved[3] = {5, 6, 7, 1};
    for (const int mesh : {0, 1, 2, 3, 4, 1})
        scene.instances.push_back({"", mesh, glm::mat4(1)});
    scene.instances.push_back({"", 2, moved});
    joinParts(scene, 2);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].triangleCount(), 4u); // 0, 3, 4 and the moved 2
    EXPECT_EQ(scene.meshes[1].triangleCount(), 2u); // a translucent part behind another one stays visible
}

TEST(SceneParts, repeatedTrianglesAreDroppedFromOpaqueMeshes)
{
    Scene scene = triangleScene();
    scene.materials[1].alphaMode = AlphaMode::blend;
    for (Mesh& mesh : scene.meshes)
        mesh.indices = {0, 1, 2, 1, 2, 0, 0, 2, 1, 0, 1, 2}; // the third faces away
    dropRepeated(scene);
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 1}));
    EXPECT_EQ(scene.meshes[1].indices.size(), 12u);
}

// A view of that triangle, which covers half of the image.
View triangleView()
{
    View view;
    view.width = view.height = 100;
    view.camera.orthographic = true;
    view.camera.verticalExtent = 1;
    view.camera.eye = {0.5f, 0.5f, 5};
    view.camera.target = {0.5f, 0.5f, 0};
    return view;
}

TEST(SceneParts, areRefusedForTooMuchCoverageUnlessTheyRepeat)
{
    Scene scene = triangleScene();
    scene.name = "model";
    scene.instances = {{"", 0, glm::mat4(1)}};
    const View view = triangleView();
    EXPECT_NEAR(pixelsCovered(scene, view), 5000, 1e-3); // half of the image
    View wide = view;
    wide.camera.verticalExtent = 2;
    EXPECT_NEAR(pixelsCovered(scene, wide), 1250, 1e-3);
    wide.camera.orthographic = false;
    wide.camera.verticalFieldOfView = 2 * std::atan(0.2f); // two units high at a distance of five
    EXPECT_NEAR(pixelsCovered(scene, wide), 1250, 1e-2);
    for (int i = 0; i < 1000; ++i)
        scene.meshes[0].indices.insert(scene.meshes[0].indices.end(), {0, 1, 2});
    Scene other = scene;
    EXPECT_TRUE(limitCoverage(scene, view));
    EXPECT_EQ(scene.meshes[0].triangleCount(), 1u);
    other.materials[0].alphaMode = AlphaMode::mask;
    const Status refused = limitCoverage(other, view);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "model: its triangles cover the image 501 times, expected at most 64: move the camera away, or remove "
              "some triangles");
}

// A triangle is the same whichever corner comes first. With the opposite winding it is another one, which faces away.
TEST(SceneParts, repeatsIgnoreTheFirstCornerButNotTheWinding)
{
    for (const std::array<glm::vec3, 3>& corners :
         {std::array<glm::vec3, 3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
          {{{2, 1, 3}, {2, 1, -3}, {2, 5, 0}}},      // equal x, two of them with equal y
          {{{-1, 4, 4}, {-1, 4, 4}, {-1, 0, 7}}}}) { // two corners coincide
        Scene scene = triangleScene();
        scene.instances = {{"", 0, glm::mat4(1)}};
        Mesh& mesh = scene.meshes[0];
        mesh.positions.assign(corners.begin(), corners.end());
        mesh.indices = {0, 1, 2, 1, 2, 0, 2, 0, 1, 0, 2, 1};
        dropRepeated(scene);
        std::vector<std::uint32_t> kept = {0, 1, 2};
        if (corners[0] != corners[1]) // a degenerate triangle has no opposite winding
            kept.insert(kept.end(), {0, 2, 1});
        EXPECT_EQ(mesh.indices, kept) << corners[1].z;
    }
}

TEST(SceneParts, backFacesCoverNothing)
{
    Scene scene = triangleScene();
    scene.instances = {{"", 0, glm::mat4(1)}};
    View view = triangleView();
    view.camera.eye.z = -5;
    EXPECT_EQ(pixelsCovered(scene, view), 0);
    scene.instances[0].toWorld[2][2] = -1; // a mirrored triangle faces the other way
    EXPECT_NEAR(pixelsCovered(scene, view), 5000, 1e-3);
    scene.instances[0].toWorld[2][2] = 1;
    scene.materials[0].doubleSided = true;
    EXPECT_NEAR(pixelsCovered(scene, view), 5000, 1e-3);
}

std::string refusalOf(Scene scene, const View& view, std::size_t images = 1)
{
    scene.name = "model";
    const Status settled = limitCoverage(scene, view, images);
    return settled ? "" : settled.error().message;
}

TEST(SceneParts, translucentLayersAndCostlyMaterialsAreRefusedEarlier)
{
    Scene scene = triangleScene();
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.instances.assign(60, {"", 0, glm::mat4(1)}); // covers the image 30 times, each layer counted half
    EXPECT_EQ(refusalOf(scene, triangleView()), "");
    EXPECT_NE(refusalOf(scene, triangleView(), 2).find("its translucent triangles cover the image 30 times,"),
              std::string::npos);
    scene.materials[0].coat.strength = 1;
    EXPECT_NE(refusalOf(scene, triangleView()).find("cover the image 30 times, expected at most 16"),
              std::string::npos);
    scene.instances.resize(16); // 8 times
    EXPECT_EQ(refusalOf(scene, triangleView()), "");
    scene.materials[0].sheen.color = glm::vec3(1);
    EXPECT_EQ(refusalOf(scene, triangleView()), "") << "1.8 times as much each: 14.4";
    scene.materials[0].anisotropy.strength = 1; // 2.6: 20.8
    EXPECT_NE(refusalOf(scene, triangleView()).find("21 times, expected at most 16"), std::string::npos);
}

TEST(SceneParts, longEdgesAreRefusedUnlessTheModelIsLarge)
{
    Scene scene = triangleScene();
    scene.meshes[0].positions = {{0, 0, 0}, {1e-4f, 0, 0}, {0, 1, 0}};
    View view = triangleView();
    scene.instances.assign(600, {"", 0, glm::mat4(1)}); // each fills about 84 pixels over the free 16
    EXPECT_NE(refusalOf(scene, view).find("the long edges of its triangles cover the image 5 times,"),
              std::string::npos);
    scene.instances.resize(250); // 2.1
    EXPECT_NE(refusalOf(scene, view).find("image 2.1 times, expected at most 2:"), std::string::npos);
    scene.instances.resize(235);
    EXPECT_EQ(refusalOf(scene, view), "");
    scene.instances.assign(600, {"", 0, glm::mat4(1)});
    scene.meshes[1].positions.resize(101'000); // all equal: copies of a vertex do not count
    EXPECT_NE(refusalOf(scene, view), "");
    for (std::size_t i = 0; i < scene.meshes[1].positions.size(); ++i)
        scene.meshes[1].positions[i].x = float(i);
    EXPECT_EQ(refusalOf(scene, view), "");
}

TEST(SceneParts, tooManyLightsAreRefused)
{
    Scene scene = triangleScene();
    scene.instances = {{"", 0, glm::mat4(1)}};
    View view = triangleView();
    view.lights.resize(390);
    EXPECT_EQ(refusalOf(scene, view), "");
    view.lights.resize(410); // the triangle covers half of the image
    EXPECT_NE(refusalOf(scene, view).find("its lights illuminate the image 205 times,"), std::string::npos);
    view.output = Output::normal; // normals need no lights
    EXPECT_EQ(refusalOf(scene, view), "");
}

} // namespace
} // namespace cotan
