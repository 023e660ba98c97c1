// Each diagnostic view reads its own map and channel; problem areas are seen from the camera that they state; every
// value under the pointer is right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "probe.hpp"

namespace cotan {
namespace {

// A square of 2 x 2 facing +z around the origin, with uv (0, 0) at the top left.
Scene panel()
{
    Scene scene;
    scene.materials.emplace_back();
    Mesh mesh;
    mesh.name = "panel";
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes = {mesh};
    scene.instances.push_back({"panel", 0, glm::mat4(1)});
    return scene;
}

Image oneColor(std::array<int, 4> codes)
{
    Image image = makeImage(1, 1, PixelType::unorm8);
    for (std::size_t c = 0; c < 4; ++c)
        image.bytes8()[c] = std::uint8_t(codes[c]);
    return image;
}

glm::ivec3 displayedColor(const Scene& scene, Inspection inspection)
{
    View view;
    view.width = view.height = 8;
    view.camera.eye = {0, 0, 5};
    view.camera.orthographic = true;
    view.camera.verticalExtent = 1.5f;
    const auto image = drawView(inspected(scene, inspection), inspectionView(view), "reference");
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return {};
    }
    const std::uint8_t* p = image->bytes8() + 4 * (2 * 8 + 5);
    return {p[0], p[1], p[2]};
}

void expectDisplayed(const Scene& scene, Inspection inspection, glm::ivec3 expected)
{
    const glm::ivec3 found = displayedColor(scene, inspection);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], expected[c], 1) << inspectionNames()[std::size_t(inspection)] << " " << c;
}

TEST(InspectionViews, eachReadsItsOwnMapAndChannel)
{
    Scene scene = panel();
    Material& m = scene.materials[0];
    Texture* const slots[] = {&m.baseColorMap, &m.normalMap, &m.metallicRoughnessMap, &m.occlusionMap, &m.emissiveMap};
    for (int k = 0; k < 5; ++k) { // no two codes are equal
        scene.images.push_back(oneColor({41 + 40 * k, 51 + 40 * k, 61 + 40 * k, 71 + 40 * k}));
        slots[k]->image = k;
    }
    m.emissive = {1, 1, 1};
    m.roughness = m.metallic = 1;
    m.alphaMode = AlphaMode::blend;
    const auto grey = [](int code) { return glm::ivec3(code); };
    expectDisplayed(scene, Inspection::baseColor, {41, 51, 61});
    expectDisplayed(scene, Inspection::alpha, grey(71));
    expectDisplayed(scene, Inspection::normalMap, {81, 91, 101});
    expectDisplayed(scene, Inspection::normalMapRed, grey(81));
    expectDisplayed(scene, Inspection::normalMapGreen, grey(91));
    expectDisplayed(scene, Inspection::normalMapBlue, grey(101));
    expectDisplayed(scene, Inspection::roughness, grey(131));
    expectDisplayed(scene, Inspection::metallic, grey(141));
    expectDisplayed(scene, Inspection::occlusion, grey(161));
    expectDisplayed(scene, Inspection::emissive, {201, 211, 221});
    m.baseColor = {0.5f, 0.5f, 0.5f, 0.2f};
    expectDisplayed(scene, Inspection::mask, {41, 51, 61}); // without the factor
    EXPECT_EQ(inspected(scene, Inspection::mask).materials[0].baseColorMap.sampler.magnify, Filter::nearest);
    EXPECT_EQ(inspected(scene, Inspection::baseColor).materials[0].baseColorMap.sampler.magnify, Filter::linear);
}

