// Input that no exporter should write: the image must still be finite.
#include <algorithm>
#include <limits>

#include "reference_scene.hpp"

using namespace cotan;
using namespace cotan::testing;

namespace {

void expectFinitePicture(const Scene& scene, View view, const char* what)
{
    view.width = view.height = 24;
    Image image = rendered(scene, view);
    for (std::size_t i = 0; i < image.pixelCount() * 4; ++i)
        ASSERT_TRUE(std::isfinite(image.floats()[i]))
            << what << ", " << name(view.frame) << ", output " << int(view.output);
}

// Draws with every frame and output and expects finite numbers everywhere.
void expectFinite(const Scene& scene, const char* what)
{
    for (const FrameInfo& f : frames())
        for (Output output : {Output::normal, Output::tangent, Output::bitangent})
            expectFinitePicture(scene, viewOf(output, f.frame), what);
    expectFinitePicture(scene, viewOf(Output::uv), what);
    expectFinitePicture(scene, viewOf(Output::depth), what);
    View view = viewOf(Output::shaded);
    view.linearOutput = true;
    view.lights.resize(3);
    view.lights[1].kind = LightKind::point;
    view.lights[2].kind = LightKind::spot;
    view.lights[2].innerCone = view.lights[2].outerCone;
    for (Shading shading : {Shading::pbr, Shading::blinnPhong}) {
        view.shading = shading;
        expectFinitePicture(scene, view, what);
    }
}

Scene fullScene()
{
    Mesh mesh = meshOf({{-1, 1, 0}, {2, 0, 0.5}, {0, -2, 0.5}});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.cotangentsU.assign(4, {1, 0, 0});
    mesh.cotangentsV.assign(4, {0, -1, 0});
    mesh.colors.assign(4, {1, 1, 1, 1});
    Scene scene = sceneOf(mesh);
    addNormalMap(scene, {150, 100, 220});
    scene.materials[0].doubleSided = true;
    scene.materials[0].baseColorMap.image = 0;
    return scene;
}

} // namespace

TEST(ReferenceHostile, zeroAttributesStayFinite)
{
    Scene scene = fullScene();
    Mesh& mesh = scene.meshes[0];
    mesh.normals.assign(4, glm::vec3(0));
    expectFinite(scene, "zero normals");
    mesh.tangents.assign(4, glm::vec4(0));
    mesh.cotangentsU.assign(4, glm::vec3(0));
    mesh.cotangentsV.assign(4, glm::vec3(0));
    expectFinite(scene, "zero normals and tangents");
    mesh.normals.clear();
    mesh.texcoords[0].clear();
    mesh.tangents.clear();
    expectFinite(scene, "no attributes");
}

TEST(ReferenceHostile, normalsThatCancelOutFallBackToThePlane)
{
    Scene scene = fullScene();
    scene.materials[0].normalMap.image = -1;
    scene.meshes[0].normals.assign(4, glm::vec3(0));
    glm::dvec3 plane = glm::normalize(glm::cross(glm::dvec3(0, -2, 0.5), glm::dvec3(2, 0, 0.5)));
    forCovered(rendered(scene, viewOf(Output::normal)), [&](int, int, glm::vec4 value) {
        double angle = degreesBetween(glm::vec3(value), plane);
        ASSERT_LT(std::min(angle, 180 - angle), 1e-2); // float differences of one pixel
    });
}

TEST(ReferenceHostile, nonFiniteAttributesStayFinite)
{
    for (float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), 3e38f, 1e-45f}) {
        Scene scene = fullScene();
        Mesh& mesh = scene.meshes[0];
        mesh.normals[1] = glm::vec3(bad);
        expectFinite(scene, "normal");
        mesh.tangents[2] = glm::vec4(bad);
        mesh.cotangentsU[0] = glm::vec3(bad);
        expectFinite(scene, "tangent");
        mesh.texcoords[0][3] = glm::vec2(bad);
        expectFinite(scene, "uv");
        mesh.colors[0] = glm::vec4(bad);
        expectFinite(scene, "colour");
        scene.materials[0].emissive = glm::vec3(bad);
        scene.materials[0].roughness = bad;
        scene.materials[0].occlusionStrength = bad;
        scene.materials[0].normalScale = bad;
        expectFinite(scene, "material");
        mesh.positions[0] = glm::vec3(bad);
        expectFinite(scene, "position");
    }
}

