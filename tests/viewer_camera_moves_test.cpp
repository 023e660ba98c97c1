// Camera movements: compared with formulas and projections by hand for random cameras, and at both sides of limits.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

#include "camera.hpp"
#include "command_words.hpp"
#include "viewer_camera_cases.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

float difference(float a, float b) { return std::remainder(a - b, 360.0f); }

Camera randomCamera(std::mt19937& dice)
{
    std::uniform_real_distribution<float> within(-4, 4);
    Camera camera;
    camera.target = {within(dice), within(dice), within(dice)};
    camera.eye = camera.target + glm::vec3(within(dice), within(dice) * 0.7f, 1 + std::abs(within(dice)));
    camera.up = {0, 1, 0};
    camera.verticalFieldOfView = 0.3f + std::abs(within(dice)) / 4;
    camera.verticalExtent = 1 + std::abs(within(dice));
    camera.orthographic = dice() % 2;
    return camera;
}

TEST(ViewerCameraMoves, rotateByTheGivenAngles)
{
    std::mt19937 dice(7);
    std::uniform_real_distribution<float> turn(-1, 1);
    for (int i = 0; i < 300; ++i) {
        const Camera before = randomCamera(dice);
        const float right = turn(dice), upward = 0.4f * turn(dice), distance = glm::length(before.eye - before.target);
        Camera camera = before;
        orbit(camera, right, upward);
        const glm::vec2 was = anglesFrom(before), is = anglesFrom(camera);
        EXPECT_NEAR(difference(is.x, was.x + right * kDegreesOfRadian), 0, 0.02f);
        EXPECT_NEAR(is.y, std::min(was.y + upward * kDegreesOfRadian, 1.56f * kDegreesOfRadian), 0.05f);
        EXPECT_NEAR(glm::length(camera.eye - camera.target), distance, 1e-4f * distance);
        camera = before;
        look(camera, right, upward); // an orbit about the eye: eye and pivot change roles
        Camera reversed = before;
        std::swap(reversed.eye, reversed.target);
        const glm::vec2 from = anglesFrom(reversed);
        reversed.eye = camera.target, reversed.target = camera.eye;
        EXPECT_NEAR(difference(anglesFrom(reversed).x, from.x - right * kDegreesOfRadian), 0, 0.02f);
        EXPECT_NEAR(anglesFrom(reversed).y, from.y + upward * kDegreesOfRadian, 0.05f);
        EXPECT_EQ(camera.eye, before.eye);
    }
}

// onPicture agrees with a projection by hand: x to the right and y down, from the centre of the image.
TEST(ViewerCameraMoves, projectionMatchesItsDefinition)
{
    std::mt19937 dice(11);
    std::uniform_real_distribution<float> within(-3, 3);
    const glm::ivec2 size{800, 600};
    for (int i = 0; i < 300; ++i) {
        const Camera camera = randomCamera(dice);
        const glm::vec3 point = camera.target + glm::vec3(within(dice), within(dice), within(dice)) * 0.2f;
        const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
        const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
        const glm::vec3 to = point - camera.eye;
        const float depth = glm::dot(to, forward);
        const float high =
            camera.orthographic ? camera.verticalExtent : 2 * depth * std::tan(camera.verticalFieldOfView / 2);
        const glm::vec3 seen = projectToImage(camera, point, size);
        EXPECT_NEAR(seen.x, 400 + glm::dot(to, right) / high * 600, 0.05f);
        EXPECT_NEAR(seen.y, 300 - glm::dot(to, up) / high * 600, 0.05f);
        EXPECT_NEAR(seen.z, camera.orthographic ? 1 : depth, 1e-4f);
        EXPECT_NEAR(unitsOfPixel(camera, depth, size), high / 600, 1e-6f);
    }
}

TEST(ViewerCameraMoves, pointsBehindAPerspectiveEyeProjectToTheCentre)
{
    const glm::vec3 behind = projectToImage(levelCamera(), {1, 2, 7}, {800, 600});
    EXPECT_EQ(behind, glm::vec3(400, 300, -2));
    const glm::vec3 parallel = projectToImage(levelCamera(true), {1, 2, 7}, {800, 600});
    expectClose(parallel, {400 + 150, 300 - 300, 1}, 1e-3f);
    EXPECT_GT(unitsOfPixel(levelCamera(true), 5, {800, 0}), 0); // no division by the height of 0
}

