// Hints before a bake: each appears where it is true, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "bake_scene.hpp"
#include "cotan/bake.hpp"
#include "cotan/lint.hpp"
#include "scene/hard_edges.hpp"

namespace cotan {
namespace {

Scene scaled(Scene scene, float factor)
{
    for (Instance& instance : scene.instances)
        instance.toWorld = glm::scale(glm::mat4(1), glm::vec3(factor)) * instance.toWorld;
    return scene;
}

Result<BakedModel> bakedWith(const Scene& low, Scene high, bool wrap = false)
{
    BakeModelOptions options;
    options.bake.frame = Frame::mikktspace;
    options.bake.width = options.bake.height = 32;
    options.wrap = wrap;
    HighModel detailed;
    detailed.scenes.push_back(std::move(high));
    return bakeModel(low, std::move(detailed), options);
}

// The warnings that contain these words.
std::size_t hintsWith(const std::string& words, const Scene& low, Scene high)
{
    const auto made = bakedWith(low, std::move(high));
    EXPECT_TRUE(made) << made.error().message;
    return made ? std::size_t(std::ranges::count_if(
               made->warnings, [&](const std::string& line) { return line.find(words) != std::string::npos; }))
                : 99;
}

TEST(BakeHints, unitsAreNamedIfTheModelsAreAHundredOrAThousandTimesApart)
{
    std::mt19937 bits(7);
    for (int i = 0; i < 2; ++i) {
        const float size = 0.1f + float(bits() % 1000) / 100, off = 0.8f + float(bits() % 100) / 250; // 0.8 to 1.2
        const Scene low = scaled(sceneOfMeshes({makeTorus(1, 0.4f, 24, 1, 1)}), size);
        for (const auto& [factor, hints] :
             {std::pair(100.0f, 1u), {0.01f, 1u}, {1000.0f, 1u}, {0.001f, 1u}, {1.0f, 0u}, {10.0f, 0u}, {30.0f, 0u}}) {
            const Scene high = scaled(sceneOfMeshes({makeTorus(1, 0.4f, 48, 1, 1)}), size * factor * off);
            EXPECT_EQ(hintsWith("export both in the same unit", low, high), hints) << size << " " << factor * off;
        }
    }
}

TEST(BakeHints, exchangedModelsAreNamed)
{
    const Scene coarse = sceneOfMeshes({makeSphere(1, 16)}), fine = sceneOfMeshes({makeSphere(1, 64)});
    EXPECT_EQ(hintsWith("exchange the two files", fine, coarse), 1u);
    EXPECT_EQ(hintsWith("exchange the two files", coarse, fine), 0u);
    EXPECT_EQ(hintsWith("exchange the two files", coarse, coarse), 0u);
    Scene bare = fine; // as sculpting programs export
    bare.meshes[0].texcoords[0].clear();
    const auto refused = bakedWith(bare, coarse);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().message.ends_with("; the high model has them: exchange the two if they are mixed up"))
        << refused.error().message;
    const auto both = bakedWith(bare, bare);
    ASSERT_FALSE(both);
    EXPECT_EQ(both.error().message.find("exchange"), std::string::npos) << both.error().message;
}

// Two squares that meet at a right angle, in one chart or in two.
Mesh corner(bool hard, bool split)
{
    Mesh mesh = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), wall = rectangle({1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    for (std::size_t v = 0; v < 4; ++v) {
        mesh.texcoords[0][v].x /= 2;
        wall.texcoords[0][v].x = wall.texcoords[0][v].x / 2 + (split ? 0.51f : 0.5f);
        if (!hard)
            mesh.normals[v] = wall.normals[v] = glm::normalize(glm::vec3(1, 0, 1));
        mesh.positions.push_back(wall.positions[v]);
    }
    mesh.normals.insert(mesh.normals.end(), wall.normals.begin(), wall.normals.end());
    mesh.texcoords[0].insert(mesh.texcoords[0].end(), wall.texcoords[0].begin(), wall.texcoords[0].end());
    for (const std::uint32_t i : rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).indices)
        mesh.indices.push_back(i + 4);
    return mesh;
}

TEST(BakeHints, hardEdgesThatUvDoNotSplitAreNamedByBakeAndLint)
{
    for (const bool hard : {true, false})
        for (const bool split : {true, false}) {
            const bool wrong = hard && !split;
            Scene scene = sceneOfMeshes({corner(hard, split)});
            EXPECT_EQ(hintsWith("1 hard edges are not split in uv", scene, scene), wrong ? 1u : 0u) << hard << split;
            EXPECT_TRUE(hardEdgeHints(scene).empty());                             // no map shows them
            EXPECT_EQ(lintWarnings(lintScene(scene, {})).size(), wrong ? 1u : 0u); // but one may be baked
            scene.images.push_back(makeReliefMap(Relief::domes, 16));
            scene.materials[0].normalMap.image = 0;
            scene.meshes[0].name = "corner";
            const std::vector<std::string> lines = lintWarnings(lintScene(scene, {}));
            EXPECT_EQ(std::ranges::count(lines, std::string("mesh 'corner': 1 ") + kHardEdgeAdvice), wrong ? 1 : 0)
                << hard << split;
        }
    const Mesh cube = makeCube(1, 1); // its faces have charts of their own
    EXPECT_EQ(unsplitHardEdges(cube.positions, cube.normals, cube.texcoords[0], cube.indices), 0u);
}

// A tile with a block that crosses its right border, and what comes in at the left one.
TEST(BakeHints, whatCrossesTheBorderOfATileIsNamedAndComesInWithWrap)
{
    const Scene low = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    const Mesh ground = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const auto slope = [](float from) { return rectangle({from, 0.4f, 0.03f}, {0.4f, 0, 0.05f}, {0, 0.2f, 0}); };
    const Scene crossing = sceneOfMeshes({ground, slope(0.8f)});
    const Scene inside = sceneOfMeshes({ground, slope(0.3f)});
    const Scene bothSides = sceneOfMeshes({ground, slope(0.8f), slope(-0.2f)});
    const Scene beyond = sceneOfMeshes({rectangle({-1, -1, 0}, {3, 0, 0}, {0, 3, 0})});
    EXPECT_EQ(hintsWith("options.wrap: ", low, crossing), 1u);
    for (const Scene* high : {&inside, &bothSides, &beyond})
        EXPECT_EQ(hintsWith("options.wrap: ", low, *high), 0u);
    const Scene half = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 0.5f, 0})}); // a rectangle is a tile, too
    EXPECT_EQ(hintsWith("options.wrap: ", half, crossing), 1u);

    const auto wrapped = bakedWith(low, crossing, true), whole = bakedWith(low, bothSides);
    ASSERT_TRUE(wrapped && whole);
    EXPECT_TRUE(wrapped->warnings.empty()) << wrapped->warnings.front();
    EXPECT_TRUE(wrapped->maps[0].image.data == whole->maps[0].image.data);
    EXPECT_FALSE(bakedWith(low, crossing)->maps[0].image.data == whole->maps[0].image.data);
    const auto round = bakedWith(sceneOfMeshes({makeSphere(1, 16)}), sceneOfMeshes({makeSphere(1, 16)}), true);
    ASSERT_FALSE(round);
    EXPECT_EQ(round.error().message,
              "options.wrap: expected a flat low mesh that fills the square of its texture coordinates once; found "
              "another");
}

