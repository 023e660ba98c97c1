// Environment lighting: compared with integrals over all directions, and drawn by both renderers.
#include "cotan/view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/loops.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "scene/environment_map.hpp"

namespace cotan {
namespace {

using glm::dvec3;
using glm::vec2;
using glm::vec3;
constexpr double kPi = std::numbers::pi;

// With metallic-roughness only.
vec3 reflectedOf(const EnvironmentMap& map, const f32::cotan_surface& s)
{
    return reflectedGlossy(map, s, f32::cotan_plain_gloss());
}

vec3 white(vec3) { return vec3(1); }

// A dark room with one wide lamp at +x, bright enough not to vanish in a mean.
vec3 lamp(vec3 d) { return vec3(0.1f, 0.2f, 0.3f) + vec3(4, 2, 1) * f32::cotan_smooth(0.7f, 0.9f, d.x); }

const EnvironmentMap& whiteMap()
{
    static const EnvironmentMap map = makeEnvironment(white, 1);
    return map;
}

const EnvironmentMap& lampMap()
{
    static const EnvironmentMap map = makeEnvironment(lamp, 2);
    return map;
}

std::vector<vec3> directions()
{
    std::vector<vec3> all;
    for (const vec3 d : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1),
                         vec3(1, 1, 1), vec3(1, -1, 0.3f), vec3(0.8f, -0.01f, -0.6f), vec3(0.8f, 0.01f, 0.6f),
                         vec3(0.6f, 0.7f, 0), vec3(-0.2f, -0.9f, 0.1f), vec3(0.5f, 0.2f, -0.5f)})
        all.push_back(glm::normalize(d));
    return all;
}

// Integrates value(direction) over the sphere in uniform steps of y and longitude.
template<class Value> dvec3 overSphere(const Value& value, int steps = 700)
{
    dvec3 sum(0);
    for (int i = 0; i < steps; ++i) {
        const double y = -1 + (2 * i + 1.0) / steps, side = std::sqrt(1 - y * y);
        for (int j = 0; j < steps; ++j) {
            const double phi = 2 * kPi * (j + 0.5) / steps;
            sum += value(dvec3(side * std::cos(phi), y, side * std::sin(phi)));
        }
    }
    return sum * (4 * kPi / (double(steps) * steps));
}

f32::cotan_surface surface(vec3 color, float metallic, float roughness, float nv)
{
    f32::cotan_surface s;
    s.base_color = color;
    s.metallic = metallic;
    s.roughness = roughness;
    s.occlusion = 1;
    s.emissive = vec3(0);
    s.n = glm::normalize(vec3(0.3f, 0.8f, 0.4f));
    const vec3 side = glm::normalize(glm::cross(s.n, vec3(1, 0, 0)));
    s.v = s.n * nv + side * std::sqrt(1 - nv * nv);
    return s;
}

TEST(Environment, whiteSurfacesAndMirrorsVanishInAWhiteFurnace)
{
    for (const float nv : {1.0f, 0.7f, 0.3f, 0.1f})
        for (const float roughness : {0.0f, 0.2f, 0.5f, 1.0f}) {
            const vec3 diffuse = reflectedOf(whiteMap(), surface(vec3(1), 0, roughness, nv));
            EXPECT_NEAR(diffuse.x, 1, 0.01) << nv << " " << roughness;
            EXPECT_EQ(diffuse.x, diffuse.z);
        }
    for (const float nv : {1.0f, 0.7f, 0.3f, 0.1f})
        for (const float roughness : {0.0f, 0.4f, 0.7f, 1.0f}) // rough surfaces get back what single scattering loses
            EXPECT_NEAR(reflectedOf(whiteMap(), surface(vec3(1), 1, roughness, nv)).x, 1, 0.01) << nv;
}

