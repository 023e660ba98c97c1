// Maps of the high model's materials, compared with the textures that the tests wrote.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "bake/bake_kinds.hpp"
#include "bake_scene.hpp"
#include "cotan/bake.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {
namespace {

constexpr int kSide = 32;

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double srgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

// An image of arbitrary colours.
Image noise(int width, int height)
{
    Image image = makeImage(width, height, PixelType::unorm8);
    unsigned state = 1;
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
        image.bytes8()[i] = std::uint8_t((state = state * 1664525u + 1013904223u) >> 24);
    return image;
}

Image columns(int side)
{
    Image image = makeImage(side, side, PixelType::unorm8);
    for (int i = 0; i < side * side; ++i)
        for (int c = 0; c < 4; ++c)
            image.bytes8()[4 * i + c] = i % side % 2 ? 255 : 0;
    return image;
}

BakedMap bakeOne(const Scene& high, BakeKind kind, PixelType type = PixelType::float32,
                 const std::function<void(BakeModelOptions&)>& change = {}, Scene low = {})
{
    if (low.meshes.empty())
        low = sceneOfMeshes({rectangle({0, 0, 0.01f}, {1, 0, 0}, {0, 1, 0})});
    BakeModelOptions options;
    options.bake.samples = 1; // a texel has the value at its centre
    options.kinds = {kind};
    options.bake.frame = Frame::smooth;
    options.bake.width = options.bake.height = kSide;
    options.bake.threads = 2;
    options.stored.type = type;
    if (change)
        change(options);
    HighModel model;
    model.scenes.push_back(high);
    const auto baked = bakeModel(low, std::move(model), options);
    EXPECT_TRUE(baked) << (baked ? "" : baked.error().message);
    return baked ? baked->maps.front() : BakedMap();
}

std::array<int, 3> colourOf(const BakedMap& map, int x, int y)
{
    const std::uint8_t* c = map.image.bytes8() + 4 * (y * kSide + x);
    return {c[0], c[1], c[2]};
}

// Where the centre of a texel of the low square lies.
glm::dvec2 pointOf(int x, int y) { return {(x + 0.5) / kSide, 1 - (y + 0.5) / kSide}; }

// A square that covers the low one, with a texture on sheared and mirrored coordinates of set 1, moved by the texture's
// transform over its borders, where it repeats along u and is mirrored along v.
struct Sheared {
    Image image = noise(16, 8);
    Scene scene = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    Texture texture{.image = 0, .texcoord = 1, .sampler = {Wrap::repeat, Wrap::mirror}};

    Sheared()
    {
        scene.images = {image};
        texture.uRow = {1.5f, 0.25f, -0.5f};
        texture.vRow = {-0.125f, 1.25f, 0.75f};
        for (const glm::vec3& p : scene.meshes[0].positions)
            scene.meshes[0].texcoords[1].emplace_back(1 - p.x + 0.5f * p.y, 0.75f * p.y + 0.125f);
    }

    // The components that a renderer reads there; isColor: in linear light.
    glm::dvec4 at(glm::dvec2 p, bool isColor) const
    {
        const glm::dvec2 uv(1 - p.x + 0.5 * p.y, 0.75 * p.y + 0.125);
        const double u = (1.5 * uv.x + 0.25 * uv.y - 0.5) * image.width - 0.5,
                     v = (-0.125 * uv.x + 1.25 * uv.y + 0.75) * image.height - 0.5;
        glm::dvec4 sum(0);
        for (const int dx : {0, 1})
            for (const int dy : {0, 1}) {
                int x = int(std::floor(u)) + dx, y = int(std::floor(v)) + dy;
                while (x < 0)
                    x += image.width;
                x %= image.width;
                while (y < 0 || y >= image.height)
                    y = y < 0 ? -1 - y : 2 * image.height - 1 - y;
                const double wx = dx ? u - std::floor(u) : 1 - u + std::floor(u),
                             wy = dy ? v - std::floor(v) : 1 - v + std::floor(v);
                for (int c = 0; c < 4; ++c) {
                    const double stored = image.bytes8()[4 * (y * image.width + x) + c] / 255.0;
                    sum[c] += wx * wy * (isColor ? linear(stored) : stored);
                }
            }
        return sum;
    }
};

TEST(BakeMaterials, baseColourIsTheTextureThroughItsOwnCoordinatesTimesTheFactor)
{
    Sheared high;
    high.scene.materials[0].baseColorMap = high.texture;
    high.scene.materials[0].baseColor = {0.5f, 1, 0.25f, 1};
    const BakedMap floats = bakeOne(high.scene, BakeKind::baseColor),
                   bytes = bakeOne(high.scene, BakeKind::baseColor, PixelType::unorm8),
                   words = bakeOne(high.scene, BakeKind::baseColor, PixelType::unorm16);
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec4 truth = high.at(pointOf(i % kSide, i / kSide), true) * glm::dvec4(0.5, 1, 0.25, 1);
        for (int c = 0; c < 3; ++c) {
            // Hits are within 1e-6 of the point, which is 24e-6 of a texel, and neighbours differ by up to 1.
            ASSERT_NEAR(double(floats.image.floats()[4 * i + c]), truth[c], 5e-5) << i << " " << c;
            ASSERT_NEAR(bytes.image.bytes8()[4 * i + c], 255 * srgb(truth[c]), 0.52) << i << " " << c;
            ASSERT_NEAR(words.image.words()[4 * i + c] / 65535.0, srgb(truth[c]), 3e-4) << i << " " << c; // steep at 0
        }
    }
}

