// Lint's measurements on shapes whose values can be derived by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/lint.hpp"
#include "cotan/scene.hpp"
#include "truth/tessellation.hpp"

namespace cotan {
namespace {

// A float map with the same texel everywhere; m is along (+u, +v, outwards).
Image constantMap(glm::dvec3 m)
{
    Image image = makeImage(4, 4, PixelType::float32, "constant");
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        float* p = image.floats() + 4 * i;
        p[0] = float(m.x);
        p[1] = float(m.y);
        p[2] = float(m.z);
        p[3] = 1;
    }
    return image;
}

// One or several meshes with one material and a map.
Scene sceneOf(std::vector<Mesh> meshes, Image map = makeReliefMap(Relief::waves, 64))
{
    Scene scene;
    scene.images.push_back(std::move(map));
    Material material;
    material.normalMap.image = 0;
    if (scene.images[0].type == PixelType::float32)
        material.normalFormat = {.expansion = Expansion::signedValues,
                                 .greenUp = false}; // signed, green along v: stored without conversion
    scene.materials.push_back(material);
    for (Mesh& mesh : meshes) {
        scene.instances.push_back({"", int(scene.meshes.size()), glm::mat4(1)});
        scene.meshes.push_back(std::move(mesh));
    }
    return scene;
}

PrimitiveLint lintOf(Mesh mesh, Image map = makeReliefMap(Relief::waves, 64))
{
    return lintScene(sceneOf({std::move(mesh)}, std::move(map))).primitives.at(0);
}

ValueSummary errorOf(const PrimitiveLint& p, const std::string& frame)
{
    for (const Reading& r : p.readings)
        if (r.name == frame)
            return r.error;
    ADD_FAILURE() << "no " << frame;
    return {};
}

// Positions and uv are floats: ratios and angles of their differences are accurate to about 1e-6.
constexpr double kFloat = 1e-4;

TEST(Lint, twoToOnePatchHasStretchTwoAndNoShear)
{
    const PrimitiveLint p = lintOf(makePatch(2, 0, false, 4));
    EXPECT_NEAR(p.uv.stretch.mean, 2, kFloat);
    EXPECT_NEAR(p.uv.stretch.maximum, 2, kFloat);
    EXPECT_NEAR(p.uv.shear.maximum, 0, kFloat);
    EXPECT_NEAR(p.uv.stretched, 1, 1e-9);
    EXPECT_EQ(p.uv.sheared, 0);
    EXPECT_EQ(p.uv.mirrored, 0);
}

TEST(Lint, unitShearIs45DegreesAndStretchesByTheGoldenRatioSquared)
{
    // grad u = (1,-1), grad v = (0,1): 135 degrees apart; singular values of a unit shear.
    const PrimitiveLint p = lintOf(makePatch(1, 1, false, 4));
    EXPECT_NEAR(p.uv.shear.mean, 45, kFloat);
    EXPECT_NEAR(p.uv.stretch.mean, (3 + std::sqrt(5.0)) / 2, kFloat);
    EXPECT_NEAR(p.uv.sheared, 1, 1e-9);
}

TEST(Lint, mirroringIsDetectedInUvAndInNodes)
{
    EXPECT_NEAR(lintOf(makePatch(1, 0, true, 4)).uv.mirrored, 1, 1e-9);
    Scene scene = sceneOf({makePatch(1, 0, false, 4)});
    scene.instances[0].toWorld[0][0] = -1;
    EXPECT_NEAR(lintScene(scene).primitives[0].uv.mirrored, 1, 1e-9);
}

TEST(Lint, nodeScaleStretchesTheUv)
{
    Scene scene = sceneOf({makePatch(1, 0, false, 4)});
    scene.instances[0].toWorld[0][0] = 3;
    EXPECT_NEAR(lintScene(scene).primitives[0].uv.stretch.mean, 3, kFloat);
}

TEST(Lint, uvInOnePointAreDegenerateWithoutAnError)
{
    Mesh mesh = makePatch(1, 0, false, 4);
    for (glm::vec2& uv : mesh.texcoords[0])
        uv = {0.3f, 0.3f};
    const PrimitiveLint p = lintOf(mesh);
    EXPECT_NEAR(p.uv.degenerate, 1, 1e-9);
    EXPECT_EQ(p.steps.edges, 0u);
    EXPECT_EQ(errorOf(p, "cotangent").count, 0u); // not an error of zero
    EXPECT_EQ(p.notJudged, "no triangle has an area both in space and in uv");
}

TEST(Lint, chartsThatShareTexelsOverlapAndNeighboursDoNot)
{
    Mesh left = makePatch(1, 0, false, 4), mirrored = makePatch(1, 0, true, 4), right = left;
    for (glm::vec2& uv : mirrored.texcoords[0])
        uv.x += 1; // was over -1..0
    for (Mesh* m : {&left, &mirrored, &right})
        for (glm::vec2& uv : m->texcoords[0])
            uv.x *= 0.5f;
    for (glm::vec2& uv : right.texcoords[0])
        uv.x += 0.5f;
    const LintReport apart = lintScene(sceneOf({left, right}));
    EXPECT_EQ(apart.primitives[0].uv.overlapping, 0); // shared edges belong to one side only
    EXPECT_EQ(apart.primitives[1].uv.overlapping, 0);
    const LintReport same = lintScene(sceneOf({left, left}));
    EXPECT_NEAR(same.primitives[0].uv.overlapping, 1, 1e-9);
    EXPECT_EQ(same.primitives[0].uv.overlappingMirrored, 0);
    const LintReport both = lintScene(sceneOf({left, mirrored, right}));
    EXPECT_NEAR(both.primitives[0].uv.overlappingMirrored, 1, 1e-9);
    EXPECT_NEAR(both.primitives[1].uv.overlappingMirrored, 1, 1e-9);
    EXPECT_EQ(both.primitives[2].uv.overlapping, 0);
}

TEST(Lint, uvRepeatingAMillionTimesTakeBoundedTime)
{
    Mesh mesh = makePatch(1, 0, false, 1);
    for (glm::vec2& uv : mesh.texcoords[0])
        uv *= 5e5f;
    EXPECT_EQ(lintOf(mesh).uv.overlapping, 1);
    for (glm::vec2& uv : mesh.texcoords[0])
        uv *= 1e30f;
    EXPECT_EQ(lintOf(mesh).uv.overlapping, 0); // out of range: not drawn
}

// The tessellated sphere of the truth module, which ends 15 degrees from the poles.
Mesh truthSphere(int segments)
{
    const Tessellation t = tessellate(surfaces()[0], segments, false, false);
    Mesh mesh;
    mesh.positions = t.positions;
    mesh.normals = t.normals;
    mesh.texcoords[0] = t.texcoords;
    mesh.indices = t.indices;
    return mesh;
}

TEST(Lint, sphereStepsMatchTheTheoryAndAreFirstOrder)
{
    ASSERT_EQ(std::string(surfaces()[0].name), "sphere");
    // docs/accuracy.csv, table facets: mean 2.549, maximum 8.438 for 32 segments, measured by other code on random
    // points of random edges. Weighting by area favours the equator, where steps are smaller (15 %); the middle of an
    // edge and eight directions miss the maximum (10 %).
    const EdgeSteps at32 = lintOf(truthSphere(32)).steps, at64 = lintOf(truthSphere(64)).steps;
    EXPECT_NEAR(at32.cotangent.mean, 2.5, 0.4);
    EXPECT_NEAR(at32.cotangent.maximum, 8.4, 0.8);
    EXPECT_NEAR(at32.cotangent.mean / at64.cotangent.mean, 2, 0.15); // first order
    EXPECT_LT(at32.orthonormal.mean, at32.cotangent.mean);
}

TEST(Lint, aFlatPatchHasNoSteps)
{
    const EdgeSteps s = lintOf(makePatch(2, 0.5f, false, 4)).steps;
    EXPECT_EQ(s.edges, 40u); // 4 x 4 cells of two triangles: 56 edges, 16 of them on the border
    EXPECT_LT(s.cotangent.maximum, kFloat);
}

TEST(Lint, errorOnAStretchedPatchIsThatOfHalvedSlopes)
{
    // uv = (x/2, y): grad u is half as long as grad v, so cotangent halves the slope along u.
    const glm::dvec3 m = glm::normalize(glm::dvec3(0.4, 0.3, 1));
    const glm::dvec3 halved = glm::normalize(glm::dvec3(0.2, 0.3, 1));
    const double expected = glm::degrees(std::acos(glm::dot(m, halved)));
    const PrimitiveLint p = lintOf(makePatch(2, 0, false, 4), constantMap(m));
    for (const char* frame : {"cotangent", "smooth", "exact", "triangle"}) {
        EXPECT_NEAR(errorOf(p, frame).mean, expected, kFloat) << frame;
        EXPECT_NEAR(errorOf(p, frame).maximum, expected, kFloat) << frame;
    }
    EXPECT_NEAR(errorOf(p, "orthonormal").maximum, 0, kFloat);
}

TEST(Lint, storedTangentsThatContradictTheUvAreFound)
{
    Mesh mesh = makePatch(1, 0, false, 4);
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(1, 0, 0, 1)); // correct: bitangent up, against +v
    EXPECT_EQ(lintOf(mesh).stored.reversedW, 0);
    EXPECT_NEAR(lintOf(mesh).stored.angle.maximum, 0, kFloat);
    EXPECT_EQ(errorOf(lintOf(mesh), "stored").maximum, 0);
    for (glm::vec4& t : mesh.tangents)
        t.w = -1;
    const LintReport reversed = lintScene(sceneOf({mesh}));
    EXPECT_NEAR(reversed.primitives[0].stored.reversedW, 1, 1e-9);
    EXPECT_EQ(reversed.primitives[0].stored.rotated, 0);
    EXPECT_EQ(reversed.distrustStored,
              reversed.maps[0].decided() && reversed.maps[0].asDeclared()); // if the map determines green
    EXPECT_GT(errorOf(reversed.primitives[0], "stored").mean, 5);
    for (glm::vec4& t : mesh.tangents)
        t = {0, 1, 0, 1};
    EXPECT_NEAR(lintOf(mesh).stored.rotated, 1, 1e-9);
    EXPECT_NEAR(lintOf(mesh).stored.angle.mean, 90, kFloat);
}