// Reference: the coat's formula for one light direction, integrated over all directions.
TEST(Environment, aCoatReflectsAWhiteFurnaceByItsAlbedo)
{
    f32::cotan_coat coat;
    coat.strength = 0.5f;
    coat.n = glm::normalize(vec3(0.3f, 0.8f, 0.4f));
    for (const float nv : {1.0f, 0.5f})
        for (const float roughness : {0.3f, 0.8f}) {
            coat.roughness = roughness;
            const vec3 v = surface(vec3(1), 0, 0, nv).v;
            f64::cotan_coat exact;
            exact.strength = 0.5, exact.roughness = roughness, exact.n = glm::normalize(dvec3(coat.n));
            const dvec3 expected = overSphere(
                [&](dvec3 l) { return dvec3(f64::cotan_reflect_coat(exact, glm::normalize(dvec3(v)), l)); }, 300);
            EXPECT_NEAR(reflectedOfCoat(whiteMap(), coat, v).y, expected.y, 0.001) << nv << " " << roughness;
        }
}

// glTF's default gloss leaves the surface unchanged; anisotropic gloss mirrors about the bent normal.
TEST(Environment, defaultGlossChangesNothingAndAnisotropyBendsTheNormal)
{
    const f32::cotan_surface s = surface(vec3(0.8f, 0.5f, 0.3f), 0.5f, 0.3f, 0.6f);
    f32::cotan_gloss gloss = f32::cotan_gloss_of(1.5f, 1, vec3(1));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(reflectedGlossy(lampMap(), s, gloss)[c], reflectedOf(lampMap(), s)[c], 1e-5f);
    gloss.anisotropy = 1;
    gloss.t = glm::normalize(glm::cross(s.n, vec3(0.2f, 0.1f, 1)));
    f32::cotan_surface perturbed = s;
    perturbed.metallic = 1;
    const vec3 n = f32::cotan_bent_normal(s.n, s.v, s.roughness, 1, gloss.t);
    const glm::vec2 albedo = albedoOf(lampMap(), s.n, s.v, s.roughness);
    const f32::cotan_bounces bounces = f32::cotan_bounces_of(perturbed.base_color, 1, albedo);
    const vec3 expected = radianceAlong(lampMap(), f32::cotan_mirrored(n, s.v), s.roughness) * bounces.once
        + irradianceAlong(lampMap(), s.n) * bounces.more;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(reflectedGlossy(lampMap(), perturbed, gloss)[c], expected[c], 1e-5f);
}

// Reference: the same metal under lamps in all directions, by the formula for one lamp, which has one bounce.
TEST(Environment, singleReflectionEqualsTheIntegralOverAllLamps)
{
    for (const float nv : {0.9f, 0.5f, 0.2f})
        for (const float roughness : {0.3f, 0.6f, 1.0f})
            for (const vec3 color : {vec3(1), vec3(0.9f, 0.6f, 0.2f)}) {
                const f32::cotan_surface s = surface(color, 1, roughness, nv);
                f64::cotan_surface exact;
                exact.base_color = s.base_color;
                exact.metallic = 1;
                exact.roughness = roughness;
                exact.n = glm::normalize(dvec3(s.n));
                exact.v = glm::normalize(dvec3(s.v));
                const dvec3 expected = overSphere([&](dvec3 l) { return f64::cotan_reflect_pbr(exact, l); }, 300);
                const vec3 found = f32::cotan_bounces_of(color, 1, albedoOf(whiteMap(), s.n, s.v, s.roughness)).once;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(found[c], expected[c], 0.01) << nv << " " << roughness;
            }
    // Seen straight on, the roughest metal loses enough for multiple scattering to matter.
    const f32::cotan_surface roughest = surface(vec3(1), 1, 1, 0.9f);
    const glm::vec2 albedo = albedoOf(whiteMap(), roughest.n, roughest.v, 1);
    EXPECT_LT(albedo.x + albedo.y, 0.4f);
}

// Each bounce multiplies by the colour: gold becomes more golden, and darker than white.
TEST(Environment, lightThatBouncesMoreThanOnceIsColouredMore)
{
    const vec3 gold(0.9f, 0.6f, 0.2f);
    const vec3 found = reflectedOf(whiteMap(), surface(gold, 1, 1, 0.7f));
    const vec3 once = reflectedOf(whiteMap(), surface(gold, 1, 0.1f, 0.7f));
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(found[c], once[c]) << c;
    EXPECT_LT(found.z / found.x, once.z / once.x);
    EXPECT_GT(found.x, 0.7f); // about two bounces of 0.9; a single bounce gives less than 0.4
}

