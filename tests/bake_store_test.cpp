// The baker on cases small enough to work out by hand: differences between x and y, both sides of limits, mirrored
// instances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bake/bake_surfaces.hpp"
#include "bake_scene.hpp"
#include "high_view.hpp"

namespace cotan {
namespace {

constexpr float kRounding = 1e-6f; // of a few operations on numbers near one

Mesh unitSquare(float z) { return rectangle({0, 0, z}, {1, 0, 0}, {0, 1, 0}); }

Baked bakeScenes(const Scene& low, const Scene& high, const BakeOptions& options)
{
    const auto lowSurface = makeLowSurface(low, -1, options.frame, TangentOrigin::stored);
    const auto highSurface = HighSurface::make({high}, 1);
    EXPECT_TRUE(lowSurface && highSurface);
    const auto baked = bake(*lowSurface, *highSurface, options);
    EXPECT_TRUE(baked);
    return *baked;
}

BakeOptions small(int width, int height)
{
    BakeOptions options;
    options.width = width;
    options.height = height;
    options.maxDistance = 0.5f;
    return options;
}

// ---- padding --------------------------------------------------------------------------------

TEST(PaddingByHand, theRadiusIsInTexels)
{
    Baked baked;
    baked.width = 13;
    baked.height = 11;
    baked.values.assign(13 * 11, glm::vec3(0));
    baked.states.assign(13 * 11, 0);
    const int cx = 5, cy = 4;
    const auto at = [](int x, int y) { return std::size_t(y * 13 + x); };
    baked.values[at(cx, cy)] = {0, 0, 1};
    baked.states[at(cx, cy)] = texelTouched;
    padCharts(baked, 3);
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 13; ++x) {
            const int distance2 = (x - cx) * (x - cx) + (y - cy) * (y - cy);
            EXPECT_EQ(baked.values[at(x, y)] == glm::vec3(0, 0, 1), distance2 <= 9) << x << " " << y;
            const int expected = distance2 == 0 ? texelTouched : distance2 <= 9 ? texelPadded : 0;
            EXPECT_EQ(int(baked.states[at(x, y)]), expected) << x << " " << y;
        }
}

TEST(PaddingByHand, eachTexelTakesTheNearerOfTwoTexels)
{
    Baked baked;
    baked.width = 8;
    baked.height = 12;
    baked.values.assign(96, glm::vec3(0));
    baked.states.assign(96, 0);
    const auto at = [](int x, int y) { return std::size_t(y * 8 + x); };
    const glm::ivec2 a(1, 2), b(6, 9);
    baked.values[at(a.x, a.y)] = {1, 0, 0};
    baked.values[at(b.x, b.y)] = {0, 1, 0};
    baked.states[at(a.x, a.y)] = baked.states[at(b.x, b.y)] = texelCovered;
    padCharts(baked, 0);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 8; ++x) {
            const glm::ivec2 da = glm::ivec2(x, y) - a, db = glm::ivec2(x, y) - b;
            const int toA = da.x * da.x + da.y * da.y, toB = db.x * db.x + db.y * db.y;
            if (toA != toB) {
                EXPECT_EQ(baked.values[at(x, y)], toA < toB ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)) << x << " " << y;
            }
        }
}

// ---- storing --------------------------------------------------------------------------------

Baked onePixel(glm::vec3 value)
{
    Baked baked;
    baked.width = baked.height = 1;
    baked.values = {value};
    baked.states = {texelCovered};
    return baked;
}

TEST(StoreByHand, sixteenBitsAreRounded)
{
    StoredAs as;
    as.type = PixelType::unorm16;
    // 0.123 * 65535 = 8060.8.
    EXPECT_EQ(storeBaked(onePixel({0.123f, 0, 1}), BakeKind::occlusion, as).words()[0], 8061);
}