TEST(ViewerCameraMoves, stopJustShortOfStraightUpAndDown)
{
    for (const float direction : {1.0f, -1.0f}) {
        Camera camera = levelCamera();
        orbit(camera, 0.3f, direction * 9);
        EXPECT_NEAR(anglesFrom(camera).y, direction * 1.56f * kDegreesOfRadian, 0.01f);
        EXPECT_NEAR(anglesFrom(camera).x, 0.3f * kDegreesOfRadian, 0.05f);
        camera = levelCamera();
        look(camera, 0, direction * 9);
        const glm::vec3 to = glm::normalize(camera.target - camera.eye);
        EXPECT_NEAR(std::asin(to.y) * kDegreesOfRadian, direction * 1.56f * kDegreesOfRadian, 0.01f);
    }
}

// Seen straight from above, the top of the image is -z; an orbit continues from that side.
TEST(ViewerCameraMoves, continueFromAboveAndBelowWithoutAJump)
{
    for (const auto& [side, direction] : {std::pair("top", -0.5f), {"bottom", 0.5f}}) {
        Camera camera = levelCamera();
        ASSERT_TRUE(viewFrom(camera, side));
        EXPECT_EQ(camera.up, (side == std::string("top") ? glm::vec3(0, 0, -1) : glm::vec3(0, 0, 1)));
        orbit(camera, 0, direction);
        EXPECT_NEAR(camera.eye.x, 0, 1e-3f) << side;
        EXPECT_NEAR(camera.eye.z, 5 * std::sin(0.5f), 0.01f) << side;
    }
}

TEST(ViewerCameraMoves, areRefusedForDegenerateCameras)
{
    const Camera before = levelCamera();
    const auto unchanged = [&](const Camera& after) {
        return after.eye == before.eye && after.target == before.target
            && after.verticalExtent == before.verticalExtent;
    };
    Camera camera = before;
    zoomTo(camera, 1e-7f, {0, 0}, {800, 600}); // 5e-7 units from the pivot
    EXPECT_TRUE(unchanged(camera));
    zoomTo(camera, 1e12f, {400, 300}, {800, 600}); // beyond 1e12
    EXPECT_TRUE(unchanged(camera));
    fly(camera, {INFINITY, 0, 0});
    EXPECT_TRUE(unchanged(camera));
    setPivot(camera, {0, 3, 5}); // directly above the eye
    EXPECT_TRUE(unchanged(camera));
    setPivot(camera, {NAN, 0, 0});
    EXPECT_TRUE(unchanged(camera));
    zoomTo(camera, 1e-6f, {400, 300}, {800, 600});
    EXPECT_NEAR(glm::length(camera.eye), 5e-6f, 1e-7f);
    camera = levelCamera(true);
    zoomTo(camera, 1e-7f, {400, 300}, {800, 600}); // 4e-7 units high
    EXPECT_EQ(camera.verticalExtent, 4.0f);
    zoomTo(camera, 1e12f, {400, 300}, {800, 600});
    EXPECT_EQ(camera.verticalExtent, 4.0f);
}

TEST(ViewerCameraMoves, anOrthographicPivotMovesTheEye)
{
    Camera camera = levelCamera(true);
    setPivot(camera, {1, 2, -3});
    EXPECT_EQ(camera.target, glm::vec3(1, 2, -3));
    expectClose(camera.eye, {1, 2, 2}, 1e-5f);
}

TEST(ViewerCameraMoves, anOrthographicZoomKeepsTheDistanceAndPerspectiveTheExtent)
{
    for (const bool orthographic : {false, true}) {
        Camera camera = levelCamera(orthographic);
        zoomTo(camera, 0.5f, {400, 300}, {800, 600});
        EXPECT_NEAR(glm::length(camera.eye - camera.target), orthographic ? 5 : 2.5f, 1e-5f);
        EXPECT_EQ(camera.verticalExtent, orthographic ? 2.0f : 4.0f);
    }
}

