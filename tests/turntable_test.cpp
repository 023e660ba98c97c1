// Rotation of a model through a full turn: its poses, and cameras that see all of it.
#include "cotan/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "cotan/scene.hpp"
#include "cotan/view.hpp"
#include "scene/geometry.hpp"

namespace cotan {
namespace {

Scene movedTeapot()
{
    Scene scene = shapeScene("teapot");
    scene.instances[0].toWorld = glm::translate(glm::mat4(1), {3, -2, 7}) * scene.instances[0].toWorld;
    return scene;
}

TEST(Turntable, rotatesCounterClockwiseAboutTheCentre)
{
    Scene scene = movedTeapot();
    const glm::mat4 before = scene.instances[0].toWorld;
    const glm::vec3 middle = bounds(scene).centre();
    const Turntable table(scene);
    table.turn(scene, 90);
    const glm::vec3 right =
        scene.instances[0].toWorld * (glm::inverse(before) * glm::vec4(middle + glm::vec3(1, 2, 0), 1));
    EXPECT_LT(glm::distance(right, middle + glm::vec3(0, 2, -1)), 1e-5f); // the point on the right is now behind
    EXPECT_LT(glm::distance(bounds(scene).centre(), middle), 0.2f);
    table.turn(scene, 0);
    EXPECT_EQ(scene.instances[0].toWorld, before);
    table.turn(scene, 360);
    for (int i = 0; i < 4; ++i)
        EXPECT_LT(glm::distance(scene.instances[0].toWorld[i], before[i]), 1e-5f);
}

TEST(Turntable, doesNotMoveLightsAndCameras)
{
    Scene scene = builtinScene();
    const glm::vec3 light = scene.lights.at(0).direction, eye = scene.cameras.at(0).eye;
    Turntable(scene).turn(scene, 90);
    EXPECT_EQ(scene.lights[0].direction, light);
    EXPECT_EQ(scene.cameras[0].eye, eye);
}

// Maximum distance of a vertex from the centre of the image over all angles, relative to half its width or height.
double furthest(Scene scene, const Camera& camera, double aspect)
{
    const Turntable table(scene);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up))),
                     up = glm::cross(right, forward);
    const double tanY = std::tan(camera.verticalFieldOfView / 2.0);
    double largest = 0;
    for (int angle = 0; angle < 360; angle += 7) {
        table.turn(scene, angle);
        forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& point) {
            const glm::dvec3 d = glm::dvec3(toWorld * glm::vec4(point, 1)) - glm::dvec3(camera.eye);
            const double depth = glm::dot(d, forward);
            EXPECT_GT(depth, 0);
            largest = std::max({largest, std::abs(glm::dot(d, right)) / (depth * tanY * aspect),
                                std::abs(glm::dot(d, up)) / (depth * tanY)});
        });
    }
    return largest;
}

TEST(Turntable, oneCameraFramesTheModelAtEveryAngle)
{
    const Scene still = movedTeapot();
    Scene scene = still;
    scene.reach = sweptPoints(still);
    for (const double aspect : {16 / 9.0, 0.5}) {
        const int width = int(900 * aspect);
        for (const Camera& camera : {frontCamera(scene, width, 900), orbitCamera(scene, 40, 60, width, 900)}) {
            const double largest = furthest(still, camera, aspect);
            EXPECT_LT(largest, 0.93);
            EXPECT_GT(largest, 0.85);
        }
        // The camera for one pose cuts off another.
        EXPECT_GT(furthest(still, frontCamera(still, width, 900), aspect), aspect < 1 ? 0.9 : 0.0);
    }
}

// sweptPoints returns 33 rings of 32 points. The rings directly above and below a vertex have at least its radius, and
// at most that of the vertices in the adjacent slices.
TEST(Turntable, adjacentRingsEncloseTheCircleOfAVertex)
{
    std::mt19937 dice(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int round = 0; round < 20; ++round) {
        Scene scene;
        scene.materials.emplace_back();
        Mesh mesh;
        for (int i = 0; i < 24; ++i) // most points near the axis, so that slices differ
            mesh.positions.push_back({unit(dice) * unit(dice) * unit(dice), 3 * unit(dice), unit(dice) * unit(dice)});
        for (std::uint32_t i = 0; i + 2 < 24; ++i)
            mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + 2});
        scene.meshes = {mesh};
        scene.instances.push_back({"", 0, glm::translate(glm::mat4(1), {4, -1, 2})});
        const std::vector<glm::vec3> points = sweptPoints(scene);
        ASSERT_EQ(points.size(), 32u * 33u);
        const Bounds box = bounds(scene);
        const glm::dvec3 middle = (glm::dvec3(box.low) + glm::dvec3(box.high)) / 2.0;
        const double height = double(box.high.y) - double(box.low.y);
        std::array<double, 33> needed{};
        for (const glm::vec3& p : mesh.positions) {
            const glm::dvec3 placed = glm::dvec3(p) + glm::dvec3(4, -1, 2);
            const double radius = std::hypot(placed.x - middle.x, placed.z - middle.z);
            const std::size_t slice =
                std::min(std::size_t((placed.y - double(box.low.y)) / height * 32), std::size_t(31));
            for (const std::size_t ring : {slice, slice + 1})
                needed[ring] = std::max(needed[ring], radius);
        }
        for (std::size_t ring = 0; ring < 33; ++ring)
            for (std::size_t k = 0; k < 32; ++k) {
                const glm::dvec3 p(points[32 * ring + k]);
                const double radius = std::hypot(p.x - middle.x, p.z - middle.z);
                EXPECT_GT(radius + 1e-5, needed[ring]) << round << " " << ring; // rounding of float
                EXPECT_LT(radius, needed[ring] * 1.006 + 1e-5) << round << ' ' << ring;
                EXPECT_NEAR(p.y, double(box.low.y) + height * double(ring) / 32, 1e-5);
            }
    }
}

TEST(Turntable, aSceneWithoutExtentSweepsNothing)
{
    EXPECT_TRUE(sweptPoints(Scene{}).empty());
    Scene scene;
    scene.instances.resize(1);
    Turntable(scene).turn(scene, 30); // no mesh
    EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(Turntable, sweepsPointsOnlyOnRequest)
{
    const auto reach = [](const PictureOptions& options) {
        auto picture = openPicture(options, 1, {FrameChoice()});
        EXPECT_TRUE(picture) << picture.error().message;
        return picture ? picture->scene.reach.size() : 0;
    };
    PictureOptions options;
    options.shape = "torus";
    options.device = "reference";
    EXPECT_EQ(reach(options), 0u);
    options.turntable = true;
    EXPECT_GT(reach(options), 0u);
}

} // namespace
} // namespace cotan
