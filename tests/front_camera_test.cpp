// Cameras that fill the image, checked by projecting each vertex separately.
#include "cotan/view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/scene.hpp"

namespace cotan {
namespace {

Scene sceneWithInstance(Mesh mesh, const glm::mat4& toWorld)
{
    Scene scene;
    scene.materials.resize(1);
    scene.meshes.push_back(std::move(mesh));
    scene.instances.resize(1);
    scene.instances[0].toWorld = toWorld;
    return scene;
}

struct Extent {
    double left = 9, right = -9, bottom = 9, top = -9; // the image is -1 to 1
};

Extent extentOf(const Scene& scene, const Camera& camera, double aspect)
{
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.eye));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tanY = std::tan(camera.verticalFieldOfView / 2.0);
    Extent e;
    for (const glm::vec3& p : scene.meshes[0].positions) {
        const glm::dvec3 d =
            glm::dvec3(glm::dmat4(scene.instances[0].toWorld) * glm::dvec4(glm::dvec3(p), 1)) - glm::dvec3(camera.eye);
        const double depth = glm::dot(d, forward);
        EXPECT_GT(depth, 0);
        const double x = glm::dot(d, right) / (depth * tanY * aspect), y = glm::dot(d, up) / (depth * tanY);
        e.left = std::min(e.left, x), e.right = std::max(e.right, x);
        e.bottom = std::min(e.bottom, y), e.top = std::max(e.top, y);
    }
    return e;
}

TEST(FrontCamera, verticesFillTheImageInOneDirectionAndAreCentredInBoth)
{
    glm::mat4 moved(1), stretched(1);
    moved[3] = glm::vec4(30, -20, 5, 1);
    stretched[0][0] = 7, stretched[3] = glm::vec4(-1000, 2, 3, 1);
    for (const glm::mat4& toWorld : {glm::mat4(1), moved, stretched, glm::mat4(1e-3f)})
        for (const auto& [width, height] : {std::pair(640, 480), std::pair(300, 900)}) {
            const Scene scene = sceneWithInstance(makeTeapot(6), toWorld);
            const Extent e = extentOf(scene, frontCamera(scene, width, height), double(width) / height);
            const double wide = std::max(-e.left, e.right), high = std::max(-e.bottom, e.top);
            EXPECT_NEAR(std::max(wide, high), 0.92, 0.003);              // the eye is stored as float
            EXPECT_NEAR(e.left + e.right, 0, wide > high ? 0.003 : 0.1); // equal margins in the tight direction
            EXPECT_NEAR(e.bottom + e.top, 0, high > wide ? 0.003 : 0.1);
        }
}

TEST(FrontCamera, flatModelsAreSeenFaceOnAndPointsGetAFiniteCamera)
{
    Mesh quad;
    quad.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const Camera camera = frontCamera(sceneWithInstance(quad, glm::mat4(1)), 100, 100);
    EXPECT_EQ(camera.eye.x, camera.target.x);
    EXPECT_EQ(camera.eye.y, camera.target.y);
    EXPECT_GT(camera.eye.z, camera.target.z);
    Mesh point;
    point.positions = {{5000, 0, 0}};
    const Camera near = frontCamera(sceneWithInstance(point, glm::mat4(1)), 100, 100);
    EXPECT_NE(near.eye, near.target);
    EXPECT_EQ(near.target, glm::vec3(5000, 0, 0));
    EXPECT_EQ(frontCamera(Scene{}, 100, 100).eye, Camera{}.eye);
}

TEST(OrbitCamera, sidesAreSeenFaceOnAndFillTheImage)
{
    struct Case {
        double azimuth, elevation;
        glm::vec3 from, up;
    };
    const Scene scene = sceneWithInstance(makeTeapot(6), glm::mat4(1));
    for (const Case& c :
         {Case{0, 0, {0, 0, 1}, {0, 1, 0}}, Case{90, 0, {1, 0, 0}, {0, 1, 0}}, Case{-90, 0, {-1, 0, 0}, {0, 1, 0}},
          Case{270, 0, {-1, 0, 0}, {0, 1, 0}}, Case{180, 0, {0, 0, -1}, {0, 1, 0}}, Case{0, 90, {0, 1, 0}, {0, 0, -1}},
          Case{0, -90, {0, -1, 0}, {0, 0, 1}}, Case{90, 90, {0, 1, 0}, {-1, 0, 0}}}) {
        const Camera camera = orbitCamera(scene, c.azimuth, c.elevation, 640, 480);
        const glm::vec3 from = glm::normalize(camera.eye - camera.target);
        EXPECT_LT(glm::distance(from, c.from), 1e-6f) << c.azimuth << " " << c.elevation;
        EXPECT_EQ(camera.up, c.up) << c.azimuth << " " << c.elevation;
        const Extent e = extentOf(scene, camera, 640.0 / 480);
        EXPECT_NEAR(std::max({-e.left, e.right, -e.bottom, e.top}), 0.92, 0.003);
    }
}

TEST(OrbitCamera, anglesAreMeasuredFromTheFrontAndTheHorizon)
{
    const Scene scene = sceneWithInstance(makeTeapot(6), glm::mat4(1));
    for (const auto& [azimuth, elevation] : {std::pair(30.0, 20.0), std::pair(-120.0, -45.0), std::pair(200.0, 80.0)}) {
        const Camera camera = orbitCamera(scene, azimuth, elevation, 200, 100);
        const glm::dvec3 from = glm::normalize(glm::dvec3(camera.eye) - glm::dvec3(camera.target));
        EXPECT_NEAR(std::asin(from.y) * 57.29577951308232, elevation, 1e-3);
        EXPECT_NEAR(std::remainder(std::atan2(from.x, from.z) * 57.29577951308232 - azimuth, 360.0), 0, 1e-3);
    }
    EXPECT_EQ(orbitCamera(Scene{}, 30, 20, 100, 100).eye, Camera{}.eye);
}

} // namespace
} // namespace cotan
