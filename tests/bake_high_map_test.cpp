// The high mesh's own normal map as the source of detail: the low map gets the normals that it means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/mat3x3.hpp>

#include "bake/bake_surfaces.hpp"
#include "high_view.hpp"
#include "truth/quad.hpp"

namespace cotan {
namespace {

constexpr int kSide = 32; // texels a side of most maps

// A unit-length texel (along u, along v, outwards) that repeats with uv.
glm::dvec3 relief(double u, double v)
{
    const double fullTurn = 2 * std::numbers::pi;
    return glm::normalize(glm::dvec3(0.6 * std::cos(fullTurn * u), 0.4 * std::sin(fullTurn * (u + 2 * v)), 1));
}

// Stores green up (against +v): integers as 127 x + 128, floats as (x + 1) / 2.
Image storedMap(int width, int height, PixelType type, const std::function<glm::dvec3(double, double)>& texel)
{
    Image image = makeImage(width, height, type, "map");
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::dvec3 m = texel((x + 0.5) / width, (y + 0.5) / height);
            m.y = -m.y;
            const std::size_t at = 4 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
            for (int k = 0; k < 3; ++k) {
                if (type == PixelType::unorm8)
                    image.bytes8()[at + std::size_t(k)] = std::uint8_t(std::lround(127 * m[k] + 128));
                else
                    image.floats()[at + std::size_t(k)] = float((m[k] + 1) / 2);
            }
        }
    return image;
}

// An affine texture layout of the unit square: uv = at + x * px + y * py.
struct Layout2 {
    glm::dvec2 at, x, y;
    glm::dvec2 operator()(double px, double py) const { return at + x * px + y * py; }
};
constexpr Layout2 kPlain{{0, 1}, {1, 0}, {0, -1}}; // v down

// A height field over the unit square, `cells` wide, with a normal map if `map` has pixels.
Scene sheet(const Layout2& uv, Image map, int cells = 1,
            const std::function<glm::dvec3(double, double)>& heightAndSlopes = {})
{
    Scene scene;
    scene.name = "sheet";
    Mesh mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = double(i) / cells, y = double(j) / cells;
            const glm::dvec3 h = heightAndSlopes ? heightAndSlopes(x, y) : glm::dvec3(0);
            mesh.positions.emplace_back(float(x), float(y), float(h.x));
            mesh.normals.push_back(glm::vec3(glm::normalize(glm::dvec3(-h.y, -h.z, 1))));
            mesh.texcoords[0].push_back(glm::vec2(uv(x, y)));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto a = std::uint32_t(j * (cells + 1) + i), b = a + 1, d = a + std::uint32_t(cells) + 1, c = d + 1;
            for (std::uint32_t k : {a, b, c, a, c, d})
                mesh.indices.push_back(k);
        }
    scene.meshes.push_back(std::move(mesh));
    scene.materials.emplace_back();
    scene.instances.push_back({});
    if (map.pixelCount() > 0) {
        scene.materials[0].normalMap.image = 0;
        scene.images.push_back(std::move(map));
    }
    return scene;
}

Baked bakeWithMap(const Scene& low, Scene high, BakeOptions options, Frame highFrame)
{
    std::vector<Scene> scenes;
    scenes.push_back(std::move(high));
    const auto lowSurface = makeLowSurface(low, -1, options.frame, TangentOrigin::stored);
    const auto surface = HighSurface::make(scenes, 1);
    auto maps = HighNormalMaps::make(scenes, highFrame);
    EXPECT_TRUE(lowSurface && surface && maps);
    options.highMaps = std::make_shared<const HighNormalMaps>(std::move(*maps));
    auto baked = bake(*lowSurface, *surface, options);
    EXPECT_TRUE(baked);
    return std::move(*baked);
}

BakeOptions square(BakeKind kind, Frame frame = Frame::cotangent)
{
    BakeOptions options;
    options.samples = 1; // a texel has the value at its centre
    options.kind = kind;
    options.frame = frame;
    options.width = options.height = kSide;
    options.maxDistance = 0.1f;
    return options;
}