TEST(InspectionViews, withoutAMapTheFactorIsShownAsStored)
{
    Scene scene = panel();
    Material& m = scene.materials[0];
    const auto srgb = [](double c) { // c is linear
        return int(std::lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
    };
    m.baseColor = {0.25f, 0.5f, 0.75f, 0.4f};
    m.roughness = 0.3f;
    m.metallic = 0.6f;
    m.emissive = {0.5f, 4, 0};
    expectDisplayed(scene, Inspection::baseColor, {srgb(0.25), srgb(0.5), srgb(0.75)});
    expectDisplayed(scene, Inspection::alpha, glm::ivec3(255)); // alpha is ignored in opaque mode
    m.alphaMode = AlphaMode::mask;
    expectDisplayed(scene, Inspection::alpha, glm::ivec3(102));
    expectDisplayed(scene, Inspection::roughness, glm::ivec3(77));
    expectDisplayed(scene, Inspection::metallic, glm::ivec3(153));
    expectDisplayed(scene, Inspection::emissive, {srgb(0.5), 255, 0});
    expectDisplayed(scene, Inspection::occlusion, glm::ivec3(255));
    expectDisplayed(scene, Inspection::normalMap, {128, 128, 255});
    expectDisplayed(scene, Inspection::mask, glm::ivec3(128));
}

// 8 x 8 squares, alternately light and dark; the first row is the least saturated.
TEST(InspectionViews, checkerHas64SquaresWithTheHueOfTheirColumn)
{
    const Scene displayed = inspected(panel(), Inspection::checker);
    ASSERT_EQ(displayed.images.size(), 1u);
    const Image& image = displayed.images[0];
    ASSERT_EQ(image.width, 512);
    ASSERT_EQ(image.height, 512);
    const auto at = [&](int column, int row) {
        const std::uint8_t* p = image.bytes8() + 4 * ((64 * row + 30) * 512 + 64 * column + 30);
        return glm::ivec3(p[0], p[1], p[2]);
    };
    const auto sum = [](glm::ivec3 c) { return c.x + c.y + c.z; };
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 8; ++column) {
            const glm::ivec3 c = at(column, row);
            if (column < 7) {
                EXPECT_EQ(sum(c) < sum(at(column + 1, row)), (column + row) % 2 == 0) << column << row;
            }
            // The brightest of red, green and blue changes at thirds of the hue circle.
            const double hue = column / 8.0 * 3;
            const int brightest = int(std::lround(hue)) % 3;
            for (int k = 0; k < 3; ++k)
                EXPECT_LE(c[k], c[brightest]) << column << row;
            const double fade = 0.35 + 0.65 * row / 7, bright = (column + row) % 2 ? 0.92 : 0.35;
            if (column == 0) { // red has tint 1, the two others a quarter
                EXPECT_NEAR(c.x, 255 * bright, 1);
                EXPECT_NEAR(c.y, 255 * bright * (1 - 0.6 * fade * 0.75), 1);
                EXPECT_NEAR(c.z, c.y, 1);
            }
        }
}

TEST(InspectionViews, trianglesKeepTheirOrderAndShareNoVertices)
{
    for (const Inspection inspection : {Inspection::stretch, Inspection::mirrored, Inspection::facing}) {
        const Scene before = panel(), after = inspected(before, inspection);
        const Mesh &a = before.meshes[0], &b = after.meshes[0];
        ASSERT_EQ(b.indices.size(), a.indices.size());
        for (std::size_t i = 0; i < a.indices.size(); ++i) {
            EXPECT_EQ(b.positions[b.indices[i]], a.positions[a.indices[i]]);
            EXPECT_EQ(b.normals[b.indices[i]], a.normals[a.indices[i]]);
        }
        EXPECT_EQ(b.name, "panel");
        for (const Material& m : after.materials)
            EXPECT_TRUE(m.unlit);
        EXPECT_EQ(after.instances.size(), inspection == Inspection::facing ? 2u : 1u);
    }
    View lit;
    lit.shadows = lit.background = true;
    lit.exposure = 3;
    const View view = inspectionView(lit);
    EXPECT_FALSE(view.shadows || view.environment || view.background || view.linearOutput || view.dither
                 || view.normalMaps);
    EXPECT_EQ(view.exposure, 1);
    EXPECT_EQ(view.toneMapping, ToneMapping::none);
}

TEST(StudyViews, showTheReliefOfEachMapWhateverTheColours)
{
    // Two panels of one relief with different looks, and one of another relief.
    const auto drawn = [](glm::vec4 color, float metallic, std::array<int, 4> texel, const char* study) {
        Scene scene = panel();
        scene.images = {oneColor(texel), oneColor({20, 200, 90, 255})};
        Material& m = scene.materials[0];
        m.baseColor = color;
        m.metallic = metallic;
        m.emissive = glm::vec3(metallic);
        m.coat.strength = metallic;
        m.normalMap.image = 0;
        m.baseColorMap.image = metallic > 0.5f ? 1 : -1;
        applyStudy(scene, study);
        View view;
        view.width = view.height = 8;
        view.camera.eye = {0, 0, 5};
        view.lights = {Light{}};
        const auto image = drawView(scene, view, "reference");
        EXPECT_TRUE(image);
        return image ? image->data : std::vector<std::byte>();
    };
    const std::array<int, 4> flat = {128, 128, 255, 255}, tilted = {200, 128, 230, 255};
    for (const char* study : {"clay", "gloss"}) {
        EXPECT_TRUE(replacesMaterials(study));
        const auto red = drawn({1, 0, 0, 1}, 0, tilted, study);
        EXPECT_EQ(red, drawn({0, 0, 1, 1}, 1, tilted, study)) << study;
        EXPECT_NE(red, drawn({1, 0, 0, 1}, 0, flat, study)) << study;
        EXPECT_NE(red, drawn({1, 0, 0, 1}, 0, tilted, "shaded")) << study;
    }
    EXPECT_NE(drawn({1, 0, 0, 1}, 0, tilted, "clay"), drawn({1, 0, 0, 1}, 0, tilted, "gloss"));
    EXPECT_FALSE(replacesMaterials("shaded"));
}

