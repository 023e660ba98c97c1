// Basic geometry: boxes, cameras that show everything, normals from triangles.
#include "scene/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "cotan/scene.hpp"

namespace cotan {
namespace {

// The cube [-1,1]^3 with eight shared vertices and twelve triangles that face outwards.
Mesh sharedCube()
{
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return mesh;
}

// Projects a point: x and y in [-1,1] if visible, z the distance in front of the camera.
glm::vec3 project(const Camera& camera, float aspect, glm::vec3 p)
{
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    const glm::vec3 d = p - camera.eye;
    const float depth = glm::dot(d, forward);
    const float scale = 1 / (depth * std::tan(camera.verticalFieldOfView / 2));
    return {glm::dot(d, right) * scale / aspect, glm::dot(d, up) * scale, depth};
}

TEST(Bounds, areOfTheTransformedInstances)
{
    Scene scene;
    scene.meshes = {sharedCube(), Mesh{}};
    scene.instances.push_back({"a", 0, glm::translate(glm::mat4(1), glm::vec3(10, 0, 0))});
    scene.instances.push_back({"b", 0, glm::scale(glm::mat4(1), glm::vec3(1, -3, 1))});
    scene.instances.push_back({"nothing", 1, glm::translate(glm::mat4(1), glm::vec3(99))});
    const Bounds box = bounds(scene);
    EXPECT_EQ(box.low, glm::vec3(-1, -3, -1));
    EXPECT_EQ(box.high, glm::vec3(11, 3, 1));
    EXPECT_TRUE(bounds(Scene{}).empty());
}

// A scene whose only mesh has the second of two materials, of one image each.
Scene twoMaterials(const char* name)
{
    Scene scene;
    scene.images.resize(2);
    scene.images[1].name = name;
    scene.materials.resize(2);
    scene.materials[1].copyOf = 0;
    scene.materials[1].normalMap.image = scene.materials[1].heightMap.map.image = 1;
    scene.meshes = {sharedCube()};
    scene.meshes[0].material = 1;
    scene.instances.push_back({name, 0, glm::mat4(1)});
    scene.warnings = {name};
    return scene;
}

TEST(AppendScene, keepsWhatEachIndexMeans)
{
    Scene scene = twoMaterials("a");
    appendScene(scene, twoMaterials("b"));
    appendScene(scene, Scene{});
    ASSERT_EQ(scene.images.size(), 4u);
    ASSERT_EQ(scene.materials.size(), 4u);
    ASSERT_EQ(scene.instances.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Material& material = scene.materials[std::size_t(mesh.material)];
        EXPECT_EQ(scene.images[std::size_t(material.normalMap.image)].name, instance.name);
        EXPECT_EQ(scene.images[std::size_t(material.heightMap.map.image)].name, instance.name);
        EXPECT_EQ(material.copyOf, mesh.material - 1);
        EXPECT_FALSE(material.baseColorMap.present());
        EXPECT_EQ(scene.warnings[i], instance.name);
    }
    EXPECT_EQ(scene.materials[2].copyOf, -1);
}

// Points on the unit sphere, including its poles on all axes.
Mesh pointsOnASphere(int count)
{
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const float a = 2.4f * float(i), z = 2 * (float(i) + 0.5f) / float(count) - 1;
        mesh.positions.push_back({std::cos(a) * std::sqrt(1 - z * z), std::sin(a) * std::sqrt(1 - z * z), z});
    }
    for (int axis = 0; axis < 3; ++axis)
        for (const float s : {-1.0f, 1.0f}) {
            mesh.positions.push_back(glm::vec3(0));
            mesh.positions.back()[axis] = s;
        }
    return mesh;
}

TEST(Bounds, areTightForFewInstancesAndEncloseTheBoxesOfMany)
{
    Scene scene;
    scene.meshes = {pointsOnASphere(4000)};
    const glm::mat4 rotated = glm::rotate(glm::mat4(1), 0.6f, glm::normalize(glm::vec3(1, 2, 3)));
    scene.instances = {{"", 0, rotated}};
    const Bounds one = bounds(scene);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(one.high[axis], 1, 2e-3f); // a sphere sampled by 4000 points
        EXPECT_NEAR(one.low[axis], -1, 2e-3f);
    }
    // With 4006 vertices each, 4188 instances are the most that are transformed vertex by vertex.
    scene.instances.assign(kMaxExactBoundsVertices / 4006, {"", 0, rotated});
    EXPECT_EQ(bounds(scene).high, one.high);
    scene.instances.push_back({"", 0, rotated});
    const Bounds many = bounds(scene);
    for (int axis = 0; axis < 3; ++axis) { // corners of the rotated [-1, 1]^3: absolute sums of the rows
        const float reach = std::abs(rotated[0][axis]) + std::abs(rotated[1][axis]) + std::abs(rotated[2][axis]);
        EXPECT_NEAR(many.high[axis], reach, 1e-6f);
        EXPECT_NEAR(many.low[axis], -reach, 1e-6f);
    }
}

