// Soft shadows and the ground, against rays to an area light; exposure by the picture.
#include "cotan/ground/ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "cotan/draw/exposure.hpp"
#include "cotan/draw/painter.hpp"
#include "cotan/environment/environment.hpp"
#include "cotan/parallel/loops.hpp"
#include "cotan/scene/picture_text.hpp"
#include "cotan/shapes/shapes.hpp"

namespace cotan {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;

// What stands there, as a formula and as a mesh: a ball, and a box that is as wide as it is deep.
struct Solids {
    dvec3 ballCentre{-0.6, 0.9, 0.1};
    double ballRadius = 0.4;
    dvec3 boxLow{0.3, 0, -0.4}, boxHigh{0.7, 1.2, 0};

    bool stop(const dvec3& from, const dvec3& d) const
    {
        const dvec3 c = from - ballCentre;
        const double b = glm::dot(c, d), root = b * b - glm::dot(c, c) + ballRadius * ballRadius;
        if (root > 0 && -b + std::sqrt(root) > 0)
            return true;
        double first = 1e-6, last = 1e9;
        for (int i = 0; i < 3; ++i) {
            const double in = (boxLow[i] - from[i]) / d[i], out = (boxHigh[i] - from[i]) / d[i];
            first = std::max(first, std::min(in, out));
            last = std::min(last, std::max(in, out));
        }
        return first < last;
    }
};

void add(Scene& scene, Mesh mesh, const glm::mat4& toWorld)
{
    scene.materials.resize(1);
    scene.materials[0].metallic = 0;
    Instance instance;
    instance.mesh = int(scene.meshes.size());
    instance.toWorld = toWorld;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back(instance);
}

glm::mat4 placed(const dvec3& at, const dvec3& size)
{
    glm::mat4 m(1);
    for (int i = 0; i < 3; ++i)
        m[i][i] = float(size[i]);
    m[3] = glm::vec4(vec3(at), 1);
    return m;
}

Scene sceneOf(const Solids& solids)
{
    Scene scene;
    add(scene, makeSphere(1, 96), placed(solids.ballCentre, dvec3(solids.ballRadius)));
    add(scene, makeCube(1, 1), placed((solids.boxLow + solids.boxHigh) / 2.0, solids.boxHigh - solids.boxLow));
    return scene;
}

constexpr float kSoftness = 0.12f;

View sunnyView()
{
    View view;
    view.environment = false;
    view.shadowSoftness = kSoftness;
    view.lights.resize(1);
    view.lights[0].direction = glm::normalize(vec3(0.6f, -0.9f, -0.5f));
    return view;
}

// The share of rays to a disc around the light that nothing stops.
double lightTraced(const Solids& solids, const dvec3& from, const dvec3& toLight, double softness)
{
    const dvec3 right = glm::normalize(glm::cross(toLight, dvec3(0, 1, 0))), up = glm::cross(right, toLight);
    constexpr int kSide = 24;
    int seen = 0, passed = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const double x = (2 * (i % kSide) + 1.0) / kSide - 1, y = (2 * (i / kSide) + 1.0) / kSide - 1;
        if (x * x + y * y > 1)
            continue;
        ++seen;
        passed += !solids.stop(from, glm::normalize(toLight + (right * x + up * y) * softness));
    }
    return double(passed) / seen;
}

// The same of the sky, as it lights a level plane.
double skyTraced(const Solids& solids, const dvec3& from)
{
    constexpr int kSide = 40;
    int passed = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const double u = (i % kSide + 0.5) / kSide, phi = 2 * std::numbers::pi * (i / kSide + 0.5) / kSide;
        const double side = std::sqrt(u);
        passed += !solids.stop(from, {side * std::cos(phi), std::sqrt(1 - u), side * std::sin(phi)});
    }
    return double(passed) / (kSide * kSide);
}

struct Difference {
    double mean = 0, most = 0;
    double darkest = 1; // of what was expected
};

// Over the places that the middle of the map has, from where nothing fades.
template<class Expected> Difference compared(const GroundMap& map, const Expected& expected)
{
    Difference d;
    int count = 0;
    for (int z = 0; z < 48; ++z)
        for (int x = 0; x < 48; ++x) {
            const vec2 place = map.low + map.extent * (vec2(float(x), float(z)) / 60.0f + 0.1f);
            const double wanted = expected(dvec3(place.x, 0, place.y));
            const double off = std::abs(groundShareAt(map, place) - wanted);
            d.mean += off;
            d.most = std::max(d.most, off);
            d.darkest = std::min(d.darkest, wanted);
            ++count;
        }
    d.mean /= count;
    return d;
}