TEST(BakeHighMap, onTheSameFlatQuadTheMapComesBack)
{
    const Image map = storedMap(kSide, kSide, PixelType::unorm8, relief);
    for (Frame frame : {Frame::cotangent, Frame::orthonormal, Frame::smooth, Frame::mikktspace, Frame::exact}) {
        const Baked baked = bakeWithMap(sheet(kPlain, {}), sheet(kPlain, map), square(BakeKind::normal, frame), frame);
        const Image stored = storeBaked(baked, BakeKind::normal, {});
        for (std::size_t i = 0; i < map.pixelCount(); ++i)
            for (std::size_t k = 0; k < 3; ++k) // 8-bit texels are not quite unit length. Normalising moves each by up
                                                // to sqrt(3)/2 steps, so by one step when stored again.
                EXPECT_NEAR(int(stored.bytes8()[4 * i + k]), int(map.bytes8()[4 * i + k]), 1) << name(frame);
    }
}

// A texture layout of a flat quad; the normals that its map means follow from the directions of u and v in space.
struct Case {
    const char* name;
    Layout2 uv;
    int width = kSide, height = kSide; // chosen so that baked texel centres are map texel centres
    double alongU = 1, alongV = 1;     // the frame's factors on the slopes
    std::vector<Frame> frames = {Frame::cotangent, Frame::orthonormal, Frame::smooth, Frame::mikktspace, Frame::vertex};
    std::function<void(Scene&)> change = {}; // to the high scene
    double scale = 1;
};

TEST(BakeHighMap, rotatedMirroredScaledAndShiftedUvGiveTheSameNormals)
{
    const glm::mat4 rotated = glm::rotate(glm::mat4(1), 1.1f, glm::normalize(glm::vec3(1, 2, -1)));
    const glm::mat4 mirrored = glm::scale(rotated, glm::vec3(-1, 1, 1));
    const Case cases[] = {
        {"plain", kPlain},
        {"a quarter turn", {{0, 0}, {0, 1}, {1, 0}}},
        {"half a turn", {{1, 0}, {-1, 0}, {0, 1}}},
        {"mirrored", {{1, 1}, {-1, 0}, {0, -1}}},
        {"beyond the unit square", {{-3.5, 7.5}, {1, 0}, {0, -1}}},
        // gradU = 1/2, gradV = 1: the longer gradient gets length one.
        {"stretched", {{0, 1}, {0.5, 0}, {0, -1}}, 2 * kSide, kSide, 0.5, 1, {Frame::cotangent, Frame::smooth}},
        {"stretched, orthonormal",
         {{0, 1}, {0.5, 0}, {0, -1}},
         2 * kSide,
         kSide,
         1,
         1,
         {Frame::orthonormal, Frame::mikktspace, Frame::vertex}},
        {"scale of the material",
         kPlain,
         kSide,
         kSide,
         1,
         1,
         {Frame::cotangent, Frame::mikktspace},
         [](Scene& s) { s.materials[0].normalScale = 2; },
         2},
        {"by uv set 1",
         {{1, 0}, {-1, 0}, {0, 1}},
         kSide,
         kSide,
         1,
         1,
         {Frame::cotangent, Frame::mikktspace},
         [](Scene& s) {
             s.materials[0].normalMap.texcoord = 1;
             s.meshes[0].texcoords[1] = s.meshes[0].texcoords[0];
             s.meshes[0].texcoords[0].assign(4, glm::vec2(0.25f));
         }},
        {"by a texture transform",
         {{0, 0}, {0, 1}, {1, 0}},
         kSide,
         kSide,
         1,
         1,
         {Frame::cotangent, Frame::mikktspace},
         [](Scene& s) { // from kPlain: u' = 1 - v, v' = u
             for (glm::vec2& uv : s.meshes[0].texcoords[0])
                 uv = {uv.y, 1 - uv.x};
             s.materials[0].normalMap.uRow = {0, -1, 1};
             s.materials[0].normalMap.vRow = {1, 0, 0};
         }},
        // TANGENT takes precedence over uv: it is along y although u runs along x.
        {"stored tangents",
         kPlain,
         kSide,
         kSide,
         1,
         1,
         {Frame::mikktspace, Frame::vertex},
         [](Scene& s) { s.meshes[0].tangents.assign(4, glm::vec4(0, 1, 0, 1)); }},
    };
    for (const Case& c : cases)
        for (Frame frame : c.frames)
            for (const glm::mat4& transform : {glm::mat4(1), rotated, mirrored}) {
                Scene high = sheet(c.uv, storedMap(c.width, c.height, PixelType::float32, relief)),
                      low = sheet(kPlain, {});
                if (c.change)
                    c.change(high);
                high.instances[0].toWorld = low.instances[0].toWorld = transform;
                const Baked baked = bakeWithMap(low, high, square(BakeKind::objectNormal), frame);
                const bool stored = !high.meshes[0].tangents.empty();
                const double length =
                    1 / std::max(glm::length(c.uv.x), glm::length(c.uv.y)); // normalises the axes of uv
                const glm::dvec3 u =
                    stored ? glm::dvec3(0, 1, 0) : glm::normalize(glm::dvec3(c.uv.x.x, c.uv.y.x, 0) * length);
                const glm::dvec3 v = stored ? glm::dvec3(1, 0, 0) // glTF's bitangent n x t is -x; +v is opposite
                                            : glm::normalize(glm::dvec3(c.uv.x.y, c.uv.y.y, 0) * length);
                const glm::dmat3 world{glm::mat3(transform)};
                double worst = 0;
                for (int j = 0; j < kSide; ++j)
                    for (int i = 0; i < kSide; ++i) {
                        const glm::dvec2 uv = c.uv((i + 0.5) / kSide, 1 - (j + 0.5) / kSide);
                        const glm::dvec3 m = relief(uv.x, uv.y) * glm::dvec3(c.scale, c.scale, 1);
                        const glm::dvec3 n =
                            world * (u * (m.x * c.alongU) + v * (m.y * c.alongV) + glm::dvec3(0, 0, m.z));
                        worst =
                            std::max(worst, degreesBetween(glm::dvec3(baked.values[std::size_t(j * kSide + i)]), n));
                    }
                EXPECT_LT(worst, 0.002) << c.name << ", " << name(frame); // float uv: 1e-6, times a slope of 4 per uv
            }
}