TEST(Bounds, areExactForAMillionTranslatedInstances)
{
    Scene scene;
    scene.meshes = {pointsOnASphere(4000)};
    for (int i = 0; i < 1'000'000; ++i)
        scene.instances.push_back({"", 0, glm::translate(glm::mat4(1), glm::vec3(i % 100, i / 100 % 100, i / 10000))});
    const Bounds box = bounds(scene);
    EXPECT_EQ(box.low, glm::vec3(-1));
    EXPECT_EQ(box.high, glm::vec3(100));
}

TEST(Bounds, omitNonFinitePointsAndHoldTheLargestFloats)
{
    Scene scene;
    scene.meshes = {sharedCube()};
    scene.meshes[0].positions.push_back(glm::vec3(std::numeric_limits<float>::infinity(), 0, 0));
    scene.meshes[0].positions.push_back(glm::vec3(0, std::nanf(""), 0));
    scene.instances = {{"", 0, glm::mat4(1)}, {"", 7, glm::mat4(1)}, {"", -1, glm::mat4(1)}};
    EXPECT_EQ(bounds(scene).high, glm::vec3(1));
    scene.meshes[0].positions.assign(1, glm::vec3(2e38f, -3e38f, 1e35f));
    EXPECT_EQ(bounds(scene).low, glm::vec3(2e38f, -3e38f, 1e35f));
    EXPECT_EQ(bounds(scene).high, glm::vec3(2e38f, -3e38f, 1e35f));
    scene.meshes[0].positions.clear();
    EXPECT_TRUE(bounds(scene).empty());
}

TEST(FitCamera, wholeBoxIsVisibleAndFillsTheImageAtAnyAspectRatio)
{
    const Bounds boxes[] = {{{-1, -1, -1}, {1, 1, 1}},
                            {{100, 5, -3}, {100.1f, 9, 4}},
                            {{-50, 0, -1}, {50, 0.1f, 1}},
                            {{-1, -1, 0}, {1, 1, 0}},
                            {{0, 0, -1000}, {1, 1, 1000}}};
    for (const Bounds& box : boxes) {
        for (const auto& [width, height] : {std::pair(1280, 720), {100, 1000}, {3000, 200}, {1, 1}}) {
            const Camera camera = fitCamera(box, width, height);
            float largest = 0;
            for (int i = 0; i < 8; ++i) {
                const glm::vec3 corner(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                       i & 4 ? box.high.z : box.low.z);
                const glm::vec3 p = project(camera, float(width) / float(height), corner);
                EXPECT_GT(p.z, 0);
                EXPECT_LT(std::abs(p.x), 0.97f);
                EXPECT_LT(std::abs(p.y), 0.97f);
                largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
            }
            EXPECT_GT(largest, 0.9f); // one corner is at the margin
        }
    }
}

TEST(FitCamera, flatPlanesAreSeenFaceOnAndSolidsObliquely)
{
    const Camera plane = fitCamera({{-2, -1, 0}, {2, 1, 0.01f}}, 640, 480);
    EXPECT_EQ(plane.eye.x, plane.target.x);
    EXPECT_EQ(plane.eye.y, plane.target.y);
    EXPECT_GT(plane.eye.z, plane.target.z);
    const Camera solid = fitCamera({{-1, -1, -1}, {1, 1, 1}}, 640, 480);
    EXPECT_GT(solid.eye.x, 0);
    EXPECT_GT(solid.eye.y, 0);
    EXPECT_GT(solid.eye.z, std::max(solid.eye.x, solid.eye.y));
}

TEST(RotatedAbout, aQuarterIsCounterclockwiseFromAboveAndFourAreTheIdentity)
{
    Camera camera;
    camera.eye = {1, 2, 5};
    camera.target = {1, 0, 2};
    const Camera quarter = orbitedCamera(camera, std::numbers::pi / 2);
    EXPECT_LT(glm::distance(quarter.eye, glm::vec3(4, 2, 2)), 1e-6f); // front (+z) moves to the right (+x)
    EXPECT_EQ(quarter.target, camera.target);
    EXPECT_EQ(quarter.up, camera.up);
    EXPECT_LT(glm::distance(orbitedCamera(camera, std::numbers::pi * 2).eye, camera.eye), 1e-6f);
}

TEST(DrawsNormalMaps, requiresAnInstanceWithTrianglesAndTheUvOfItsMap)
{
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].normalMap.image = 0;
    scene.meshes.resize(1);
    Mesh& mesh = scene.meshes[0];
    mesh.positions.resize(3);
    mesh.indices = {0, 1, 2};
    mesh.texcoords[0].resize(3);
    EXPECT_FALSE(drawsNormalMaps(scene)); // there is no instance
    scene.instances = {{"", 0, glm::mat4(1)}};
    EXPECT_TRUE(drawsNormalMaps(scene));
    scene.materials[0].normalMap.texcoord = 1;
    EXPECT_FALSE(drawsNormalMaps(scene));
    mesh.texcoords[1].resize(3);
    EXPECT_TRUE(drawsNormalMaps(scene));
    mesh.indices.clear();
    EXPECT_FALSE(drawsNormalMaps(scene));
    mesh.indices = {0, 1, 2};
    scene.materials[0].normalMap.image = -1;
    EXPECT_FALSE(drawsNormalMaps(scene));
}

