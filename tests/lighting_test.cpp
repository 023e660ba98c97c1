// Lighting in tangent space against lighting in world space: where they must agree and where they cannot.
#include <algorithm>

#include "reference_scene.hpp"

#include "cotan/view.hpp"

namespace cotan {
namespace {

using namespace cotan::testing;

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

View litView(Shading shading, Lighting lighting, Frame frame)
{
    View view = viewOf(Output::shaded, frame);
    view.samples = 1;
    view.linearOutput = true;
    view.shading = shading;
    view.lighting = lighting;
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
double largestDifference(const Scene& scene, View view)
{
    const Image there = rendered(scene, view);
    view.lighting = Lighting::world;
    const Image world = rendered(scene, view);
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
            EXPECT_LT(largestDifference(scene, litView(shading, Lighting::tangentPixel, Frame::orthonormal)),
                      kRounding);
}

TEST(TangentSpaceLighting, agreesOnBackFaces)
{
    Scene scene = squareScene();
    scene.materials[0].doubleSided = true;
    View view = litView(Shading::blinnPhong, Lighting::tangentPixel, Frame::orthonormal);
    view.camera.eye = {0, 0, -4};
    for (Light& light : view.lights) {
        light.direction.z = -light.direction.z;
        light.position.z = -light.position.z;
    }
    EXPECT_LT(largestDifference(scene, view), kRounding);
}

TEST(TangentSpaceLighting, vertexFramesAreExactOnAFlatSquarePlane)
{
    Scene scene = squareScene();
    deriveVertexFrames(scene, Frame::vertex, TangentOrigin::generated);
    ASSERT_FALSE(scene.meshes[0].tangents.empty());
    for (Shading shading : {Shading::blinnPhong, Shading::pbr})
        EXPECT_LT(largestDifference(scene, litView(shading, Lighting::tangentVertex, Frame::vertex)), kRounding);
}

TEST(TangentSpaceLighting, generalFramesDifferFromWorldSpaceLighting)
{
    // At a stretch of 2:1 the frame's inverse is not its transpose: angles differ by degrees and light by more than
    // 0.01.
    const Scene scene = tiltedScene({1, 0, 0.3}, {0, -2, 0});
    EXPECT_GT(largestDifference(scene, litView(Shading::blinnPhong, Lighting::tangentPixel, Frame::cotangent)), 0.01);
}

TEST(TangentSpaceLighting, withoutMapOrTangentsEqualsWorldSpaceLighting)
{
    Scene unmapped = squareScene();
    unmapped.materials[0].normalMap.image = -1;
    EXPECT_EQ(largestDifference(unmapped, litView(Shading::blinnPhong, Lighting::tangentPixel, Frame::cotangent)), 0);
    // The frame must read no tangents: those that do refuse a scene without them.
    EXPECT_EQ(largestDifference(squareScene(), litView(Shading::blinnPhong, Lighting::tangentVertex, Frame::cotangent)),
              0);
}

// Applies to lights only; the environment is read in world space, with anisotropic highlights.
TEST(TangentSpaceLighting, ignoresAnisotropyAndNormalMappingByRays)
{
    Scene little = squareScene();
    little.materials[0].metallic = 1;
    little.materials[0].anisotropy.strength = 0.25f;
    Scene much = little;
    much.materials[0].anisotropy.strength = 0.9f;
    much.materials[0].anisotropy.rotation = 0.7f;
    View view = litView(Shading::pbr, Lighting::tangentPixel, Frame::orthonormal);
    view.environment = false;
    const auto draw = [](const Scene& scene, const View& v) { return rendered(scene, v).data; };
    EXPECT_EQ(draw(little, view), draw(much, view));
    View other = view;
    other.normalMapping = NormalMapping::rays;
    EXPECT_EQ(draw(much, view), draw(much, other));
    other.lighting = view.lighting = Lighting::world;
    EXPECT_NE(draw(little, view), draw(much, view));
    EXPECT_NE(draw(much, view), draw(much, other));
    other.shading = view.shading = Shading::blinnPhong;
    EXPECT_EQ(draw(much, view), draw(much, other));
    view = litView(Shading::pbr, Lighting::tangentPixel, Frame::orthonormal);
    EXPECT_NE(draw(little, view), draw(much, view));
}

} // namespace
} // namespace cotan