TEST(Environment, aMirrorShowsTheEnvironment)
{
    for (const vec3& d : directions())
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(radianceAlong(lampMap(), d, 0)[c], lamp(d)[c], 0.01f) << d.x << " " << d.y << " " << d.z;
    const f32::cotan_surface s = surface(vec3(1), 1, 0, 0.6f);
    EXPECT_NEAR(reflectedOf(lampMap(), s).x, lamp(f32::cotan_mirrored(s.n, s.v)).x, 0.02f);
}

// The lobe seen straight on: GGX microfacets, weighted by the cosine.
vec3 lobesMean(const Radiance& radiance, vec3 d, float roughness)
{
    const double alpha2 = std::pow(roughness, 4);
    double weights = 0;
    const dvec3 n(d);
    const dvec3 sum = overSphere([&](dvec3 l) {
        const double nl = glm::dot(n, l);
        if (nl <= 0)
            return dvec3(0);
        const double nh2 = (1 + nl) / 2, k = 1 + (alpha2 - 1) * nh2;
        const double weight = alpha2 / (k * k) * nl;
        weights += weight;
        return dvec3(radiance(vec3(l))) * weight;
    });
    return vec3(sum / (4 * kPi) * (700.0 * 700.0) / weights);
}

// Where the map is folded, lookups are up to half a texel, 0.7 degrees, away: 0.7 % of the lamp.
TEST(Environment, filteredRadianceIsTheMeanOverTheLobe)
{
    for (const float roughness : {0.25f, 0.5f, 1.0f})
        for (const vec3& d : directions()) {
            const vec3 expected = lobesMean(lamp, d, roughness), found = radianceAlong(lampMap(), d, roughness);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], expected[c], 0.028) << roughness << ": " << d.x << " " << d.y << " " << d.z;
        }
}

// Softboxes up to a thousand times brighter than the rest: their distant contribution to dark directions is right, too.
// The tolerance is 5 %: the light of a distant texel counts at its centre.
TEST(Environment, filteredStudiosAreRightInDarkDirectionsToo)
{
    const Radiance studio = [](vec3 d) {
        const bool lit = d.z > 0.8f && d.x > 0.1f && d.x < 0.5f && d.y > -0.1f && d.y < 0.1f;
        return lit ? vec3(60) : vec3(0.05f, 0.06f, 0.08f);
    };
    const EnvironmentMap map = makeEnvironment(studio, 2);
    for (const float roughness : {0.125f, 0.25f, 0.5f, 0.75f, 1.0f})
        for (const vec3& d : directions()) {
            const vec3 expected = lobesMean(studio, d, roughness), found = radianceAlong(map, d, roughness);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], expected[c], 0.05 * expected[c])
                    << roughness << ": " << d.x << " " << d.y << " " << d.z;
        }
}

TEST(Environment, irradianceIsTheCosineWeightedMean)
{
    for (const vec3& d : directions()) {
        const dvec3 expected =
            overSphere([&](dvec3 l) { return dvec3(lamp(vec3(l))) * std::max(glm::dot(dvec3(d), l), 0.0); }) / kPi;
        const vec3 found = irradianceAlong(lampMap(), d);
        for (int c = 0; c < 3; ++c) // half a texel, 0.7 degrees, where the map is folded
            EXPECT_NEAR(found[c], expected[c], 0.008 * (1 + expected[c])) << d.x << " " << d.y << " " << d.z;
    }
}

