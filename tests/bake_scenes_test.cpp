// Scenes before they are baked: whether one has to be turned, and one taken apart.
#include <string>

#include <gtest/gtest.h>

#include "bake_objects.hpp"
#include "likely_turn.hpp"

namespace cotan::app {
namespace {

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
} // namespace cotan::app
