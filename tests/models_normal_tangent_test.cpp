// NormalTangentTest and NormalTangentMirrorTest: real half-spheres beside quads whose normal map shows the same
// half-sphere under rotated and mirrored uv. Without tangents, both must look alike.
#include "models.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "cotan/frame.hpp"
#include "truth/quad.hpp"

namespace cotan {
namespace {

using namespace test;

struct Pair {
    double real, mapped; // x of the centres of the two squares
};

// The squares of both models are 0.3 wide and form rows at these heights.
constexpr double kRows[] = {-0.8, -0.4, 0, 0.4, 0.8};
constexpr double kHalfSide = 0.14; // slightly less than half of 0.3: excludes border pixels
constexpr float kPerUnit = 600;

// The exact centre of the square near (x, row): the centre of the bounds of its vertices.
glm::dvec2 centreNear(const Scene& scene, double x, double row)
{
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::vec3& p : scene.meshes[0].positions)
        if (std::abs(p.x - x) < 0.155 && std::abs(p.y - row) < 0.155) {
            low = glm::min(low, glm::dvec2(p));
            high = glm::max(high, glm::dvec2(p));
        }
    EXPECT_NEAR(high.x - low.x, 0.3, 0.01);
    return (low + high) * 0.5;
}

// The direction at a point of the plane, interpolated from the four nearest pixels.
glm::dvec3 directionNear(const Image& normals, const View& view, glm::dvec2 p)
{
    const double x = (p.x - view.camera.eye.x) * kPerUnit + view.width * 0.5 - 0.5;
    const double y = (view.camera.eye.y - p.y) * kPerUnit + view.height * 0.5 - 0.5;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const double fx = x - i, fy = y - j;
    return (directionAt(normals, i, j) * (1 - fx) + directionAt(normals, i + 1, j) * fx) * (1 - fy)
        + (directionAt(normals, i, j + 1) * (1 - fx) + directionAt(normals, i + 1, j + 1) * fx) * fy;
}

// Mean angle in degrees between the real half-sphere and the mapped quad over the whole square.
double meanDifference(const Image& normals, const View& view, glm::dvec2 real, glm::dvec2 mapped)
{
    constexpr int kSteps = 160; // samples per side
    double sum = 0;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const glm::dvec2 offset = (glm::dvec2(i, j) + 0.5) * (2 * kHalfSide / kSteps) - kHalfSide;
            const glm::dvec3 a = directionNear(normals, view, real + offset);
            const glm::dvec3 b = directionNear(normals, view, mapped + offset);
            EXPECT_NE(a, glm::dvec3(0));
            EXPECT_NE(b, glm::dvec3(0));
            sum += degreesBetween(a, b);
        }
    return sum / (kSteps * kSteps);
}

void check(const char* device, const char* model, const std::vector<Pair>& pairs)
{
    COTAN_NEEDS_DATA(model);
    auto renderer = rendererFor(device);
    if (!renderer)
        GTEST_SKIP() << "no Vulkan device";
    const Scene scene = loadModel(model);
    ASSERT_TRUE(renderer->load(scene));
    View view = frontView({-1.5f, -1.0f}, {1.5f, 1.0f}, kPerUnit);
    view.frame = Frame::cotangent;
    const Image normals = drawWith(*renderer, view);
    view.normalMaps = false;
    const Image plain = drawWith(*renderer, view);
    double worst = 0;
    for (const Pair& pair : pairs)
        for (double row : kRows) {
            const glm::dvec2 real = centreNear(scene, pair.real, row);
            const glm::dvec2 mapped = centreNear(scene, pair.mapped, row);
            const double mean = meanDifference(normals, view, real, mapped);
            worst = std::max(worst, mean);
            EXPECT_LT(mean, 1.5) << model << " at " << pair.mapped << ", " << row;
            // the control: without the map the quad is flat and the half-sphere is not
            EXPECT_GT(meanDifference(plain, view, real, mapped), 5);
        }
    std::cout << model << " on " << renderer->device() << ": worst mean " << worst << " degrees\n";
}

const std::vector<Pair> kRotated = {{-0.96, -0.64}, {-0.16, 0.16}, {0.64, 0.96}};
const std::vector<Pair> kMirrored = {{-1.275, -0.955}, {-1.275, -0.629}, {-1.275, -0.291},
                                     {0.300, 0.620},   {0.300, 0.941},   {0.300, 1.264}};

TEST(NormalTangentModels, mappedQuadsMatchHalfSpheresOnTheReference)
{
    check("reference", "models/NormalTangentTest/NormalTangentTest.glb", kRotated);
}
TEST(NormalTangentModels, mappedQuadsMatchHalfSpheresOnVulkan)
{
    check("auto", "models/NormalTangentTest/NormalTangentTest.glb", kRotated);
}
TEST(NormalTangentModels, mirroredQuadsWithoutTangentsMatchHalfSpheresOnTheReference)
{
    check("reference", "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb", kMirrored);
}
TEST(NormalTangentModels, mirroredQuadsWithoutTangentsMatchHalfSpheresOnVulkan)
{
    check("auto", "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb", kMirrored);
}

} // namespace
} // namespace cotan