Image withGreenReversed(Image image)
{
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        std::uint8_t& green = image.bytes8()[4 * i + 1];
        green = std::uint8_t(std::min(256 - green, 255));
    }
    return image;
}

GreenEvidence greenOf(Image map) { return lintScene(sceneOf({makePatch(1, 0, false, 1)}, std::move(map))).maps.at(0); }

TEST(Lint, curlOfTheMapDecidesGreen)
{
    for (Relief relief : {Relief::waves, Relief::domes, Relief::bricks}) {
        const GreenEvidence right = greenOf(makeReliefMap(relief, 256));
        // in bricks, straight edges are inconclusive and only corners count
        EXPECT_TRUE(right.decided() && right.asDeclared()) << int(relief) << " " << right.verdict.agreement;
        const GreenEvidence wrong = greenOf(withGreenReversed(makeReliefMap(relief, 256)));
        EXPECT_TRUE(wrong.decided() && !wrong.asDeclared()) << int(relief) << " " << wrong.verdict.agreement;
    }
    // A smooth height field, except for rounding to 8 bits and steps over the detector's limit, which are clamped to
    // it.
    EXPECT_GT(greenOf(makeReliefMap(Relief::waves, 256)).verdict.agreement, 0.9);
}

TEST(Lint, greenVerdictEqualsMapDetectOnCharts)
{
    Image map = makeReliefMap(Relief::waves, 128);
    for (std::size_t i = 0; i < map.pixelCount(); ++i)
        if (i % 128 > 60 || i / 128 > 90) // black outside
            std::fill_n(map.bytes8() + 4 * i, 3, std::uint8_t(0));
    const GreenEvidence e = greenOf(map);
    const maps::GreenVerdict v = maps::greenOf(map);
    EXPECT_EQ(v.green, maps::Green::up);
    EXPECT_TRUE(e.decided() && e.asDeclared());
    EXPECT_EQ(e.verdict.agreement, v.agreement);
    EXPECT_EQ(e.verdict.confidence, v.confidence);
}