TEST(BakeHighMap, onAWavySheetTheNormalIsThatOfTheMapOnTheWaves)
{
    auto waves = [](double x, double y) {
        return glm::dvec3(0.02 * std::sin(9 * x + 1) * std::cos(7 * y), 0.18 * std::cos(9 * x + 1) * std::cos(7 * y),
                          -0.14 * std::sin(9 * x + 1) * std::sin(7 * y));
    };
    // Interpolated normals of 200 cells have an error of (9 / 200)^2 / 8 of the slope, below 0.01 degrees. A frame per
    // triangle takes gradients at up to a cell's distance: 9 / 200 of a slope of 0.18 rotates them by at most 0.46
    // degrees, and 0.7 of the texel lies along them. `smooth` interpolates: second order again.
    for (const auto& [frame, limit] : {std::pair(Frame::smooth, 0.02), {Frame::cotangent, 0.33}}) {
        const Baked baked = bakeWithMap(sheet(kPlain, {}),
                                        sheet(kPlain, storedMap(kSide, kSide, PixelType::float32, relief), 200, waves),
                                        square(BakeKind::objectNormal), frame);
        double worst = 0;
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                const double x = (i + 0.5) / kSide, y = 1 - (j + 0.5) / kSide;
                const glm::dvec3 h = waves(x, y), m = relief(x, 1 - y);
                const glm::dvec3 px(1, 0, h.y), py(0, 1, h.z), n = glm::normalize(glm::cross(px, py));
                // Surface gradients of u = x and v = 1 - y.
                const glm::dvec3 gradU = glm::cross(py, n) / glm::dot(px, glm::cross(py, n));
                const glm::dvec3 gradV = -glm::cross(n, px) / glm::dot(py, glm::cross(n, px));
                const double s = commonScale(gradU, gradV);
                const glm::dvec3 truth = gradU * (s * m.x) + gradV * (s * m.y) + n * m.z;
                worst = std::max(worst, degreesBetween(glm::dvec3(baked.values[std::size_t(j * kSide + i)]), truth));
            }
        EXPECT_LT(worst, limit) << name(frame);
    }
}