TEST(BakeHints, trianglesThatNoMapShowsAreNamedUnlessTheTileWasChosen)
{
    const auto onTiles = [](const std::vector<glm::vec2>& moved) {
        std::vector<Mesh> meshes;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            meshes.push_back(rectangle({2 * float(i), 0, 0}, {1, 0, 0}, {0, 1, 0}));
            for (glm::vec2& uv : meshes.back().texcoords[0])
                uv += moved[i];
        }
        return sceneOfMeshes(std::move(meshes));
    };
    const auto warningsOf = [](const Scene& low, const std::vector<int>& tiles) {
        BakeModelOptions options;
        options.bake.frame = Frame::mikktspace;
        options.bake.width = options.bake.height = 8;
        options.tiles = tiles;
        HighModel high;
        high.scenes.push_back(low);
        const auto baked = bakeModel(low, std::move(high), options);
        EXPECT_TRUE(baked) << baked.error().message;
        return baked ? baked->warnings : std::vector<std::string>{"none"};
    };
    using Lines = std::vector<std::string>;
    const Scene two = onTiles({{0, 0}, {1, 0}, {0, -1}}); // here v runs down
    EXPECT_EQ(warningsOf(two, {}),
              Lines{"options.tiles: the low mesh also has triangles on tiles 1002, 1011: they are not baked"});
    for (const std::vector<int>& chosen : {std::vector{1001}, {1002}, {1001, 1002, 1011}})
        EXPECT_EQ(warningsOf(two, chosen), Lines()) << chosen.front();
    EXPECT_EQ(warningsOf(onTiles({{0, 0}, {0, 0}}), {}), Lines());
    EXPECT_EQ(
        warningsOf(onTiles({{0, 0}, {-1, 0}}), {}),
        Lines{"2 of 4 triangles of the low mesh lie at least in part outside of the tiles 1001 to 1999: nothing is "
              "baked for them there"});
    std::vector<glm::vec2> ten;
    for (int i = 0; i < 10; ++i)
        ten.emplace_back(i, 0);
    EXPECT_EQ(warningsOf(onTiles(ten), {})[0],
              "options.tiles: the low mesh also has triangles on tiles 1002, 1003, 1004, 1005, 1006, 1007, 1008, 1009, "
              "...: they are not baked");
}

// The two words of each pair; one pair needs no matching.
TEST(BakeHints, namesThatPairAreNamedWithoutMatching)
{
    for (const auto& [simple, detailed] : {std::pair("_low", "_high"), {"_lp", "_hp"}, {".lo", ".hi"}}) {
        Scene low =
            sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), rectangle({2, 0, 0}, {1, 0, 0}, {0, 1, 0})});
        Scene high = low;
        for (std::size_t i = 0; i < 2; ++i) {
            const std::string base = i == 0 ? "door" : "wall";
            low.instances[i].name = base + simple;
            high.instances[i].name = base + detailed;
        }
        EXPECT_EQ(hintsWith("options.matchByName: ", low, high), 1u) << simple;
        high.instances[1].name = low.instances[1].name = "other";
        EXPECT_EQ(hintsWith("options.matchByName: ", low, high), 0u) << simple;
    }
}

} // namespace
} // namespace cotan
