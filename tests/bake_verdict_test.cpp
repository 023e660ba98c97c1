// What a bake says of its map: nothing of good ones, the cause of bad ones.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "bake_scene.hpp"
#include "cotan/bake.hpp"

namespace cotan {
namespace {

using Kind = BakeProblem::Kind;

// Pseudorandom sizes of one case.
struct Drawn {
    std::mt19937 bits;
    explicit Drawn(unsigned seed) : bits(seed) {}
    float between(float low, float high) { return low + (high - low) * float(bits() % 10007) / 10006; }
};

// The mesh with its vertices moved along their normals by waves of this height.
Mesh displaced(Mesh mesh, float height, float frequency)
{
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        const glm::vec3 p = mesh.positions[v] * frequency;
        mesh.positions[v] += mesh.normals[v] * (height * std::sin(p.x) * std::sin(p.y + 1) * std::sin(p.z + 2));
    }
    return mesh;
}

Scene placed(Scene scene, const glm::mat4& where)
{
    for (Instance& instance : scene.instances)
        instance.toWorld = where * instance.toWorld;
    return scene;
}

BakedModel baked(const Scene& low, Scene high, int side = 96, float extrusion = 0)
{
    BakeModelOptions options;
    options.bake.frame = Frame::mikktspace;
    options.bake.width = options.bake.height = side;
    options.bake.extrusion = extrusion;
    options.mask = true;
    HighModel detailed;
    detailed.scenes.push_back(std::move(high));
    auto made = bakeModel(low, std::move(detailed), options);
    EXPECT_TRUE(made) << made.error().message;
    return made ? *std::move(made) : BakedModel{.maps = {BakedMap{}}, .warnings = {}};
}

void expectUsable(const BakedModel& model, const std::string& which)
{
    EXPECT_TRUE(model.warnings.empty()) << which << ": " << model.warnings.front();
    EXPECT_TRUE(model.maps[0].problems.empty()) << which;
    EXPECT_TRUE(model.maps[0].verdict.starts_with("usable: ")) << which << ": " << model.maps[0].verdict;
}

// Expects that the worst problem is of this kind, and is among the warnings.
BakeProblem worst(const BakedModel& model, Kind kind, const std::string& which)
{
    if (model.maps[0].problems.empty()) {
        ADD_FAILURE() << which << ": " << model.maps[0].verdict;
        return {};
    }
    const BakeProblem& problem = model.maps[0].problems.front();
    EXPECT_EQ(problem.kind, kind) << which << ": " << problem.text;
    EXPECT_EQ(model.warnings.front(), problem.text) << which;
    EXPECT_FALSE(model.maps[0].verdict.starts_with("usable")) << which;
    return problem;
}

// A plane in xz that faces +y, and its detail.
Scene plane(int segments) { return sceneOfMeshes({makePlane(2, segments, 1)}); }

TEST(BakeVerdict, shapesWithDetailOnThemAreUsable)
{
    for (unsigned seed = 0; seed < 12; ++seed) {
        Drawn drawn(seed);
        const float height = drawn.between(0.002f, 0.02f), frequency = drawn.between(2, 7);
        const auto shape = [&](int segments) {
            return seed % 3 == 0 ? makeSphere(1, segments)
                : seed % 3 == 1  ? makeTorus(1, 0.4f, segments, 1, 1)
                                 : makePlane(2, segments, 1);
        };
        expectUsable(baked(sceneOfMeshes({shape(32)}), sceneOfMeshes({displaced(shape(96), height, frequency)})),
                     "seed " + std::to_string(seed));
    }
}

// The first surface from outside is then not the nearest one: a bolt that is sunk into the wall, one that floats before
// it, and a head that overhangs its shaft.
TEST(BakeVerdict, partsThatIntersectFloatAndOverhangAreUsable)
{
    for (unsigned seed = 0; seed < 8; ++seed) {
        Drawn drawn(seed);
        const float radius = drawn.between(0.1f, 0.3f), up = drawn.between(-0.5f, 0.5f) * radius;
        Scene high = sceneOfMeshes({makePlane(2, 8, 1), makeSphere(radius, 32), makeCube(radius, 1)});
        high.instances[1].toWorld = glm::translate(glm::mat4(1), {drawn.between(-0.6f, 0.6f), up, 0});
        high.instances[2].toWorld = glm::translate(glm::mat4(1), {0, 0.52f * radius, 0.6f});
        expectUsable(baked(plane(1), std::move(high)), "seed " + std::to_string(seed));
    }
}

// Two squares side by side with the same texels, the second mirrored; the detail is mirrored too, or leans alike.
BakedModel halves(float lean, float leanOfSecond)
{
    const auto leaning = [](float from, float slope) { // over x = from to from + 1
        return rectangle({from, 0, slope * (from < 0 ? 0.0f : -1.0f)}, {1, 0, slope}, {0, 1, 0});
    };
    Mesh first = rectangle({-1, 0, 0}, {1, 0, 0}, {0, 1, 0}), second = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (glm::vec2& uv : second.texcoords[0])
        uv.x = 1 - uv.x;
    return baked(sceneOfMeshes({first, second}), sceneOfMeshes({leaning(-1, lean), leaning(0, leanOfSecond)}));
}

TEST(BakeVerdict, mirroredHalvesShareTexelsUnlessTheDetailDiffers)
{
    for (unsigned seed = 0; seed < 6; ++seed) {
        const float slope = Drawn(seed).between(0.06f, 0.12f);
        const std::string which = "seed " + std::to_string(seed);
        const BakedModel alike = halves(slope, -slope);
        expectUsable(alike, which);
        EXPECT_EQ(alike.maps[0].statistics.twice, 96u * 96u) << which;
        EXPECT_EQ(alike.maps[0].statistics.disputed, 0u) << which;
        EXPECT_EQ(int(alike.maps[0].mask.bytes8()[0]), 0) << which; // green

        const BakedModel apart = halves(slope, slope);
        const BakeProblem problem = worst(apart, Kind::disputed, which);
        EXPECT_NEAR(problem.degrees, 2 * std::atan(double(slope)) * 180 / 3.14159265, 0.01) << which;
        EXPECT_EQ(problem.texels, 96u * 96u) << which;
        EXPECT_EQ(int(apart.maps[0].mask.bytes8()[0]), 255) << which; // yellow
    }
}

TEST(BakeVerdict, theCauseOfABadBakeIsNamed)
{
    for (unsigned seed = 0; seed < 8; ++seed) {
        Drawn drawn(seed);
        const std::string which = "seed " + std::to_string(seed);
        // Further away than 10 % of the diagonal, 0.28.
        const float away = drawn.between(0.35f, 3) * (seed % 2 ? 1.0f : -1.0f);
        const BakeProblem far =
            worst(baked(plane(1), placed(plane(4), glm::translate(glm::mat4(1), {0, away, 0}))), Kind::tooFar, which);
        EXPECT_EQ(far.texels, 96u * 96u) << which;
        EXPECT_NE(far.text.find("there is one further away: search further, or use a cage"), std::string::npos);

        // Smaller than the low mesh: the fraction of texels around it has none.
        const float scale = drawn.between(0.3f, 0.9f);
        const BakeProblem small = worst(baked(plane(1), placed(plane(4), glm::scale(glm::mat4(1), glm::vec3(scale)))),
                                        Kind::noSurface, which);
        EXPECT_NEAR(double(small.texels) / (96 * 96), 1 - scale * scale, 0.03) << which;

        // Inside out: normals point inwards.
        Mesh inside = displaced(makeSphere(1, 48), drawn.between(0, 0.01f), 3);
        for (glm::vec3& n : inside.normals)
            n = -n;
        for (std::size_t i = 0; i < inside.indices.size(); i += 3)
            std::swap(inside.indices[i], inside.indices[i + 1]);
        const BakeProblem below =
            worst(baked(sceneOfMeshes({makeSphere(1, 32)}), sceneOfMeshes({inside})), Kind::belowHorizon, which);
        EXPECT_GT(below.degrees, 45) << which;
    }
}

// A floor in the texels from the left to the middle, and above it a slab whose bottom and top have the other quarters.
// Waves move the detail by up to `height`.
Scene floorUnderSlab(float bottom, float top, float height, int segments)
{
    const auto part = [&](float y, bool up, float begin, float end) {
        Mesh mesh = makePlane(2, segments, 1);
        for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
            glm::vec3& p = mesh.positions[v];
            const float wave = height * std::sin(9 * p.x + y) * std::sin(7 * p.z);
            p = {up ? p.x : -p.x, y + (up ? wave : -wave), p.z};
            mesh.normals[v].y = up ? 1 : -1;
            mesh.texcoords[0][v].x = begin + (end - begin) * mesh.texcoords[0][v].x;
        }
        return mesh;
    };
    return sceneOfMeshes({part(0, true, 0, 0.5f), part(bottom, false, 0.5f, 0.75f), part(top, true, 0.75f, 1)});
}