TEST(ViewerCameraMoves, changingTheProjectionKeepsDirectionAndScale)
{
    Camera camera = levelCamera();
    camera.verticalFieldOfView = 0.8f;
    setOrthographic(camera, true);
    EXPECT_NEAR(camera.verticalExtent, 10 * std::tan(0.4f), 1e-5f);
    expectClose(camera.eye, {0, 0, 5}, 1e-5f);
    camera.verticalExtent = 3;
    setOrthographic(camera, false);
    expectClose(camera.eye, {0, 0, 1.5f / std::tan(0.4f)}, 1e-5f);
    EXPECT_EQ(camera.target, glm::vec3(0));
    const Camera same = camera;
    setOrthographic(camera, false);
    EXPECT_EQ(camera.eye, same.eye);
}

TEST(ViewerCameraAngles, azimuthIncreasesFromTheFrontToTheRight)
{
    for (const auto& [eye, degrees] : {std::pair(glm::vec3(0, 3, 5), 0.0f),
                                       {{5, 1, 0}, 90.0f},
                                       {{-5, 1, 0}, -90.0f},
                                       {{1, 0, 1}, 45.0f},
                                       {{1, 0, -1}, 135.0f}}) {
        Camera camera = levelCamera();
        camera.eye = eye;
        EXPECT_NEAR(azimuthOf(camera), degrees, 1e-3f);
    }
}

TEST(ViewerCameraCommands, takeTheirNumbersInOrder)
{
    struct Case {
        const char* command;
        void (*same)(Camera&);
    };
    for (const Case& c :
         {Case{"orbit 20 10", [](Camera& x) { orbit(x, 20 / kDegreesOfRadian, 10 / kDegreesOfRadian); }},
          Case{"look 20 10", [](Camera& x) { look(x, 20 / kDegreesOfRadian, 10 / kDegreesOfRadian); }},
          Case{"pan 20 10",
               [](Camera& x) {
                   pan(x, {20, 10}, {1280, 720});
               }},
          Case{"zoom 0.5",
               [](Camera& x) {
                   zoomTo(x, 0.5f, {640, 360}, {1280, 720});
               }},
          Case{"fly 1 2 3",
               [](Camera& x) {
                   fly(x, {1, 2, 3});
               }},
          Case{"see left", [](Camera& x) { viewFrom(x, "left"); }},
          Case{"orthographic", [](Camera& x) { setOrthographic(x, true); }}}) {
        State state = builtIn();
        state.cameraMoved = false;
        Camera expected = state.camera;
        c.same(expected);
        ASSERT_TRUE(perform(state, c.command)) << c.command;
        expectClose(state.camera.eye, expected.eye, 1e-4f);
        expectClose(state.camera.target, expected.target, 1e-4f);
        EXPECT_EQ(state.camera.orthographic, expected.orthographic);
        EXPECT_TRUE(state.cameraMoved) << c.command;
        EXPECT_FALSE(state.camera.eye == builtIn().camera.eye && state.camera.target == builtIn().camera.target
                     && state.camera.orthographic == builtIn().camera.orthographic);
    }
    State state = builtIn();
    for (const char* wrong : {"orbit 1", "orbit x 1", "orbit 1 y", "fly 1 2", "zoom", "see behind", "camera 1,2",
                              "turn-light x", "hot-spot 0"})
        EXPECT_FALSE(perform(state, wrong)) << wrong;
    EXPECT_EQ(state.camera.eye, builtIn().camera.eye);
}

TEST(ViewerCameraCommands, environmentRotationWrapsAndIsRoundedToThousandths)
{
    State state = builtIn();
    for (const auto& [before, by, after] :
         {std::tuple(170.0, "20", -170.0), {-170.0, "-20", 170.0}, {10.0, "0.12345", 10.123}, {0.0, "720", 0.0}}) {
        state.picture.environmentRotation = before;
        ASSERT_TRUE(perform(state, std::string("turn-light ") + by));
        EXPECT_NEAR(state.picture.environmentRotation, after, 1e-9) << before << ' ' << by;
    }
}

} // namespace
} // namespace cotan::viewer
