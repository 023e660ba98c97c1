// Ground shadows compared with rays to an area light and to the sky.
#include "cotan/view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/loops.hpp"
#include "ground_scene.hpp"
#include "scene/environment_map.hpp"
#include "scene/render_text.hpp"

namespace cotan {
namespace {

using namespace test;
using glm::dvec3;
using glm::vec2;
using glm::vec3;

// The fraction of unoccluded rays to the sky, with the cosine weight of a level plane.
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
    double mean = 0, maximum = 0;
    double darkest = 1; // of the expected values
};

// Compares the central texels of the map, where the shadow does not fade.
template<class Expected> Difference compared(const GroundMap& map, const Expected& expected)
{
    Difference d;
    int count = 0;
    for (int z = 0; z < 48; ++z)
        for (int x = 0; x < 48; ++x) {
            const vec2 at = map.low + map.extent * (vec2(float(x), float(z)) / 60.0f + 0.1f);
            const double truth = expected(dvec3(at.x, 0, at.y));
            const double error = std::abs(groundVisibilityAt(map, at) - truth);
            d.mean += error;
            d.maximum = std::max(d.maximum, error);
            d.darkest = std::min(d.darkest, truth);
            ++count;
        }
    d.mean /= count;
    return d;
}

TEST(Ground, shadowOfALampMatchesRaysToItsDisc)
{
    const Solids solids;
    const View view = sunnyView();
    const auto map = makeGround(sceneOf(solids), view);
    ASSERT_TRUE(map);
    EXPECT_NEAR(map->height, 0, 1e-6f);
    const dvec3 toLight = -dvec3(view.lights[0].direction);
    const Difference d =
        compared(*map, [&](const dvec3& p) { return tracedTransmittance(solids, p, toLight, kSoftness); });
    EXPECT_EQ(d.darkest, 0);
    // At the box the shadow has an edge, which the map blurs over two texels.
    EXPECT_LT(d.mean, 0.01);
    EXPECT_LT(d.maximum, 0.5);
}

TEST(Ground, darkeningIsTheFractionOfTheSkyThatRaysMiss)
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
    EXPECT_LT(d.maximum, 0.5);
}

TEST(Ground, aLampWithoutADirectionShinesFromAbove)
{
    const Solids solids;
    View view = sunnyView();
    view.lights[0].direction = {0, -1, 0};
    const auto above = makeGround(sceneOf(solids), view);
    view.lights[0].direction = {0, 0, 0};
    const auto none = makeGround(sceneOf(solids), view);
    ASSERT_TRUE(above && none);
    EXPECT_EQ(compared(*none, [&](const dvec3& p) { return groundVisibilityAt(*above, vec2(p.x, p.z)); }).maximum, 0);
}

TEST(Ground, lampAndSkyAreWeightedByTheirIrradianceOnTheGround)
{
    const Solids solids;
    View view = sunnyView();
    view.environment = true;
    view.lights[0].direction = glm::normalize(vec3(0.9f, -0.6f, -0.5f)); // low: 0.5 of the light from above
    view.lights[0].color = {1, 0.5f, 0.25f};
    view.lights[0].intensity = 2.5f;
    const auto map = makeGround(sceneOf(solids), view);
    ASSERT_TRUE(map);
    const dvec3 toLight = -dvec3(view.lights[0].direction);
    const auto luminance = [](const dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; };
    const double lamp = luminance(view.lights[0].color) * 2.5 * toLight.y / std::numbers::pi;
    const double sky = luminance(f32::cotan_environment(vec3(0, 1, 0), 1));
    const Difference d = compared(*map, [&](const dvec3& p) {
        return (lamp * tracedTransmittance(solids, p, toLight, kSoftness) + sky * skyTraced(solids, p)) / (lamp + sky);
    });
    EXPECT_LT(d.mean, 0.02); // far from the solids the darkening of the sky fades
    EXPECT_LT(d.maximum, 0.5);
}

// Around a centred box the sky's darkening is equal on all sides.
TEST(Ground, darkeningIsSymmetricAndFadesAtTheEdgesOfTheMap)
{
    Scene scene;
    add(scene, makeCube(1, 1), translationScale({0, 0.5, 0}, dvec3(1)));
    View view = sunnyView();
    view.environment = true;
    view.lights.clear();
    const auto map = makeGround(scene, view);
    ASSERT_TRUE(map);
    vec2 apart(0), total(0);
    constexpr int kPoints = 60;
    for (int i = 0; i < kPoints; ++i)
        for (int k = -kPoints; k < kPoints; ++k) {
            const vec2 at(0.5f + 0.3f * (float(i) + 0.5f) / kPoints, 0.8f * (float(k) + 0.5f) / kPoints);
            apart.x += groundVisibilityAt(*map, at) - groundVisibilityAt(*map, {-at.x, at.y});
            apart.y += groundVisibilityAt(*map, {at.y, at.x}) - groundVisibilityAt(*map, {at.y, -at.x});
            total += 1.0f;
        }
    EXPECT_NEAR(apart.x / total.x, 0, 0.004);
    EXPECT_NEAR(apart.y / total.y, 0, 0.004);
    const int side = map->visibility.width;
    for (int i = 0; i < side; ++i)
        for (const int texel : {i, (side - 1) * side + i, i * side, i * side + side - 1})
            EXPECT_NEAR(map->visibility.floats()[4 * texel], 1, 1e-3f);
}

