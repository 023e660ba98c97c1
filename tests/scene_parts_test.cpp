// Scenes turned and taken apart.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <string>

#include "scene/geometry.hpp"
#include "scene/parts.hpp"

namespace cotan {
namespace {

TEST(SceneUp, whatWasAlongZIsAlongYInAllThatAScenePlaces)
{
    Scene scene;
    scene.instances.push_back({"", 0, glm::mat4(1)});
    scene.cameras.emplace_back();
    scene.cameras[0].up = {0, 0, 1};
    scene.cameras[0].eye = {1, 2, 3};
    scene.lights.emplace_back();
    scene.lights[0].direction = {0, 0, -1};
    scene.reach = {{4, 5, 6}};
    turnZUp(scene);
    EXPECT_EQ(glm::vec3(scene.instances[0].toWorld * glm::vec4(1, 2, 3, 1)), glm::vec3(1, 3, -2));
    EXPECT_EQ(scene.cameras[0].up, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.cameras[0].eye, glm::vec3(1, 3, -2));
    EXPECT_EQ(scene.lights[0].direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(scene.reach[0], glm::vec3(4, 6, -5));
}

// A scene of one right triangle in the plane z = 0, of opaque material 0 and 1.
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

TEST(SceneParts, ofOneMaterialAreJoinedWhereInstancesPlaceThem)
{
    Scene scene = triangleScene();
    glm::mat4 moved(1), mirrored(1);
    moved[3] = {5, 6, 7, 1};
    mirrored[0] = {-2, 0, 0, 0};
    scene.instances = {{"a", 0, moved}, {"b", 1, glm::mat4(1)}, {"c", 0, mirrored}};
    Scene few = scene;
    joinParts(few, 3); // not more than that
    EXPECT_EQ(few.instances.size(), 3u);
    joinParts(scene, 2);
    ASSERT_EQ(scene.instances.size(), 2u); // one of each material
    ASSERT_EQ(scene.meshes.size(), 2u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.material, 0);
    EXPECT_EQ(mesh.positions,
              (std::vector<glm::vec3>{{5, 6, 7}, {6, 6, 7}, {5, 7, 7}, {0, 0, 0}, {-2, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 5, 4})); // still counter-clockwise from +z
    EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(6, {0, 0, 1}));
    EXPECT_EQ(mesh.tangents[1], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(mesh.tangents[4], glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(mesh.texcoords[0][4], glm::vec2(1, 0));
    EXPECT_EQ(scene.meshes[1].material, 1);
    EXPECT_EQ(scene.meshes[1].positions.size(), 3u);
}

TEST(SceneParts, anOpaquePartInThePlaceOfTheSamePartIsDrawnOnce)
{
    Scene scene = triangleScene(); // meshes 0 and 1 differ in their material
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[3].texcoords[0][2].x += 1; // another look in the same place
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes[4].tangents[1].w = -1; // and another
    scene.materials[1].alphaMode = AlphaMode::blend;
    glm::mat4 moved(1);
    moved[3] = {5, 6, 7, 1};
    for (const int mesh : {0, 1, 2, 3, 4, 1})
        scene.instances.push_back({"", mesh, glm::mat4(1)});
    scene.instances.push_back({"", 2, moved});
    joinParts(scene, 2);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].triangleCount(), 4u); // 0, 3, 4, and 2 that was moved
    EXPECT_EQ(scene.meshes[1].triangleCount(), 2u); // what lies behind the other shines through
}

TEST(SceneParts, trianglesThatLieOnAnEarlierOneOfTheirMeshGoFromOpaqueOnes)
{
    Scene scene = triangleScene();
    scene.materials[1].alphaMode = AlphaMode::blend;
    for (Mesh& mesh : scene.meshes)
        mesh.indices = {0, 1, 2, 1, 2, 0, 0, 2, 1, 0, 1, 2}; // the third is seen from the other side
    dropRepeated(scene);
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 1}));
    EXPECT_EQ(scene.meshes[1].indices.size(), 12u);
}

// Looks at that triangle, which covers half of it.
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

TEST(SceneParts, thatCoverThePictureTooOftenAreRefusedUnlessTheyAreTheSame)
{
    Scene scene = triangleScene();
    scene.name = "model";
    scene.instances = {{"", 0, glm::mat4(1)}};
    const View view = triangleView();
    EXPECT_NEAR(pixelsCovered(scene, view), 5000, 1e-3); // half of it
    View wide = view;
    wide.camera.verticalExtent = 2;
    EXPECT_NEAR(pixelsCovered(scene, wide), 1250, 1e-3);
    wide.camera.orthographic = false;
    wide.camera.verticalFieldOfView = 2 * std::atan(0.2f); // two units at a distance of five
    EXPECT_NEAR(pixelsCovered(scene, wide), 1250, 1e-2);
    for (int i = 0; i < 1000; ++i)
        scene.meshes[0].indices.insert(scene.meshes[0].indices.end(), {0, 1, 2});
    Scene other = scene;
    EXPECT_TRUE(settleCovered(scene, view));
    EXPECT_EQ(scene.meshes[0].triangleCount(), 1u);
    other.materials[0].alphaMode = AlphaMode::mask;
    const Status refused = settleCovered(other, view);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "model: its triangles cover the picture 501 times over, expected at most 64: look from further away, or "
              "leave some out");
}