// A sun of half a degree, 10000 times as bright as the sky. Without filtering it would cause fireflies.
TEST(Environment, aSmallSunMakesNoFireflies)
{
    const vec3 sun = glm::normalize(vec3(0.4f, 0.5f, -0.3f));
    const EnvironmentMap map = makeEnvironment(
        [&](vec3 d) {
            return vec3(1 + 1e4f * f32::cotan_smooth(std::cos(0.006f), std::cos(0.004f), glm::dot(d, sun)));
        },
        8);
    const vec3 side = glm::normalize(glm::cross(sun, vec3(0, 1, 0)));
    for (const float roughness : {0.25f, 0.375f, 0.5f, 0.75f, 1.0f}) {
        const float peak = radianceAlong(map, sun, roughness).x;
        float before = peak;
        for (float angle = 0.01f; angle < 1.5f; angle += 0.01f) {
            const float here = radianceAlong(map, sun * std::cos(angle) + side * std::sin(angle), roughness).x;
            EXPECT_LT(here, before + 0.05f * peak) << roughness << " at " << angle;
            before = here;
        }
    }
}

TEST(Environment, rotationIsCounterclockwiseFromAbove)
{
    EnvironmentOptions quarter;
    quarter.rotation = float(kPi / 2);
    quarter.intensity = 2;
    const EnvironmentMap rotated = makeEnvironment(lamp, 1, quarter);
    for (const vec3& d : directions()) {
        const vec3 after(d.z, d.y, -d.x); // +x goes to -z
        for (const float roughness : {0.0f, 0.5f})
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(radianceAlong(rotated, after, roughness)[c], 2 * radianceAlong(lampMap(), d, roughness)[c],
                            0.04f);
    }
}

// Bright columns of an otherwise black image, to find their directions in the world.
TEST(Environment, theCentreOfAnImageIsTowardsXAndItsTopUp)
{
    Image image = makeImage(64, 32, PixelType::float32, "test");
    const auto fill = [&](int x0, int x1, int y0, int y1, int channel) {
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x)
                image.floats()[4 * (y * 64 + x) + channel] = 1;
    };
    fill(28, 36, 8, 24, 0); // the middle: red
    fill(44, 52, 8, 24, 1); // a quarter to the right: green
    fill(0, 64, 0, 4, 2);   // the top: blue
    const auto map = environmentOfImage(image);
    ASSERT_TRUE(map) << map.error().message;
    const auto expectColor = [&](vec3 d, vec3 color) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(radianceAlong(*map, d, 0)[c], color[c], 1e-3f) << d.x << " " << d.y << " " << d.z;
    };
    expectColor({1, 0, 0}, {1, 0, 0});
    expectColor({0, 0, 1}, {0, 1, 0});
    expectColor({0, 1, 0}, {0, 0, 1});
    expectColor({-1, 0, 0}, {0, 0, 0});
    expectColor({0, 0, -1}, {0, 0, 0});
    expectColor({0, -1, 0}, {0, 0, 0});
}

// Ramps across the planes x = 0 and z = 0, where the map is folded below the horizon: lookups give ramps there as well.
TEST(Environment, thereIsNoSeam)
{
    const auto ramps = [](vec3 d) {
        return glm::clamp(0.5f + 50.0f * d, 0.0f, 1.0f);
    }; // a texel is up to a quarter of a ramp
    const EnvironmentMap map = makeEnvironment(ramps, 2);
    for (const float y : {-0.05f, -0.3f, -0.6f, -0.9f, 0.2f})
        for (const vec2 side : {vec2(1, 0), vec2(-1, 0), vec2(0, 1), vec2(0, -1)})
            for (const float offset : {-0.004f, -0.001f, 0.001f, 0.004f}) {
                const vec2 level = std::sqrt(1 - y * y) * side + offset * vec2(side.y, side.x);
                const vec3 d = glm::normalize(vec3(level.x, y, level.y));
                for (const int c : {0, 2})
                    EXPECT_NEAR(radianceAlong(map, d, 0)[c], ramps(d)[c], 0.02f) << d.x << ' ' << d.y << ' ' << d.z;
            }
}

