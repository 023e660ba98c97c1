// The lights of an image and the maps on its model, as options set them: each option on its own.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <unistd.h>

#include "cotan/image.hpp"
#include "cotan/picture.hpp"
#include "cotan/scene.hpp"

namespace cotan {
namespace {

PictureOptions optionsWith(void (*set)(PictureOptions&))
{
    PictureOptions o;
    set(o);
    return o;
}

using Options = PictureOptions;

TEST(PictureLight, lampsFollowRotationAndIntensityOfTheEnvironment)
{
    const auto lampsOf = [](void (*set)(Options&)) { return lightsOf(optionsWith(set), Scene()); };
    const Light studio = lampsOf([](Options&) {}).at(0);
    EXPECT_NEAR(glm::length(studio.direction), 1, 1e-6);
    EXPECT_LT(studio.direction.y, 0); // from above, front and left
    EXPECT_LT(studio.direction.z, 0);
    EXPECT_GT(studio.direction.x, 0);
    const Light evening = lampsOf([](Options& o) { o.environment = "evening"; }).at(0);
    EXPECT_GT(evening.color.x, 2 * evening.color.z); // a low, reddish sun
    EXPECT_LT(std::abs(evening.direction.y), std::abs(studio.direction.y));
    EXPECT_LT(evening.direction.y, -0.1f); // still above the horizon
    for (const double degrees : {90.0, -30.0, 180.0}) {
        Options o;
        o.environmentRotation = degrees;
        o.environmentIntensity = 2;
        const Light turned = lightsOf(o, Scene()).at(0);
        const double c = std::cos(degrees * 0.017453292519943295), s = std::sin(degrees * 0.017453292519943295);
        const glm::vec3 d = studio.direction; // rotated about the vertical, to the right as seen from above
        EXPECT_NEAR(turned.direction.x, c * d.x + s * d.z, 1e-5) << degrees;
        EXPECT_NEAR(turned.direction.y, d.y, 1e-6) << degrees;
        EXPECT_NEAR(turned.direction.z, c * d.z - s * d.x, 1e-5) << degrees;
        EXPECT_NEAR(turned.intensity, 2 * studio.intensity, 1e-6);
        EXPECT_EQ(turned.color, studio.color);
    }
    EXPECT_TRUE(lampsOf([](Options& o) { o.environment = "overcast"; }).empty());
    EXPECT_TRUE(lampsOf([](Options& o) { o.environment = "sky.hdr"; }).empty());
    EXPECT_FALSE(lampsOf([](Options& o) { o.environment = "none"; }).empty());
    Scene lit;
    lit.lights.resize(2);
    lit.lights[1].intensity = 7;
    ASSERT_EQ(lightsOf(Options(), lit).size(), 2u);
    EXPECT_EQ(lightsOf(Options(), lit)[1].intensity, 7);
}

TEST(PictureLight, eachOptionSetsItsOwnFieldOfTheView)
{
    const auto viewWith = [](void (*set)(Options&)) {
        View view;
        const Status done = lightPicture(optionsWith(set), view);
        EXPECT_TRUE(done);
        return view;
    };
    const auto tangent = [](double degrees) { return std::tan(degrees / 2 * 0.017453292519943295); };
    const View usual = viewWith([](Options&) {});
    EXPECT_NEAR(usual.shadowSoftness, tangent(10), 1e-6);
    EXPECT_TRUE(usual.shadows && usual.background);
    EXPECT_EQ(usual.backdrop, Backdrop::paper);
    EXPECT_EQ(usual.toneMapping, ToneMapping::neutral);
    EXPECT_EQ(usual.exposure, 1);
    EXPECT_NEAR(viewWith([](Options& o) { o.environment = "evening"; }).shadowSoftness, tangent(3), 1e-6);
    EXPECT_NEAR(viewWith([](Options& o) { o.shadowSoftness = 20; }).shadowSoftness, tangent(20), 1e-6);
    EXPECT_EQ(viewWith([](Options& o) { o.shadowSoftness = 0; }).shadowSoftness, 0);
    EXPECT_FALSE(viewWith([](Options& o) { o.noShadows = true; }).shadows);
    EXPECT_EQ(viewWith([](Options& o) { o.exposure = 0.25f; }).exposure, 0.25f);
    EXPECT_EQ(viewWith([](Options& o) { o.environment = "overcast"; }).backdrop, Backdrop::blurred);
    EXPECT_EQ(viewWith([](Options& o) { o.environment = "none"; }).backdrop, Backdrop::gradient);
    EXPECT_FALSE(viewWith([](Options& o) { o.background = Background::none; }).background);
    EXPECT_EQ(viewWith([](Options& o) { o.background = Background::sharp; }).backdrop, Backdrop::sharp);
    EXPECT_EQ(viewWith([](Options& o) { o.background = Background::blurred; }).backdrop, Backdrop::blurred);
    EXPECT_EQ(viewWith([](Options& o) { o.background = Background::gradient; }).backdrop, Backdrop::gradient);
    EXPECT_EQ(viewWith([](Options& o) { o.toneMapping = ToneMapping::none; }).toneMapping, ToneMapping::none);
    EXPECT_EQ(viewWith([](Options& o) { o.toneMapping = ToneMapping::aces; }).toneMapping, ToneMapping::aces);
    EXPECT_EQ(viewWith([](Options& o) { o.toneMapping = ToneMapping::agx; }).toneMapping, ToneMapping::agx);
}

TEST(PictureLight, environmentOptionsWithoutEnvironmentAreRefused)
{
    struct Row {
        void (*set)(Options&);
        const char* said;
    };
    for (const Row& row :
         {Row{[](Options& o) { o.background = Background::blurred; }, "--background blur: expected an --environment"},
          {[](Options& o) { o.background = Background::sharp; }, "--background environment: expected"},
          {[](Options& o) { o.environmentRotation = 1; }, "--environment-rotation: expected"},
          {[](Options& o) { o.environmentIntensity = 2; }, "--environment-intensity: expected"}}) {
        Options o = optionsWith(row.set);
        View view;
        EXPECT_TRUE(lightPicture(o, view));
        o.environment = "none";
        const Status done = lightPicture(o, view);
        ASSERT_FALSE(done) << row.said;
        EXPECT_EQ(done.error().kind, ErrorKind::usage);
        EXPECT_EQ(done.error().message.find(row.said), 0u) << done.error().message;
    }
    Options unknown;
    unknown.environment = "noon";
    const auto opened = openEnvironmentMap(unknown);
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().message.find("none, or a .hdr or .exr file; found 'noon'"), std::string::npos);
    unknown.use = PictureUse::data; // unlit images open no environment map
    EXPECT_TRUE(openEnvironmentMap(unknown));
}

// ---- maps --------------------------------------------------------------------------------------------

// A temporary folder, removed with its contents.
struct MapFolder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("cotan_picture_maps_" + std::to_string(::getpid()));
    MapFolder() { std::filesystem::create_directories(path); }
    ~MapFolder() { std::filesystem::remove_all(path); }
    std::filesystem::path operator/(const char* name) const { return path / name; }
};

