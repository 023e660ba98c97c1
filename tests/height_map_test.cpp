// Height maps: images of flat surfaces with one are compared with images of really displaced meshes, drawn by the
// rasteriser alone, on both renderers.
#include "reference_scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include "cotan/image.hpp"
#include "cotan/picture.hpp"
#include "cotan/render.hpp"
#include "cotan/view.hpp"

namespace cotan {
namespace {

using namespace cotan::testing;

constexpr int kTexels = 128;   // of a map, per unit of uv
constexpr float kDepth = 0.1f; // world units

// Low waves, repeating over the unit square, between 0.2 and 1.
double storedHeight(glm::dvec2 uv)
{
    return 0.6 + 0.25 * std::sin(2 * std::numbers::pi * 3 * uv.x) + 0.15 * std::cos(2 * std::numbers::pi * 2 * uv.y);
}

Image heightImage(const std::function<double(glm::dvec2)>& height)
{
    Image image = makeImage(kTexels, kTexels, PixelType::unorm16, "heights");
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x)
            std::fill_n(image.words() + 4 * (y * kTexels + x), 4,
                        std::uint16_t(std::lround(65535 * height({(x + 0.5) / kTexels, (y + 0.5) / kTexels}))));
    return image;
}

void addHeightMap(Scene& scene, Image image, float depth = kDepth, std::size_t material = 0)
{
    scene.materials[material].heightMap.map.image = int(scene.images.size());
    scene.materials[material].heightMap.depth = depth;
    scene.images.push_back(std::move(image));
}

// A grid from -3 to 3 in x and y, uv = layout * (x, y), lowered by depth(uv). The second uv set is (x, y).
Mesh grid(int cells, const glm::dmat2& layout, const std::function<double(glm::dvec2)>& depth)
{
    Mesh mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const glm::dvec2 p = glm::dvec2(i, j) * (6.0 / cells) - 3.0, uv = layout * p;
            mesh.positions.push_back(glm::vec3(p, -depth(uv)));
            mesh.normals.push_back({0, 0, 1});
            mesh.texcoords[0].push_back(glm::vec2(uv));
            mesh.texcoords[1].push_back(glm::vec2(p));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto a = std::uint32_t(j * (cells + 1) + i), c = a + std::uint32_t(cells) + 1;
            for (const std::uint32_t k : {a, a + 1, c + 1, a, c + 1, c})
                mesh.indices.push_back(k);
        }
    return mesh;
}

double flat(glm::dvec2) { return 0; }
double lowered(glm::dvec2 uv) { return kDepth * (1 - storedHeight(uv)); }

struct Layout {
    const char* name;
    glm::dmat2 uv; // columns: uv along x and along y
};
const Layout kLayouts[] = {{"square", {{0.5, 0}, {0, -0.5}}},
                           {"stretch 4:1", {{0.25, 0}, {0, -1}}},
                           {"shear 45", {{0.5, 0}, {0.5, -0.5}}},
                           {"shear 45, mirrored", {{-0.5, 0}, {0.5, -0.5}}}};

// A view from `degrees` off the normal, in which the grid covers every pixel.
View slanted(double degrees, Output output = Output::uv)
{
    View view = viewOf(output);
    const double a = degrees * std::numbers::pi / 180;
    view.camera.eye = glm::vec3(1.5 * std::sin(a) * 0.6, -1.5 * std::sin(a) * 0.8, 1.5 * std::cos(a));
    view.camera.verticalFieldOfView = 0.3f;
    return view;
}

// The renderers of this machine.
std::vector<std::unique_ptr<Renderer>> renderers()
{
    std::vector<std::unique_ptr<Renderer>> all;
    for (const char* device : {"reference", "auto"})
        if (auto opened = openRenderer(device); opened && (*opened)->note.empty())
            all.push_back(std::move(*opened));
    EXPECT_FALSE(all.empty());
    return all;
}

Image drawn(Renderer& renderer, const Scene& scene, const View& view)
{
    EXPECT_TRUE(renderer.load(scene));
    Result<Image> image = renderer.draw(view);
    if (!image) {
        ADD_FAILURE() << image.error().message;
        return makeImage(view.width, view.height, PixelType::float32);
    }
    return *std::move(image);
}