// Between pixel centres an image is interpolated, also across its left and right borders.
TEST(Environment, imagesAreInterpolated)
{
    constexpr int kWidth = 16, kHeight = 8;
    Image image = makeImage(kWidth, kHeight, PixelType::float32, "test");
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const double longitude = 2 * kPi * (x + 0.5) / kWidth - kPi;
            image.floats()[4 * (y * kWidth + x)] = float(y);
            image.floats()[4 * (y * kWidth + x) + 1] = float(1 + std::sin(longitude));
        }
    const auto map = environmentOfImage(image);
    ASSERT_TRUE(map) << map.error().message;
    for (double colatitude = 0.35; colatitude < 2.8; colatitude += 0.05)
        for (double longitude = 0.1 - kPi; longitude < kPi; longitude += 0.2) {
            const vec3 d(std::sin(colatitude) * std::cos(longitude), std::cos(colatitude),
                         std::sin(colatitude) * std::sin(longitude));
            const vec3 found = radianceAlong(*map, d, 0);
            EXPECT_NEAR(found.x, colatitude / kPi * kHeight - 0.5, 0.08) << colatitude;
            // A sine interpolated between 16 values: an error of (2 pi / 16)^2 / 8 at most.
            EXPECT_NEAR(found.y, 1 + std::sin(longitude), 0.02 + 0.02) << longitude;
        }
}

TEST(Environment, imagesOfOtherShapesAndTypesAreRefused)
{
    for (const Image& wrong : {makeImage(64, 64, PixelType::float32), makeImage(0, 0, PixelType::float32),
                               makeImage(64, 32, PixelType::unorm8)}) {
        const auto map = environmentOfImage(wrong);
        ASSERT_FALSE(map);
        EXPECT_EQ(map.error().kind, ErrorKind::input);
    }
    // Values that are not light count as zero: the atlas is finite.
    Image odd = makeImage(8, 4, PixelType::float32);
    std::fill_n(odd.floats(), 8 * 4 * 4, std::nanf(""));
    odd.floats()[0] = -1;
    odd.floats()[4] = std::numeric_limits<float>::infinity();
    const auto map = environmentOfImage(odd);
    ASSERT_TRUE(map);
    for (std::size_t i = 0; i < 4 * map->atlas.pixelCount(); ++i)
        ASSERT_TRUE(map->atlas.floats()[i] >= 0 && map->atlas.floats()[i] <= 65504) << i;
}

TEST(Environment, theStoredStudioEqualsAComputedOne)
{
    const auto stored = builtinEnvironment("studio");
    const EnvironmentMap made = makeEnvironment(*builtinRadiance("studio"), 1);
    ASSERT_TRUE(stored);
    EXPECT_EQ(stored->name, "studio");
    ASSERT_EQ(stored->atlas.width, made.atlas.width);
    EXPECT_EQ(stored->atlas.data, made.atlas.data);
    EXPECT_NE(builtinEnvironment("studio", {.rotation = 0, .intensity = 2})->atlas.data, made.atlas.data);
    EXPECT_NE(builtinEnvironment("studio", {.rotation = 1, .intensity = 1})->atlas.data, made.atlas.data);
    EXPECT_FALSE(builtinEnvironment("nowhere"));
}

// An upright plate of metal, seen from slightly above, whose normals an engraving tilts up and down by 8 degrees. Where
// the room is the same in all directions that it reflects, all walls of the engraving look alike.
TEST(Environment, theStudioShowsReliefOnUprightMetals)
{
    const auto studio = builtinEnvironment("studio");
    ASSERT_TRUE(studio);
    for (const float across : {0.0f, 20.0f})
        for (const float above : {10.0f, 15.0f, 20.0f}) {
            const float a = glm::radians(across), e = glm::radians(above), tilt = glm::radians(8.0f);
            const vec3 toCamera(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
            float brightest = 0, darkest = 1e9f;
            for (const float side : {-1.0f, 0.0f, 1.0f}) {
                const vec3 normal(0, side * std::sin(tilt), std::cos(tilt)); // of the plate or of a wall
                const float radiance = radianceAlong(*studio, glm::reflect(-toCamera, glm::normalize(normal)), 0.25f).y;
                brightest = std::max(brightest, radiance);
                darkest = std::min(darkest, radiance);
            }
            EXPECT_GT(brightest, 1.5f * darkest) << across << " to the right, " << above << " above";
        }
}

TEST(Environment, theAtlasHasTheSameBytesForAnyNumberOfThreads)
{
    ASSERT_EQ(environmentNames().size(), 3u);
    EXPECT_FALSE(builtinRadiance("nowhere"));
    for (const std::string& name : environmentNames())
        ASSERT_TRUE(builtinRadiance(name)) << name;
    std::optional<EnvironmentMap> one, many;
    withThreads(1, [&] { one = makeEnvironment(*builtinRadiance("studio"), 1); });
    withThreads(2, [&] { many = makeEnvironment(*builtinRadiance("studio"), 1); });
    EXPECT_EQ(one->atlas.data, many->atlas.data);
}

// A ball of this material in front of the lamp, without other lights.
Scene ball(float metallic, float roughness)
{
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].baseColor = {0.9f, 0.7f, 0.5f, 1};
    scene.materials[0].metallic = metallic;
    scene.materials[0].roughness = roughness;
    scene.meshes.push_back(makeSphere(1, 96));
    scene.instances.resize(1);
    return scene;
}