TEST(BakeMaterials, texturesOf16BitsAreSrgbAndThoseOfFloatsLinear)
{
    for (const PixelType type : {PixelType::unorm16, PixelType::float32}) {
        Sheared high;
        Image& image = high.scene.images[0];
        image = makeImage(high.image.width, high.image.height, type);
        for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
            if (type == PixelType::unorm16)
                image.words()[i] = std::uint16_t(257 * high.image.bytes8()[i]);
            else
                image.floats()[i] = float(linear(high.image.bytes8()[i] / 255.0));
        high.scene.materials[0].baseColorMap = high.texture;
        const BakedMap map = bakeOne(high.scene, BakeKind::baseColor);
        for (int i = 0; i < kSide * kSide; ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(double(map.image.floats()[4 * i + c]), high.at(pointOf(i % kSide, i / kSide), true)[c],
                            5e-5)
                    << i << " " << c;
    }
}

TEST(BakeMaterials, texelsOfFloatsThatAreNoColoursBecomeBlackOrTheBrightest)
{
    for (const auto& [texel, stored] : {std::pair(NAN, 0), {-3.0f, 0}, {-1.0f, 0}, {INFINITY, 255}}) {
        Scene high = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
        high.images = {makeImage(2, 2, PixelType::float32)};
        std::fill_n(high.images[0].floats(), 16, texel);
        high.materials[0].baseColorMap.image = high.materials[0].metallicRoughnessMap.image = 0;
        for (const BakeKind kind : {BakeKind::baseColor, BakeKind::roughness})
            EXPECT_EQ(colourOf(bakeOne(high, kind, PixelType::unorm8), 5, 5), (std::array{stored, stored, stored}))
                << texel;
    }
}

TEST(BakeMaterials, aMirroredInstanceKeepsItsCoordinates)
{
    Sheared high;
    high.scene.materials[0].baseColorMap = high.texture;
    // The same square in the world, made by an instance that is mirrored along x, of a mesh from -1 to 0.
    for (glm::vec3& p : high.scene.meshes[0].positions)
        p.x = -p.x;
    for (std::size_t i = 0; i < 6; i += 3)
        std::swap(high.scene.meshes[0].indices[i], high.scene.meshes[0].indices[i + 1]);
    high.scene.instances[0].toWorld = glm::scale(glm::mat4(1), {-1, 1, 1});
    const BakedMap map = bakeOne(high.scene, BakeKind::baseColor);
    for (int i = 0; i < kSide * kSide; ++i)
        ASSERT_NEAR(double(map.image.floats()[4 * i]), high.at(pointOf(i % kSide, i / kSide), true).x, 5e-5) << i;
}

TEST(BakeMaterials, vertexColoursMultiplyTheBaseColour)
{
    Scene high = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    for (const glm::vec3& p : high.meshes[0].positions)
        high.meshes[0].colors.emplace_back(0.2f + 0.5f * p.x, 0.1f + 0.8f * p.y, 1 - 0.4f * p.x - 0.4f * p.y, 1);
    high.materials[0].baseColor = {1, 0.5f, 0.25f, 1};
    const BakedMap map = bakeOne(high, BakeKind::baseColor);
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec2 p = pointOf(i % kSide, i / kSide);
        const glm::dvec3 truth(0.2 + 0.5 * p.x, 0.5 * (0.1 + 0.8 * p.y), 0.25 * (1 - 0.4 * p.x - 0.4 * p.y));
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(double(map.image.floats()[4 * i + c]), truth[c], 1e-5) << i << " " << c;
    }
}

