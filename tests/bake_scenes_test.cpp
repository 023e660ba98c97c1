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

// Both sides of each limit: less than a half now, three tenths more turned, and one side a tenth better than the other.
TEST(SceneUp, aTurnIsLikelyFromThreeTenthsMoreOfTheVolumeOn)
{
    // Posts of a square foot: `high` stands, the other lies, moved up the first by what they are to share when turned.
    const auto standing = [](float from, float to) { return Bounds{{0, from, 0}, {1, to, 1}}; };
    const auto lying = [](float from, float to) { return Bounds{{0, -1, from}, {1, 0, to}}; };
    // Turned the first is from `from` to 10 on the second, of which nothing is shared now.
    for (const auto& [length, likely] : {std::pair(2.9f, false), {3.1f, true}, {10.0f, true}})
        EXPECT_EQ(likelyTurn(lying(10 - length, 10), standing(0, 10)) == LikelyTurn::first, likely) << length;
    // A board of thickness 2r that lies on the axis that it turns about: it shares r of 2 - r with the turned one.
    const auto board = [](float r, float moved) { return Bounds{{0, -1, moved - r}, {1, 1, moved + r}}; };
    for (const auto& [r, turn] : {std::pair(0.6f, LikelyTurn::either),
                                  {0.65f, LikelyTurn::either},
                                  {0.68f, LikelyTurn::none}}) // over two thirds it is half
        EXPECT_EQ(likelyTurn(board(r, 0), turnedZUp(board(r, 0))), turn) << r;
    // Moved by a little, the first fits better than the second, which comes out on the other side.
    for (const auto& [moved, turn] : {std::pair(0.008f, LikelyTurn::either), {0.013f, LikelyTurn::first}}) {
        EXPECT_EQ(likelyTurn(board(0.2f, moved), turnedZUp(board(0.2f, moved))), turn) << moved;
    }
    // A thin box counts as a hundredth of its longest side thick: without that no two walls would share anything.
    const Bounds wall{{0, 0, 0}, {1, 2, 0}}, floor{{0, 0, 0}, {1, 0, 2}};
    EXPECT_EQ(likelyTurn(Bounds{{0, 0, 0}, {1, 0, 2}}, wall), LikelyTurn::first);
    EXPECT_EQ(likelyTurn(wall, floor), LikelyTurn::second);
    const Bounds apart{{0, 0, 0.019f}, {1, 2, 0.019f}}; // walls of 0.02 share a twentieth
    EXPECT_EQ(likelyTurn(wall, apart), LikelyTurn::none);
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