TEST(Lint, flatAndOneDimensionalMapsAreUndecided)
{
    Image flat = makeImage(64, 64, PixelType::unorm8, "flat"), ridges = flat;
    for (std::size_t i = 0; i < flat.pixelCount(); ++i) {
        const double x = 0.4 * std::sin(double(i % 64) * 0.3);
        const std::uint8_t up[4] = {128, 128, 255, 255};
        const std::uint8_t ridge[4] = {std::uint8_t(std::lround(128 + 127 * x)), 128,
                                       std::uint8_t(std::lround(128 + 127 * std::sqrt(1 - x * x))), 255};
        std::copy_n(up, 4, flat.bytes8() + 4 * i);
        std::copy_n(ridge, 4, ridges.bytes8() + 4 * i);
    }
    EXPECT_FALSE(greenOf(flat).decided());
    EXPECT_FALSE(greenOf(ridges).decided());
}

TEST(Lint, roundingFallsWithTheDistanceAndGrowsWithTheUv)
{
    Scene scene = sceneOf({makePatch(1, 0, false, 4)});
    const double near = lintScene(scene, {1}).primitives[0].precision;
    // One line of 1080 at distance 1 covers 2 tan(22.5 degrees)/1080 = 7.7e-4 uv: 1e-6/7.7e-4 degrees.
    EXPECT_NEAR(near, 1.3e-3, 1e-5);
    EXPECT_NEAR(lintScene(scene, {10}).primitives[0].precision, near / 10, 1e-9);
    for (glm::vec2& uv : scene.meshes[0].texcoords[0])
        uv += 100.0f;
    EXPECT_NEAR(lintScene(scene, {1}).primitives[0].precision, near * 101, near);
}

