// Both sides of each bound of a bake's options and inputs, messages with their numbers, names that match, and tiles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "bake/bake_surfaces.hpp"
#include "bake_scene.hpp"

namespace cotan {
namespace {

// The unit square in z = `height`, facing up; its uv fill the tile.
Mesh flatSquare(float height, glm::vec2 tile = {0, 0})
{
    Mesh mesh = rectangle({0, 0, height}, {1, 0, 0}, {0, 1, 0});
    for (glm::vec2& uv : mesh.texcoords[0])
        uv += tile;
    return mesh;
}

HighModel highModel(std::vector<Mesh> meshes)
{
    HighModel high;
    high.scenes.push_back(sceneOfMeshes(std::move(meshes)));
    return high;
}

BakeModelOptions fewTexels(BakeKind kind = BakeKind::normal)
{
    BakeModelOptions options;
    options.bake.kind = kind;
    options.bake.width = 4;
    options.bake.height = 3;
    options.bake.threads = 1;
    return options;
}

std::string messageOf(const Result<BakeSetup>& setup) { return setup ? "" : setup.error().message; }

TEST(BakeBounds, optionsAreAcceptedUpToTheirLimits)
{
    using O = BakeModelOptions;
    const float most = 1e17f, more = 1.01e17f;
    const struct {
        std::function<void(O&)> change;
        const char* message; // empty: accepted
    } cases[] = {
        {[](O& o) { o.bake.width = o.bake.height = 65535, o.memory = SIZE_MAX; }, ""},
        {[](O& o) { o.bake.width = o.bake.height = 1; }, ""},
        {[](O& o) { o.bake.width = 65536; },
         "options.bake.width: expected a width and a height from 1 to 65535; found 65536x3"},
        {[](O& o) { o.bake.height = 65536; },
         "options.bake.width: expected a width and a height from 1 to 65535; found 4x65536"},
        {[](O& o) { o.bake.width = 0; },
         "options.bake.width: expected a width and a height from 1 to 65535; found 0x3"},
        {[](O& o) { o.bake.samples = 2; }, ""},
        {[](O& o) { o.bake.samples = 4; }, ""},
        {[](O& o) { o.bake.samples = 0; },
         "options.bake.samples: expected 1, 2 or 4 samples per texel and axis; found 0"},
        {[](O& o) { o.bake.samples = 5; },
         "options.bake.samples: expected 1, 2 or 4 samples per texel and axis; found 5"},
        {[](O& o) { o.bake.occlusionRays = 1; }, ""},
        {[](O& o) { o.bake.occlusionRays = 65536; }, ""},
        {[](O& o) { o.bake.occlusionRays = 65537; },
         "options.bake.occlusionRays: expected 1 to 65536 rays for occlusion; found 65537"},
        {[=](O& o) { o.bake.maxDistance = most; }, ""},
        {[=](O& o) { o.bake.cageReach = most; }, ""},
        {[=](O& o) { o.bake.extrusion = most; }, ""},
        {[=](O& o) { o.bake.maxDistance = more; }, "options.maxDistance: expected 0 to 1e+17; found 1.01e+17"},
        {[=](O& o) { o.bake.cageReach = more; }, "options.cageReach: expected 0 to 1e+17; found 1.01e+17"},
        {[=](O& o) { o.bake.extrusion = more; }, "options.extrusion: expected 0 to 1e+17; found 1.01e+17"},
        {[](O& o) { o.bake.cageReach = -0.5f; }, "options.cageReach: expected 0 to 1e+17; found -0.5"},
        {[](O& o) { o.material = 0; }, ""},
        {[](O& o) { o.material = 1; }, ""},
        {[](O& o) { o.material = 2; }, "options.material: expected 0 to 1; found 2"},
        {[](O& o) { o.bake.frame = Frame(kFrameCount); }, nullptr},
        {[](O& o) { o.bake.search = BakeSearch::nearest; }, ""},
    };
    Scene low = sceneOfMeshes({flatSquare(0), flatSquare(1, {1, 0})});
    low.materials.emplace_back();
    low.meshes[1].material = 1;
    for (std::size_t i = 0; i < std::size(cases); ++i) {
        BakeModelOptions options = fewTexels();
        cases[i].change(options);
        const std::string expected = cases[i].message
            ? cases[i].message
            : fmt::format("options.bake.frame: expected 0 to {}; found {}", kFrameCount - 1, kFrameCount);
        const auto setup = prepareBake(low, highModel({flatSquare(0)}), options);
        EXPECT_EQ(messageOf(setup), expected) << i;
        if (!setup) {
            EXPECT_EQ(setup.error().kind, ErrorKind::usage) << i;
        }
    }
    for (const auto& [scenes, maps, accepted] :
         {std::tuple(2, 0, true), {2, 1, true}, {2, 2, true}, {2, 3, false}, {3, 2, false}}) {
        HighModel high;
        high.scenes.assign(std::size_t(scenes), sceneOfMeshes({flatSquare(0)}));
        high.maps.resize(std::size_t(maps));
        EXPECT_EQ(messageOf(prepareBake(low, std::move(high), fewTexels())),
                  accepted ? ""
                           : fmt::format("high.maps: expected none, one, or one for each of the {} scenes; found {}",
                                         scenes, maps));
    }
}

TEST(BakeBounds, positionsAreAcceptedUpToTheirLimitOnEachAxis)
{
    const Scene flat = sceneOfMeshes({flatSquare(0)});
    for (int axis = 0; axis < 3; ++axis)
        for (const auto& [far, accepted] :
             {std::pair(0.9e17f, true), {1.1e17f, false}, {-0.9e17f, true}, {-1.1e17f, false}}) {
            glm::vec3 corner(0);
            corner[axis] = far;
            Scene offsetScene = sceneOfMeshes({rectangle(corner, {1e16f, 0, 0}, {0, 1e16f, 0})});
            if (far < 0) // all but the first corner are elsewhere
                offsetScene = sceneOfMeshes({rectangle(corner, {1e16f, 0, 1e15f}, {0, 1e16f, 1e15f})});
            const std::string found =
                accepted ? "" : fmt::format("expected positions up to 1e+17 from the origin; found {:g}", far);
            const auto errorOf = [&](const char* what) {
                return accepted ? std::string() : std::string(what) + ": " + found;
            };
            HighModel high;
            high.scenes = {offsetScene};
            BakeModelOptions options = fewTexels();
            EXPECT_EQ(messageOf(prepareBake(offsetScene, highModel({flatSquare(0)}), options)), errorOf("low")) << axis;
            EXPECT_EQ(messageOf(prepareBake(flat, std::move(high), options)), errorOf("high")) << axis;
            options.cage = &offsetScene;
            EXPECT_EQ(messageOf(prepareBake(flat, highModel({flatSquare(0)}), options)), errorOf("options.cage"))
                << axis;
        }
}

TEST(BakeBounds, eachTileIsItsSquareOfUv)
{
    // UDIM 1001 + u + 10 v with v upwards; texcoords here have v down. Each tile gets its own height.
    const std::pair<int, glm::vec2> tiles[] = {{1001, {0, 0}},  {1002, {1, 0}},  {1010, {9, 0}},
                                               {1011, {0, -1}}, {1023, {2, -2}}, {1100, {9, -9}}};
    std::vector<Mesh> low, high;
    for (std::size_t i = 0; i < std::size(tiles); ++i) {
        Mesh mesh = flatSquare(0, tiles[i].second), over = flatSquare(0.01f * float(i + 1));
        for (std::size_t v = 0; v < 4; ++v) {
            mesh.positions[v].x += 2 * float(i);
            over.positions[v].x += 2 * float(i);
        }
        low.push_back(mesh);
        high.push_back(over);
    }
    BakeModelOptions options = fewTexels(BakeKind::height);
    options.stored.type = PixelType::float32;
    const auto setup = prepareBake(sceneOfMeshes(low), highModel(high), options);
    ASSERT_TRUE(setup) << messageOf(setup);
    for (std::size_t i = 0; i < std::size(tiles); ++i) {
        const auto maps = bakeTile(*setup, tiles[i].first);
        ASSERT_TRUE(maps) << tiles[i].first << ": " << maps.error().message;
        const BakedMap* const map = &maps->front();
        EXPECT_EQ(map->tile, tiles[i].first);
        EXPECT_EQ(map->statistics.covered, 12u);
        EXPECT_NEAR(map->image.floats()[0], 0.01f * float(i + 1), 1e-5f) << tiles[i].first;
        EXPECT_EQ(map->image.frame, ""); // heights have no frame
    }
    for (const int tile : {1005, 1031, 1098}) {
        const auto none = bakeTile(*setup, tile);
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().message,
                  fmt::format("options.tiles: no triangle lies on tile {} of the texture coordinates", tile));
    }
    const auto before = bakeTile(*setup, 1000);
    ASSERT_FALSE(before);
    EXPECT_EQ(before.error().message, "options.tiles: expected numbers of at least 1001; found 1000");
}

TEST(BakeBounds, mapsNameTheirFrameAndPaddingFillsTheGivenRadius)
{
    Mesh low = flatSquare(0);
    for (glm::vec2& uv : low.texcoords[0])
        uv.x /= 6; // the first of six columns; the edge touches the second
    const Mesh high = rectangle({0, 0, 0}, {1, 0, 0.3f}, {0, 1, 0});
    for (const auto& [padding, columns] : {std::pair(-1, 2), {1, 3}, {2, 4}, {0, 6}}) {
        BakeModelOptions options = fewTexels();
        options.bake.width = 6;
        options.bake.frame = Frame::smooth;
        options.bake.maxDistance = 0.5f;
        options.padding = padding;
        const auto model = bakeModel(sceneOfMeshes({low}), highModel({high}), options);
        ASSERT_TRUE(model) << model.error().message;
        const Image& image = model->maps[0].image;
        EXPECT_EQ(image.frame, "smooth");
        for (int i = 0; i < 18; ++i)
            EXPECT_EQ(image.bytes8()[4 * i] < 128, i % 6 < columns) << padding; // tilted against u, or flat
    }
}

// ---- crowds ---------------------------------------------------------------------------------

TEST(BakeBounds, aRayMayCross2000Triangles)
{
    for (const auto& [count, message] :
         {std::pair(2000, ""),
          {2001, "high: a ray crosses about 2001 of its triangles; expected at most 2000: remove hidden triangles"}}) {
        Mesh low = rectangle({0.1f, 0.1f, 0}, {0.1f, 0, 0}, {0, 0.1f, 0});
        EXPECT_EQ(messageOf(prepareBake(sceneOfMeshes({low}), highModel({crowd(count)}), fewTexels())), message);
    }
}

TEST(BakeBounds, upTo2000LowTrianglesMayOverlapAtAPoint)
{
    for (const auto& [count, message] :
         {std::pair(2000, ""),
          {2001,
           "low: about 2001 of its triangles overlap at each point; expected at most 2000: remove hidden triangles"}}) {
        const Mesh high = rectangle({0.1f, 0.1f, 0}, {0.1f, 0, 0}, {0, 0.1f, 0});
        EXPECT_EQ(messageOf(prepareBake(sceneOfMeshes({crowd(count)}), highModel({high}), fewTexels())), message);
    }
}

TEST(BakeBounds, rowsUnderAllTrianglesAreLimited)
{
    // A map of 1 x 65535 may have 4e7 + 2 * 65535 rows under its triangles: 612.4 times its height. Each triangle
    // counts at most all rows, however far it extends; one without height or with NaN counts none.
    const auto bakeOf = [](int full) {
        LowSurface low;
        const auto add = [&](glm::vec2 a, glm::vec2 b, glm::vec2 c) {
            for (const glm::vec2 uv : {a, b, c}) {
                low.indices.push_back(std::uint32_t(low.positions.size()));
                low.positions.emplace_back(uv, 0);
                low.normals.push_back({0, 0, 1});
                low.texcoords.push_back(uv);
            }
            low.triangleInstance.push_back(0);
        };
        for (int i = 0; i < full; ++i)
            add({0.001f * float(i), -1}, {1 + 0.001f * float(i), -1}, {0.5f, 2});
        for (int i = 0; i < 5; ++i)
            add({0.1f * float(i), 0.5f}, {2, 0.5f}, {3, 0.5f});
        low.texcoords.back() = glm::vec2(std::numeric_limits<float>::quiet_NaN());
        for (std::size_t k = 4; k < 7; ++k)
            low.texcoords[low.texcoords.size() - k] = glm::vec2(std::numeric_limits<float>::quiet_NaN());
        BakeOptions options;
        options.samples = 1;
        options.width = 1;
        options.height = 65535;
        options.threads = 1;
        options.extrusion = 0.1f;
        const auto high = HighSurface::make({sceneOfMeshes({flatSquare(0)})}, 1);
        EXPECT_TRUE(high);
        return bake(low, *high, options, [](double) { return false; });
    };
    const auto most = bakeOf(612), more = bakeOf(613);
    ASSERT_FALSE(most || more);
    EXPECT_EQ(most.error().kind, ErrorKind::stopped) << most.error().message;
    EXPECT_EQ(more.error().kind, ErrorKind::input);
    EXPECT_EQ(more.error().message,
              "low: its triangles overlap in 4.02e+07 rows of texels; expected at most "
              "4.01e+07: use fewer triangles or a smaller map");
}

// ---- stored ---------------------------------------------------------------------------------

TEST(BakeBounds, ditherFollowsAnOrderedPatternOfEightByEight)
{
    // Bayer's ordered dither: the pattern after B (side n) has 4 B + {0, 2; 3, 1} in its quarters.
    std::vector<std::vector<int>> pattern{{0}};
    while (pattern.size() < 8) {
        const std::size_t n = pattern.size();
        std::vector<std::vector<int>> next(2 * n, std::vector<int>(2 * n));
        for (std::size_t y = 0; y < 2 * n; ++y)
            for (std::size_t x = 0; x < 2 * n; ++x)
                next[y][x] = 4 * pattern[y % n][x % n] + std::array{0, 2, 3, 1}[2 * (y / n) + x / n];
        pattern = next;
    }
    Baked baked;
    baked.width = 17; // not a multiple of eight
    baked.height = 10;
    baked.states.assign(170, texelCovered);
    StoredAs as;
    as.dither = true;
    for (const int of64 : {0, 1, 7, 16, 31, 48, 63}) {
        // A value `of64` 64ths above a level is rounded up where the pattern's number is at least 64 - of64.
        baked.values.assign(170, glm::vec3((100 + float(of64) / 64) / 255, 0, 1));
        const Image image = storeBaked(baked, BakeKind::occlusion, as);
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 17; ++x) {
                const std::uint8_t* texel = image.bytes8() + 4 * (y * 17 + x);
                const bool up = pattern[std::size_t(y % 8)][std::size_t(x % 8)] >= 64 - of64;
                for (int k = 0; k < 3; ++k)
                    ASSERT_EQ(int(texel[k]), up ? 101 : 100) << of64 << " at " << x << " " << y;
                EXPECT_EQ(texel[3], 255);
            }
    }
}

