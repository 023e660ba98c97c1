// Green of normal maps as the stored tangents mean it.
#include "scene/normal_maps.hpp"

#include <gtest/gtest.h>

namespace cotan {
namespace {

// Unit squares in a row in xy, seen from +z, each with its own w on the right tangent. right: what glTF asks for.
struct Row {
    Scene scene;

    Row()
    {
        scene.images.push_back({"waves", 1, 1, PixelType::unorm8, std::vector<std::byte>(4)});
        scene.materials.resize(1);
        scene.materials[0].normalMap.image = 0;
    }
    // mirrored: u runs to the left.
    void add(float w, float width = 1, int material = 0, bool mirrored = false)
    {
        Mesh mesh;
        mesh.material = material;
        mesh.positions = {{0, 0, 0}, {width, 0, 0}, {width, 1, 0}, {0, 1, 0}};
        mesh.normals.assign(4, {0, 0, 1});
        const float left = mirrored ? 1.0f : 0.0f, right = 1 - left;
        mesh.texcoords[0] = {{left, 1}, {right, 1}, {right, 0}, {left, 0}};
        mesh.tangents.assign(4, {mirrored ? -1.0f : 1.0f, 0, 0, w});
        mesh.indices = {0, 1, 2, 0, 2, 3};
        scene.instances.push_back({"", int(scene.meshes.size()), glm::mat4(1)});
        scene.meshes.push_back(std::move(mesh));
    }
};

TEST(StoredGreen, wAgainstTheUvTurnsGreenAndWTogether)
{
    for (const bool mirrored : {false, true}) {
        const float right = mirrored ? -1.0f : 1.0f; // u to the right and v down in a right-handed space
        Row agrees, contradicts;
        agrees.add(right, 1, 0, mirrored);
        contradicts.add(-right, 1, 0, mirrored);
        EXPECT_TRUE(followStoredTangents(agrees.scene).empty());
        EXPECT_FALSE(agrees.scene.materials[0].greenReversed);
        EXPECT_EQ(agrees.scene.meshes[0].tangents[0].w, right);

        const std::vector<std::string> lines = followStoredTangents(contradicts.scene);
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_NE(lines[0].find("100 % of the area of normal map 'waves'"), std::string::npos) << lines[0];
        EXPECT_NE(lines[0].find("green is read the other way"), std::string::npos) << lines[0];
        const Material& m = contradicts.scene.materials[0];
        EXPECT_TRUE(m.greenReversed);
        EXPECT_FALSE(m.normalFormat.greenUp);
        EXPECT_FALSE(m.coat.normalFormat.greenUp);
        for (const glm::vec4& t : contradicts.scene.meshes[0].tangents)
            EXPECT_EQ(t.w, right);
    }
}

TEST(StoredGreen, theLimitIsNineTenthsOfTheMapsArea)
{
    const auto reversedOver = [](float width) { // of ten
        Row row;
        row.add(-1, width);
        row.add(1, 10 - width);
        const auto lines = followStoredTangents(row.scene);
        return std::pair(row.scene.materials[0].greenReversed, lines.size());
    };
    EXPECT_EQ(reversedOver(9.1f), std::pair(true, std::size_t(1)));
    EXPECT_EQ(reversedOver(8.9f), std::pair(false, std::size_t(1))); // mentioned
    EXPECT_EQ(reversedOver(1.1f), std::pair(false, std::size_t(1)));
    EXPECT_EQ(reversedOver(0.9f), std::pair(false, std::size_t(0)));
}

TEST(StoredGreen, mapsAreDecidedApartAndMaterialsOfOneMapTogether)
{
    Row row;
    row.scene.images.push_back({"rings", 1, 1, PixelType::unorm8, std::vector<std::byte>(4)});
    row.scene.materials.resize(4);
    row.scene.materials[1].normalMap.image = 1; // another map
    row.scene.materials[2].coat.normalMap.image = 0;
    row.scene.materials[3] = {}; // none
    row.add(-1, 10, 0);
    row.add(1, 1, 1);
    row.add(1, 1, 2); // little of the area of map 0
    row.add(-1, 1, 3);
    EXPECT_EQ(followStoredTangents(row.scene).size(), 1u);
    EXPECT_TRUE(row.scene.materials[0].greenReversed);
    EXPECT_FALSE(row.scene.materials[1].greenReversed);
    EXPECT_TRUE(row.scene.materials[2].greenReversed);
    EXPECT_FALSE(row.scene.materials[3].greenReversed);
    EXPECT_EQ(row.scene.meshes[1].tangents[0].w, 1);
    EXPECT_EQ(row.scene.meshes[2].tangents[0].w, -1); // so that stored tangents show what they showed
    EXPECT_EQ(row.scene.meshes[3].tangents[0].w, -1);
}

TEST(StoredGreen, whatCannotBeComparedDoesNotCount)
{
    Row row;
    row.add(-1, 9.5f);
    row.add(1, 100); // uv without area
    row.scene.meshes[1].texcoords[0].assign(4, {0.5f, 0.5f});
    row.add(1, 100); // tangents against dP/du: red is the other way as well
    for (glm::vec4& t : row.scene.meshes[2].tangents)
        t.x = -1;
    row.add(1, 0.5f);
    row.add(1, 100); // no tangents
    row.scene.meshes[4].tangents.clear();
    Row none;
    none.add(1);
    none.scene.meshes[0].tangents.clear();
    EXPECT_TRUE(followStoredTangents(none.scene).empty());
    EXPECT_FALSE(none.scene.materials[0].greenReversed);
    // The turned tangents are compared, and do not contradict in the way that green makes up for.
    const auto lines = followStoredTangents(row.scene);
    EXPECT_TRUE(lines.empty());
    row.scene.meshes.erase(row.scene.meshes.begin() + 2);
    row.scene.instances.pop_back();
    EXPECT_EQ(followStoredTangents(row.scene).size(), 1u);
    EXPECT_TRUE(row.scene.materials[0].greenReversed);
}

TEST(StoredGreen, restoringGivesTheFilesOwnBack)
{
    Row row;
    row.scene.materials[0].anisotropy = {.strength = 1, .rotation = 0.5f, .map = {}};
    row.add(-1);
    followStoredTangents(row.scene);
    EXPECT_EQ(row.scene.materials[0].anisotropy.rotation, -0.5f);
    restoreDeclaredGreen(row.scene, 0);
    EXPECT_FALSE(row.scene.materials[0].greenReversed);
    EXPECT_TRUE(row.scene.materials[0].normalFormat.greenUp);
    EXPECT_EQ(row.scene.materials[0].anisotropy.rotation, 0.5f);
    EXPECT_EQ(row.scene.meshes[0].tangents[0].w, -1);
    restoreDeclaredGreen(row.scene); // nothing is left to restore
    EXPECT_EQ(row.scene.meshes[0].tangents[0].w, -1);
}

TEST(StoredGreen, directionsOfAnisotropyInAMapKeepTheDeclaration)
{
    Row row;
    row.scene.materials[0].anisotropy.strength = 1;
    row.scene.materials[0].anisotropy.map.image = 0;
    row.add(-1);
    const auto lines = followStoredTangents(row.scene);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("as declared"), std::string::npos) << lines[0];
    EXPECT_FALSE(row.scene.materials[0].greenReversed);
}

TEST(StoredGreen, anotherMapPutOnTheModelIsReadAsItSays)
{
    Row row;
    row.add(-1);
    followStoredTangents(row.scene);
    row.scene.materials[0].normalFrame = Frame::smooth;
    putNormalMap(row.scene, Image(row.scene.images[0]), Convention{});
    EXPECT_FALSE(row.scene.materials[0].greenReversed);
    EXPECT_TRUE(row.scene.materials[0].normalFormat.greenUp);
    EXPECT_FALSE(row.scene.materials[0].normalFrame);
    EXPECT_EQ(row.scene.meshes[0].tangents[0].w, -1);
}

} // namespace
} // namespace cotan
