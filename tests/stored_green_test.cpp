// The sense of green in normal maps that stored tangents imply.
#include "scene/normal_maps.hpp"

#include <gtest/gtest.h>

namespace cotan {
namespace {

// Rectangles in the xy plane that face +z, each with a normal map and a tangent w of its own.
struct Rectangles {
    Scene scene;

    Rectangles()
    {
        scene.images.push_back({"waves", 1, 1, PixelType::unorm8, std::vector<std::byte>(4)});
        scene.materials.resize(1);
        scene.materials[0].normalMap.image = 0;
    }
    // mirrored: u increases to the left.
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

TEST(StoredGreen, reversedWFlipsGreenAndWTogether)
{
    for (const bool mirrored : {false, true}) {
        const float right = mirrored ? -1.0f : 1.0f; // w of glTF: u to the right, v down, right-handed space
        Rectangles agrees, contradicts;
        agrees.add(right, 1, 0, mirrored);
        contradicts.add(-right, 1, 0, mirrored);
        EXPECT_TRUE(reconcileGreenWithTangents(agrees.scene).empty());
        EXPECT_FALSE(agrees.scene.materials[0].greenReversed);
        EXPECT_EQ(agrees.scene.meshes[0].tangents[0].w, right);

        const std::vector<std::string> lines = reconcileGreenWithTangents(contradicts.scene);
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_NE(lines[0].find("100 % of the area of normal map 'waves'"), std::string::npos) << lines[0];
        EXPECT_NE(lines[0].find("green is flipped"), std::string::npos) << lines[0];
        const Material& m = contradicts.scene.materials[0];
        EXPECT_TRUE(m.greenReversed);
        EXPECT_FALSE(m.normalFormat.greenUp);
        EXPECT_FALSE(m.coat.normalFormat.greenUp);
        for (const glm::vec4& t : contradicts.scene.meshes[0].tangents)
            EXPECT_EQ(t.w, right);
    }
}

// One mesh of ten cells, of which `reversed` contradict the uv.
Mesh cells(int reversed)
{
    Rectangles parts;
    for (int i = 0; i < 10; ++i)
        parts.add(i < reversed ? -1.0f : 1.0f);
    Mesh all;
    for (const Mesh& part : parts.scene.meshes) {
        const std::uint32_t first = std::uint32_t(all.positions.size());
        for (const std::uint32_t i : part.indices)
            all.indices.push_back(first + i);
        all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
        all.normals.insert(all.normals.end(), part.normals.begin(), part.normals.end());
        all.tangents.insert(all.tangents.end(), part.tangents.begin(), part.tangents.end());
        all.texcoords[0].insert(all.texcoords[0].end(), part.texcoords[0].begin(), part.texcoords[0].end());
    }
    return all;
}

TEST(StoredGreen, greenFlipsFromNineTenthsOfAMeshesArea)
{
    const auto reversedBy = [](int reversed) {
        Rectangles one;
        one.scene.meshes = {cells(reversed)};
        const auto lines = reconcileGreenWithTangents(one.scene);
        return std::pair(one.scene.materials[0].greenReversed, lines.size());
    };
    EXPECT_EQ(reversedBy(10), std::pair(true, std::size_t(1)));
    EXPECT_EQ(reversedBy(9), std::pair(true, std::size_t(1)));
    EXPECT_EQ(reversedBy(8), std::pair(false, std::size_t(1))); // left as declared, with a warning
    EXPECT_EQ(reversedBy(1), std::pair(false, std::size_t(1)));
    EXPECT_EQ(reversedBy(0), std::pair(false, std::size_t(0)));
}

TEST(StoredGreen, anUnclearMeshFollowsTheWholeAreaOfItsMap)
{
    for (const bool mostReversed : {true, false}) {
        Rectangles two;
        two.scene.meshes = {cells(5)};
        two.add(mostReversed ? -1.0f : 1.0f, 100);
        reconcileGreenWithTangents(two.scene);
        for (const Mesh& mesh : two.scene.meshes)
            EXPECT_EQ(two.scene.materials[std::size_t(mesh.material)].greenReversed, mostReversed);
        EXPECT_EQ(two.scene.materials.size(), 1u);
    }
}

TEST(StoredGreen, eachMeshIsDecidedByItself)
{
    Rectangles rectangles;
    rectangles.scene.images.push_back({"rings", 1, 1, PixelType::unorm8, std::vector<std::byte>(4)});
    rectangles.scene.materials.resize(4);
    rectangles.scene.materials[1].normalMap.image = 1; // another map
    rectangles.scene.materials[2].coat.normalMap.image = 0;
    rectangles.scene.materials[3] = {}; // none
    rectangles.add(-1, 10, 0);
    rectangles.add(1, 1, 1);
    rectangles.add(1, 1, 2); // declared, although the larger part of the map's area is reversed
    rectangles.add(-1, 1, 3);
    const auto lines = reconcileGreenWithTangents(rectangles.scene);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("green is flipped in 1 of 2 meshes"), std::string::npos) << lines[0];
    EXPECT_TRUE(rectangles.scene.materials[0].greenReversed);
    for (const std::size_t declared : {1u, 2u, 3u})
        EXPECT_FALSE(rectangles.scene.materials[declared].greenReversed) << declared;
    EXPECT_EQ(rectangles.scene.meshes[0].tangents[0].w, 1); // keeps the appearance with stored tangents
    EXPECT_EQ(rectangles.scene.meshes[1].tangents[0].w, 1);
    EXPECT_EQ(rectangles.scene.meshes[2].tangents[0].w, 1);
    EXPECT_EQ(rectangles.scene.meshes[3].tangents[0].w, -1);
}

TEST(StoredGreen, aMeshWithoutTangentsStaysAsDeclaredAlsoInASharedMaterial)
{
    Rectangles shared;
    shared.add(-1, 1);
    shared.add(1, 10);
    shared.scene.meshes[1].tangents.clear();
    shared.add(-1, 1);
    const std::vector<std::string> lines = reconcileGreenWithTangents(shared.scene);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("green is flipped in 2 of 3 meshes"), std::string::npos) << lines[0];
    ASSERT_EQ(shared.scene.materials.size(), 2u); // one copy for both
    EXPECT_EQ(shared.scene.materials[1].copyOf, 0);
    EXPECT_TRUE(shared.scene.materials[1].greenReversed);
    EXPECT_FALSE(shared.scene.materials[0].greenReversed);
    EXPECT_EQ(shared.scene.meshes[0].material, 1);
    EXPECT_EQ(shared.scene.meshes[1].material, 0);
    EXPECT_EQ(shared.scene.meshes[2].material, 1);
    // A new map for the material is for its copy too, and needs none.
    Scene again = shared.scene;
    putNormalMap(again, Image(again.images[0]), Convention{}, 0);
    for (const Material& m : again.materials) {
        EXPECT_EQ(m.normalMap.image, 1);
        EXPECT_FALSE(m.greenReversed);
    }
    restoreDeclaredGreen(shared.scene);
    EXPECT_EQ(shared.scene.materials.size(), 1u);
    for (const Mesh& mesh : shared.scene.meshes)
        EXPECT_EQ(mesh.material, 0);
    EXPECT_EQ(shared.scene.meshes[0].tangents[0].w, -1);
}

TEST(StoredGreen, tangentsSayNothingOfMapsForOtherFrames)
{
    for (const Frame frame : {Frame::smooth, Frame::orthonormal, Frame::mikktspace, Frame::vertex}) {
        Rectangles rectangles;
        rectangles.scene.materials[0].normalFrame = frame;
        rectangles.add(-1);
        reconcileGreenWithTangents(rectangles.scene);
        EXPECT_EQ(rectangles.scene.materials[0].greenReversed, readsTangents(frame)) << name(frame);
    }
}

TEST(StoredGreen, trianglesWithoutUvAreaOrTangentsDoNotCount)
{
    Rectangles rectangles;
    rectangles.add(-1, 9.5f);
    rectangles.add(1, 100); // uv without area
    rectangles.scene.meshes[1].texcoords[0].assign(4, {0.5f, 0.5f});
    rectangles.add(1, 100); // tangents opposite to dP/du: red is inverted as well
    for (glm::vec4& t : rectangles.scene.meshes[2].tangents)
        t.x = -1;
    rectangles.add(1, 0.5f);
    rectangles.add(1, 100); // no tangents
    rectangles.scene.meshes[4].tangents.clear();
    Rectangles none;
    none.add(1);
    none.scene.meshes[0].tangents.clear();
    EXPECT_TRUE(reconcileGreenWithTangents(none.scene).empty());
    EXPECT_FALSE(none.scene.materials[0].greenReversed);
    const std::vector<std::string> lines = reconcileGreenWithTangents(rectangles.scene);
    ASSERT_EQ(lines.size(), 1u); // of 9.5, 0.5 and 100, which are compared: rotated tangents, too
    EXPECT_NE(lines[0].find("on 9 % of the area"), std::string::npos) << lines[0];
    const auto reversed = [&](std::size_t i) {
        return rectangles.scene.materials[std::size_t(rectangles.scene.meshes[i].material)].greenReversed;
    };
    EXPECT_TRUE(reversed(0));
    for (const std::size_t declared : {2u, 3u, 4u}) // green cannot compensate rotated tangents
        EXPECT_FALSE(reversed(declared)) << declared;
}

TEST(StoredGreen, restoringGivesBackTheDeclaredGreen)
{
    Rectangles rectangles;
    rectangles.scene.materials[0].anisotropy = {.strength = 1, .rotation = 0.5f, .map = {}};
    rectangles.add(-1);
    reconcileGreenWithTangents(rectangles.scene);
    EXPECT_EQ(rectangles.scene.materials[0].anisotropy.rotation, -0.5f);
    restoreDeclaredGreen(rectangles.scene, 0);
    EXPECT_FALSE(rectangles.scene.materials[0].greenReversed);
    EXPECT_TRUE(rectangles.scene.materials[0].normalFormat.greenUp);
    EXPECT_EQ(rectangles.scene.materials[0].anisotropy.rotation, 0.5f);
    EXPECT_EQ(rectangles.scene.meshes[0].tangents[0].w, -1);
    restoreDeclaredGreen(rectangles.scene); // nothing remains to be restored
    EXPECT_EQ(rectangles.scene.meshes[0].tangents[0].w, -1);
}

TEST(StoredGreen, anisotropyMapsKeepTheDeclaredGreen)
{
    Rectangles rectangles;
    rectangles.scene.materials[0].anisotropy.strength = 1;
    rectangles.scene.materials[0].anisotropy.map.image = 0;
    rectangles.add(-1);
    const auto lines = reconcileGreenWithTangents(rectangles.scene);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("as declared"), std::string::npos) << lines[0];
    EXPECT_FALSE(rectangles.scene.materials[0].greenReversed);
}

TEST(StoredGreen, aReplacedMapIsReadByItsOwnConvention)
{
    Rectangles rectangles;
    rectangles.add(-1);
    reconcileGreenWithTangents(rectangles.scene);
    rectangles.scene.materials[0].normalFrame = Frame::smooth;
    putNormalMap(rectangles.scene, Image(rectangles.scene.images[0]), Convention{});
    EXPECT_FALSE(rectangles.scene.materials[0].greenReversed);
    EXPECT_TRUE(rectangles.scene.materials[0].normalFormat.greenUp);
    EXPECT_FALSE(rectangles.scene.materials[0].normalFrame);
    EXPECT_EQ(rectangles.scene.meshes[0].tangents[0].w, -1);
}

} // namespace
} // namespace cotan
