// Which parts are joined, and each limit on covered pixels, met exactly and exceeded by the smallest step.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "scene/parts.hpp"

namespace cotan {
namespace {

// Right triangles side by side along x, with opaque material 0.
Mesh triangles(std::size_t count)
{
    Mesh mesh;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = float(i);
        for (const glm::vec3 corner : {glm::vec3(x, 0, 0), glm::vec3(x + 1, 0, 0), glm::vec3(x, 1, 0)})
            mesh.positions.push_back(corner);
        for (std::uint32_t k = 0; k < 3; ++k)
            mesh.indices.push_back(std::uint32_t(3 * i) + k);
    }
    mesh.normals.assign(3 * count, {0, 0, 1});
    return mesh;
}

Scene sceneWith(std::vector<Mesh> meshes)
{
    Scene scene;
    scene.name = "model";
    scene.materials.resize(1);
    scene.meshes = std::move(meshes);
    return scene;
}

glm::mat4 movedBy(float x, float y, float z)
{
    glm::mat4 moved(1);
    moved[3] = {x, y, z, 1};
    return moved;
}

TEST(SceneParts, areJoinedUpTo256Triangles)
{
    Mesh odd = triangles(2);
    odd.cotangentsU.assign(6, {1, 0, 0});
    Scene scene = sceneWith({triangles(257), triangles(256), odd, triangles(258)});
    scene.instances = {{"a", 3, movedBy(1, 2, 3)}, {"b", 1, movedBy(4, 5, 6)}, {"c", 0, movedBy(7, 8, 9)},
                       {"d", 3, glm::mat4(2)},     {"e", 2, movedBy(3, 1, 2)}, {"f", 1, glm::mat4(1)}};
    scene.instances.push_back({"g", 0, movedBy(0, std::numeric_limits<float>::infinity(), 0)}); // not finite
    Scene all = scene;
    joinParts(all, 7);
    EXPECT_EQ(all.instances.size(), 7u); // already within the limit, so nothing is joined
    joinParts(scene, 6);
    struct Row {
        const char* name;
        std::size_t triangles;
        glm::mat4 transform;
    };
    const Row rows[] = {{"a", 258, movedBy(1, 2, 3)},
                        {"c", 257, movedBy(7, 8, 9)},
                        {"d", 258, glm::mat4(2)},
                        {"e", 2, movedBy(3, 1, 2)},
                        {"", 512, glm::mat4(1)}}; // b and f, transformed to world space
    ASSERT_EQ(scene.instances.size(), std::size(rows));
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const Instance& instance = scene.instances[i];
        EXPECT_EQ(instance.name, rows[i].name) << i;
        EXPECT_EQ(instance.toWorld, rows[i].transform) << i;
        EXPECT_EQ(scene.meshes.at(std::size_t(instance.mesh)).triangleCount(), rows[i].triangles) << i;
    }
    EXPECT_EQ(scene.meshes.size(), 4u);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
    const Mesh& joined = scene.meshes[std::size_t(scene.instances.back().mesh)];
    EXPECT_EQ(joined.positions[0], glm::vec3(4, 5, 6));
    EXPECT_EQ(joined.positions[767], glm::vec3(4 + 255, 6, 6)); // the last vertex of b
    EXPECT_EQ(joined.positions[768], glm::vec3(0, 0, 0));       // the first vertex of f
    EXPECT_EQ(joined.indices[768], 768u);
}

// Meshes with different vertex attributes are not joined.
TEST(SceneParts, areJoinedOnlyWithTheSameAttributes)
{
    Mesh full = triangles(1);
    full.tangents.assign(3, {1, 0, 0, 1});
    full.texcoords[0] = {{0, 0.25f}, {1, 0.5f}, {0, 0.75f}};
    full.texcoords[1] = {{0.1f, 0}, {0.2f, 0}, {0.3f, 0}};
    full.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 0.5f}};
    std::vector<Mesh> meshes(6, full);
    meshes[1].normals.clear();
    meshes[2].tangents.clear();
    meshes[3].texcoords[0].clear();
    meshes[4].texcoords[1].clear();
    meshes[5].colors.clear();
    Scene scene = sceneWith(meshes);
    for (int round = 0; round < 2; ++round)
        for (int m = 0; m < 6; ++m)
            scene.instances.push_back({"", m, movedBy(float(m), float(round), 0)});
    joinParts(scene, 1);
    ASSERT_EQ(scene.meshes.size(), 6u);
    int complete = 0;
    for (const Mesh& m : scene.meshes) {
        EXPECT_EQ(m.triangleCount(), 2u);
        const std::size_t sizes[] = {m.normals.size(), m.tangents.size(), m.texcoords[0].size(), m.texcoords[1].size(),
                                     m.colors.size()};
        int none = 0;
        for (const std::size_t size : sizes) {
            EXPECT_TRUE(size == 0 || size == 6u) << size;
            none += size == 0;
        }
        EXPECT_LE(none, 1);
        if (none > 0)
            continue;
        ++complete;
        for (std::size_t v = 0; v < 6; ++v) {
            EXPECT_EQ(m.texcoords[0][v], full.texcoords[0][v % 3]) << v;
            EXPECT_EQ(m.texcoords[1][v], full.texcoords[1][v % 3]) << v;
            EXPECT_EQ(m.colors[v], full.colors[v % 3]) << v;
        }
    }
    EXPECT_EQ(complete, 1);
}

