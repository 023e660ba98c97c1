// Extensions of GLM for vectors that may be zero or not finite, and the axes for a viewing direction.
#include "cotan/vector.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scene/geometry.hpp"

namespace cotan::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Vector, anyNonFiniteComponentIsFound)
{
    EXPECT_TRUE(isFinite(glm::vec4(1e38f, -3e38f, 0, 1e-45f)));
    EXPECT_TRUE(isFinite(glm::mat4(1)));
    for (const float bad : {kInfinity, -kInfinity, std::nanf("")}) {
        for (int i = 0; i < 4; ++i) {
            glm::vec4 v(1);
            v[i] = bad;
            EXPECT_FALSE(isFinite(v)) << i;
        }
        for (int i = 0; i < 16; ++i) {
            glm::mat4 m(1);
            m[i / 4][i % 4] = bad;
            EXPECT_FALSE(isFinite(m)) << i;
        }
    }
}

TEST(Vector, vectorsWithoutADirectionGiveTheFallback)
{
    const glm::dvec3 other(0, 0, -1);
    EXPECT_EQ(unitOr(glm::dvec3(0, 3, 4), other), glm::dvec3(0, 0.6, 0.8));
    EXPECT_EQ(unitOr(glm::dvec3(0), other), other);
    EXPECT_EQ(unitOr(glm::dvec3(0, double(kInfinity), 0), other), other);
    EXPECT_EQ(unitOr(glm::dvec3(0, std::nan(""), 1), other), other);
    EXPECT_EQ(unitOr(glm::dvec3(0, 0.5, 0), other, 0.5), other); // not longer than the minimum
    EXPECT_EQ(unitOr(glm::dvec3(0, 0.5, 0), other, 0.25), glm::dvec3(0, 1, 0));
    EXPECT_EQ(unitOrZero(glm::dvec3(0)), glm::vec3(0));
    EXPECT_EQ(unitOrZero(glm::dvec3(-1e-150, 0, 0)), glm::vec3(-1, 0, 0));
}

void expectAxes(const CameraAxes& a)
{
    EXPECT_NEAR(glm::length(a.right), 1, 1e-15);
    EXPECT_NEAR(glm::length(a.up), 1, 1e-15);
    EXPECT_NEAR(glm::dot(a.right, a.forward), 0, 1e-15);
    EXPECT_NEAR(glm::dot(a.up, a.forward), 0, 1e-15);
    EXPECT_NEAR(glm::length(glm::cross(a.forward, a.up) - a.right), 0, 1e-15);
}

TEST(CameraAxes, upIsTheClosestToTheGivenOne)
{
    const CameraAxes a = axesAlong({0, 0, -1}, {0.2, 3, 5});
    expectAxes(a);
    EXPECT_EQ(a.forward, glm::dvec3(0, 0, -1));
    EXPECT_NEAR(glm::length(a.up - glm::normalize(glm::dvec3(0.2, 3, 0))), 0, 1e-15);
}

TEST(CameraAxes, invalidUpGivesYOrMinusZ)
{
    for (const glm::dvec3& up : {glm::dvec3(0), glm::dvec3(0, 0, -7), glm::dvec3(std::nan(""), 1, 0)}) {
        const CameraAxes a = axesAlong({0, 0, -1}, up);
        expectAxes(a);
        EXPECT_EQ(a.up, glm::dvec3(0, 1, 0));
    }
    for (const double y : {1.0, -1.0}) {
        const CameraAxes a = axesAlong({0, y, 0}, {0, 1, 0});
        expectAxes(a);
        EXPECT_EQ(a.up, glm::dvec3(0, 0, -1));
    }
}

TEST(CameraAxes, aCameraWithoutADirectionLooksAlongMinusZ)
{
    Camera camera;
    camera.eye = camera.target = glm::vec3(3, 2, 1);
    const CameraAxes a = cameraAxes(camera);
    expectAxes(a);
    EXPECT_EQ(a.eye, glm::dvec3(3, 2, 1));
    EXPECT_EQ(a.forward, glm::dvec3(0, 0, -1));
    camera.eye.y = kInfinity;
    EXPECT_EQ(cameraAxes(camera).eye, glm::dvec3(0));
    camera.eye = {0, 0, 5};
    camera.target = {5, 0, 5};
    EXPECT_EQ(cameraAxes(camera).forward, glm::dvec3(1, 0, 0));
    EXPECT_EQ(cameraAxes(camera).right, glm::dvec3(0, 0, 1));
}

} // namespace
} // namespace cotan::test
