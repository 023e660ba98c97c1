// The frame `auto`: the frame that a scene's normal maps were made for.
#include "scene/normal_maps.hpp"

#include <gtest/gtest.h>

#include "gltf_maker.hpp"

namespace cotan {
namespace {

using test::Gltf;
using test::json;

// Squares of the given widths, with a material each.
Scene squares(const std::vector<float>& widths)
{
    Scene scene;
    scene.images.push_back({"waves", 1, 1, PixelType::unorm8, std::vector<std::byte>(4)});
    for (const float width : widths) {
        Mesh mesh;
        mesh.material = int(scene.materials.size());
        mesh.positions = {{0, 0, 0}, {width, 0, 0}, {width, 1, 0}, {0, 1, 0}};
        mesh.normals.assign(4, {0, 0, 1});
        mesh.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        scene.instances.push_back({"", int(scene.meshes.size()), glm::mat4(1)});
        scene.meshes.push_back(std::move(mesh));
        scene.materials.emplace_back().normalMap.image = 0;
    }
    return scene;
}

TEST(AutoFrameChoice, isOrthonormalForTheMapsOfAModel)
{
    EXPECT_EQ(autoFrame(squares({1}), MapSource::model), Frame::orthonormal);
    EXPECT_EQ(autoFrame(squares({1}), MapSource::own), Frame::orthonormal);
    EXPECT_EQ(autoFrame(squares({1}), MapSource::shape), Frame::cotangent);
    Scene bare = squares({1});
    bare.materials[0].normalMap.image = -1;
    EXPECT_EQ(autoFrame(bare, MapSource::model), Frame::cotangent);
    bare.materials[0].coat.normalMap.image = 0;
    EXPECT_EQ(autoFrame(bare, MapSource::model), Frame::orthonormal);
}

TEST(AutoFrameChoice, isCotangentForRepeatedImages)
{
    for (const int axis : {0, 1}) {
        Scene scene = squares({1, 1});
        for (glm::vec2& uv : scene.meshes[1].texcoords[0])
            uv[axis] *= 1.5f;
        EXPECT_EQ(autoFrame(scene, MapSource::own), Frame::cotangent);
        EXPECT_EQ(autoFrame(scene, MapSource::model), Frame::orthonormal); // glTF prescribes MikkTSpace all the same
    }
    Scene moved = squares({1}); // one copy, at another offset
    for (glm::vec2& uv : moved.meshes[0].texcoords[0])
        uv += glm::vec2(3, -2);
    EXPECT_EQ(autoFrame(moved, MapSource::own), Frame::orthonormal);
    moved.materials[0].normalMap.uRow = {2, 0, 0};
    EXPECT_EQ(autoFrame(moved, MapSource::own), Frame::cotangent);
    moved.materials[0].coat.normalMap.image = 0; // the coat's map is ignored here
    moved.materials[0].normalMap.image = -1;
    EXPECT_EQ(autoFrame(moved, MapSource::own), Frame::orthonormal);
}

TEST(AutoFrameChoice, isTheNamedFrameOfTheLargestArea)
{
    Scene scene = squares({1, 2, 4, 8});
    scene.materials[0].normalFrame = scene.materials[1].normalFrame = Frame::smooth;
    scene.materials[2].normalFrame = Frame::cotangent;
    for (const MapSource source : {MapSource::model, MapSource::own, MapSource::shape})
        EXPECT_EQ(autoFrame(scene, source), Frame::cotangent);
    auto named = namedFrame(scene);
    ASSERT_TRUE(named);
    EXPECT_EQ(named->others, 3u);                            // two for smooth, one without a name
    scene.instances[2].toWorld = glm::mat4(glm::mat3(0.5f)); // a quarter of its area
    EXPECT_EQ(namedFrame(scene)->frame, Frame::smooth);
    scene.materials[0].normalMap = scene.materials[1].normalMap = {};
    EXPECT_EQ(namedFrame(scene)->frame, Frame::cotangent); // names count only with a map
    scene.materials[2].normalFrame.reset();
    EXPECT_FALSE(namedFrame(scene));
}

TEST(AutoFrameChoice, differingFramesAreNoted)
{
    Scene scene = squares({2, 1});
    EXPECT_EQ(frameNote(scene, Frame::cotangent), "");
    scene.materials[0].normalFrame = scene.materials[1].normalFrame = Frame::smooth;
    EXPECT_EQ(frameNote(scene, Frame::smooth), "");
    EXPECT_EQ(frameNote(scene, Frame::unit),
              "the normal maps are for the frame smooth, as the file says, and are read with unit");
    scene.materials[1].normalFrame.reset();
    EXPECT_NE(frameNote(scene, Frame::smooth).find("1 other material(s)"), std::string::npos);
}

TEST(AutoFrameChoice, isReadFromMaterialExtras)
{
    const auto loaded = [](const json& extras) {
        Gltf g;
        const int p = g.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"), uv = g.floats({0, 1, 1, 1, 0, 0}, "VEC2");
        const int n = g.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        g.root["accessors"][std::size_t(p)]["min"] = {0, 0, 0};
        g.root["accessors"][std::size_t(p)]["max"] = {1, 1, 0};
        g.add("materials", {{"name", "m"}, {"extras", extras}});
        const json attributes = {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", uv}};
        g.add("meshes", {{"primitives", json::array({{{"attributes", attributes}, {"material", 0}}})}});
        g.add("nodes", {{"mesh", 0}});
        g.add("scenes", {{"nodes", {0}}});
        auto scene = g.load();
        EXPECT_TRUE(scene) << scene.error().message;
        return std::move(*scene);
    };
    EXPECT_EQ(loaded({{"cotanFrame", "paper-full"}, {"mine", 7}}).materials[0].normalFrame, Frame::paperFull);
    for (const json& odd : {json(nullptr), json(3), json::array({"cotanFrame"}), json({{"mine", 7}})}) {
        const Scene scene = loaded(odd);
        EXPECT_FALSE(scene.materials[0].normalFrame);
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    }
    for (const json& wrong : {json("smoth"), json(3), json({{"a", "b"}})}) {
        const Scene scene = loaded({{"cotanFrame", wrong}});
        EXPECT_FALSE(scene.materials[0].normalFrame);
        ASSERT_EQ(scene.warnings.size(), 1u);
        EXPECT_NE(scene.warnings[0].find("materials[0].extras.cotanFrame"), std::string::npos) << scene.warnings[0];
    }
}

} // namespace
} // namespace cotan