TEST(Ground, shadowOfALampIsThatOfRaysToItsDisc)
{
    const Solids solids;
    const View view = sunnyView();
    const auto map = makeGround(sceneOf(solids), view);
    ASSERT_TRUE(map);
    EXPECT_NEAR(map->height, 0, 1e-6f);
    const dvec3 toLight = -dvec3(view.lights[0].direction);
    const Difference d = compared(*map, [&](const dvec3& p) { return lightTraced(solids, p, toLight, kSoftness); });
    EXPECT_EQ(d.darkest, 0);
    // Where the box stands the shadow has an edge, which the map spreads over two places.
    EXPECT_LT(d.mean, 0.01);
    EXPECT_LT(d.most, 0.5);
}

TEST(Ground, darkeningIsTheSkyThatRaysDoNotReach)
{
    const Solids solids;
    View view = sunnyView();
    view.environment = true;
    view.lights.clear();
    const auto map = makeGround(sceneOf(solids), view);
    ASSERT_TRUE(map);
    const Difference d = compared(*map, [&](const dvec3& p) { return skyTraced(solids, p); });
    EXPECT_LT(d.darkest, 0.1);
    EXPECT_LT(d.mean, 0.02);
    EXPECT_LT(d.most, 0.5);
}

// The share of a pane's shadow in the middle below it.
float shareUnder(const Material& material)
{
    Scene scene;
    add(scene, makePlane(1, 1, 1), placed({0, 0.2, 0}, dvec3(1)));
    scene.materials[0] = material;
    View view = sunnyView();
    view.lights[0].direction = {0, -1, 0};
    GroundOptions floor;
    floor.height = 0;
    const auto map = makeGround(scene, view, floor);
    return map ? groundShareAt(*map, {0, 0}) : -1;
}

TEST(Ground, masksThrowShadowsWhereTheyAreAndPanesNone)
{
    Material material;
    EXPECT_EQ(shareUnder(material), 0);
    material.alphaMode = AlphaMode::mask;
    EXPECT_EQ(shareUnder(material), 0);
    material.baseColor.w = 0.3f;
    EXPECT_EQ(shareUnder(material), 1);
    material.alphaMode = AlphaMode::blend;
    EXPECT_EQ(shareUnder(material), 1);
}

TEST(Ground, everyScaleAndPlaceHasTheSameShadowAndNothingHasNone)
{
    const Solids solids;
    const View view = sunnyView();
    const auto usual = makeGround(sceneOf(solids), view);
    ASSERT_TRUE(usual);
    for (const float scale : {1e-6f, 1e4f}) {
        Scene scene = sceneOf(solids);
        for (Instance& instance : scene.instances)
            instance.toWorld = placed(dvec3(10, -3, 7) * double(scale), dvec3(scale)) * instance.toWorld;
        const auto map = makeGround(scene, view);
        ASSERT_TRUE(map);
        EXPECT_NEAR(map->height, -3 * scale, 1e-5f * scale);
        for (const vec2 place : {vec2(0.5f, -0.6f), vec2(0, -0.5f), vec2(-0.2f, -0.3f), vec2(0.3f, 0.5f)})
            EXPECT_NEAR(groundShareAt(*map, (place + vec2(10, 7)) * scale), groundShareAt(*usual, place), 0.02f);
    }
    EXPECT_FALSE(makeGround(Scene{}, view));
    View dark = view;
    dark.lights.clear();
    EXPECT_FALSE(makeGround(sceneOf(solids), dark));
    Scene odd = sceneOf(solids);
    odd.meshes[0].positions[7] = vec3(std::nanf(""), 0, 1e38f);
    odd.instances[1].toWorld[3].x = std::numeric_limits<float>::infinity();
    const auto map = makeGround(odd, view);
    ASSERT_TRUE(map);
    for (std::size_t i = 0; i < map->shares.pixelCount(); ++i)
        ASSERT_TRUE(map->shares.floats()[4 * i] >= 0 && map->shares.floats()[4 * i] <= 1);
}