// Normals stay perpendicular to the surface and tangents in it, and both stay unit vectors.
TEST(SceneParts, keepNormalsAndTangentsValidUnderStretching)
{
    Mesh mesh = triangles(1);
    mesh.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}}; // in the plane z = x
    const float r = std::sqrt(0.5f);
    mesh.normals.assign(3, {-r, 0, r});
    mesh.tangents.assign(3, {r, 0, r, -1});
    Scene scene = sceneWith({mesh});
    glm::mat4 stretched(1);
    stretched[0][0] = 3;
    stretched[1][1] = 5;
    scene.instances = {{"", 0, stretched}, {"", 0, movedBy(9, 0, 0)}};
    joinParts(scene, 1);
    const Mesh& joined = scene.meshes.at(0);
    ASSERT_EQ(joined.normals.size(), 6u);
    const float length = std::sqrt(10.0f); // of (3, 0, 1), the tangent's direction
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(joined.normals[0][c], (glm::vec3(-1, 0, 3) / length)[c], 1e-6f) << c;
        EXPECT_NEAR(joined.tangents[0][c], (glm::vec3(3, 0, 1) / length)[c], 1e-6f) << c;
        EXPECT_NEAR(joined.normals[3][c], mesh.normals[0][c], 1e-6f) << c;
    }
    EXPECT_EQ(joined.tangents[0].w, -1);
}

// ---- limits ------------------------------------------------------------------------------------

// One pixel is one unit, with the origin in the centre of 128 x 128 pixels. All numbers are exact.
View pixelView(int width = 128)
{
    View view;
    view.width = width;
    view.height = 128;
    view.camera.orthographic = true;
    view.camera.verticalExtent = 128;
    view.camera.eye = {0, 0, 5};
    view.camera.target = {0, 0, 0};
    return view;
}

// A right triangle `times` times, with its right angle at (x, y) and legs `wide` along x and `high` along y.
Scene oneTriangle(float x, float y, float wide, float high, std::size_t times = 1)
{
    Mesh mesh = triangles(1);
    mesh.positions = {{x, y, 0}, {x + wide, y, 0}, {x, y + high, 0}};
    Scene scene = sceneWith({mesh});
    scene.instances.assign(times, {"", 0, glm::mat4(1)});
    return scene;
}

std::string refusedWith(Scene scene, const View& view, std::size_t images = 1)
{
    const Status settled = limitCoverage(scene, view, images);
    return settled ? "" : settled.error().message;
}

void expectLimit(const Scene& allowed, const Scene& excessive, const View& view, const std::string& message)
{
    EXPECT_EQ(refusedWith(allowed, view), "");
    EXPECT_EQ(refusedWith(excessive, view), "model: " + message);
}