TEST(StoreByHand, heightsFillTheRangeAndEmptyTexelsDoNotCount)
{
    Baked baked;
    baked.width = 2;
    baked.height = 2;
    baked.values = {{2, 0, 1}, {6, 0, 1}, {0, 0, 0}, {3, 0, 1}}; // z: whether the texel has a value
    baked.states = {texelCovered, texelCovered, 0, texelCovered};
    StoredAs as;
    const Image image = storeBaked(baked, BakeKind::height, as);
    EXPECT_EQ(image.bytes8()[0], 0);
    EXPECT_EQ(image.bytes8()[4], 255);
    EXPECT_EQ(image.bytes8()[8], 0);
    EXPECT_EQ(image.bytes8()[12], 64); // 255 / 4 = 63.75
    as.type = PixelType::float32;
    const Image floats = storeBaked(baked, BakeKind::height, as);
    EXPECT_EQ(floats.floats()[4], 6); // unscaled
}

TEST(StoreByHand, objectNormalsIgnoreTheTangentMapFormat)
{
    StoredAs as;
    as.type = PixelType::float32;
    as.format.expansion = Expansion::signedValues;
    as.format.channels = Channels::orthographic;
    as.format.greenUp = true;
    const glm::vec3 v(0.48f, 0.6f, -0.64f);
    const Image image = storeBaked(onePixel(v), BakeKind::objectNormal, as);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(image.floats()[k], v[k], kRounding);
}

// ---- instance transforms --------------------------------------------------------------------

// Mirrors x and stretches y and z. Normals take the inverse transpose, diag(-1, 1/2, 1/3).
const glm::mat4 kMirrored(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 2, 0, 0), glm::vec4(0, 0, 3, 0), glm::vec4(0, 0, 0, 1));

Mesh slanted()
{
    Mesh mesh;
    mesh.positions = {{3, 0, 0}, {0, 1.5f, 0}, {0, 0, 1}}; // in the plane x + 2y + 3z = 3
    mesh.normals.assign(3, glm::normalize(glm::vec3(1, 2, 3)));
    mesh.texcoords[0] = {{0.1f, 0.2f}, {0.6f, 0.3f}, {0.2f, 0.9f}};
    mesh.tangents.assign(3, glm::vec4(glm::normalize(glm::vec3(3, 0, -1)), 1));
    mesh.indices = {0, 1, 2};
    return mesh;
}

TEST(TransformsByHand, aMirroredLowMeshKeepsItsSidesAndFlipsItsHandedness)
{
    Scene scene = sceneOfMeshes({slanted()});
    scene.instances[0].toWorld = kMirrored;
    const auto low = makeLowSurface(scene, -1, Frame::vertex, TangentOrigin::stored);
    ASSERT_TRUE(low);
    const glm::vec3 n = low->normals[0], expected = glm::normalize(glm::vec3(-1, 1, 1));
    EXPECT_LT(glm::length(n - expected), kRounding);
    const glm::vec3 a = low->positions[low->indices[0]], b = low->positions[low->indices[1]],
                    c = low->positions[low->indices[2]];
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), n), 0) << "the triangle runs the other way";
    EXPECT_EQ(low->tangents[0].w, 1); // glTF's 1 is -1 along v; the mirroring flips it again
    EXPECT_LT(glm::length(glm::vec3(low->tangents[0]) - glm::normalize(glm::vec3(-3, 0, -3))), kRounding);
}

TEST(TransformsByHand, aMirroredHighMeshKeepsItsSides)
{
    Scene scene = sceneOfMeshes({slanted()});
    scene.instances[0].toWorld = kMirrored;
    const auto high = HighSurface::make({scene}, 1);
    ASSERT_TRUE(high);
    const glm::vec3 outside = glm::normalize(glm::vec3(-1, 1, 1)), middle(-1, 1, 1); // of the transformed corners
    const Hit hit = high->trace({middle + outside, -outside, 0, 10});
    ASSERT_TRUE(hit.found);
    EXPECT_NEAR(hit.distance, 1, kRounding);
    EXPECT_LT(glm::length(high->normalOf(hit, HighNormals::smooth, -outside) - outside), kRounding);
    EXPECT_LT(glm::length(hit.faceNormal - outside), kRounding);
}