// Distances in texels between the uv of two images: their mean, and the fraction over half a texel.
struct Off {
    double mean = 0, fraction = 0;
};
Off offBetween(const Image& a, const Image& b)
{
    Off off;
    const int covered = forCovered(b, [&](int x, int y, glm::vec4 value) {
        const double texels = double(glm::length(glm::vec2(pixelOf(a, x, y)) - glm::vec2(value))) * kTexels;
        off.mean += texels;
        off.fraction += texels > 0.5 ? 1 : 0;
    });
    EXPECT_EQ(covered, b.width * b.height);
    return {off.mean / covered, off.fraction / covered};
}

// The bars. A search ends within 1/256 of a texel. Cells of the displaced mesh are 0.0075
// wide, which puts their middle up to 0.0003 wrong: 0.05 texels there. Devices without anisotropic filters read the
// heights of far pixels from a coarser mip. Where a wave hides another, a pixel may show either.
void expectEqualUv(const Image& image, const Image& truth, const std::string& what)
{
    const Off off = offBetween(image, truth);
    EXPECT_LT(off.mean, 0.1) << what;
    EXPECT_LT(off.fraction, 0.01) << what;
}

TEST(HeightMap, showsTheUvThatTheDisplacedMeshShows)
{
    const auto all = renderers();
    for (const Layout& layout : kLayouts)
        for (const double degrees : {20.0, 65.0}) {
            const View view = slanted(degrees);
            const Image truth = drawn(*all[0], sceneOf(grid(800, layout.uv, lowered)), view);
            Scene scene = sceneOf(grid(4, layout.uv, flat));
            EXPECT_GT(offBetween(drawn(*all[0], scene, view), truth).mean, 0.5) << layout.name; // what the test can see
            addHeightMap(scene, heightImage(storedHeight));
            for (const auto& renderer : all)
                expectEqualUv(drawn(*renderer, scene, view), truth,
                              renderer->device() + ", " + layout.name + ", " + std::to_string(int(degrees)));
        }
}

// Depth is in world units: an instance that stretches the mesh stretches uv, not the depth.
TEST(HeightMap, itsDepthIsInWorldUnitsOnAnInstanceThatIsScaled)
{
    const glm::dmat2 layout(glm::dvec2(0.25, 0), glm::dvec2(0.5, -0.5));
    glm::mat4 narrow(1);
    narrow[0][0] = 0.5f;
    const glm::dmat2 inWorld(layout[0] * 2.0, layout[1]);
    for (const auto& renderer : renderers()) {
        Scene scene = sceneOf(grid(4, layout, flat), narrow);
        addHeightMap(scene, heightImage(storedHeight));
        const View view = slanted(45);
        expectEqualUv(drawn(*renderer, scene, view), drawn(*renderer, sceneOf(grid(800, inWorld, lowered)), view),
                      renderer->device());
    }
}

// The height map has its own transform; the map that is drawn has none, or reads the other uv set. All show the same
// point of the surface.
TEST(HeightMap, allMapsMoveWhateverTheirTransformAndUvSet)
{
    const Layout& layout = kLayouts[3];
    Texture transformed;
    transformed.uRow = {1.5f, 0.5f, 0.2f};
    transformed.vRow = {-0.5f, 1, 0.7f};
    const auto depth = [&](glm::dvec2 uv) {
        return lowered({1.5 * uv.x + 0.5 * uv.y + double(0.2f), -0.5 * uv.x + uv.y + double(0.7f)});
    };
    for (const auto& renderer : renderers())
        for (const int set : {0, 1}) {
            Scene scene = sceneOf(grid(4, layout.uv, flat)), truth = sceneOf(grid(800, layout.uv, depth));
            addHeightMap(scene, heightImage(storedHeight));
            Texture& map = scene.materials[0].heightMap.map;
            map.uRow = transformed.uRow, map.vRow = transformed.vRow;
            for (Scene* s : {&scene, &truth}) {
                addNormalMap(*s, {128, 128, 255});
                s->materials[0].normalMap.texcoord = set;
            }
            const View view = slanted(45);
            expectEqualUv(drawn(*renderer, scene, view), drawn(*renderer, truth, view),
                          renderer->device() + ", set " + std::to_string(set));
        }
}