TEST(BakeVerdict, raysThatStartBeyondAnotherPartAreNamed)
{
    for (unsigned seed = 0; seed < 6; ++seed) {
        Drawn drawn(seed);
        const std::string which = "seed " + std::to_string(seed);
        const float bottom = drawn.between(0.15f, 0.3f), top = bottom + drawn.between(0.1f, 0.2f);
        const auto with = [&](float extrusion, int side) {
            return baked(floorUnderSlab(bottom, top, 0, 1), floorUnderSlab(bottom, top, 0.01f, 24), side, extrusion);
        };
        for (const float extrusion : {0.0f, 0.05f, 0.6f * bottom, (bottom + top) / 2}) // the last begin in the slab
            expectUsable(with(extrusion, 96), which + ", " + std::to_string(extrusion));
        for (const int side : {96, seed == 0 ? 512 : 128}) { // the larger one in cells of several texels
            const BakeProblem problem = worst(with(top + 0.1f, side), Kind::beyondPart, which);
            EXPECT_EQ(problem.texels, std::size_t(side) * std::size_t(side) / 2) << which << ": those of the floor";
            EXPECT_LT(problem.at.x, side / 2) << which;
            EXPECT_NE(problem.text.find("start them nearer"), std::string::npos) << problem.text;
        }
    }
}

