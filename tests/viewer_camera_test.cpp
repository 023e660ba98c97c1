// Camera movements of the viewer.
#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "camera.hpp"
#include "cotan/render.hpp"

namespace cotan::viewer {
namespace {

constexpr glm::ivec2 kSize{800, 600};

Camera someCamera(bool orthographic = false)
{
    Camera camera;
    camera.eye = {3, 2, 5};
    camera.target = {0.5f, 0.25f, -1};
    camera.orthographic = orthographic;
    camera.verticalExtent = 4;
    return camera;
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance)
{
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(ViewerCamera, orbitKeepsThePivotAndTheDistance)
{
    Camera camera = someCamera();
    const float distance = glm::length(camera.eye - camera.target);
    for (int i = 0; i < 100; ++i)
        orbit(camera, 0.3f, 0.07f * float(i % 5 - 2));
    expectNear(camera.target, someCamera().target, 1e-6f);
    EXPECT_NEAR(glm::length(camera.eye - camera.target), distance, 1e-3f);
    orbit(camera, 0, 100); // up to nearly straight above
    EXPECT_GT(camera.eye.y - camera.target.y, 0.999f * distance);
    EXPECT_GT(glm::length(glm::cross(camera.target - camera.eye, camera.up)), 1e-3f);
}

TEST(ViewerCamera, orbitToTheRightGoesToTheRight)
{
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.target = {0, 0, 0};
    orbit(camera, 0.5f, 0);
    expectNear(camera.eye, {5 * std::sin(0.5f), 0, 5 * std::cos(0.5f)}, 1e-5f);
    orbit(camera, -0.5f, 0.5f);
    expectNear(camera.eye, {0, 5 * std::sin(0.5f), 5 * std::cos(0.5f)}, 1e-5f);
}

TEST(ViewerCamera, panMovesThePivotWithThePointer)
{
    for (const bool orthographic : {false, true}) {
        Camera camera = someCamera(orthographic);
        const glm::vec3 before = camera.target;
        pan(camera, {37, -12}, kSize);
        const glm::vec3 seen = projectToImage(camera, before, kSize);
        EXPECT_NEAR(seen.x, 400 + 37, 0.01f);
        EXPECT_NEAR(seen.y, 300 - 12, 0.01f);
    }
}

TEST(ViewerCamera, zoomKeepsThePointUnderThePointer)
{
    for (const bool orthographic : {false, true}) {
        Camera camera = someCamera(orthographic);
        const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
        const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
        const glm::vec3 point = camera.target + right * 0.7f + glm::cross(right, forward) * 0.4f;
        const glm::vec3 before = projectToImage(camera, point, kSize);
        const float unit = unitsOfPixel(camera, glm::length(camera.target - camera.eye), kSize);
        zoomTo(camera, 0.5f, glm::vec2(before), kSize);
        const glm::vec3 after = projectToImage(camera, point, kSize);
        EXPECT_NEAR(after.x, before.x, 0.01f);
        EXPECT_NEAR(after.y, before.y, 0.01f);
        EXPECT_NEAR(unitsOfPixel(camera, glm::length(camera.target - camera.eye), kSize), unit / 2, unit * 1e-4f);
    }
}

TEST(ViewerCamera, zoomNeverReachesThePivotAndStaysFinite)
{
    for (const bool orthographic : {false, true}) {
        Camera camera = someCamera(orthographic);
        for (const float factor : {0.001f, 1000.0f, 0.0f, -1.0f, std::nanf(""), INFINITY})
            for (int i = 0; i < 100; ++i)
                zoomTo(camera, factor, {10, 10}, kSize);
        EXPECT_TRUE(std::isfinite(camera.eye.x) && std::isfinite(camera.target.x));
        EXPECT_GT(glm::length(camera.eye - camera.target), 0.0f);
        EXPECT_GT(camera.verticalExtent, 0.0f);
    }
}

TEST(ViewerCamera, sideViewsKeepTheDistance)
{
    for (const auto& [side, from] : {std::pair("front", glm::vec3(0, 0, 1)),
                                     {"back", {0, 0, -1}},
                                     {"left", {-1, 0, 0}},
                                     {"right", {1, 0, 0}},
                                     {"top", {0, 1, 0}},
                                     {"bottom", {0, -1, 0}}}) {
        Camera camera = someCamera();
        const float distance = glm::length(camera.eye - camera.target);
        ASSERT_TRUE(viewFrom(camera, side));
        expectNear(camera.eye, camera.target + from * distance, 1e-4f);
        orbit(camera, 0.1f, 0.1f); // the side view can be left again
        EXPECT_NEAR(glm::length(camera.eye - camera.target), distance, 1e-3f) << side;
        EXPECT_EQ(camera.up, glm::vec3(0, 1, 0)) << side;
    }
    Camera camera = someCamera();
    EXPECT_FALSE(viewFrom(camera, "behind"));
}

TEST(ViewerCamera, changingTheProjectionKeepsTheSizeAtThePivot)
{
    Camera camera = someCamera();
    const float unit = unitsOfPixel(camera, glm::length(camera.eye - camera.target), kSize);
    setOrthographic(camera, true);
    EXPECT_NEAR(unitsOfPixel(camera, 1, kSize), unit, unit * 1e-5f);
    zoomTo(camera, 0.5f, {400, 300}, kSize);
    setOrthographic(camera, false);
    EXPECT_NEAR(unitsOfPixel(camera, glm::length(camera.eye - camera.target), kSize), unit / 2, unit * 1e-4f);
}

TEST(ViewerCamera, lookRotatesAboutTheEyeAndFlyMovesTheEye)
{
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.target = {0, 0, 0};
    look(camera, 0.25f, 0); // to the right: towards +x
    expectNear(camera.eye, {0, 0, 5}, 1e-6f);
    EXPECT_GT(camera.target.x, 1.0f);
    camera.target = {0, 0, 0};
    fly(camera, {1, 2, 3});
    expectNear(camera.eye, {1, 2, 2}, 1e-6f);
    expectNear(camera.target, {1, 2, -3}, 1e-6f);
}

TEST(ViewerCamera, aClickedPointBecomesThePivotAndTheEyeStays)
{
    Camera camera = someCamera();
    const glm::vec3 eye = camera.eye;
    setPivot(camera, {1, 1, 1});
    EXPECT_EQ(camera.eye, eye);
    EXPECT_EQ(camera.target, glm::vec3(1, 1, 1));
    setPivot(camera, eye); // the eye and the pivot must differ
    EXPECT_EQ(camera.target, glm::vec3(1, 1, 1));
}

// The formatted camera is used in command lines that must draw the same image.
TEST(CameraText, roundTripsExactly)
{
    Camera camera = someCamera();
    for (int i = 0; i < 500; ++i) {
        orbit(camera, 0.37f, 0.11f * float(i % 7 - 3));
        zoomTo(camera, i % 2 ? 0.93f : 1.08f, {float(i), 20}, kSize);
        camera.verticalFieldOfView = 0.1f + 0.005f * float(i);
        camera.orthographic = i % 3 == 0;
        if (i % 50 == 49)
            viewFrom(camera, i % 100 == 99 ? "top" : "bottom");
        const std::string words = formatCamera(camera);
        const auto back = parseCamera(words, {}, kSize.x, kSize.y);
        ASSERT_TRUE(back) << words << ": " << back.error().message;
        EXPECT_EQ(back->eye, camera.eye) << words;
        EXPECT_EQ(back->target, camera.target) << words;
        EXPECT_EQ(back->up, camera.up) << words;
        EXPECT_EQ(back->orthographic, camera.orthographic) << words;
        if (camera.orthographic) {
            EXPECT_EQ(back->verticalExtent, camera.verticalExtent) << words;
        } else {
            EXPECT_EQ(back->verticalFieldOfView, camera.verticalFieldOfView) << words;
        }
    }
}

TEST(CameraText, badTextIsRefused)
{
    for (const char* words : {"0,0,5,0,0,0,", "0,0,5,0,0,0,0", "0,0,5,0,0,0,180", "0,0,5,0,0,0,h0", "0,0,5,0,0,0,h",
                              "0,0,5,0,0,0,nan", "0,0,5,0,0,0,45,0", "0,0,5,0,0,0,45,0,0,1", "0,0,5,0,0,0,45,0,0,0",
                              "0,0,5,0,0,0,45,0,1,0,1", "0,0,5,0,0", ""})
        EXPECT_FALSE(parseCamera(words, {}, 10, 10)) << words;
    const auto wide = parseCamera("0,0,5,0,0,0,90,1,0,0", {}, 10, 10);
    ASSERT_TRUE(wide);
    EXPECT_NEAR(wide->verticalFieldOfView, 1.5707963f, 1e-6f);
    EXPECT_EQ(wide->up, glm::vec3(1, 0, 0));
}

} // namespace
} // namespace cotan::viewer
