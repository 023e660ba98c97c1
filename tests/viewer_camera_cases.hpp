// Cameras for tests of the viewer, and the angles from which they look.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/scene.hpp"

namespace cotan::viewer {

inline constexpr float kDegreesOfRadian = 57.29578f;

// Azimuth and elevation above the horizon, in degrees, from which a camera looks at its pivot.
inline glm::vec2 anglesFrom(const Camera& camera)
{
    const glm::vec3 back = camera.eye - camera.target;
    return {std::atan2(back.x, back.z) * kDegreesOfRadian, std::asin(back.y / glm::length(back)) * kDegreesOfRadian};
}

inline void expectClose(const glm::vec3& a, const glm::vec3& b, float tolerance)
{
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

// A level camera 5 units in front of the origin.
inline Camera levelCamera(bool orthographic = false)
{
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.target = {0, 0, 0};
    camera.up = {0, 1, 0};
    camera.orthographic = orthographic;
    camera.verticalExtent = 4;
    return camera;
}

} // namespace cotan::viewer
