// The laboratory's lighting in tangent space against lighting in world space: where they must agree and where they
// cannot.
#include <algorithm>

#include "reference_scene.hpp"

#include "cotan/view.hpp"
#include "figures/tangent_space.hpp"

namespace cotan {
namespace {

using namespace cotan::testing;
using namespace cotan::figures;

// A tilted plane whose texels are all tilted, along u and v alike.
Scene tiltedScene(glm::dvec3 alongU, glm::dvec3 alongV)
{
    Patch patch;
    patch.origin = {-1, 1, 0};
    patch.alongU = alongU;
    patch.alongV = alongV;
    Scene scene = sceneOf(meshOf(patch));
    scene.materials[0].baseColor = {0.5f, 0.4f, 0.3f, 1};
    scene.materials[0].metallic = 0;
    scene.materials[0].roughness = 0.5f;
    addNormalMap(scene, {168, 98, 240});
    return scene;
}

Scene squareScene() { return tiltedScene({2, 0, 0.4}, {0.08, -2, -0.4}); }

View litView(Shading shading, Frame frame)
{
    View view = viewOf(Output::shaded, frame);
    view.samples = 1;
    view.linearOutput = true;
    view.shading = shading;
    Light sun;
    sun.direction = glm::normalize(glm::vec3(0.5f, -0.4f, -0.7f));
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position = {0.6f, -0.3f, 1.5f};
    lamp.intensity = 4;
    view.lights = {sun, lamp};
    view.shadows = false;
    return view;
}

// Maximum difference of a channel, relative to the brightest value of the world-space render.
double largestDifference(const Scene& scene, const View& view, const reference::LightSpace& space)
{
    const auto drawn = reference::renderIn(space, scene, view, 2);
    if (!drawn) {
        ADD_FAILURE() << drawn.error().message;
        return 1e9;
    }
    const Image &there = *drawn, world = rendered(scene, view);
    double largest = 0, brightest = 0;
    const int covered = forCovered(world, [&](int x, int y, glm::vec4 value) {
        const glm::vec4 d = glm::abs(value - pixelOf(there, x, y));
        largest = std::max({largest, double(d.x), double(d.y), double(d.z)});
        brightest = std::max({brightest, double(value.x), double(value.y), double(value.z)});
    });
    EXPECT_GT(covered, 500);
    EXPECT_GT(brightest, 0.05);
    return largest / brightest;
}

// Float rounding of unit vectors, times an exponent of about 30 in the highlight.
constexpr double kRounding = 1e-4;

TEST(TangentSpaceLighting, orthonormalFramesEqualWorldSpaceLighting)
{
    // Square and stretched: an orthonormal frame may misplace the bumps, and the two lightings still agree.
    for (const Scene& scene : {squareScene(), tiltedScene({1, 0, 0.3}, {0.7, -2, 0})})
        for (Shading shading : {Shading::blinnPhong, Shading::pbr})
            EXPECT_LT(largestDifference(scene, litView(shading, Frame::orthonormal), tangentSpaceOfPixels()),
                      kRounding);
}

TEST(TangentSpaceLighting, agreesOnBackFaces)
{
    Scene scene = squareScene();
    scene.materials[0].doubleSided = true;
    View view = litView(Shading::blinnPhong, Frame::orthonormal);
    view.camera.eye = {0, 0, -4};
    for (Light& light : view.lights) {
        light.direction.z = -light.direction.z;
        light.position.z = -light.position.z;
    }
    EXPECT_LT(largestDifference(scene, view, tangentSpaceOfPixels()), kRounding);
}

TEST(TangentSpaceLighting, vertexFramesAreExactOnAFlatSquarePlane)
{
    Scene scene = squareScene();
    deriveVertexFrames(scene, Frame::vertex, TangentOrigin::generated);
    ASSERT_FALSE(scene.meshes[0].tangents.empty());
    for (Shading shading : {Shading::blinnPhong, Shading::pbr})
        EXPECT_LT(largestDifference(scene, litView(shading, Frame::vertex), tangentSpaceOfVertices()), kRounding);
}

TEST(TangentSpaceLighting, generalFramesDifferFromWorldSpaceLighting)
{
    // At a stretch of 2:1 the frame's inverse is not its transpose: angles differ by degrees and light by more than
    // 0.01.
    const Scene scene = tiltedScene({1, 0, 0.3}, {0, -2, 0});
    EXPECT_GT(largestDifference(scene, litView(Shading::blinnPhong, Frame::cotangent), tangentSpaceOfPixels()), 0.01);
}

TEST(TangentSpaceLighting, withoutMapOrTangentsEqualsWorldSpaceLighting)
{
    Scene unmapped = squareScene();
    unmapped.materials[0].normalMap.image = -1;
    EXPECT_EQ(largestDifference(unmapped, litView(Shading::blinnPhong, Frame::cotangent), tangentSpaceOfPixels()), 0);
    // The frame must read no tangents: those that do refuse a scene without them.
    EXPECT_EQ(
        largestDifference(squareScene(), litView(Shading::blinnPhong, Frame::cotangent), tangentSpaceOfVertices()), 0);
}

} // namespace
} // namespace cotan