// ---- problem areas -------------------------------------------------------------------------------------

// Patches side by side: stretched by 4, sheared by 45 degrees, and without area in uv.
Scene faulty()
{
    Scene scene;
    scene.materials.emplace_back();
    const auto add = [&](const char* name, Mesh mesh, float x) {
        mesh.name = name;
        scene.instances.push_back({name, int(scene.meshes.size()), glm::translate(glm::mat4(1), glm::vec3(x, 0, 0))});
        scene.meshes.push_back(std::move(mesh));
    };
    add("wide", makePatch(4, 0, false, 1), 0);
    add("sheared", makePatch(1, 1, false, 1), 10);
    add("flat", makePatch(1, 0, false, 1), 20);
    for (glm::vec2& uv : scene.meshes[2].texcoords[0])
        uv.y = uv.x;
    add("", makePatch(1, 0, false, 1), 30);
    scene.meshes[3].tangents.assign(scene.meshes[3].vertexCount(), {0, 1, 0, -1}); // rotated by 90 degrees, w wrong
    return scene;
}

TEST(ProblemAreas, areNamedWithTheirViewWorstFirst)
{
    const std::vector<ProblemArea> spots = problemAreas(faulty());
    ASSERT_GE(spots.size(), 5u);
    struct Row {
        const char *mesh, *words, *view;
        std::size_t number;
        bool storedTangents;
    };
    for (const Row& row :
         {Row{"wide", "stretched by more than 1.2: 100.0 % of wide, here 4", "stretch", 0, false},
          {"sheared", "sheared by more than 10 degrees: 100.0 % of sheared, here 45", "shear", 1, false},
          {"flat", "uv without area: 100.0 % of flat", "mirrored", 2, false},
          {"", "stored w contradicts the uv: 100.0 % of mesh 3", "w", 3, false},
          {"", "stored tangents rotated by more than 45 degrees: 100.0 % of mesh 3, here 90", "tangent", 3, true}}) {
        const auto spot = std::ranges::find(spots, std::string(row.words), &ProblemArea::text);
        ASSERT_NE(spot, spots.end()) << row.words;
        EXPECT_EQ(spot->view, row.view);
        EXPECT_EQ(spot->mesh, row.number) << row.words;
        EXPECT_EQ(spot->storedTangents, row.storedTangents) << row.words;
        EXPECT_NEAR(spot->share, 1, 1e-6) << row.words;
    }
    for (std::size_t i = 1; i < spots.size(); ++i)
        EXPECT_GE(spots[i - 1].severity, spots[i].severity);
    EXPECT_EQ(problemAreas(faulty(), 2).size(), 2u);
    EXPECT_EQ(problemAreas(faulty(), 2)[1].text, spots[1].text);
}