TEST(TransformsByHand, uvGetTheTextureTransform)
{
    Scene scene = sceneOfMeshes({slanted()});
    Texture& map = scene.materials[0].normalMap;
    map.image = 0;
    map.uRow = {2, 0.5f, 0.25f};
    map.vRow = {0.25f, 3, 0.5f};
    const auto low = makeLowSurface(scene, -1, Frame::cotangent, TangentOrigin::generated);
    ASSERT_TRUE(low);
    // 0.2 + 0.1 + 0.25 and 0.025 + 0.6 + 0.5 for uv (0.1, 0.2).
    EXPECT_NEAR(low->texcoords[0].x, 0.55f, kRounding);
    EXPECT_NEAR(low->texcoords[0].y, 1.125f, kRounding);
}

TEST(TransformsByHand, differencesAreThoseAlongUAndAlongV)
{
    // p(u, v) = u (2, 1, 0) + v (0, 1, 3): corners at uv (0,0), (0.5, 0.25), (0.25, 1).
    const auto p = [](float u, float v) { return u * glm::vec3(2, 1, 0) + v * glm::vec3(0, 1, 3); };
    LowSurface s;
    s.texcoords = {{0, 0}, {0.5f, 0.25f}, {0.25f, 1}};
    for (const glm::vec2 c : s.texcoords)
        s.positions.push_back(p(c.x, c.y));
    s.indices = {0, 1, 2};
    const Differences<double> d = differencesOf(s, 0);
    EXPECT_LT(glm::length(d.dpdx.raw() - glm::dvec3(2, 1, 0)), 1e-12); // double, exact inputs
    EXPECT_LT(glm::length(d.dpdy.raw() - glm::dvec3(0, 1, 3)), 1e-12);
}

// ---- rays -----------------------------------------------------------------------------------

TEST(RaysByHand, nearestSearchTakesTheNearerOfFrontAndBack)
{
    BakeOptions options = small(4, 4);
    options.kind = BakeKind::height;
    options.search = BakeSearch::nearest;
    const Scene low = sceneOfMeshes({unitSquare(0)});
    for (const auto& [front, behind] : {std::pair(0.3f, -0.1f), std::pair(0.1f, -0.3f)}) {
        const Baked baked = bakeScenes(low, sceneOfMeshes({unitSquare(front), unitSquare(behind)}), options);
        const float nearer = front < -behind ? front : behind;
        for (const glm::vec3& v : baked.values)
            EXPECT_NEAR(v.x, nearer, kRounding);
    }
}

TEST(RaysByHand, aCageReachesAsFarBehindTheLowSurfaceAsInFront)
{
    BakeOptions options = small(4, 4);
    options.kind = BakeKind::height;
    const Scene low = sceneOfMeshes({unitSquare(0)});
    for (const glm::vec3& p : low.meshes[0].positions)
        options.cage.push_back(p + glm::vec3(0, 0, 1));
    for (const auto& [height, found] :
         {std::pair(0.8f, true), std::pair(-0.8f, true), std::pair(1.2f, false), std::pair(-1.2f, false)}) {
        const Baked baked = bakeScenes(low, sceneOfMeshes({unitSquare(height)}), options);
        EXPECT_EQ(baked.statistics.missed, found ? 0u : 16u) << height;
        for (const glm::vec3& v : baked.values)
            EXPECT_NEAR(v.x, found ? height : 0, kRounding) << height;
    }
}

TEST(RaysByHand, cageRaysReachTheGivenMultiple)
{
    BakeOptions options = small(4, 4);
    options.kind = BakeKind::height;
    const Scene low = sceneOfMeshes({unitSquare(0)});
    for (const glm::vec3& p : low.meshes[0].positions)
        options.cage.push_back(p + glm::vec3(0, 0, 1));
    options.cageReach = 3;
    for (const auto& [height, found] : {std::pair(0.8f, true), std::pair(-1.9f, true), std::pair(-2.1f, false)})
        EXPECT_EQ(bakeScenes(low, sceneOfMeshes({unitSquare(height)}), options).statistics.missed, found ? 0u : 16u)
            << height;
}