// A ball that is sunk into the floor covers a part of it, which nobody sees.
TEST(BakeVerdict, raysThatStartBeyondAPartWhichCoversThemAreNoProblem)
{
    for (unsigned seed = 0; seed < 6; ++seed) {
        Drawn drawn(seed);
        const auto scene = [&, radius = drawn.between(0.1f, 0.3f)](int segments) {
            Mesh floor = makePlane(2, 1, 1), ball = makeSphere(radius, segments);
            for (glm::vec2& uv : floor.texcoords[0])
                uv.x /= 2;
            for (glm::vec2& uv : ball.texcoords[0])
                uv.x = 0.5f + uv.x / 2;
            return sceneOfMeshes({floor, ball});
        };
        const BakedModel model = baked(scene(16), scene(64), 96, drawn.between(0.7f, 1));
        for (const BakeProblem& problem : model.maps[0].problems)
            EXPECT_NE(problem.kind, Kind::beyondPart) << "seed " << seed << ": " << problem.text;
    }
}

TEST(BakeVerdict, linesOfMissedTexelsAtEdgesAreNoProblem)
{
    // Two texels of 96 at one border are not covered by the high mesh.
    const BakedModel model = baked(plane(1), placed(plane(1), glm::translate(glm::mat4(1), {2 * 2 / 96.0f, 0, 0})));
    EXPECT_EQ(model.maps[0].statistics.missed, 2u * 96u);
    expectUsable(model, "border");
}

} // namespace
} // namespace cotan