TEST(BakeMaterials, samplesAreMixedInLinearLight)
{
    // Black and white columns, two of each in a texel of the map.
    Scene high = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    high.images = {columns(4 * kSide)};
    high.materials[0].baseColorMap = {.image = 0, .sampler = {.magnify = Filter::nearest}};
    const BakedMap map = bakeOne(high, BakeKind::baseColor, PixelType::unorm8,
                                 [](BakeModelOptions& options) { options.bake.samples = 4; });
    for (int i = 0; i < 4 * kSide * kSide; ++i)
        ASSERT_EQ(map.image.bytes8()[i], i % 4 == 3 ? 255 : 188) << i; // 255 srgb(0.5) = 187.5; 127 without the curve
}

TEST(BakeMaterials, roughnessIsGreenAndMetallicIsBlueAndEachAloneIsGrey)
{
    Sheared high;
    high.scene.materials[0].metallicRoughnessMap = high.texture;
    high.scene.materials[0].roughness = 0.75f;
    high.scene.materials[0].metallic = 0.5f;
    const BakedMap both = bakeOne(high.scene, BakeKind::roughnessMetallic, PixelType::unorm8),
                   roughness = bakeOne(high.scene, BakeKind::roughness, PixelType::unorm8),
                   metallic = bakeOne(high.scene, BakeKind::metallic);
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec4 truth = high.at(pointOf(i % kSide, i / kSide), false);
        ASSERT_EQ(both.image.bytes8()[4 * i], 255);
        ASSERT_NEAR(both.image.bytes8()[4 * i + 1], 255 * 0.75 * truth.y, 0.51);
        ASSERT_NEAR(both.image.bytes8()[4 * i + 2], 255 * 0.5 * truth.z, 0.51);
        for (int c = 0; c < 3; ++c) {
            ASSERT_EQ(roughness.image.bytes8()[4 * i + c], both.image.bytes8()[4 * i + 1]);
            ASSERT_NEAR(double(metallic.image.floats()[4 * i + c]), 0.5 * truth.z, 5e-5);
        }
    }
}

TEST(BakeMaterials, lightBeyondOneStaysInFloatsAndIsClampedInIntegers)
{
    Sheared high;
    high.scene.materials[0].emissiveMap = high.texture;
    high.scene.materials[0].emissive = {4, 0.5f, 0};
    const BakedMap floats = bakeOne(high.scene, BakeKind::emissive),
                   bytes = bakeOne(high.scene, BakeKind::emissive, PixelType::unorm8);
    double brightest = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec4 texel = high.at(pointOf(i % kSide, i / kSide), true);
        ASSERT_NEAR(double(floats.image.floats()[4 * i]), 4 * texel.x, 2e-4);
        ASSERT_NEAR(bytes.image.bytes8()[4 * i], 255 * srgb(std::min(4 * texel.x, 1.0)), 0.55);
        ASSERT_NEAR(bytes.image.bytes8()[4 * i + 1], 255 * srgb(0.5 * texel.y), 0.52);
        ASSERT_EQ(bytes.image.bytes8()[4 * i + 2], 0);
        brightest = std::max(brightest, 4 * texel.x);
    }
    EXPECT_GT(brightest, 2);
}

// Squares over the left `share` of the low one and over the rest.
Scene halves(float share)
{
    Scene scene = sceneOfMeshes(
        {rectangle({0, 0, 0}, {share, 0, 0}, {0, 1, 0}), rectangle({share, 0, 0}, {1 - share, 0, 0}, {0, 1, 0})});
    scene.materials.resize(2);
    scene.meshes[1].material = 1;
    return scene;
}