TEST(ReferenceHostile, hugeAndTinyCoordinatesStayFinite)
{
    for (float size : {1e-30f, 1e-12f, 1e12f, 1e30f, 3e38f}) {
        Scene scene = fullScene();
        for (glm::vec3& p : scene.meshes[0].positions)
            p *= size;
        expectFinite(scene, "all scaled");
        scene = fullScene();
        scene.meshes[0].positions[2] *= size;
        expectFinite(scene, "one corner far away");
    }
}

TEST(ReferenceHostile, trianglesWithoutAreaAreNotDrawn)
{
    Scene scene = fullScene();
    Mesh& mesh = scene.meshes[0];
    mesh.positions[1] = mesh.positions[2];
    mesh.positions[3] = mesh.positions[0];
    expectFinite(scene, "no area");
    EXPECT_EQ(forCovered(rendered(scene, viewOf(Output::normal)), [](int, int, glm::vec4) {}), 0);
}

TEST(ReferenceHostile, degenerateMatricesStayFinite)
{
    for (int kind = 0; kind < 4; ++kind) {
        Scene scene = fullScene();
        glm::mat4& m = scene.instances[0].toWorld;
        if (kind == 0)
            m = glm::mat4(0);
        if (kind == 1)
            m[2][2] = 0;
        if (kind == 2)
            m = m * 1e-25f;
        if (kind == 3)
            m[1][1] = std::nanf("");
        expectFinite(scene, "matrix");
    }
}

TEST(ReferenceHostile, flattenedInstanceKeepsTheNormalOfItsPlane)
{
    Scene scene = fullScene();
    scene.materials[0].normalMap.image = -1;
    scene.instances[0].toWorld[2][2] = 0;
    forCovered(rendered(scene, viewOf(Output::normal)), [](int, int, glm::vec4 value) {
        ASSERT_LT(degreesBetween(glm::vec3(value), {0, 0, 1}), 1e-4);
    });
}

TEST(ReferenceHostile, indicesOutOfRangeAreIgnored)
{
    Scene scene = fullScene();
    scene.meshes[0].indices = {0, 2, 1, 1, 2, 4000000000u, 7};
    scene.instances.push_back({"", 12, glm::mat4(1)});
    scene.instances.push_back({"", -1, glm::mat4(1)});
    scene.materials[0].baseColorMap.image = 99;
    scene.materials[0].emissiveMap.image = 1;
    scene.images.push_back(makeImage(4, 4, PixelType::unorm8));
    scene.images.back().data.resize(3); // shorter than its size requires
    expectFinite(scene, "indices");
    scene.meshes[0].material = 5;
    expectFinite(scene, "material index");
}

// tests/scene_check_test.cpp tests the messages.
TEST(ReferenceHostile, degenerateCamerasAreRefused)
{
    void (*const wrong[])(Camera&) = {
        [](Camera& c) { c.target = c.eye; },
        [](Camera& c) {
            c.up = {0, 0, 1};
        },
        [](Camera& c) { c.verticalFieldOfView = 0; },
        [](Camera& c) { c.verticalFieldOfView = 7; },
        [](Camera& c) { c.eye = glm::vec3(std::nanf("")); },
        [](Camera& c) { c.orthographic = true, c.verticalExtent = -1; },
    };
    for (const auto& change : wrong) {
        View view = viewOf(Output::shaded);
        change(view.camera);
        const Result<Image> refused = renderReference(fullScene(), view);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    }
}
