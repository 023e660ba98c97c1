// Scenes turned and taken apart.
#include <gtest/gtest.h>

#include "cotan/scene/objects.hpp"
#include "cotan/scene/up.hpp"

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

TEST(SceneUp, aTurnIsLikelyWhereBoxesLieApartAndWouldNot)
{
    const Bounds high{{0, 1, 0}, {1, 3, 0.5f}}; // stands
    EXPECT_EQ(likelyTurn(high, high), LikelyTurn::none);
    const Bounds lying{{0, -0.5f, 1}, {1, 0, 3}}; // that with z up
    EXPECT_EQ(turnedZUp(lying).low, high.low);
    EXPECT_EQ(likelyTurn(lying, high), LikelyTurn::first);
    EXPECT_EQ(likelyTurn(high, lying), LikelyTurn::second);
    const Bounds cube{{-1, -1, -1}, {1, 1, 1}}, far{{5, 5, 5}, {6, 6, 6}};
    EXPECT_EQ(likelyTurn(cube, cube), LikelyTurn::none);
    EXPECT_EQ(likelyTurn(cube, far), LikelyTurn::none); // no turn helps
    const Bounds flat{{-1, 0, -1}, {1, 0, 1}}, wall{{-1, -1, 0}, {1, 1, 0}};
    EXPECT_EQ(likelyTurn(flat, wall), LikelyTurn::either);
    EXPECT_EQ(likelyTurn(Bounds{}, cube), LikelyTurn::none);
}

TEST(SceneObjects, haveTheNamesOfInstancesElseOfMeshesAndComeApart)
{
    Scene scene;
    scene.materials.resize(3);
    scene.meshes.resize(3);
    scene.meshes[0].name = "door";
    scene.meshes[1].name = "handle";
    scene.meshes[1].material = 2;
    scene.instances = {{"", 0, glm::mat4(1)}, {"lid", 1, glm::mat4(2)}, {"door", 1, glm::mat4(3)}};
    EXPECT_EQ(objectNames(scene), (std::vector<std::string>{"door", "lid"}));
    const SplitScene split = splitObject(scene, "door");
    ASSERT_EQ(split.object.instances.size(), 2u);
    EXPECT_EQ(split.object.meshes.size(), 2u); // the third is nowhere
    EXPECT_EQ(split.object.meshes[std::size_t(split.object.instances[1].mesh)].name, "handle");
    EXPECT_EQ(split.object.meshes[1].material, 2);
    ASSERT_EQ(split.others.instances.size(), 1u);
    EXPECT_EQ(split.others.meshes[0].name, "handle"); // both have it
    EXPECT_EQ(split.others.meshes[0].material, 0);
    EXPECT_TRUE(splitObject(scene, "window").object.instances.empty());
}

} // namespace
} // namespace cotan