// Two meshes and two materials share one image of heights, with other depths; a third has none.
TEST(HeightMap, eachMaterialHasItsOwnDepthOfASharedImage)
{
    const auto at = [](float x) {
        glm::mat4 m(1.0f / 3);
        m[3] = {x, 0, 0, 1};
        return m;
    };
    for (const auto& renderer : renderers()) {
        Scene scene = sceneOf(grid(4, kLayouts[0].uv, flat));
        scene.materials.resize(3);
        addHeightMap(scene, heightImage(storedHeight));
        scene.materials[1].heightMap = scene.materials[0].heightMap;
        scene.materials[1].heightMap.depth = kDepth * 2;
        View view = slanted(45);
        std::vector<Image> alone;
        for (int i = 0; i < 3; ++i) {
            scene.meshes.resize(std::size_t(i) + 1, scene.meshes[0]);
            scene.meshes.back().material = i;
            scene.instances = {{"", i, glm::mat4(1)}};
            alone.push_back(drawn(*renderer, scene, view));
        }
        EXPECT_GT(offBetween(alone[0], alone[2]).mean, 1);
        EXPECT_GT(offBetween(alone[0], alone[1]).mean, 1);
        EXPECT_GT(offBetween(alone[1], alone[2]).mean, offBetween(alone[0], alone[2]).mean);
        // All three side by side are drawn as each of them alone.
        view.camera.eye = {0.5f, -3, 4};
        scene.instances.clear();
        Image together = makeImage(view.width, view.height, PixelType::float32);
        for (int i = 0; i < 3; ++i) {
            const Instance one{"", i, at(2.2f * float(i - 1))};
            Scene single = scene;
            single.instances = {one};
            scene.instances.push_back(one);
            const Image image = drawn(*renderer, single, view);
            forCovered(image, [&](int x, int y, glm::vec4 value) {
                std::copy_n(&value.x, 4, together.floats() + 4 * (y * view.width + x));
            });
        }
        EXPECT_EQ(drawn(*renderer, scene, view).data, together.data) << renderer->device();
    }
}

// A trench: its right half lies kDepth lower. Light from the left at 45 degrees leaves the shadow of the wall on its
// floor, kDepth wide; light from the right none.
TEST(HeightMap, theReliefShadowsItselfAsFarAsItsWallIsHigh)
{
    constexpr float kWall = 0.3f; // depth
    for (const auto& renderer : renderers())
        for (const float side : {-1.0f, 1.0f}) {
            Scene scene = sceneOf(grid(4, {{1.0 / 6, 0}, {0, -1.0 / 6}}, flat));
            addHeightMap(scene, heightImage([](glm::dvec2 uv) { return uv.x < 0.5 ? 1.0 : 0.0; }), kWall);
            scene.materials[0].heightMap.map.uRow.z = 0.5f; // the wall is at x = 0
            View view = viewOf(Output::shaded);
            view.camera.orthographic = true;
            view.camera.verticalExtent = 1.28f; // 0.02 a pixel
            view.samples = 1;
            view.environment = view.background = false;
            view.linearOutput = true;
            view.shadowSoftness = 0;
            view.lights = {Light{}};
            view.lights[0].direction = glm::normalize(glm::vec3(-side, 0, -1));
            const Image image = drawn(*renderer, scene, view);
            int dark = 0;
            for (int x = 0; x < 64; ++x) {
                const float at = (float(x) - 31.5f) * 0.02f;
                const bool isDark = pixelOf(image, x, 32).x < 1e-3f;
                dark += isDark ? 1 : 0;
                // A texel is 0.047 wide, and the wall is a slope over one of them.
                if (std::abs(at) > 0.05f && std::abs(at - kWall) > 0.05f) {
                    EXPECT_EQ(isDark, side < 0 && at > 0 && at < kWall) << renderer->device() << " at " << at;
                }
            }
            EXPECT_EQ(dark > 10, side < 0);
            view.shadows = false;
            EXPECT_GT(pixelOf(drawn(*renderer, scene, view), 39, 32).x, 0.1f);
        }
}