View lampView()
{
    View view;
    view.width = view.height = 160;
    view.camera.eye = {0, 0, 3.2f};
    view.environmentMap = std::make_shared<const EnvironmentMap>(lampMap());
    view.backdrop = Backdrop::sharp;
    view.linearOutput = true;
    view.samples = 1;
    return view;
}

TEST(Environment, aMirrorBallReflectsTheEnvironmentByItsNormal)
{
    const Scene scene = ball(1, 0);
    auto renderer = openRenderer("reference");
    ASSERT_TRUE(renderer && (*renderer)->load(scene));
    View view = lampView();
    const auto shaded = (*renderer)->draw(view);
    view.output = Output::normal;
    const auto normals = (*renderer)->draw(view);
    ASSERT_TRUE(shaded && normals);
    const float half = std::tan(view.camera.verticalFieldOfView / 2);
    int covered = 0;
    for (int y = 0; y < 160; ++y)
        for (int x = 0; x < 160; ++x) {
            const float* n = normals->floats() + 4 * (y * 160 + x);
            const vec3 ray =
                glm::normalize(vec3(half * ((float(x) + 0.5f) / 80 - 1), half * (1 - (float(y) + 0.5f) / 80), -1));
            const vec3 normal(n[0], n[1], n[2]);
            if (n[3] > 0 && -glm::dot(normal, ray) < 0.4f)
                continue; // there Fresnel's term differs from the metal's
            const vec3 d = n[3] > 0 ? f32::cotan_mirrored(normal, -ray) : ray;
            const float expected = lamp(d).x * (n[3] > 0 ? 0.9f : 1.0f);
            EXPECT_NEAR(shaded->floats()[4 * (y * 160 + x)], expected, 0.02f + 0.03f * expected) << x << " " << y;
            covered += n[3] > 0;
        }
    EXPECT_GT(covered, 5000);
}

TEST(Environment, bothRenderersDrawTheSame)
{
    auto gpu = openRenderer("auto"), reference = openRenderer("reference");
    ASSERT_TRUE(gpu && reference);
    if (!(*gpu)->note.empty())
        GTEST_SKIP() << (*gpu)->note;
    View view = lampView();
    view.linearOutput = false;
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.0f, 0.4f, 1.0f})
            for (const Backdrop backdrop : {Backdrop::gradient, Backdrop::blurred, Backdrop::sharp})
                for (const ToneMapping tone : {ToneMapping::neutral, ToneMapping::agx, ToneMapping::none}) {
                    view.backdrop = backdrop;
                    view.toneMapping = tone;
                    const Scene scene = ball(metallic, roughness);
                    ASSERT_TRUE((*gpu)->load(scene) && (*reference)->load(scene));
                    const auto a = (*gpu)->draw(view), b = (*reference)->draw(view);
                    ASSERT_TRUE(a && b);
                    int large = 0;
                    for (std::size_t i = 0; i < a->data.size(); ++i)
                        large += std::abs(int(a->bytes8()[i]) - int(b->bytes8()[i])) > 2;
                    // Only one renderer covers some pixels at the silhouette; the others differ by rounding.
                    EXPECT_LT(large, int(a->data.size()) / 200) << metallic << " " << roughness << " " << int(tone);
                }
}

} // namespace
} // namespace cotan