// Darkness vanishes before the map ends, decreases outwards, and never faster than beside the box: the map's square is
// not visible.
TEST(Ground, skyDarkeningEndsWithoutAVisibleEdge)
{
    Scene scene;
    add(scene, makeCube(1, 1), translationScale({0, 0.5, 0}, dvec3(1)));
    View view = sunnyView();
    view.environment = true;
    for (const bool lamp : {false, true}) {
        if (!lamp)
            view.lights.clear();
        else
            view.lights = sunnyView().lights;
        const auto map = makeGround(scene, view);
        ASSERT_TRUE(map);
        const auto darkness = [&](vec2 at) { return 1 - groundVisibilityAt(*map, at); };
        const vec2 high = map->low + map->extent;
        for (int i = 0; i <= 100; ++i) { // a twentieth inside the map's edges: half of an 8-bit level
            const vec2 along = glm::mix(map->low, high, float(i) / 100);
            const vec2 inset = map->extent * 0.05f;
            for (const vec2 at : {vec2(along.x, map->low.y + inset.y), vec2(along.x, high.y - inset.y),
                                  vec2(map->low.x + inset.x, along.y), vec2(high.x - inset.x, along.y)})
                EXPECT_LT(darkness(at), 0.002f) << at.x << " " << at.y;
        }
        if (lamp)
            continue;
        for (const float angle : {0.0f, 0.3f, 0.6f, 0.785f}) { // steps of a fiftieth of the box outwards
            const vec2 direction(std::cos(angle), std::sin(angle));
            float before = darkness(direction * 0.8f), steepest = 0;
            for (float radius = 0.82f; radius < 2.2f; radius += 0.02f) {
                const float here = darkness(direction * radius);
                EXPECT_LT(here, before + 0.002f) << angle << " " << radius; // noise of 512 rays
                if (radius < 1)
                    steepest = std::max(steepest, before - here);
                else
                    EXPECT_LE(before - here, steepest) << angle << " " << radius;
                before = here;
            }
        }
    }
}

// The unshadowed fraction of light below the middle of a pane.
float litFractionUnder(const Material& material, float vertexAlpha = 1)
{
    Scene scene;
    add(scene, makePlane(1, 1, 1), translationScale({0, 0.2, 0}, dvec3(1)));
    scene.materials[0] = material;
    if (vertexAlpha < 1)
        scene.meshes[0].colors.assign(scene.meshes[0].vertexCount(), glm::vec4(1, 1, 1, vertexAlpha));
    View view = sunnyView();
    view.lights[0].direction = {0, -1, 0};
    GroundOptions floor;
    floor.height = 0;
    const auto map = makeGround(scene, view, floor);
    return map ? groundVisibilityAt(*map, {0, 0}) : -1;
}

TEST(Ground, masksCastFullShadowsAndBlendedSurfacesByAlpha)
{
    Material material;
    EXPECT_EQ(litFractionUnder(material), 0);
    material.alphaMode = AlphaMode::mask;
    EXPECT_EQ(litFractionUnder(material), 0);
    EXPECT_EQ(litFractionUnder(material, 0.4f), 1);
    EXPECT_EQ(litFractionUnder(material, 0.6f), 0);
    material.baseColor.w = 0.3f;
    EXPECT_EQ(litFractionUnder(material), 1);
    material.alphaCutoff = 0.2f;
    EXPECT_EQ(litFractionUnder(material), 0);
    EXPECT_EQ(litFractionUnder(material, 0.6f), 1); // 0.18
    material.alphaMode = AlphaMode::blend;
    EXPECT_NEAR(litFractionUnder(material), 0.7f, 1e-3f); // a half of it
    EXPECT_NEAR(litFractionUnder(material, 0.5f), 0.85f, 1e-3f);
    material.baseColor.w = 1;
    EXPECT_EQ(litFractionUnder(material), 0);
    EXPECT_NEAR(litFractionUnder(material, 0.25f), 0.75f, 1e-3f);
    material.transmission.strength = 1; // clear glass
    EXPECT_EQ(litFractionUnder(material), 1);
}