// Two materials, whose normal maps differ in uv set and transform.
TEST(HeightMap, ofTheUserTakesUvSetAndTransformOfEachChosenNormalMap)
{
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "height_map_test.png";
    ASSERT_TRUE(writeImage(file, heightImage(storedHeight)));
    Scene scene = sceneOf(grid(4, kLayouts[0].uv, flat));
    scene.materials.resize(2);
    addNormalMap(scene, {128, 128, 255});
    scene.materials[1].normalMap = {
        0, 1, {Wrap::clamp, Wrap::clamp, Filter::nearest, Filter::nearest, MipFilter::none}, {2, 3, 4}, {5, 6, 7}};
    for (const int chosen : {-1, 0, 1}) {
        Scene mapped = scene;
        OwnMaps maps;
        maps.height = file.string();
        maps.heightDepth = 0.25f;
        maps.material = chosen;
        mapped.meshes.push_back(mapped.meshes[0]);
        mapped.meshes[1].material = 1;
        const Status done = applyOwnMaps(maps, limitsFor(kDefaultMemory), mapped);
        ASSERT_TRUE(done) << done.error().message;
        for (int i = 0; i < 2; ++i) {
            const HeightMap& found = mapped.materials[std::size_t(i)].heightMap;
            const Texture& normal = scene.materials[std::size_t(i)].normalMap;
            ASSERT_EQ(found.present(), chosen == -1 || chosen == i);
            if (!found.present())
                continue;
            EXPECT_EQ(found.depth, 0.25f);
            EXPECT_EQ(mapped.images[std::size_t(found.map.image)].name, file.string());
            EXPECT_EQ(found.map.texcoord, normal.texcoord);
            EXPECT_EQ(found.map.uRow, normal.uRow);
            EXPECT_EQ(found.map.vRow, normal.vRow);
            EXPECT_EQ(found.map.sampler.wrapU, Wrap::repeat);
            EXPECT_EQ(found.map.sampler.minify, Filter::linear);
        }
        EXPECT_TRUE(mapped.warnings.empty());
    }
    Scene bare = sceneOf(grid(4, kLayouts[0].uv, flat));
    OwnMaps maps;
    maps.height = file.string();
    ASSERT_TRUE(applyOwnMaps(maps, limitsFor(kDefaultMemory), bare));
    ASSERT_EQ(bare.warnings.size(), 1u);
    EXPECT_NE(bare.warnings[0].find("without a normal map"), std::string::npos);
    EXPECT_NEAR(bare.materials[0].heightMap.depth, 0.02 * 6 * std::sqrt(2.0), 1e-6); // of the diagonal
}

TEST(HeightMap, withoutDepthFromBehindAndOnTheHorizonTheSurfaceIsAsItIs)
{
    for (const auto& renderer : renderers()) {
        Scene plain = sceneOf(grid(4, kLayouts[2].uv, flat));
        plain.materials[0].doubleSided = true;
        Scene zero = plain, deep = plain;
        addHeightMap(zero, heightImage(storedHeight), 0);
        addHeightMap(deep, heightImage(storedHeight));
        const View front = slanted(60);
        EXPECT_LT(offBetween(drawn(*renderer, zero, front), drawn(*renderer, plain, front)).mean, 1e-4);
        View behind = front;
        behind.camera.eye.z = -behind.camera.eye.z;
        EXPECT_LT(offBetween(drawn(*renderer, deep, behind), drawn(*renderer, plain, behind)).mean, 1e-4);
        View horizon = viewOf(Output::uv);
        horizon.camera.eye = {0, -2.9f, 0.002f};
        horizon.camera.target = {0, 0, 0};
        const Image image = drawn(*renderer, deep, horizon);
        EXPECT_GT(forCovered(image, [](int, int, glm::vec4 v) { EXPECT_TRUE(std::isfinite(v.x + v.y)); }), 1000);
        // Numbers as broken as a caller of the library can make them.
        for (const float depth : {1e30f, 1e-30f}) {
            deep.materials[0].heightMap.depth = depth;
            forCovered(drawn(*renderer, deep, front),
                       [](int, int, glm::vec4 v) { EXPECT_TRUE(std::isfinite(v.x + v.y)); });
        }
    }
}

} // namespace
} // namespace cotan