TEST(BakeHighMap, unusableTexelsOrUvGiveTheSmoothNormal)
{
    auto slope = [](double x, double) { return glm::dvec3(0.05 * x, 0.05, 0); };
    const glm::dvec3 smooth(-0.05, 0, 1);
    Scene zero =
        sheet(kPlain, storedMap(4, 4, PixelType::float32, [](double, double) { return glm::dvec3(0); }), 1, slope);
    Scene nan =
        sheet(kPlain, storedMap(4, 4, PixelType::float32, [](double, double) { return glm::dvec3(NAN); }), 1, slope);
    Scene noArea = sheet({{0, 0}, {1, 0}, {1, 0}}, storedMap(4, 4, PixelType::float32, relief), 1, slope);
    Scene notFinite = sheet({{0, 0}, {INFINITY, 0}, {0, 1}}, storedMap(4, 4, PixelType::float32, relief), 1, slope);
    Scene partly = sheet(kPlain, storedMap(4, 4, PixelType::float32, relief), 1, slope);
    partly.meshes.push_back(partly.meshes[0]); // the instance in view has another material
    partly.meshes[0].material = 1;
    partly.materials.emplace_back();
    partly.instances.push_back({"far", 1, glm::translate(glm::mat4(1), glm::vec3(5, 0, 0))});
    for (Scene* high : {&zero, &nan, &noArea, &notFinite, &partly})
        for (Frame frame : {Frame::cotangent, Frame::mikktspace, Frame::smooth})
            for (const glm::vec3& n :
                 bakeWithMap(sheet(kPlain, {}), *high, square(BakeKind::objectNormal), frame).values)
                ASSERT_LT(degreesBetween(glm::dvec3(n), smooth), 1e-4) << name(frame); // float rounding
}

TEST(BakeHighMap, heightsAndOcclusionIgnoreTheMap)
{
    for (BakeKind kind : {BakeKind::height, BakeKind::occlusion}) {
        const Scene low = sheet(kPlain, {}), high = sheet(kPlain, storedMap(kSide, kSide, PixelType::float32, relief));
        const auto surface = makeLowSurface(low, -1, Frame::cotangent, TangentOrigin::stored);
        const auto plain = HighSurface::make({high}, 1);
        ASSERT_TRUE(surface && plain);
        BakeOptions options = square(kind);
        options.occlusionRays = 4;
        const auto without = bake(*surface, *plain, options);
        ASSERT_TRUE(without);
        EXPECT_TRUE(bakeWithMap(low, high, options, Frame::mikktspace).values == without->values);
    }
}

TEST(BakeHighMap, viewRaysReadTheMapToo)
{
    const glm::dvec3 m = glm::normalize(glm::dvec3(0.3, -0.2, 1));
    std::vector<Scene> high;
    high.push_back(sheet(kPlain, storedMap(4, 4, PixelType::float32, [&](double, double) { return m; })));
    const auto low = makeLowSurface(sheet(kPlain, {}), -1, Frame::cotangent, TangentOrigin::stored);
    const auto surface = HighSurface::make(high, 1);
    auto maps = HighNormalMaps::make(high, Frame::mikktspace);
    ASSERT_TRUE(low && surface && maps);
    BakeOptions options = square(BakeKind::normal);
    options.highMaps = std::make_shared<const HighNormalMaps>(std::move(*maps));
    View view;
    view.width = view.height = 16;
    view.camera.eye = {0.5f, 0.5f, 3};
    view.camera.target = {0.5f, 0.5f, 0};
    const auto both = app::renderHighView(*low, *surface, options, view);
    ASSERT_TRUE(both);
    const Image& rendered = both->expected;
    EXPECT_EQ(both->others, 0u);
    int found = 0;
    for (std::size_t i = 0; i < rendered.pixelCount(); ++i)
        if (const float* p = rendered.floats() + 4 * i; p[3] > 0) {
            ++found;
            EXPECT_LT(degreesBetween(glm::dvec3(p[0], p[1], p[2]), glm::dvec3(m.x, -m.y, m.z)),
                      1e-3); // v points down; float rounding
        }
    EXPECT_GT(found, 16); // the square fills 0.4 of the image's height
}

TEST(BakeHighMap, missingMapsOrUvAreRefused)
{
    Scene bare = sheet(kPlain, {}), noUv = sheet(kPlain, storedMap(4, 4, PixelType::unorm8, relief));
    noUv.meshes[0].texcoords[0].clear();
    for (const auto& [scene, word] : {std::pair(&bare, "in a material"), {&noUv, "texture coordinates"}}) {
        std::vector<Scene> scenes{*scene};
        const auto maps = HighNormalMaps::make(scenes, Frame::mikktspace);
        ASSERT_FALSE(maps);
        EXPECT_EQ(maps.error().kind, ErrorKind::input);
        EXPECT_NE(maps.error().message.find(word), std::string::npos) << maps.error().message;
    }
}

} // namespace
} // namespace cotan