TEST(FitCamera, emptyPointAndInfiniteBoxesGiveAFiniteCamera)
{
    const float inf = std::numeric_limits<float>::infinity();
    for (const Bounds& box :
         {Bounds{}, Bounds{{3, 3, 3}, {3, 3, 3}}, Bounds{glm::vec3(1e30f), glm::vec3(1e30f)},
          Bounds{{-inf, 0, 0}, {inf, 1, 1}}, Bounds{glm::vec3(-1e37f), glm::vec3(1e37f)},
          Bounds{{-1, -1, -1}, {1, 1, 3e38f}}, Bounds{{-1e38f, -1e38f, 0}, {1.7e38f, 1.7e38f, 1}}}) {
        for (const int size : {0, 100}) {
            const Camera camera = fitCamera(box, size, size);
            for (int c = 0; c < 3; ++c)
                EXPECT_TRUE(std::isfinite(camera.eye[c]) && std::isfinite(camera.target[c]));
            EXPECT_NE(camera.eye, camera.target);
        }
    }
}

TEST(DefaultLights, keyLightComesFromTheUpperLeftFront)
{
    const auto lights = defaultLights();
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].kind, LightKind::directional);
    EXPECT_GT(lights[0].direction.x, 0);
    EXPECT_LT(lights[0].direction.y, 0);
    EXPECT_LT(lights[0].direction.z, 0);
    EXPECT_NEAR(glm::length(lights[0].direction), 1, 1e-6);
}

TEST(GenerateNormals, cubeSmoothedHasDiagonalsWhateverItsTriangulation)
{
    // Weighted by angle, the three faces at a corner count equally; by area or number they would not.
    Mesh mesh = sharedCube();
    generateNormals(mesh);
    ASSERT_EQ(mesh.vertexCount(), 8u);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i])), 1, 1e-6);
}

TEST(GenerateNormals, cubeWithCreasesGetsThreeVerticesPerCorner)
{
    Mesh mesh = sharedCube();
    for (const glm::vec3& p : mesh.positions)
        mesh.texcoords[0].emplace_back(p.x + 2 * p.y, p.z);
    const auto texcoords = mesh.texcoords[0];
    const auto indices = mesh.indices;
    generateNormals(mesh, 60);
    ASSERT_EQ(mesh.vertexCount(), 24u);
    ASSERT_EQ(mesh.texcoords[0].size(), 24u);
    std::set<std::tuple<float, float, float>> normals;
    for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
        const std::size_t base = c / 3 * 3;
        const glm::vec3 a = mesh.positions[mesh.indices[base]];
        const glm::vec3 face = glm::normalize(
            glm::cross(mesh.positions[mesh.indices[base + 1]] - a, mesh.positions[mesh.indices[base + 2]] - a));
        const glm::vec3 normal = mesh.normals[mesh.indices[c]];
        EXPECT_NEAR(glm::dot(normal, face), 1, 1e-6);
        EXPECT_EQ(mesh.texcoords[0][mesh.indices[c]], texcoords[indices[c]]); // copied with the corner
        normals.emplace(normal.x, normal.y, normal.z);
    }
    EXPECT_EQ(normals.size(), 6u);
}

TEST(GenerateNormals, sphereIsSmoothAcrossItsTextureSeam)
{
    Mesh mesh = makeSphere(1, 64);
    mesh.normals.clear();
    generateNormals(mesh, 60);
    // Angle weights on a regular grid are second order in the cell size: (2 pi / 64)^2 = 0.0096 rad.
    for (const std::uint32_t i : mesh.indices)
        EXPECT_GT(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i])), std::cos(0.0096f));
}

TEST(GenerateNormals, degenerateTrianglesAndLooseVerticesGetAUnitNormal)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {2, 0, 0}, {5, 5, 5}};
    mesh.indices = {0, 1, 2, 0, 1, 3, 1, 1, 1}; // faces +y; collinear; a point
    for (const float crease : {30.0f, 180.0f}) {
        Mesh made = mesh;
        generateNormals(made, crease);
        for (const glm::vec3& n : made.normals)
            EXPECT_NEAR(glm::length(n), 1, 1e-6);
        EXPECT_EQ(made.normals[0], glm::vec3(0, 1, 0));
        EXPECT_EQ(made.normals[3], glm::vec3(0, 0, 1)); // no usable triangle
        EXPECT_EQ(made.normals[4], glm::vec3(0, 0, 1)); // no triangle
        EXPECT_EQ(made.vertexCount(), 5u);
    }
    Mesh empty;
    generateNormals(empty);
    EXPECT_TRUE(empty.normals.empty());
}

TEST(GenerateNormals, backToBackSheetsDoNotCancelToZero)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2, 2, 1, 0};
    generateNormals(mesh);
    for (const glm::vec3& n : mesh.normals)
        EXPECT_NEAR(glm::length(n), 1, 1e-6);
}

} // namespace
} // namespace cotan