TEST(Lint, roundingIsZeroWithoutUvGradient)
{
    Mesh mesh = makePlane(1, 2, 1);
    mesh.texcoords[0].assign(mesh.vertexCount(), {0.25f, 0.5f});
    const PrimitiveLint p = lintScene(sceneOf({mesh}), {1}).primitives.at(0);
    EXPECT_EQ(p.uv.gradient, 0);
    EXPECT_EQ(p.precision, 0);
    EXPECT_EQ(p.closest, 0);
}

TEST(Lint, theAdviceFollowsTheNumbers)
{
    const LintReport flat = lintScene(sceneOf({makePatch(1, 0, false, 4)}));
    EXPECT_EQ(flat.advice, Advice::readChosen);
    EXPECT_EQ(frameOf(flat), Frame::orthonormal);
    // A coarse sphere: without tangents at its vertices every frame differs from MikkTSpace.
    EXPECT_EQ(frameOf(lintScene(sceneOf({makeSphere(1, 8)}, makeReliefMap(Relief::domes, 128)))), Frame::mikktspace);
    Scene plain = sceneOf({makePatch(1, 0, false, 4)});
    plain.materials[0].normalMap.image = -1;
    EXPECT_EQ(lintScene(plain).advice, Advice::nothing);
    EXPECT_EQ(lintScene(Scene{}).advice, Advice::nothing);
}

TEST(Lint, meshIsJudgedWithTheStretchOfItsInstances)
{
    Scene scene = sceneOf({makePatch(1, 0, false, 4)});
    for (Instance& instance : scene.instances)
        instance.toWorld[0][0] *= 2;
    const LintReport r = lintScene(scene);
    ASSERT_EQ(r.primitives.size(), 1u);
    EXPECT_EQ(r.primitives[0].placings, 1u);
    EXPECT_NEAR(r.primitives[0].uv.stretch.mean, 2, kFloat);
}

TEST(Lint, onlyInstancesOfDifferentStretchAreReportedApart)
{
    Scene scene = sceneOf({makePatch(1, 0, false, 4)});
    glm::mat4 larger(3), rotated(1), wide(1);
    larger[3][3] = 1;
    rotated[0] = {0, 1, 0, 0};
    rotated[1] = {1, 0, 0, 0}; // mirrors as well
    wide[0][0] = 2;
    for (const glm::mat4& m : {larger, rotated, wide, wide})
        scene.instances.push_back({"", 0, m});
    const LintReport r = lintScene(scene);
    ASSERT_EQ(r.primitives.size(), 2u);
    EXPECT_NEAR(r.primitives[0].uv.stretch.mean, 1, kFloat);
    EXPECT_NEAR(r.primitives[1].uv.stretch.mean, 2, kFloat);
    EXPECT_EQ(r.primitives[1].placing, 1u);
    EXPECT_EQ(r.primitives[1].placings, 2u);
    EXPECT_EQ(r.primitives[1].uv.overlapping, 0); // copies elsewhere do not count as overlapping uv
    for (int k = 0; k < 20; ++k) {
        wide[0][0] = 3 + float(k);
        scene.instances.push_back({"", 0, wide});
    }
    EXPECT_EQ(lintScene(scene).primitives.size(), kMaxPlacings);
    EXPECT_EQ(lintScene(scene).primitives[0].placings, 22u);
}

