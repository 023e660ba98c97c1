// What lint does with a whole scene: distances, rounding, the maps and coats that it judges and how it reads them,
// progress and memory. The scenes are small, and no two things in them are equal.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "cotan/lint.hpp"
#include "judgement_cases.hpp"

namespace cotan {
namespace {

using namespace test;

const double kHalfFieldOfView = glm::radians(22.5); // half of the field of view

// A material with the given normal map, stored without conversion; -1: none.
Material mapped(int image, const std::string& name = "")
{
    Material m;
    m.name = name;
    m.normalMap.image = image;
    m.normalFormat = kUnconverted;
    m.coat.normalFormat = kUnconverted;
    return m;
}

Image constant(const glm::dvec3& m, const std::string& name = "map")
{
    Image image = floatMap(2, 2, [&](int, int) { return m; });
    image.name = name;
    return image;
}

const glm::dvec3 kTilted(0.4, 0.3, 1);

// Each mesh gets the material of its index and one instance without a transform.
Scene sceneOf(const std::vector<std::vector<Corner>>& meshes, std::vector<Material> materials,
              std::vector<Image> images)
{
    Scene scene;
    scene.materials = std::move(materials);
    scene.images = std::move(images);
    for (const auto& corners : meshes) {
        Mesh mesh = meshOf(corners);
        mesh.material = int(scene.meshes.size());
        scene.instances.push_back({"", mesh.material, glm::mat4(1)});
        scene.meshes.push_back(std::move(mesh));
    }
    return scene;
}

std::vector<Corner> square() { return rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}); }
std::vector<Corner> wide() { return rectangle({0, 0}, {2, 1}, {0, 0}, {1, 1}); } // u is half as dense as v

// Two triangles whose uv differ in density and direction, so that averages at the edge equal neither.
std::vector<Corner> uneven()
{
    return {{{0, 0, 0}, {0, 1}}, {{0, 1, 0}, {0, 0}},       {{-1, 0, 0}, {-1, 1}},
            {{0, 0, 0}, {0, 1}}, {{1, 0, 0}, {0.5f, 1.5f}}, {{0, 1, 0}, {0, 0}}};
}

TEST(Lint, defaultDistanceFitsTheBoundingSphere)
{
    // A box of 2 by 3 by 6: its diagonal is 7.
    const std::vector<Corner> triangle = {{{1, 2, 3}, {0, 0}}, {{3, 5, 9}, {1, 0}}, {{1, 5, 3}, {0, 1}}};
    Scene scene = sceneOf({triangle}, {mapped(-1)}, {});
    EXPECT_NEAR(lintScene(scene).distance, 3.5 / std::sin(kHalfFieldOfView), 1e-5);
    EXPECT_EQ(lintScene(scene, {.distance = 0.25}).distance, 0.25);
    scene.instances.push_back({"", 0, glm::translate(glm::mat4(1), {10, 0, 0})}); // now 12 by 3 by 6
    EXPECT_NEAR(lintScene(scene).distance, std::sqrt(144.0 + 9 + 36) / 2 / std::sin(kHalfFieldOfView), 1e-5);
    const std::vector<Corner> point(3, {{1, 2, 3}, {0, 0}});
    EXPECT_EQ(lintScene(sceneOf({point}, {mapped(-1)}, {})).distance, 1);
    EXPECT_EQ(lintScene(Scene{}).distance, 1);
}

TEST(Lint, roundingFollowsTheLargestUvAndTheLongerGradient)
{
    const double pixel = 2 * std::tan(kHalfFieldOfView) / 1080; // at distance 1
    const auto lintAt = [&](glm::vec2 from, glm::vec2 to, double distance) {
        const Scene scene = sceneOf({rectangle({0, 0}, {1, 2}, from, to)}, {mapped(-1)}, {});
        return lintScene(scene, {.distance = distance}).primitives.at(0);
    };
    const PrimitiveLint p = lintAt({0, 0}, {3, 1}, 5); // gradients 3 and 1/2
    EXPECT_NEAR(p.precision / (3 * 1e-6 / (pixel * 3) / 5), 1, 1e-5);
    EXPECT_NEAR(p.closest / (3 * 1e-6 / (pixel * 3) / 0.5), 1, 1e-5);
    EXPECT_NEAR(lintAt({0, 0}, {0.25f, 0.25f}, 5).precision / (1e-6 / (pixel * 0.25) / 5), 1, 1e-5); // uv below 1 as 1
    EXPECT_EQ(lintAt({0, 0}, {3, 1}, 1e-9).precision, 180);
}

