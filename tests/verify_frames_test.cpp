// Compares one view in two frames: the fractions of pixels with reversed tangents and bitangents, and the resulting
// difference of normals. Stored tangents are reversed by hand and compared with the exact frame.
#include "reference_scene.hpp"

#include <cmath>

#include "cotan/inspect.hpp"

namespace cotan {
namespace {

using namespace cotan::testing;

// Bytes 128 + 127 x: m = (40, -30, 112) / 127.
constexpr glm::ivec3 kTiltedBytes{168, 98, 240};

// A square quad with this tangent at each corner. (1, 0, 0, 1) is correct: u runs along x, green up along y.
Scene quadWithTangents(glm::vec4 tangent)
{
    Scene scene = sceneOf(meshOf(Patch{}));
    scene.meshes[0].tangents.assign(4, tangent);
    addNormalMap(scene, kTiltedBytes);
    return scene;
}

ComparedFrames compared(const Scene& scene,
                        std::array<std::optional<Frame>, 2> frames = {Frame::mikktspace, Frame::exact},
                        bool normalMaps = true)
{
    const auto renderer = openRenderer("reference", 1);
    EXPECT_TRUE(renderer);
    EXPECT_TRUE((*renderer)->load(scene));
    View view = viewOf(Output::shaded);
    view.normalMaps = normalMaps;
    view.lights.push_back({LightKind::directional, {1, 1, 1}, 3, {}, glm::normalize(glm::vec3(-1, -2, -3)), 0, 0, 0});
    auto done = compareFrames(**renderer, scene, view, frames);
    EXPECT_TRUE(done) << done.error().message;
    return *std::move(done);
}

double degreesOf(double cosine) { return std::acos(cosine / (40 * 40 + 30 * 30 + 112 * 112)) * 57.29577951308232; }

TEST(CompareFrames, findsReversedTangentsAndBitangents)
{
    const double square = 112 * 112;
    struct Case {
        glm::vec4 tangent;
        double t, b, degrees;
        const char* verdict;
    };
    for (const Case& c : {Case{{1, 0, 0, 1}, 0, 0, 0, "tangents and bitangents point the same way"},
                          Case{{1, 0, 0, -1},
                               0,
                               1,
                               degreesOf(1600 - 900 + square),
                               "bitangents are reversed everywhere: TANGENT.w is inverted"},
                          Case{{-1, 0, 0, -1},
                               1,
                               0,
                               degreesOf(-1600 + 900 + square),
                               "tangents are reversed on 100.0 % and bitangents on 0.0 % of the pixels"},
                          Case{{-1, 0, 0, 1},
                               1,
                               1,
                               degreesOf(-1600 - 900 + square),
                               "tangents are reversed on 100.0 % and bitangents on 100.0 % of the pixels"}}) {
        const ComparedFrames f = compared(quadWithTangents(c.tangent));
        EXPECT_EQ(f.tangentsOpposed, c.t) << c.verdict;
        EXPECT_EQ(f.bitangentsOpposed, c.b) << c.verdict;
        EXPECT_EQ(f.verdict, c.verdict);
        EXPECT_TRUE(f.mapped);
        EXPECT_GT(f.normals.count, 300u);
        EXPECT_NEAR(f.normals.mean, c.degrees, 0.05) << c.verdict;
        EXPECT_NEAR(f.normals.maximum, c.degrees, 0.05) << c.verdict;
        EXPECT_EQ(f.difference.width, 64);
        EXPECT_EQ(f.shaded[0].data == f.shaded[1].data, c.degrees == 0) << c.verdict;
    }
}

TEST(CompareFrames, fractionsCountVisiblePixels)
{
    Scene scene = quadWithTangents({1, 0, 0, 1});
    Mesh other = meshOf(Patch{});
    other.tangents.assign(4, {-1, 0, 0, -1});
    scene.meshes.push_back(other);
    glm::mat4 left(1), right(1);
    left[3] = {-1.05f, 0, 0, 1}, right[3] = {1.05f, 0, 0, 1};
    scene.instances[0].toWorld = left;
    scene.instances.push_back({"reversed", 1, right});
    const ComparedFrames f = compared(scene);
    EXPECT_NEAR(f.tangentsOpposed, 0.5, 0.03);
    EXPECT_EQ(f.bitangentsOpposed, 0);
}

TEST(CompareFrames, imagesFollowTheOrderOfTheFrames)
{
    const Scene scene = quadWithTangents({1, 0, 0, -1});
    const ComparedFrames f = compared(scene), back = compared(scene, {Frame::exact, Frame::mikktspace});
    EXPECT_EQ(f.shaded[0].data, back.shaded[1].data);
    EXPECT_EQ(f.shaded[1].data, back.shaded[0].data);
    const auto renderer = openRenderer("reference", 1);
    ASSERT_TRUE((*renderer)->load(scene));
    View view = viewOf(Output::normal, Frame::mikktspace);
    const auto error = errorAgainst(Frame::exact, **renderer, scene, view);
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->degrees.mean, f.normals.mean, 1e-6);
    EXPECT_EQ(error->difference.data, f.difference.data);
    view.frame = Frame::exact;
    EXPECT_EQ(errorAgainst(Frame::exact, **renderer, scene, view)->degrees.maximum, 0);
}

TEST(CompareFrames, withoutANormalMapNothingIsCompared)
{
    const ComparedFrames unmapped = compared(quadWithTangents({1, 0, 0, -1}), {Frame::mikktspace, Frame::exact}, false);
    EXPECT_FALSE(unmapped.mapped);
    EXPECT_EQ(unmapped.normals.count, 0u);
    EXPECT_EQ(toText(unmapped), "nothing was compared: no normal map is drawn");
    Scene bare = quadWithTangents({1, 0, 0, 1});
    bare.materials[0].normalMap.image = -1;
    EXPECT_FALSE(compared(bare).mapped);
    Scene none = quadWithTangents({1, 0, 0, 1});
    none.instances.clear();
    const ComparedFrames nothing = compared(none);
    EXPECT_TRUE(std::isnan(nothing.tangentsOpposed));
    EXPECT_EQ(nothing.verdict, "no pixel has tangents of both frames: nothing was compared");
}

} // namespace
} // namespace cotan