// The same whichever corner it begins with; the other way round it is another, which faces away.
TEST(SceneParts, aTriangleRepeatsFromAnyCornerButNotTurnedRound)
{
    for (const std::array<glm::vec3, 3>& corners :
         {std::array<glm::vec3, 3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
          {{{2, 1, 3}, {2, 1, -3}, {2, 5, 0}}},      // alike in x, two of them in y
          {{{-1, 4, 4}, {-1, 4, 4}, {-1, 0, 7}}}}) { // two corners in one place
        Scene scene = triangleScene();
        scene.instances = {{"", 0, glm::mat4(1)}};
        Mesh& mesh = scene.meshes[0];
        mesh.positions.assign(corners.begin(), corners.end());
        mesh.indices = {0, 1, 2, 1, 2, 0, 2, 0, 1, 0, 2, 1};
        dropRepeated(scene);
        std::vector<std::uint32_t> kept = {0, 1, 2};
        if (corners[0] != corners[1]) // else it has no other way round
            kept.insert(kept.end(), {0, 2, 1});
        EXPECT_EQ(mesh.indices, kept) << corners[1].z;
    }
}

TEST(SceneParts, ofWhichNothingIsDrawnFromBehindCoverNothingThere)
{
    Scene scene = triangleScene();
    scene.instances = {{"", 0, glm::mat4(1)}};
    View view = triangleView();
    view.camera.eye.z = -5;
    EXPECT_EQ(pixelsCovered(scene, view), 0);
    scene.instances[0].toWorld[2][2] = -1; // mirrored: its front is on the other side
    EXPECT_NEAR(pixelsCovered(scene, view), 5000, 1e-3);
    scene.instances[0].toWorld[2][2] = 1;
    scene.materials[0].doubleSided = true;
    EXPECT_NEAR(pixelsCovered(scene, view), 5000, 1e-3);
}

std::string refusalOf(Scene scene, const View& view, std::size_t pictures = 1)
{
    scene.name = "model";
    const Status settled = settleCovered(scene, view, pictures);
    return settled ? "" : settled.error().message;
}

TEST(SceneParts, inTranslucentLayersAreRefusedEarlierAndOfRichMaterialsEarlierStill)
{
    Scene scene = triangleScene();
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.instances.assign(60, {"", 0, glm::mat4(1)}); // 30 times, each counted half
    EXPECT_EQ(refusalOf(scene, triangleView()), "");
    EXPECT_NE(refusalOf(scene, triangleView(), 2).find("its translucent triangles cover the picture 30 times over"),
              std::string::npos);
    scene.materials[0].coat.strength = 1;
    EXPECT_NE(refusalOf(scene, triangleView()).find("cover the picture 30 times over, expected at most 16"),
              std::string::npos);
    scene.instances.resize(16); // 8 times
    EXPECT_EQ(refusalOf(scene, triangleView()), "");
    scene.materials[0].sheen.color = glm::vec3(1);
    EXPECT_EQ(refusalOf(scene, triangleView()), "") << "1.8 times as much each: 14.4";
    scene.materials[0].anisotropy.strength = 1; // 2.6: 20.8
    EXPECT_NE(refusalOf(scene, triangleView()).find("21 times over, expected at most 16"), std::string::npos);
}

TEST(SceneParts, ofLongEdgesAreRefusedUnlessTheModelIsLarge)
{
    Scene scene = triangleScene();
    scene.meshes[0].positions = {{0, 0, 0}, {1e-4f, 0, 0}, {0, 1, 0}};
    View view = triangleView();
    scene.instances.assign(600, {"", 0, glm::mat4(1)}); // each about 84 pixels more than 16
    EXPECT_NE(refusalOf(scene, view).find("the long edges of its triangles fill the picture 5 times over"),
              std::string::npos);
    scene.instances.resize(250); // 2.1
    EXPECT_NE(refusalOf(scene, view).find("picture 2.1 times over, expected at most 2:"), std::string::npos);
    scene.instances.resize(235);
    EXPECT_EQ(refusalOf(scene, view), "");
    scene.instances.assign(600, {"", 0, glm::mat4(1)});
    scene.meshes[1].positions.resize(101'000); // in one place: a loader may copy a vertex for each triangle
    EXPECT_NE(refusalOf(scene, view), "");
    for (std::size_t i = 0; i < scene.meshes[1].positions.size(); ++i)
        scene.meshes[1].positions[i].x = float(i);
    EXPECT_EQ(refusalOf(scene, view), "");
}

TEST(SceneParts, underVeryManyLightsAreRefused)
{
    Scene scene = triangleScene();
    scene.instances = {{"", 0, glm::mat4(1)}};
    View view = triangleView();
    view.lights.resize(390);
    EXPECT_EQ(refusalOf(scene, view), "");
    view.lights.resize(410); // on half the picture
    EXPECT_NE(refusalOf(scene, view).find("its lights shine on the picture 205 times over"), std::string::npos);
    view.output = Output::normal; // nothing is lit
    EXPECT_EQ(refusalOf(scene, view), "");
}

} // namespace
} // namespace cotan