// Two squares, each with a material, all of whose factors differ.
Scene twoMaterials()
{
    Scene scene;
    scene.name = "two.obj";
    for (int i = 0; i < 2; ++i) {
        Material m;
        m.baseColor = {0.1f, 0.2f, 0.3f, 0.4f};
        m.metallic = 0.5f;
        m.roughness = 0.6f;
        m.occlusionStrength = 0.7f;
        scene.materials.push_back(m);
        scene.meshes.push_back(makePatch(1, 0, false, 1));
        scene.meshes.back().material = i;
        scene.instances.push_back({"", i, glm::mat4(1)});
    }
    return scene;
}

TEST(PictureMaps, eachMapSetsItsSlotAndAFactorOfOne)
{
    const MapFolder folder;
    Image image = makeImage(2, 1, PixelType::unorm8);
    for (std::size_t i = 0; i < 8; ++i)
        image.bytes8()[i] = std::uint8_t(i % 4 == 3 ? 255 : 128 + 10 * i);
    ASSERT_TRUE(writeImage(folder / "a.png", image));
    const std::string file = (folder / "a.png").string();
    struct Row {
        std::string OwnMaps::*field;
        Texture Material::*slot;
    };
    for (const Row& row : {Row{&OwnMaps::normal, &Material::normalMap},
                           {&OwnMaps::baseColor, &Material::baseColorMap},
                           {&OwnMaps::metallicRoughness, &Material::metallicRoughnessMap},
                           {&OwnMaps::occlusion, &Material::occlusionMap}})
        for (const int material : {-1, 0, 1}) {
            Scene scene = twoMaterials();
            OwnMaps maps;
            maps.*row.field = file;
            maps.material = material;
            ASSERT_TRUE(applyOwnMaps(maps, limitsFor(640), scene));
            for (int i = 0; i < 2; ++i) {
                const Material& m = scene.materials[std::size_t(i)];
                const bool here = material < 0 || material == i;
                for (const auto slot : {&Material::normalMap, &Material::baseColorMap, &Material::metallicRoughnessMap,
                                        &Material::occlusionMap, &Material::emissiveMap})
                    EXPECT_EQ((m.*slot).present(), here && slot == row.slot) << material << i;
                const bool color = here && row.slot == &Material::baseColorMap,
                           rough = here && row.slot == &Material::metallicRoughnessMap,
                           occluded = here && row.slot == &Material::occlusionMap;
                EXPECT_EQ(m.baseColor, color ? glm::vec4(1) : glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
                EXPECT_EQ(m.metallic, rough ? 1.0f : 0.5f);
                EXPECT_EQ(m.roughness, rough ? 1.0f : 0.6f);
                EXPECT_EQ(m.occlusionStrength, occluded ? 1.0f : 0.7f);
            }
        }
}

TEST(PictureMaps, incompatibleOptionsNameTheBrokenRule)
{
    const MapFolder folder;
    Image image = makeImage(1, 1, PixelType::unorm8);
    for (std::size_t i = 0; i < 4; ++i)
        image.bytes8()[i] = 200;
    ASSERT_TRUE(writeImage(folder / "a.png", image));
    const std::string file = (folder / "a.png").string();
    struct Row {
        OwnMaps maps;
        ErrorKind kind;
        const char* said;
    };
    OwnMaps material, high, convention, object, words, missing;
    material.material = 0;
    high.baseColor = file, high.material = 2;
    convention.convention = "directx";
    object.normal = file, object.convention = "gltf,object";
    words.normal = file, words.convention = "rgb";
    missing.occlusion = (folder / "gone.png").string();
    for (const Row& row :
         {Row{material, ErrorKind::usage, "--material: expected --normal-map FILE or another map with it; found none"},
          {high, ErrorKind::usage, "--material: expected 0 to 1; found 2"},
          {convention, ErrorKind::usage,
           "--convention: expected --normal-map FILE with it, or a model with normal maps"},
          {object, ErrorKind::usage, "--convention: expected a tangent-space map; found 'gltf,object'"},
          {words, ErrorKind::usage, "--convention: "},
          {missing, ErrorKind::input, "gone.png"}}) {
        Scene scene = twoMaterials();
        const Status done = applyOwnMaps(row.maps, limitsFor(640), scene);
        ASSERT_FALSE(done) << row.said;
        EXPECT_EQ(done.error().kind, row.kind) << row.said;
        EXPECT_NE(done.error().message.find(row.said), std::string::npos) << done.error().message;
    }
    Scene plain = twoMaterials();
    EXPECT_TRUE(applyOwnMaps({}, limitsFor(640), plain));
    high.material = 1;
    EXPECT_TRUE(applyOwnMaps(high, limitsFor(640), plain));
    plain.meshes[0].texcoords[0].clear(); // the other mesh can show it
    OwnMaps all;
    all.baseColor = file;
    EXPECT_TRUE(applyOwnMaps(all, limitsFor(640), plain));
    all.material = 0;
    const Status bare = applyOwnMaps(all, limitsFor(640), plain);
    ASSERT_FALSE(bare);
    EXPECT_EQ(bare.error().message,
              "two.obj: expected a mesh with texture coordinates to show " + file + " on; found none");
}

// A convention alone sets how the model's own maps are read, for one material or all.
TEST(PictureMaps, conventionAloneAppliesToTheMapsOfTheModel)
{
    for (const int material : {-1, 0, 1}) {
        Scene scene = twoMaterials();
        scene.images.push_back(makeImage(1, 1, PixelType::unorm8));
        for (Material& m : scene.materials)
            m.normalMap.image = 0;
        OwnMaps maps;
        maps.convention = "directx";
        maps.material = material;
        ASSERT_TRUE(applyOwnMaps(maps, limitsFor(640), scene));
        for (int i = 0; i < 2; ++i)
            EXPECT_EQ(scene.materials[std::size_t(i)].normalFormat.greenUp, material >= 0 && material != i) << material;
    }
}

} // namespace
} // namespace cotan