// The largest uv may be at any corner, in u or v, and negative.
TEST(UvQuality, largestUvIsTheMaximumMagnitudeOverAllCorners)
{
    for (int corner = 0; corner < 3; ++corner)
        for (const glm::vec2 uv : {glm::vec2(5, 0.5f), {0.5f, 5}, {-5, 0.5f}, {0.5f, -5}}) {
            std::vector<Corner> triangle = {{{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{0, 1, 0}, {0, 1}}};
            triangle[std::size_t(corner)].uv = uv;
            const Scene scene = sceneOf({triangle}, {mapped(-1)}, {});
            EXPECT_EQ(lintScene(scene).primitives.at(0).uv.largestUv, 5) << corner << " " << uv.x << " " << uv.y;
        }
}

TEST(Lint, primitivesStateWhyTheirMapWasNotJudged)
{
    const auto lintOf = [](const Scene& scene) { return lintScene(scene).primitives.at(0); };
    Scene scene = sceneOf({square() + square()}, {mapped(0, "oak")}, {constant(kTilted, "bark.webp")});
    scene.meshes[0].name = "door";
    const PrimitiveLint p = lintOf(scene);
    EXPECT_EQ(p.notJudged, "");
    EXPECT_EQ(p.mesh, "door");
    EXPECT_EQ(p.material, "oak");
    EXPECT_EQ(p.triangles, 4u);
    EXPECT_EQ(p.image, 0);
    EXPECT_TRUE(p.hasUv);
    EXPECT_FALSE(p.unread);
    EXPECT_EQ(p.readings.size(), 6u);
    Scene other = scene;
    other.meshes[0].texcoords[0].clear();
    EXPECT_EQ(lintOf(other).notJudged, "no uv");
    EXPECT_FALSE(lintOf(other).hasUv);
    EXPECT_TRUE(lintOf(other).readings.empty());
    other = scene;
    other.meshes[0].texcoords[0].assign(12, {0.25f, 0.5f});
    EXPECT_EQ(lintOf(other).notJudged, "no triangle has an area both in space and in uv");
    other = scene;
    other.images[0] = Image{};
    EXPECT_EQ(lintOf(other).notJudged, "its pixels were not read");
    EXPECT_TRUE(lintOf(other).unread);
    EXPECT_TRUE(lintOf(other).readings.empty());
    other.images[0].name = "bark.webp";
    EXPECT_EQ(lintOf(other).notJudged, "bark.webp was not read");
    other = scene;
    other.materials[0].normalMap.image = -1;
    EXPECT_EQ(lintOf(other).notJudged, "");
    EXPECT_EQ(lintOf(other).image, -1);
}

TEST(Lint, inconsistentSceneIsNotChecked)
{
    Scene scene = sceneOf({square()}, {mapped(-1)}, {});
    scene.meshes[0].positions[0].x = NAN; // not a reason to refuse the scene
    EXPECT_EQ(lintScene(scene).primitives.size(), 1u);
    scene.meshes[0].material = 1;
    const LintReport report = lintScene(scene);
    EXPECT_EQ(report.defects.find("Nothing was checked: scene: "), 0u) << report.defects;
    EXPECT_EQ(report.defects.back(), '.');
    EXPECT_EQ(report.recommendation, report.defects);
    EXPECT_TRUE(report.primitives.empty());
}

TEST(Lint, primitivesOverlapIfTheyShareAMap)
{
    const auto overlapping = [](const Scene& scene) {
        std::vector<double> fractions;
        for (const PrimitiveLint& p : lintScene(scene).primitives)
            fractions.push_back(p.uv.overlapping);
        return fractions;
    };
    const auto both = {square(), square()};
    const std::vector<Image> images(2); // without pixels: uv are judged all the same
    EXPECT_EQ(overlapping(sceneOf(both, {mapped(0), mapped(1)}, images)), (std::vector<double>{0, 0}));
    EXPECT_EQ(overlapping(sceneOf(both, {mapped(-1), mapped(-1)}, {})), (std::vector<double>{0, 0}));
    Scene same = sceneOf(both, {mapped(1), mapped(1)}, images);
    same.instances.push_back({"", 0, glm::scale(glm::mat4(1), {2, 1, 1})});
    const LintReport report = lintScene(same);
    ASSERT_EQ(report.primitives.size(), 3u);
    for (const PrimitiveLint& p : report.primitives)
        EXPECT_NEAR(p.uv.overlapping, 1, 1e-9);
    EXPECT_EQ(report.primitives[1].placing, 1u);
    EXPECT_EQ(report.primitives[1].placings, 2u);
}

TEST(Lint, eachMapIsCheckedOnceAsItsFirstMaterialReadsIt)
{
    std::vector<Material> materials = {mapped(-1), mapped(1), mapped(1), mapped(0), mapped(2)};
    materials[1].normalFormat.greenUp = true;
    materials[2].normalFormat.greenUp = false;
    materials[3].normalFormat.greenUp = true;
    materials[3].greenReversed = true;
    materials[4].greenReversed = true; // green down, reversed
    const Scene scene = sceneOf({}, materials, {constant(kTilted, "a"), constant(kTilted, "b"), Image{}});
    const LintReport report = lintScene(scene);
    ASSERT_EQ(report.maps.size(), 3u);
    EXPECT_EQ(report.maps[0].image, 1);
    EXPECT_EQ(report.maps[0].name, "b");
    EXPECT_TRUE(report.maps[0].declaredUp);
    EXPECT_EQ(report.maps[1].name, "a");
    EXPECT_FALSE(report.maps[1].declaredUp);
    EXPECT_EQ(report.maps[2].image, 2);
    EXPECT_TRUE(report.maps[2].declaredUp);
    EXPECT_FALSE(report.maps[2].decided());
}

TEST(Lint, wIsComparedWithTheFileIfGreenIsReversed)
{
    Scene scene = sceneOf({square() + rectangle({2, 0}, {3, 1}, {0, 0}, {3, 1})}, {mapped(-1)}, {});
    scene.meshes[0].tangents.assign(12, glm::vec4(1, 0, 0, 1));
    for (std::size_t i = 0; i < 6; ++i)
        scene.meshes[0].tangents[i].w = -1;
    EXPECT_NEAR(lintScene(scene).primitives[0].stored.reversedW, 0.25, 1e-6);
    scene.materials[0].greenReversed = true;
    EXPECT_NEAR(lintScene(scene).primitives[0].stored.reversedW, 0.75, 1e-6);
}

// ---- how maps and coats would do -------------------------------------------------------------

TEST(Lint, fitComparesEachFrameWithTheOneOfTheMap)
{
    const auto fitOf = [&](std::optional<Frame> frame) {
        Scene scene = sceneOf({uneven()}, {mapped(1)}, {Image{}, constant(kTilted, "grain")});
        scene.materials[0].normalFrame = frame;
        const LintReport report = lintScene(scene);
        EXPECT_EQ(report.named, frame);
        EXPECT_EQ(report.primitives.at(0).madeFor, frame.value_or(Frame::mikktspace));
        EXPECT_EQ(report.fits.size(), 1u);
        EXPECT_EQ(report.fits.at(0).name, "grain");
        EXPECT_EQ(report.fits.at(0).image, 1);
        return report.fits.at(0);
    };
    const MapFit mikktspace = fitOf({}), cotangent = fitOf(Frame::cotangent), smooth = fitOf(Frame::smooth);
    EXPECT_GT(mikktspace.orthonormal.mean, 1);
    EXPECT_GT(mikktspace.cotangent.mean, 1);
    EXPECT_GT(mikktspace.smooth.mean, 1);
    EXPECT_GT(cotangent.orthonormal.mean, 1);
    EXPECT_NEAR(cotangent.cotangent.mean, 0, 1e-3);
    EXPECT_GT(cotangent.smooth.mean, 1);
    EXPECT_GT(smooth.orthonormal.mean, 1);
    EXPECT_GT(smooth.cotangent.mean, 1);
    EXPECT_NEAR(smooth.smooth.mean, 0, 1e-3);
}

TEST(Lint, coatReadsItsOwnMapWithItsOwnSampler)
{
    // Only the left texel is tilted. u starts at 1: repeat reads the left texel again, clamp the right one.
    const Image halves = floatMap(2, 1, [](int x, int) { return x == 0 ? kTilted : glm::dvec3(0, 0, 1); });
    // cotangent has half the gradient in u that it has in v, which halves the slope along u.
    const double expected = angleBetween(kTilted, {0.2, 0.3, 1});
    for (const bool ofCoat : {false, true}) {
        Scene scene = sceneOf({rectangle({0, 0}, {0.875f, 2}, {1, 0}, {1.4375f, 2})}, {mapped(0)}, {halves, halves});
        Material& m = scene.materials[0];
        m.coat.normalMap.image = 1;
        Sampler &along = ofCoat ? m.coat.normalMap.sampler : m.normalMap.sampler,
                &other = ofCoat ? m.normalMap.sampler : m.coat.normalMap.sampler;
        along.wrapV = other.wrapU = Wrap::clamp; // the other modes repeat
        const LintReport report = lintScene(scene);
        ASSERT_EQ(report.fits.size(), 2u);
        EXPECT_NEAR(report.fits[ofCoat].cotangent.mean, expected, 1e-4) << ofCoat;
        EXPECT_NEAR(report.fits[!ofCoat].cotangent.mean, 0, 1e-4) << ofCoat;
    }
}

TEST(Lint, coatUsesItsOwnNormalScale)
{
    Scene scene = sceneOf({wide()}, {mapped(0)}, {constant(kTilted), constant(kTilted)});
    scene.materials[0].coat.normalMap.image = 1;
    scene.materials[0].coat.normalScale = 2;
    EXPECT_NEAR(lintScene(scene).fits[1].cotangent.mean, angleBetween({0.8, 0.6, 1}, {0.4, 0.6, 1}), 1e-4);
    scene.materials[0].coat.normalScale = 0; // flattens the map
    const LintReport flattened = lintScene(scene);
    EXPECT_EQ(flattened.fits[1].cotangent.count, 0u);
    EXPECT_NEAR(flattened.fits[0].cotangent.mean, angleBetween(kTilted, {0.2, 0.3, 1}), 1e-4);
}

TEST(Lint, unreadCoatMapNeedsTangents)
{
    Scene scene = sceneOf({uneven()}, {mapped(1)}, {constant(kTilted), constant(kTilted)});
    scene.materials[0].tangentsFor = "KHR_materials_anisotropy";
    scene.materials[0].coat.normalMap.image = 0;
    const PrimitiveLint read = lintScene(scene).primitives.at(0);
    EXPECT_EQ(read.tangentsFor, "KHR_materials_anisotropy");
    // Both follow the lines of equal v in each triangle, which turn at the edge; `smooth` averages like tangents do.
    EXPECT_GT(read.rotation.orthonormal.mean, 5);
    EXPECT_NEAR(read.rotation.cotangent.mean, read.rotation.orthonormal.mean, 1e-3);
    EXPECT_LT(read.rotation.smooth.mean, read.rotation.orthonormal.mean - 1);
    scene.images[0] = Image{};
    const LintReport report = lintScene(scene);
    EXPECT_EQ(report.primitives.at(0).tangentsFor, "KHR_materials_clearcoat");
    EXPECT_EQ(report.primitives.at(0).rotation.orthonormal.count, 0u);
    EXPECT_EQ(report.fits.at(0).orthonormal.count, 0u);
    scene.materials[0].coat.normalMap.image = -1;
    scene.materials[0].tangentsFor.clear();
    EXPECT_EQ(lintScene(scene).primitives.at(0).tangentsFor, "");
    EXPECT_EQ(lintScene(scene).primitives.at(0).rotation.cotangent.count, 0u);
}

// 129 surfaces share the points, so each has 128 / 129 of its own; at most eight stretches of a mesh count.
TEST(Lint, manySurfacesShareTheSamplePoints)
{
    Scene scene = sceneOf({square()}, {mapped(0), mapped(-1)}, {constant(kTilted)});
    const Mesh plain = [] {
        Mesh mesh = meshOf({{{0, 0, 0}, {}}, {{1, 0, 0}, {}}, {{0, 1, 0}, {}}});
        mesh.texcoords[0].clear();
        mesh.material = 1;
        return mesh;
    }();
    while (scene.meshes.size() < 122)
        scene.meshes.push_back(plain);
    for (int i = 1; i <= 20; ++i)
        scene.instances.push_back({"", 1, glm::scale(glm::mat4(1), {float(i), 1, 1})});
    const LintReport report = lintScene(scene);
    EXPECT_EQ(report.primitives.size(), 129u);
    EXPECT_EQ(report.primitives[0].readings.at(0).error.count, 4096u * 128 / 129);
    EXPECT_EQ(report.fits.at(0).orthonormal.count, 4096u * 128 / 129);
}

// ---- progress and memory -----------------------------------------------------------------------

TEST(Lint, progressIsTheFractionOfProcessedTriangles)
{
    // 2 triangles, and 6 with two instances, one of them stretched.
    Scene scene = sceneOf({square(), square() + square() + square()}, {mapped(-1), mapped(-1)}, {});
    scene.instances.push_back({"", 1, glm::scale(glm::mat4(1), {3, 1, 1})});
    std::vector<double> fractions;
    ASSERT_TRUE(lintScene(scene, {}, [&](double fraction) {
        fractions.push_back(fraction);
        return true;
    }));
    // Progress: 0.4 of a mesh for its surface and 3 * 0.15 for its looks; then 0.05 twice for all, and 1 at the end.
    std::vector<double> expected;
    double done = 0;
    const auto add = [&](double triangles) { expected.push_back((done += triangles) / 8); };
    add(0.4 * 2);
    for (int look = 0; look < 3; ++look)
        add(0.15 * 2);
    add(0.4 * 6);
    for (int look = 0; look < 6; ++look)
        add(0.15 * 3);
    add(0.05 * 8);
    add(0.05 * 8);
    expected.push_back(1);
    ASSERT_EQ(fractions.size(), expected.size());
    for (std::size_t i = 0; i < fractions.size(); ++i)
        EXPECT_NEAR(fractions[i], expected[i], 1e-12) << i;
    for (std::size_t last = 1; last <= fractions.size(); ++last) { // stops at the last step, too
        std::size_t calls = 0;
        const auto stopped = lintScene(scene, {}, [&](double) { return ++calls < last; });
        ASSERT_FALSE(stopped) << last;
        EXPECT_EQ(stopped.error().kind, ErrorKind::stopped);
        EXPECT_EQ(calls, last);
    }
}

TEST(Lint, memoryIsAllSurfacesAndTheLargestConstruction)
{
    const auto one = square(), three = square() + square() + square();
    const std::vector<Material> materials = {mapped(-1), mapped(-1)};
    const auto bytesOf = [&](const auto&... meshes) { return lintBytes(sceneOf({meshes...}, materials, {})); };
    FrameSet frames;
    frames.set(std::size_t(Frame::mikktspace));
    frames.set(std::size_t(Frame::smooth));
    frames.set(std::size_t(Frame::areaWeighted));
    const SurfaceBytes small = surfaceBytes(6, 2, frames), large = surfaceBytes(18, 6, frames);
    EXPECT_LT(small.making, large.making);
    EXPECT_EQ(bytesOf(one), small.kept + small.making + 2 * kRasterBytes);
    EXPECT_EQ(bytesOf(one, three), small.kept + large.kept + large.making + 8 * kRasterBytes);
    EXPECT_EQ(bytesOf(three, one), bytesOf(one, three));

    Scene scene = sceneOf({one}, materials, {});
    scene.name = "house";
    const std::size_t bytes = lintBytes(scene);
    EXPECT_TRUE(lintScene(scene, {.memory = bytes}, {}));
    EXPECT_TRUE(lintScene(scene, {.memory = 0}, {}));
    EXPECT_FALSE(lintScene(scene, {.memory = bytes - 1}, {}));
    EXPECT_EQ(lintScene(scene, {.memory = 1}).primitives.size(), 1u); // this overload ignores the limit
    std::vector<std::uint32_t>& indices = scene.meshes[0].indices;
    while (indices.size() < 300000)
        indices.insert(indices.end(), indices.begin(), indices.end());
    const auto refused = lintScene(scene, {.memory = 3 << 20}, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::input);
    EXPECT_NE(refused.error().message.find("house: its triangles take " + std::to_string(lintBytes(scene) / 1048576)
                                           + " MiB to judge, the limit is 3 MiB"),
              std::string::npos)
        << refused.error().message;
}

// Frames differ by the more, the more a map tilts the normal.
TEST(LintScene, whatItCallsInvisibleItAdvises)
{
    std::vector<bool> invisible;
    for (double tilt = 1; tilt > 0.005; tilt *= 0.7) {
        Scene scene;
        scene.images = {constant({tilt * 0.4, tilt * 0.3, 1})};
        scene.materials = {mapped(0)};
        scene.meshes = {makeSphere(1, 12)};
        scene.meshes[0].material = 0;
        scene.instances = {{"", 0, glm::mat4(1)}};
        const LintReport report = lintScene(scene);
        ASSERT_EQ(report.decisions.size(), 1u);
        invisible.push_back(report.seen.find("invisible") != std::string::npos);
        EXPECT_EQ(invisible.back(), report.decisions[0].frame == Frame::orthonormal)
            << "tilt " << tilt << ": " << report.recommendation;
        EXPECT_EQ(report.worst.empty(), invisible.back());
    }
    EXPECT_FALSE(invisible.front());
    EXPECT_TRUE(invisible.back());
}

} // namespace
} // namespace cotan