TEST(Lint, tangentsThatAnExtensionReadsAreNotCalledUnused)
{
    Scene scene = sceneOf({makePatch(1, 0, false, 4)});
    scene.materials[0].name = "hair";
    scene.materials[0].tangentsFor = "KHR_materials_anisotropy";
    Mesh& mesh = scene.meshes[0]; // along the diagonal of the uv
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(std::sqrt(0.5f), std::sqrt(0.5f), 0, 1));
    EXPECT_NE(lintScene(scene).recommendation.find("hair (KHR_materials_anisotropy)"), std::string::npos);
    scene.materials[0].normalMap.image = -1;
    const std::string text = lintScene(scene).recommendation;
    EXPECT_NE(text.find("hair (KHR_materials_anisotropy)"), std::string::npos) << text;
    EXPECT_EQ(text.find("can be dropped"), std::string::npos) << text;
}

TEST(Lint, primitiveOfLargeErrorIsNamedInAGoodModel)
{
    Mesh sphere = makeSphere(1, 16), plane = makePatch(1, 0, false, 4);
    sphere.name = "coarse";
    for (glm::vec3& p : plane.positions)
        p *= 100.0f; // outweighs the sphere
    const LintReport r = lintScene(sceneOf({plane, sphere}, makeReliefMap(Relief::domes, 128)));
    EXPECT_EQ(r.advice, Advice::readChosen);
    EXPECT_NE(r.recommendation.find("largest error is in coarse"), std::string::npos) << r.recommendation;
}

TEST(Lint, hostileNumbersGiveNoNaN)
{
    Mesh mesh = makePatch(1, 0, false, 4);
    mesh.positions[3] = glm::vec3(NAN, INFINITY, 1e38f);
    mesh.texcoords[0][5] = glm::vec2(INFINITY, NAN);
    mesh.normals[7] = glm::vec3(0);
    const PrimitiveLint p = lintOf(mesh);
    for (const Reading& r : p.readings)
        EXPECT_TRUE(std::isfinite(r.error.mean) && std::isfinite(r.error.maximum)) << r.name;
    for (double x : {p.uv.area, p.uv.stretch.mean, p.uv.mirrored, p.steps.cotangent.mean, p.precision})
        EXPECT_TRUE(std::isfinite(x));
    Mesh empty = makePatch(1, 0, false, 1);
    empty.indices.clear();
    EXPECT_EQ(lintOf(empty).triangles, 0u);
    Mesh noUv = makePatch(1, 0, false, 1);
    noUv.texcoords[0].clear();
    EXPECT_FALSE(lintOf(noUv).hasUv);
}

TEST(Lint, progressStopsLintAndDoesNotChangeIt)
{
    const Scene scene = sceneOf({makeSphere(1, 8), makePlane(1, 1, 1)});
    int calls = 0;
    const auto stopped = lintScene(scene, {}, [&](double) { return ++calls < 1; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::stopped);
    EXPECT_EQ(calls, 1);
    double last = 0;
    const auto whole = lintScene(scene, {}, [&](double fraction) {
        last = fraction;
        return true;
    });
    ASSERT_TRUE(whole);
    EXPECT_EQ(last, 1);
    EXPECT_EQ(whole->recommendation, lintScene(scene).recommendation);
}

TEST(Lint, progressAdvancesAndStopsWithinOneMesh)
{
    const Scene scene = sceneOf({makeSphere(1, 8)});
    std::vector<double> fractions;
    ASSERT_TRUE(lintScene(scene, {}, [&](double fraction) {
        fractions.push_back(fraction);
        return true;
    }));
    EXPECT_GE(fractions.size(), 5u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_LE(fractions.front(), 0.5);
    for (std::size_t last = 1; last < fractions.size(); ++last) {
        std::size_t calls = 0;
        EXPECT_FALSE(lintScene(scene, {}, [&](double) { return ++calls < last; }));
        EXPECT_EQ(calls, last);
    }
}

} // namespace
} // namespace cotan