// A checkerboard of transparent and opaque squares that are smaller than a column of the ground map.
TEST(Ground, texelAlphaIsTheFractionOfLightBlocked)
{
    Image holes = makeImage(1024, 1024, PixelType::unorm8, "holes");
    for (int i = 0; i < 1024 * 1024; ++i) {
        std::uint8_t* texel = holes.bytes8() + 4 * i;
        texel[0] = texel[1] = texel[2] = 255;
        texel[3] = ((i % 1024) ^ (i / 1024)) & 1 ? 255 : 0;
    }
    Scene scene;
    add(scene, makePlane(1, 1, 1), translationScale({0, 0.2, 0}, dvec3(1)));
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.materials[0].baseColorMap.image = 0;
    scene.images.push_back(holes);
    View view = sunnyView();
    view.lights[0].direction = {0, -1, 0};
    GroundOptions floor;
    floor.height = 0;
    const auto map = makeGround(scene, view, floor);
    ASSERT_TRUE(map);
    float mean = 0;
    for (int i = 0; i < 400; ++i)
        mean += groundVisibilityAt(*map, vec2(float(i % 20), float(i / 20)) / 50.0f - 0.2f) / 400;
    EXPECT_NEAR(mean, 0.5f, 0.05f); // four reads of a column's 28 texels, averaged over the columns
}

TEST(Ground, transmittancesOfStackedPanesMultiply)
{
    View view = sunnyView();
    view.lights[0].direction = {0, -1, 0};
    GroundOptions floor;
    floor.height = 0;
    const auto under = [&](const Scene& scene) {
        const auto map = makeGround(scene, view, floor);
        return map ? groundVisibilityAt(*map, {0, 0}) : -1;
    };
    Scene panes;
    add(panes, makePlane(1, 1, 1), translationScale({0, 0.2, 0}, dvec3(1)));
    add(panes, makePlane(1, 1, 1), translationScale({0, 0.4, 0}, dvec3(1)));
    panes.materials[0].alphaMode = AlphaMode::blend;
    panes.materials[0].baseColor.w = 0.6f;
    EXPECT_NEAR(under(panes), 0.16f, 1e-3f);
    Scene box; // its top and its bottom
    add(box, makeCube(1, 1), translationScale({0, 0.3, 0}, {1, 0.2, 1}));
    box.materials[0] = panes.materials[0];
    EXPECT_NEAR(under(box), 0.16f, 1e-3f);
    add(box, makeCube(1, 1), translationScale({0, 0.3, 0}, {0.9, 0.1, 0.9})); // and a solid inside
    box.materials.resize(2);
    box.meshes.back().material = 1;
    EXPECT_EQ(under(box), 0);
}

TEST(Ground, shadowsAreIndependentOfScaleAndPosition)
{
    const Solids solids;
    const View view = sunnyView();
    const auto usual = makeGround(sceneOf(solids), view);
    ASSERT_TRUE(usual);
    for (const float scale : {1e-6f, 1e4f}) {
        Scene scene = sceneOf(solids);
        for (Instance& instance : scene.instances)
            instance.toWorld = translationScale(dvec3(10, -3, 7) * double(scale), dvec3(scale)) * instance.toWorld;
        const auto map = makeGround(scene, view);
        ASSERT_TRUE(map);
        EXPECT_NEAR(map->height, -3 * scale, 1e-5f * scale);
        for (const vec2 at : {vec2(0.5f, -0.6f), vec2(0, -0.5f), vec2(-0.2f, -0.3f), vec2(0.3f, 0.5f)})
            EXPECT_NEAR(groundVisibilityAt(*map, (at + vec2(10, 7)) * scale), groundVisibilityAt(*usual, at), 0.02f);
    }
    EXPECT_FALSE(makeGround(Scene{}, view));
    View dark = view;
    dark.lights.clear();
    EXPECT_FALSE(makeGround(sceneOf(solids), dark));
    dark.lights.resize(1);
    dark.lights[0].kind = LightKind::point; // point lights have no shadow here
    EXPECT_FALSE(makeGround(sceneOf(solids), dark));
    Scene odd = sceneOf(solids);
    odd.meshes[0].positions[7] = vec3(std::nanf(""), 0, 1e38f);
    odd.instances[1].toWorld[3].x = std::numeric_limits<float>::infinity();
    const auto map = makeGround(odd, view);
    ASSERT_TRUE(map);
    for (std::size_t i = 0; i < map->visibility.pixelCount(); ++i)
        ASSERT_TRUE(map->visibility.floats()[4 * i] >= 0 && map->visibility.floats()[4 * i] <= 1);
}

TEST(Ground, theMapDoesNotDependOnThreads)
{
    std::optional<GroundMap> one, many;
    withThreads(1, [&] { one = makeGround(sceneOf({}), sunnyView()); });
    withThreads(2, [&] { many = makeGround(sceneOf({}), sunnyView()); });
    ASSERT_TRUE(one && many);
    EXPECT_EQ(one->visibility.data, many->visibility.data);
}

} // namespace
} // namespace cotan