TEST(BakeMaterials, idsAreThoseOfMostSamplesAndNeverMixed)
{
    using Colour = std::array<int, 3>;
    const Colour first{128, 0, 0}, second{0, 128, 0}; // the labels 1 and 2 of PASCAL VOC
    for (const double inTexel : {0.3, 0.8}) {         // of the texel 10, in which 1 and 3 of 4 columns lie left of it
        Scene high = halves(float((10 + inTexel) / kSide));
        high.materials[0].name = "wood";
        high.materials[1].name = "metal";
        high.instances[0].name = high.instances[1].name = "lid"; // one object
        const auto four = [](BakeModelOptions& options) { options.bake.samples = 4; };
        const BakedMap map = bakeOne(high, BakeKind::id, PixelType::unorm8, four);
        for (int i = 0; i < kSide * kSide; ++i)
            ASSERT_EQ(colourOf(map, i % kSide, i / kSide), i % kSide < (inTexel < 0.5 ? 10 : 11) ? first : second) << i;
        ASSERT_EQ(map.ids.size(), 2u);
        EXPECT_EQ(map.ids[1].name, "metal");
        EXPECT_EQ(map.ids[1].color, 0x008000u);
        const BakedMap objects = bakeOne(high, BakeKind::id, PixelType::unorm8,
                                         [](BakeModelOptions& options) { options.bake.idBy = IdBy::object; });
        for (int i = 0; i < kSide * kSide; ++i)
            ASSERT_EQ(colourOf(objects, i % kSide, i / kSide), first);
    }
}

TEST(BakeMaterials, materialsOfOneNameHaveOneColourAlsoInTwoFilesAndNamelessOnesDoNot)
{
    for (const char* name : {"wood", ""}) {
        Scene left = sceneOfMeshes({rectangle({0, 0, 0}, {0.5f, 0, 0}, {0, 1, 0})}),
              right = sceneOfMeshes({rectangle({0.5f, 0, 0}, {0.5f, 0, 0}, {0, 1, 0})});
        left.materials[0].name = right.materials[0].name = name;
        BakeModelOptions options;
        options.kinds = {BakeKind::id};
        options.bake.width = options.bake.height = kSide;
        HighModel model;
        model.scenes = {left, right};
        const auto baked =
            bakeModel(sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}), std::move(model), options);
        ASSERT_TRUE(baked) << baked.error().message;
        EXPECT_EQ(colourOf(baked->maps[0], 2, 2) == colourOf(baked->maps[0], kSide - 2, 2), name[0] != '\0');
    }
}

TEST(BakeMaterials, idsOfVertexColoursAreThoseOfTheNearestCorner)
{
    Scene high = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    high.meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 0, 1}};
    const BakedMap map = bakeOne(high, BakeKind::id, PixelType::unorm8,
                                 [](BakeModelOptions& options) { options.bake.idBy = IdBy::vertexColor; });
    using Colour = std::array<int, 3>;
    EXPECT_EQ(colourOf(map, 1, kSide - 2), (Colour{255, 0, 0})); // the corner at the origin, and so on
    EXPECT_EQ(colourOf(map, kSide - 2, kSide - 2), (Colour{0, 255, 0}));
    EXPECT_EQ(colourOf(map, kSide - 2, 1), (Colour{0, 0, 255}));
    EXPECT_EQ(colourOf(map, 1, 1), (Colour{255, 255, 0}));
    std::set<Colour> all;
    for (int i = 0; i < kSide * kSide; ++i)
        all.insert(colourOf(map, i % kSide, i / kSide));
    EXPECT_EQ(all.size(), 4u);
    EXPECT_TRUE(map.ids.empty());
}

TEST(BakeMaterials, theFirstIdsAreFarApartAndAllDiffer)
{
    // 1100 squares, one material each, in a row. As many small ones are joined for rays, but not their objects.
    constexpr int kCount = 1100;
    std::vector<Mesh> meshes;
    for (int i = 0; i < kCount; ++i)
        meshes.push_back(rectangle({float(i) / kCount, 0, 0}, {1.0f / kCount, 0, 0}, {0, 1, 0}));
    Scene high = sceneOfMeshes(std::move(meshes));
    high.materials.resize(kCount);
    for (int i = 0; i < kCount; ++i)
        high.meshes[std::size_t(i)].material = i;
    const std::vector<IdColor> ids = bakeOne(high, BakeKind::id).ids,
                               objects = bakeOne(high, BakeKind::id, PixelType::unorm8, [](BakeModelOptions&options) {
                                             options.bake.idBy = IdBy::object;
                                         }).ids;
    ASSERT_EQ(ids.size(), std::size_t(kCount));
    EXPECT_EQ(objects.size(), std::size_t(kCount));
    std::set<std::uint32_t> all;
    for (const IdColor& id : ids)
        all.insert(id.color);
    EXPECT_EQ(all.size(), std::size_t(kCount));
    EXPECT_EQ(all.count(0), 0u); // black is none
    const auto part = [&](std::size_t i, int shift) { return int(ids[i].color >> shift & 255u); };
    for (std::size_t i = 0; i < 63; ++i) // labels below 64 have two bits a channel
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GE(std::max({std::abs(part(i, 16) - part(j, 16)), std::abs(part(i, 8) - part(j, 8)),
                                std::abs(part(i, 0) - part(j, 0))}),
                      64);
}