// Seen along the normal from four times the longest edge, or from a sixth of the model's size if that is more.
TEST(ProblemAreas, areViewedAlongTheNormalFromFourTimesTheirSize)
{
    for (const float mirror : {1.0f, -1.0f}) {
        Scene scene;
        scene.materials.emplace_back();
        scene.meshes = {makePatch(4, 0, false, 1)};
        scene.instances.push_back({"a", 0, glm::scale(glm::mat4(1), glm::vec3(mirror, 1, 1))});
        const std::vector<ProblemArea> spots = problemAreas(scene);
        ASSERT_EQ(spots.size(), 1u);
        const ProblemArea& spot = spots[0];
        const glm::vec3 middle = (spot.corners[0] + spot.corners[1] + spot.corners[2]) / 3.0f;
        float longest = 0;
        for (int k = 0; k < 3; ++k)
            longest =
                std::max(longest, glm::length(spot.corners[std::size_t(k)] - spot.corners[std::size_t((k + 1) % 3)]));
        EXPECT_NEAR(glm::length(spot.camera.target - middle), 0, 1e-5);
        EXPECT_NEAR(glm::length(spot.camera.eye - middle - glm::vec3(0, 0, 4 * longest)), 0, 1e-4) << mirror;
        EXPECT_TRUE(pick(scene, spot.camera, {100, 100}, {50, 50}));
        scene.meshes.push_back(makePatch(1, 0, false, 1)); // far away: makes the model 1000 wide
        scene.instances.push_back({"b", 1, glm::translate(glm::mat4(1), glm::vec3(1000, 0, 0))});
        const ProblemArea small = problemAreas(scene).at(0);
        EXPECT_NEAR(glm::length(small.camera.eye - small.camera.target), 1000.0 / 6, 2);
    }
    Scene floor; // seen from above; up in the image points away
    floor.materials.emplace_back();
    floor.meshes = {makePatch(4, 0, false, 1)};
    floor.instances.push_back({"a", 0, glm::rotate(glm::mat4(1), -1.5707963f, glm::vec3(1, 0, 0))});
    EXPECT_EQ(problemAreas(floor).at(0).camera.up, glm::vec3(0, 0, -1));
    for (const float degrees : {-30.0f, 45.0f, 80.0f}) { // a slope seen from above or below keeps y up
        floor.instances[0].toWorld = glm::rotate(glm::mat4(1), glm::radians(degrees), glm::vec3(1, 0, 0));
        const Camera camera = problemAreas(floor).at(0).camera;
        EXPECT_EQ(camera.up, glm::vec3(0, 1, 0)) << degrees;
        EXPECT_NEAR(glm::normalize(camera.eye - camera.target).y, -std::sin(glm::radians(degrees)), 1e-5) << degrees;
    }
}

// ---- what is under the pointer ------------------------------------------------------------------------

TEST(ProbeValues, applyTheInstanceTransform)
{
    Scene scene = panel();
    scene.images.push_back(makeImage(8, 4, PixelType::unorm8));
    scene.materials[0].normalMap.image = 0;
    scene.meshes[0].tangents.assign(4, {1, 0, 0, 1});
    scene.instances.push_back(
        {"turned", 0, glm::rotate(glm::translate(glm::mat4(1), glm::vec3(0, 0, 3)), 1.5707963f, glm::vec3(0, 0, 1))});
    Camera camera;
    camera.eye = {0, 0, 9};
    camera.orthographic = true;
    camera.verticalExtent = 2;
    viewer::Prober prober;
    const auto hit = pick(scene, camera, {100, 100}, {75, 40}); // world (0.5, 0.2), in the rotated instance (0.2, -0.5)
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->instance, 1);
    EXPECT_NEAR(hit->depth, 6, 1e-5);
    const viewer::Probed p = prober.at(scene, 1, *hit, Frame::cotangent, TangentOrigin::stored);
    EXPECT_NEAR(p.uv.x, 0.6f, 1e-5);
    EXPECT_NEAR(p.uv.y, 0.75f, 1e-5);
    EXPECT_EQ(p.texel, glm::ivec2(4, 3)); // 4.8 and 3
    EXPECT_NEAR(glm::length(p.storedTangent - glm::vec3(0, 1, 0)), 0, 1e-5);
    EXPECT_NEAR(glm::length(glm::normalize(p.t) - glm::vec3(0, 1, 0)), 0, 1e-5);
    EXPECT_NEAR(glm::length(glm::normalize(p.b) - glm::vec3(1, 0, 0)), 0, 1e-5);
    EXPECT_EQ(p.w, 1);
    camera.eye = {0, 0, 2}; // below the rotated instance: hits the other one, with the same prober
    const auto other = pick(scene, camera, {100, 100}, {75, 40});
    ASSERT_TRUE(other);
    EXPECT_EQ(other->instance, 0);
    const viewer::Probed q = prober.at(scene, 1, *other, Frame::cotangent, TangentOrigin::stored);
    EXPECT_NEAR(q.uv.x, 0.75f, 1e-5);
    EXPECT_NEAR(q.uv.y, 0.4f, 1e-5);
    EXPECT_NEAR(glm::length(glm::normalize(q.t) - glm::vec3(1, 0, 0)), 0, 1e-5);
    scene.meshes[0].texcoords[0].clear(); // the new number marks another scene
    const viewer::Probed none = prober.at(scene, 2, *other, Frame::cotangent, TangentOrigin::stored);
    EXPECT_FALSE(none.hasUv);
    EXPECT_EQ(none.w, 0);
    EXPECT_EQ(none.t, glm::vec3(0));
    EXPECT_NEAR(glm::length(none.normal - glm::vec3(0, 0, 1)), 0, 1e-6);
}

} // namespace
} // namespace cotan