TEST(RaysByHand, theDefaultDistanceIsAFractionOfTheBounds)
{
    BakeOptions options = small(4, 4);
    options.maxDistance = 0;
    const Scene low = sceneOfMeshes({unitSquare(0)});
    const Scene high =
        sceneOfMeshes({unitSquare(0), rectangle({3, 0, 0}, {0, 4, 0}, {0, 0, 12})}); // a box of 3 x 4 x 12
    EXPECT_NEAR(bakeScenes(low, high, options).statistics.rayDistance, 0.1 * std::sqrt(2.0), kRounding);
    options.search = BakeSearch::nearest;
    EXPECT_NEAR(bakeScenes(low, high, options).statistics.rayDistance, 0.05 * 13, kRounding);
    options.maxDistance = 0.25f;
    EXPECT_EQ(bakeScenes(low, high, options).statistics.rayDistance, 0.25);
}

TEST(RaysByHand, aDiscOverheadHidesTheSquareOfTheSineOfItsAngle)
{
    // With cosine weights, a disc of radius r at height h above the middle hides r^2 / (r^2 + h^2).
    const float radius = 2, height = 1.5f;
    Mesh disc;
    constexpr int kSides = 256;
    disc.positions.push_back({0.5f, 0.5f, height});
    for (int i = 0; i < kSides; ++i) {
        const float a = 2 * std::numbers::pi_v<float> * float(i) / kSides;
        disc.positions.push_back({0.5f + radius * std::cos(a), 0.5f + radius * std::sin(a), height});
        const auto here = std::uint32_t(i + 1), next = std::uint32_t((i + 1) % kSides + 1);
        disc.indices.insert(disc.indices.end(), {0, next, here});
    }
    disc.normals.assign(disc.positions.size(), glm::vec3(0, 0, -1));
    BakeOptions options = small(1, 1);
    options.kind = BakeKind::occlusion;
    options.occlusionRays = 4000;
    const Baked baked = bakeScenes(sceneOfMeshes({unitSquare(0)}), sceneOfMeshes({unitSquare(0), disc}), options);
    const double hidden = radius * radius / (radius * radius + height * height);
    EXPECT_NEAR(baked.values[0].x, 1 - hidden, 0.01); // 4000 rays in a spiral: a ring of them holds 40
}

// ---- statistics -----------------------------------------------------------------------------

TEST(CountedByHand, backfacingNormalsAreBelowTheHorizon)
{
    Mesh away = unitSquare(0.1f);
    for (glm::vec3& n : away.normals)
        n = glm::normalize(glm::vec3(0.3f, 0.2f, -1));
    const Baked baked = bakeScenes(sceneOfMeshes({unitSquare(0)}), sceneOfMeshes({away}), small(4, 4));
    EXPECT_EQ(baked.statistics.negative, 16u);
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_EQ(baked.states[i] & texelNegative, texelNegative);
    const Baked upright = bakeScenes(sceneOfMeshes({unitSquare(0)}), sceneOfMeshes({unitSquare(0.1f)}), small(4, 4));
    EXPECT_EQ(upright.statistics.negative, 0u);
}

TEST(CountedByHand, coveredTexelsAreNotCountedAsTouched)
{
    // A triangle whose edges cross texels at various angles.
    Mesh triangle = unitSquare(0);
    triangle.indices = {0, 1, 2};
    triangle.texcoords[0] = {{0.05f, 0.93f}, {0.91f, 0.84f}, {0.78f, 0.11f}, {0, 0}};
    BakeOptions options = small(8, 8);
    options.samples = 2;
    const Baked baked = bakeScenes(sceneOfMeshes({triangle}), sceneOfMeshes({unitSquare(0.1f)}), options);
    std::size_t covered = 0, onlyTouched = 0;
    for (const std::uint8_t s : baked.states) {
        covered += (s & texelCovered) != 0;
        onlyTouched += (s & texelTouched) != 0 && (s & texelCovered) == 0;
    }
    EXPECT_EQ(baked.statistics.covered, covered);
    EXPECT_EQ(baked.statistics.touched, onlyTouched);
    EXPECT_GT(onlyTouched, 0u);
}