TEST(BakeBounds, theMaskShowsTheMostSevereState)
{
    const int states[] = {0,
                          texelTouched,
                          texelCovered,
                          texelCovered | texelOverlapped,
                          texelCovered | texelNegative,
                          texelCovered | texelMissed,
                          texelCovered | texelTouched,
                          texelCovered | texelOverlapped | texelNegative,
                          texelCovered | texelNegative | texelMissed,
                          texelPadded};
    Baked baked;
    baked.width = int(std::size(states));
    baked.height = 1;
    baked.values.resize(std::size(states));
    for (const int s : states)
        baked.states.push_back(std::uint8_t(s));
    const Image mask = maskOf(baked);
    const auto at = [&](int x) {
        return glm::ivec3(mask.bytes8()[4 * x], mask.bytes8()[4 * x + 1], mask.bytes8()[4 * x + 2]);
    };
    EXPECT_EQ(at(0), glm::ivec3(0));
    EXPECT_EQ(at(9), glm::ivec3(0));
    for (const int green : {1, 2}) {
        EXPECT_EQ(at(green).x, 0);
        EXPECT_EQ(at(green).z, 0);
    }
    EXPECT_GT(at(1).y, 64);
    EXPECT_GT(at(2).y, at(1).y + 64);
    EXPECT_LT(at(2).y, 255);
    EXPECT_EQ(at(6), at(2)); // covered by one sample, touched by another
    EXPECT_EQ(at(3), glm::ivec3(255, 255, 0));
    EXPECT_EQ(at(4).x, 0);
    EXPECT_EQ(at(4).z, 255);
    EXPECT_LT(at(4).y, 128);
    EXPECT_EQ(at(7), at(4));
    EXPECT_EQ(at(5), glm::ivec3(255, 0, 0));
    EXPECT_EQ(at(8), at(5));
}

} // namespace
} // namespace cotan