TEST(SceneParts, areRefusedJustAboveEachLimit)
{
    const std::string advice = ": move the camera away, or remove some triangles";
    // Each covers half of the image: 128 of them cover it 64 times, 129 of them 64.5 times.
    expectLimit(oneTriangle(-64, -64, 128, 128, 128), oneTriangle(-64, -64, 128, 128, 129), pixelView(),
                "its triangles cover the image 65 times, expected at most 64" + advice);
    EXPECT_NE(refusedWith(oneTriangle(-64, -64, 128, 128, 66), pixelView(), 2), "") << "two halves of the size";
    Scene allowed = oneTriangle(-64, -64, 128, 128, 64), excessive = oneTriangle(-64, -64, 128, 128, 66);
    for (Scene* scene : {&allowed, &excessive})
        scene->materials[0].alphaMode = AlphaMode::blend; // counts half
    expectLimit(allowed, excessive, pixelView(),
                "its translucent triangles cover the image 17 times, expected at most 16" + advice);
    // Bounding boxes of 48 x 64 have diagonals of 80, 64 pixels over the free 16. 512 of them fill the image twice.
    expectLimit(oneTriangle(0, 0, 48, 64, 512), oneTriangle(0, 0, 48, 64, 544), pixelView(),
                "the long edges of its triangles cover the image 2.1 times, expected at most 2" + advice);
    Scene longEdges = oneTriangle(0, 0, 48, 64, 1024); // fills it 4 times, the limit for 60,000 positions
    longEdges.meshes.push_back(triangles(1));
    std::vector<glm::vec3>& others = longEdges.meshes[1].positions;
    others.resize(60'000 - 3, glm::vec3(0));
    for (std::size_t i = 0; i < others.size(); ++i)
        others[i].y = float(i / 2) * (i % 2 ? 1.0f : -1.0f) + 0.5f;
    Scene fewer = longEdges;
    fewer.meshes[1].positions.back() = fewer.meshes[1].positions.front();
    expectLimit(longEdges, fewer, pixelView(),
                "the long edges of its triangles cover the image 2 times, expected at most 2" + advice);
}

TEST(SceneParts, lightsTimesCoverageIsLimitedTo200)
{
    for (const auto& [triangles, allowed, times] : {std::tuple(1, 400, "201"), {2, 200, "201"}, {3, 200, "201"}}) {
        const Scene scene = oneTriangle(-64, -64, 128, 128, std::size_t(triangles));
        View view = pixelView();
        view.lights.resize(std::size_t(allowed));
        EXPECT_EQ(refusedWith(scene, view), "") << triangles;
        view.lights.resize(std::size_t(allowed) + 1);
        EXPECT_EQ(refusedWith(scene, view),
                  "model: its lights illuminate the image " + std::string(times)
                      + " times, expected at most 200: remove some lights");
    }
}

TEST(SceneParts, loseRepeatedTrianglesAboveACoverageOf20)
{
    for (const std::size_t times : {40, 41}) {
        Scene scene = oneTriangle(-64, -64, 128, 128);
        std::vector<std::uint32_t>& indices = scene.meshes[0].indices;
        for (std::size_t i = 1; i < times; ++i)
            indices.insert(indices.end(), {0, 1, 2});
        EXPECT_TRUE(limitCoverage(scene, pixelView()));
        EXPECT_EQ(scene.meshes[0].triangleCount(), times == 40 ? 40u : 1u);
    }
}

TEST(SceneParts, coverageIsClippedToTheImage)
{
    struct Row {
        float x, y, wide, high;
        double pixels;
    };
    for (const Row& row : {Row{-10, -20, 30, 40, 600},               // inside
                           {-96, -10, 64, 20, 32.0 * 20},            // left: only the box of the remainder
                           {-10, -96, 20, 64, 20 * 32.0},            // below
                           {96, -10, 200, 20, 0},                    // only in the wider image
                           {-64, -300, 128, 236, 0},                 // touches the edge
                           {-1000, -1000, 4000, 4000, 128 * 128}}) { // covers the image
        const Scene scene = oneTriangle(row.x, row.y, row.wide, row.high);
        EXPECT_EQ(pixelsCovered(scene, pixelView()), row.pixels) << row.x << " " << row.y;
    }
    const Scene right = oneTriangle(96, -10, 200, 20);
    EXPECT_EQ(pixelsCovered(right, pixelView(256)), 32.0 * 20); // from 96 to 128
    const Scene wide = oneTriangle(-300, -300, 900, 900);
    EXPECT_EQ(pixelsCovered(wide, pixelView(256)), 256.0 * 128);
}

TEST(SceneParts, coverHalfTheImageIfPartlyBehindTheEye)
{
    View view = pixelView(256);
    for (const bool orthographic : {true, false}) {
        view.camera.orthographic = orthographic;
        for (int behind = 0; behind <= 3; ++behind) {
            Scene scene = oneTriangle(-1, -1, 2, 2);
            for (int k = 0; k < behind; ++k)
                scene.meshes[0].positions[std::size_t(k)].z = 5; // at the eye, no longer in front of it
            const double found = pixelsCovered(scene, view);
            if (behind == 0)
                EXPECT_LT(found, 2000) << orthographic;
            else
                EXPECT_EQ(found, behind == 3 ? 0 : 128.0 * 128) << orthographic << behind;
        }
    }
}

// ---- triangles that repeat ---------------------------------------------------------------------

// Triangles 1 to `same` repeat triangle 0; the others differ. With `keysDiffer` every triangle has its own key.
std::vector<std::uint8_t> repeatedOf(std::size_t count, std::size_t same, bool keysDiffer = false)
{
    return repeatedTriangles(count, [&](std::size_t i) {
        const float x = i <= same ? 0.0f : float(i);
        return CornersOfTriangle{{glm::vec3(x, 1, 2), {x + 1, 1, 2}, {x, 2, 3}},
                                 keysDiffer ? std::int64_t(i) << 32 : 7};
    });
}

TEST(RepeatedTriangles, areCountedOnlyIfFortySampledOnesRepeat)
{
    EXPECT_TRUE(repeatedOf(100, 39).empty());
    EXPECT_TRUE(repeatedOf(100, 99, true).empty()) << "their keys differ";
    EXPECT_TRUE(repeatedOf(0, 0).empty());
    const std::vector<std::uint8_t> forty = repeatedOf(100, 40);
    ASSERT_EQ(forty.size(), 100u);
    for (std::size_t i = 0; i < forty.size(); ++i)
        EXPECT_EQ(int(forty[i]), i > 40 ? 0 : i < 2 ? int(i) : 2) << i;
    // Of 8192 triangles every second is sampled: 40 of the 80 that repeat.
    EXPECT_EQ(repeatedOf(8192, 81).size(), 8192u);
    EXPECT_TRUE(repeatedOf(8192, 79).empty());
}

} // namespace
} // namespace cotan