TEST(Ground, theMapHasTheSameBytesForAnyNumberOfThreads)
{
    std::optional<GroundMap> one, many;
    withThreads(1, [&] { one = makeGround(sceneOf({}), sunnyView()); });
    withThreads(2, [&] { many = makeGround(sceneOf({}), sunnyView()); });
    ASSERT_TRUE(one && many);
    EXPECT_EQ(one->shares.data, many->shares.data);
}

std::vector<std::unique_ptr<Painter>> painters()
{
    std::vector<std::unique_ptr<Painter>> all;
    all.push_back(*openPainter("reference"));
    auto gpu = openPainter("auto");
    if (gpu && (*gpu)->note.empty())
        all.push_back(std::move(*gpu));
    return all;
}

// Percentage-closer filtering takes one distance for all that stands before the lamp, and one disc for the search: the
// bar is what that leaves on the floor under a ball and a box; sharp shadows are off by three times as much.
TEST(SoftShadows, areThoseOfRaysToTheLampsDisc)
{
    const Solids solids;
    Scene scene = sceneOf(solids);
    add(scene, makePlane(6, 1, 1), glm::mat4(1));
    View view = sunnyView();
    view.width = view.height = 96;
    view.camera.orthographic = true;
    view.camera.verticalExtent = 4;
    view.camera.eye = {0, 5, 0};
    view.camera.up = {0, 0, -1};
    view.linearOutput = true;
    view.samples = 1;
    view.shadowSoftness = 0.06f;
    const dvec3 toLight = -dvec3(view.lights[0].direction);
    for (const auto& painter : painters()) {
        ASSERT_TRUE(painter->load(scene));
        const auto meanError = [&](const View& drawn) {
            View bare = drawn;
            bare.shadows = false;
            const auto with = painter->draw(drawn), without = painter->draw(bare);
            double sum = 0;
            int count = 0;
            for (int i = 0; with && without && i < 96 * 96; ++i) {
                const dvec3 p((i % 96 + 0.5) / 24 - 2, 0, (i / 96 + 0.5) / 24 - 2);
                if (solids.stop(p, {1e-9, 1, 1e-9}))
                    continue; // not the floor
                const double share = with->floats()[4 * i] / double(without->floats()[4 * i]);
                sum += std::abs(share - lightTraced(solids, p, toLight, view.shadowSoftness));
                ++count;
            }
            EXPECT_GT(count, 5000);
            return sum / count;
        };
        View sharp = view;
        sharp.shadowSoftness = 0;
        EXPECT_LT(meanError(view), 0.003) << painter->device();
        EXPECT_GT(meanError(sharp), 0.007) << painter->device();
    }
}

TEST(SoftShadows, convexSolidsDoNotShadeTheirLitSides)
{
    Scene scene = sceneOf({});
    scene.instances.resize(1); // the ball
    View view = sunnyView();
    view.width = view.height = 128;
    view.camera.eye = vec3(-0.6f, 0.9f, 0.1f) - view.lights[0].direction * 2.0f;
    view.camera.target = {-0.6f, 0.9f, 0.1f};
    view.linearOutput = true;
    view.samples = 1;
    for (const auto& painter : painters()) {
        ASSERT_TRUE(painter->load(scene));
        View bare = view;
        bare.shadows = false;
        const auto with = painter->draw(view), without = painter->draw(bare);
        ASSERT_TRUE(with && without);
        for (std::size_t i = 0; i < with->pixelCount(); ++i)
            ASSERT_NEAR(with->floats()[4 * i], without->floats()[4 * i], 0.004f) << painter->device() << " " << i;
    }
}

