// Scenes before they are baked: whether one has to be rotated, and splitting one into objects.
#include <string>

#include <gtest/gtest.h>

#include "bake_objects.hpp"
#include "up_mismatch.hpp"

namespace cotan::app {
namespace {

TEST(SceneUp, suggestsRotationIfOnlyRotatedBoxesOverlap)
{
    const Bounds high{{0, 1, 0}, {1, 3, 0.5f}}; // upright
    EXPECT_EQ(findUpMismatch(high, high), UpMismatch::none);
    const Bounds lying{{0, -0.5f, 1}, {1, 0, 3}}; // the same box with z up
    EXPECT_EQ(rotatedZUp(lying).low, high.low);
    EXPECT_EQ(findUpMismatch(lying, high), UpMismatch::first);
    EXPECT_EQ(findUpMismatch(high, lying), UpMismatch::second);
    const Bounds cube{{-1, -1, -1}, {1, 1, 1}}, far{{5, 5, 5}, {6, 6, 6}};
    EXPECT_EQ(findUpMismatch(cube, cube), UpMismatch::none);
    EXPECT_EQ(findUpMismatch(cube, far), UpMismatch::none); // no rotation helps
    const Bounds flat{{-1, 0, -1}, {1, 0, 1}}, wall{{-1, -1, 0}, {1, 1, 0}};
    EXPECT_EQ(findUpMismatch(flat, wall), UpMismatch::either);
    EXPECT_EQ(findUpMismatch(Bounds{}, cube), UpMismatch::none);
}

// Both sides of each limit: less than half shared now, three tenths more if rotated, one side a tenth better.
TEST(SceneUp, suggestsRotationIfItAddsThreeTenthsOfOverlap)
{
    // Posts with a footprint of 1 x 1: `standing` is upright; `lying` needs the rotation to overlap it.
    const auto standing = [](float from, float to) { return Bounds{{0, from, 0}, {1, to, 1}}; };
    const auto lying = [](float from, float to) { return Bounds{{0, -1, from}, {1, 0, to}}; };
    // The rotated first box reaches from `from` to 10 on the second; now they share nothing.
    for (const auto& [length, likely] : {std::pair(2.9f, false), {3.1f, true}, {10.0f, true}})
        EXPECT_EQ(findUpMismatch(lying(10 - length, 10), standing(0, 10)) == UpMismatch::first, likely) << length;
    // A board of thickness 2r that lies on the axis of rotation: it shares r of 2 - r with the rotated board.
    const auto board = [](float r, float moved) { return Bounds{{0, -1, moved - r}, {1, 1, moved + r}}; };
    for (const auto& [r, turn] : {std::pair(0.6f, UpMismatch::either),
                                  {0.65f, UpMismatch::either},
                                  {0.68f, UpMismatch::none}}) // above two thirds, half is shared
        EXPECT_EQ(findUpMismatch(board(r, 0), rotatedZUp(board(r, 0))), turn) << r;
    // If moved slightly, the first fits better than the second, which ends up on the other side.
    for (const auto& [moved, turn] : {std::pair(0.008f, UpMismatch::either), {0.013f, UpMismatch::first}}) {
        EXPECT_EQ(findUpMismatch(board(0.2f, moved), rotatedZUp(board(0.2f, moved))), turn) << moved;
    }
    // A flat box counts as a hundredth of its longest side thick; otherwise two walls would never overlap.
    const Bounds wall{{0, 0, 0}, {1, 2, 0}}, floor{{0, 0, 0}, {1, 0, 2}};
    EXPECT_EQ(findUpMismatch(Bounds{{0, 0, 0}, {1, 0, 2}}, wall), UpMismatch::first);
    EXPECT_EQ(findUpMismatch(wall, floor), UpMismatch::second);
    const Bounds apart{{0, 0, 0.019f}, {1, 2, 0.019f}}; // walls of thickness 0.02 share a twentieth
    EXPECT_EQ(findUpMismatch(wall, apart), UpMismatch::none);
}

TEST(SceneObjects, areNamedByInstanceElseMeshAndCanBeSplitOff)
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
    EXPECT_EQ(split.object.meshes.size(), 2u); // the third has no instance
    EXPECT_EQ(split.object.meshes[std::size_t(split.object.instances[1].mesh)].name, "handle");
    EXPECT_EQ(split.object.meshes[1].material, 2);
    ASSERT_EQ(split.others.instances.size(), 1u);
    EXPECT_EQ(split.others.meshes[0].name, "handle"); // both objects use it
    EXPECT_EQ(split.others.meshes[0].material, 0);
    EXPECT_TRUE(splitObject(scene, "window").object.instances.empty());
}

} // namespace
} // namespace cotan::app