TEST(BakeMaterials, blackIsAColourThatFillsAroundItsChart)
{
    // The left chart shows black, the right one white; between them is a gap.
    Scene high = halves(0.5f);
    high.materials[0].baseColor = {0, 0, 0, 1};
    Mesh left = rectangle({0, 0, 0.01f}, {0.5f, 0, 0}, {0, 1, 0}),
         right = rectangle({0.5f, 0, 0.01f}, {0.5f, 0, 0}, {0, 1, 0});
    for (glm::vec2& uv : left.texcoords[0])
        uv.x *= 0.25f;
    for (glm::vec2& uv : right.texcoords[0])
        uv.x = 0.75f + 0.25f * uv.x;
    const BakedMap map = bakeOne(high, BakeKind::baseColor, PixelType::unorm8, {}, sceneOfMeshes({left, right}));
    for (int x = 0; x < kSide; ++x)
        EXPECT_EQ(colourOf(map, x, kSide / 2)[0], x < kSide / 2 ? 0 : 255) << x;
}

TEST(BakeMaterials, aKindThatTheHighModelLacksIsNamed)
{
    const Scene plain = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    const struct {
        BakeKind kind;
        const char* message;
    } lacking[] = {
        {BakeKind::baseColor,
         "scene: expected a base colour map, a colour or vertex colours for a map of kind "
         "base-color; found none"},
        {BakeKind::roughness,
         "scene: expected a map or numbers of roughness and metallic for a map of kind roughness; "
         "found none"},
        {BakeKind::roughnessMetallic,
         "scene: expected a map or numbers of roughness and metallic for a map of kind "
         "roughness-metallic; found none"},
        {BakeKind::emissive, "scene: expected light that the material emits for a map of kind emissive; found none"},
        {BakeKind::id, "scene: expected vertex colours for a map of kind id; found none"}};
    for (const auto& [kind, message] : lacking) {
        BakeModelOptions options;
        options.kinds = {BakeKind::normal, kind};
        options.bake.idBy = IdBy::vertexColor;
        HighModel model;
        model.scenes.push_back(plain);
        const auto baked = bakeModel(plain, std::move(model), options);
        ASSERT_FALSE(baked);
        EXPECT_EQ(baked.error().kind, ErrorKind::input);
        EXPECT_EQ(baked.error().message, message);
    }
}

TEST(BakeMaterials, packedMapsHaveTheChannelsOfTheMapsAloneAndOnlyAskedMapsAreReturned)
{
    Sheared high;
    high.scene.materials[0].metallicRoughnessMap = high.texture;
    high.scene.meshes.push_back(rectangle({0.5f, 0, 0}, {0, 1, 0}, {0, 0, 1})); // a wall, so that occlusion differs
    high.scene.instances.push_back({"", 1, glm::mat4(1)});
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16, PixelType::float32}) {
        BakeModelOptions options;
        options.kinds = {BakeKind::normal, BakeKind::metallic};
        options.packed = {*parsePackedMap("orm"), *parsePackedMap("mask:b=metallic,A=0.5,G=1")};
        options.bake.width = options.bake.height = kSide;
        options.stored.type = type;
        options.mask = true;
        const auto bake = [&] {
            HighModel model;
            model.scenes.push_back(high.scene);
            return bakeModel(sceneOfMeshes({rectangle({0, 0, 0.01f}, {1, 0, 0}, {0, 1, 0})}), std::move(model),
                             options);
        };
        const auto baked = bake();
        ASSERT_TRUE(baked) << baked.error().message;
        ASSERT_EQ(baked->maps.size(), 4u);
        EXPECT_EQ(baked->maps[3].packed->name, "mask");
        options.kinds = {BakeKind::occlusion, BakeKind::roughness, BakeKind::metallic};
        options.packed = {};
        const auto alone = bake();
        const std::size_t size = bytesPerComponent(type);
        const auto component = [&](const BakedMap& map, std::size_t i) {
            return std::vector(map.image.data.begin() + std::ptrdiff_t(i * size),
                               map.image.data.begin() + std::ptrdiff_t((i + 1) * size));
        };
        for (std::size_t i = 0; i < kSide * kSide; ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_EQ(component(baked->maps[2], 4 * i + c), component(alone->maps[c], 4 * i)) << i << " " << c;
            ASSERT_EQ(component(baked->maps[3], 4 * i + 2), component(alone->maps[2], 4 * i));
        }
        const glm::vec4 mask = storedComponents(baked->maps[3].image, 3, 3);
        EXPECT_EQ(glm::vec2(mask.x, mask.y), glm::vec2(0, 1));
        EXPECT_NEAR(mask.w, 0.5, 0.5 / 255 + 1e-6);
        EXPECT_EQ(storedComponents(baked->maps[2].image, 3, 3).w, 1);
        options.kinds = {};
        options.packed = {*parsePackedMap("R=ao")};
        const auto only = bake();
        ASSERT_EQ(only->maps.size(), 1u);
        EXPECT_FALSE(only->maps[0].mask.data.empty());
    }
}