TEST(CountedByHand, mirroredTrianglesHaveReversedUv)
{
    Mesh plain = unitSquare(0), mirrored = unitSquare(0);
    for (glm::vec2& uv : mirrored.texcoords[0])
        uv.x = 1 - uv.x;
    const Scene high = sceneOfMeshes({unitSquare(0.1f)});
    EXPECT_EQ(bakeScenes(sceneOfMeshes({plain}), high, small(4, 4)).statistics.mirroredTriangles, 0u);
    EXPECT_EQ(bakeScenes(sceneOfMeshes({mirrored}), high, small(4, 4)).statistics.mirroredTriangles, 2u);
}

TEST(CountedByHand, theMeanOfSeveralSamplesIsUnit)
{
    Mesh tilted = unitSquare(0.1f); // normals on opposite sides are 100 degrees apart
    for (std::size_t i = 0; i < 4; ++i)
        tilted.normals[i] = glm::normalize(glm::vec3(tilted.positions[i].x < 0.5f ? -1.2f : 1.2f, 0.1f, 1));
    BakeOptions options = small(3, 3);
    options.samples = 4;
    for (const glm::vec3& v : bakeScenes(sceneOfMeshes({unitSquare(0)}), sceneOfMeshes({tilted}), options).values)
        EXPECT_NEAR(glm::length(v), 1, kRounding);
}

// ---- views of the baked mesh ----------------------------------------------------------------

TEST(HighViewByHand, everyPixelShowsTheNormalOfItsSurfacePoint)
{
    // Normals that encode their position: n along (x, 2y, 1).
    Mesh high = unitSquare(0);
    high.positions.clear();
    high.normals.clear();
    high.indices.clear();
    constexpr std::uint32_t kCells = 64;
    for (std::uint32_t j = 0; j <= kCells; ++j)
        for (std::uint32_t i = 0; i <= kCells; ++i) {
            const float x = float(i) / kCells, y = float(j) / kCells;
            high.positions.push_back({x, y, 0});
            high.normals.push_back(glm::normalize(glm::vec3(x, 2 * y, 1)));
            if (i < kCells && j < kCells) {
                const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, d = a + kCells + 1, c = d + 1;
                high.indices.insert(high.indices.end(), {a, b, c, a, c, d});
            }
        }
    high.texcoords[0].clear();
    BakeOptions options = small(1, 1);
    View view;
    view.width = 40;
    view.height = 20;
    view.camera.eye = {0.5f, 0.5f, 1};
    view.camera.target = {0.5f, 0.5f, 0};
    view.camera.verticalFieldOfView = 0.5f;
    const auto low = makeLowSurface(sceneOfMeshes({unitSquare(0)}), -1, options.frame, TangentOrigin::generated);
    const auto surface = HighSurface::make({sceneOfMeshes({high})}, 1);
    ASSERT_TRUE(low && surface);
    const auto rendered = app::renderHighView(*low, *surface, options, view);
    ASSERT_TRUE(rendered);
    const Image& image = rendered->expected;
    ASSERT_EQ(image.data.size(), image.pixelCount() * image.bytesPerPixel());
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i) // the high surface equals the low one
        if (image.floats()[i / 4 * 4 + 3] > 0) {
            // The mean over nine points with a variance of w w 2 / 27, w = 0.026; second derivatives are at most 4.
            EXPECT_NEAR(rendered->normals.floats()[i], image.floats()[i], 1e-4f);
        }
    EXPECT_EQ(rendered->others, 0u);
    const double halfHeight = std::tan(0.25); // of the image, in the plane one unit away
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 40; ++x) {
            const double px = 0.5 + ((x + 0.5) / 20 - 1) * 2 * halfHeight, py = 0.5 + (1 - (y + 0.5) / 10) * halfHeight;
            const float* pixel = image.floats() + 4 * std::size_t(y * 40 + x);
            const double third = 2 * halfHeight / 20 / 3; // of a pixel: the nine points reach that far
            const bool inside = px > third && px < 1 - third;
            ASSERT_EQ(pixel[3], inside ? 1 : 0) << x << " " << y;
            if (inside) { // chord error of 64 cells: (2/64)^2 / 8
                EXPECT_NEAR(pixel[0] / pixel[2], px, 2e-4) << x << " " << y;
                EXPECT_NEAR(pixel[1] / pixel[2], 2 * py, 2e-4) << x << " " << y;
            }
        }
}

} // namespace
} // namespace cotan