TEST(SoftShadows, bothRenderersDrawTheSameOverEveryBackground)
{
    const auto all = painters();
    if (all.size() < 2)
        GTEST_SKIP() << "no Vulkan device";
    Scene scene = sceneOf({});
    add(scene, makeTorus(0.3f, 0.1f, 48, 1, 1), placed({0, 0.4, 0.6}, dvec3(1)));
    scene.materials.resize(2);
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.materials[1].baseColor = {0.2f, 0.8f, 0.3f, 0.5f};
    scene.meshes.back().material = 1;
    View view = sunnyView();
    view.width = 240, view.height = 180;
    view.environment = true;
    view.environmentMap = std::make_shared<const EnvironmentMap>(makeEnvironment(*builtinRadiance("studio"), 1));
    auto ground = makeGround(scene, view);
    ASSERT_TRUE(ground);
    view.ground = std::make_shared<const GroundMap>(std::move(*ground));
    view.camera.eye = {1.5f, 1.6f, 4};
    view.camera.target = {0, 0.5f, 0};
    view.camera.verticalExtent = 3;
    for (const auto& painter : all)
        ASSERT_TRUE(painter->load(scene));
    for (const Backdrop backdrop : {Backdrop::gradient, Backdrop::blurred, Backdrop::sharp, Backdrop::paper})
        for (const bool background : {true, false})
            for (const bool orthographic : {false, true}) {
                view.backdrop = backdrop;
                view.background = background;
                view.camera.orthographic = orthographic;
                const auto a = all[0]->draw(view), b = all[1]->draw(view);
                ASSERT_TRUE(a && b);
                int large = 0;
                for (std::size_t i = 0; i < a->data.size(); ++i)
                    large += std::abs(int(a->bytes8()[i]) - int(b->bytes8()[i])) > 3;
                // Rims of the shadow on the solids, whose maps have texels of their own.
                EXPECT_LT(large, int(a->data.size()) / 100) << int(backdrop) << background << orthographic;
                if (background)
                    continue;
                // The shadow alone: black, as opaque as it is dark.
                const std::uint8_t* shadow = a->bytes8() + 4 * (240 * 170 + 120);
                EXPECT_EQ(shadow[0] + shadow[1] + shadow[2], 0);
                int half = 0;
                for (std::size_t i = 0; i < a->pixelCount(); ++i) {
                    const std::uint8_t* p = a->bytes8() + 4 * i;
                    half += p[0] + p[1] + p[2] == 0 && p[3] > 60 && p[3] < 240;
                }
                EXPECT_GT(half, 300);
            }
}

// A ball of clay or rubber in the studio, as it is shown.
struct Shown {
    float exposure = 0, mean = 0, most = 0; // of 255
};

Shown shown(Painter& painter, float color, float lamp)
{
    Scene scene;
    add(scene, makeSphere(1, 64), glm::mat4(1));
    scene.materials[0].baseColor = {color, color, color, 1};
    EXPECT_TRUE(painter.load(scene));
    View view = sunnyView();
    view.width = view.height = 120;
    view.environment = true;
    static const auto studio = std::make_shared<const EnvironmentMap>(makeEnvironment(*builtinRadiance("studio"), 1));
    view.environmentMap = studio;
    view.lights[0].intensity = lamp;
    view.camera.eye = {0, 0.5f, 4};
    view.toneMapping = ToneMapping::neutral;
    Shown result;
    result.exposure = *meterExposure(painter, view);
    view.exposure = result.exposure;
    view.background = false;
    const auto picture = painter.draw(view);
    int count = 0;
    for (std::size_t i = 0; picture && i < picture->pixelCount(); ++i) {
        const std::uint8_t* p = picture->bytes8() + 4 * i;
        if (p[3] < 255)
            continue;
        result.mean += p[1];
        result.most = std::max(result.most, float(p[1]));
        ++count;
    }
    result.mean /= float(count);
    return result;
}

TEST(Exposure, whiteClayIsBrightAndNotBurntOutAndRubberStaysBlack)
{
    std::vector<float> exposures;
    for (const auto& painter : painters()) {
        const Shown clay = shown(*painter, 0.9f, 3), grey = shown(*painter, 0.2f, 3),
                    rubber = shown(*painter, 0.02f, 3);
        EXPECT_LT(clay.most, 252) << painter->device();
        EXPECT_GT(clay.mean, 165) << painter->device();
        EXPECT_LT(rubber.mean, 75) << painter->device();
        EXPECT_GT(rubber.mean, 25) << painter->device();
        EXPECT_LT(clay.exposure, grey.exposure);
        EXPECT_LT(grey.exposure, rubber.exposure);
        // A thousand times the light is no other picture; a hundredth is one of what the studio still gives.
        const Shown flooded = shown(*painter, 0.9f, 3000);
        EXPECT_LT(flooded.most, 255) << painter->device();
        EXPECT_GT(flooded.mean, 60) << painter->device();
        exposures.push_back(clay.exposure);
    }
    EXPECT_NEAR(exposures.front(), exposures.back(), 0.023f * exposures.front()); // a 32nd of a stop
}

TEST(Exposure, ofNothingIsOne)
{
    const Scene nothing;
    for (const auto& painter : painters()) {
        ASSERT_TRUE(painter->load(nothing));
        EXPECT_EQ(*meterExposure(*painter, sunnyView()), 1);
    }
}

} // namespace
} // namespace cotan