TEST(BakeMaterials, wordsOfPackedMapsAreCheckedOneByOne)
{
    for (const auto& [text, message] : {
             std::pair("", "expected orm, or channels such as R=ao,G=roughness,B=metallic,A=1; found ''"),
             {"R", "expected orm, or channels"},
             {"R=", "expected orm, or channels"},
             {"R=ao,", "expected orm, or channels"},
             {"X=ao", "expected orm, or channels"},
             {"RG=ao", "expected orm, or channels"},
             {"R=ao,r=metallic", "expected each channel once; found r twice"},
             {"R=normal",
              "R: expected a map of one value per texel (height, ao, thickness, curvature, roughness, "
              "metallic) or a number from 0 to 1; found 'normal'"},
             {"R=gloss", "found 'gloss'"},
             {"R=1.5", "found '1.5'"},
             {"R=nan", "found 'nan'"},
             {"R=-1", "found '-1'"},
             {"a/b:R=ao", "expected a name of letters, digits, - and _; found 'a/b'"},
             {":R=ao", "expected a name before ':'"},
             {"R=1,A=0", "expected a map in one of the channels; found constants only"},
         }) {
        const auto map = parsePackedMap(text);
        ASSERT_FALSE(map) << text;
        EXPECT_EQ(map.error().kind, ErrorKind::usage);
        EXPECT_NE(map.error().message.find(message), std::string::npos) << map.error().message;
    }
}

TEST(BakeMaterials, anImageWithoutPixelsIsRefused)
{
    Scene high = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    high.images.resize(1);
    high.images[0].name = "wood.png";
    high.materials[0].baseColorMap.image = 0;
    HighModel model;
    model.scenes.push_back(high);
    BakeModelOptions options;
    options.kinds = {BakeKind::baseColor};
    const auto baked = bakeModel(high, std::move(model), options);
    ASSERT_FALSE(baked);
    EXPECT_EQ(baked.error().message, "wood.png: expected an image with pixels; the model was read without them");
}

TEST(BakeMaterials, aTextureThatIsAlsoANormalMapServesBoth)
{
    Sheared high;
    high.scene.materials[0].baseColorMap = high.texture;
    high.scene.materials[0].normalMap = high.texture;
    BakeModelOptions options;
    options.kinds = {BakeKind::normal, BakeKind::baseColor};
    options.ownMaps = true;
    options.bake.samples = 1; // a texel has the value at its centre
    options.bake.width = options.bake.height = kSide;
    options.stored.type = PixelType::float32;
    HighModel model;
    model.scenes.push_back(high.scene);
    const auto baked =
        bakeModel(sceneOfMeshes({rectangle({0, 0, 0.01f}, {1, 0, 0}, {0, 1, 0})}), std::move(model), options);
    ASSERT_TRUE(baked) << baked.error().message;
    EXPECT_NEAR(double(baked->maps[1].image.floats()[4 * 40]), high.at(pointOf(40 % kSide, 40 / kSide), true).x, 5e-5);
}

} // namespace
} // namespace cotan
