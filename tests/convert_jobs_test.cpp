// Which primitives read which image, and how: each field of a job, in a document without two equal primitives. Also
// into which slots a converted map is written back, with which notes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <glm/gtc/matrix_transform.hpp>

#include "bake/convert/map_jobs.hpp"
#include "cotan/convert.hpp"
#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "gltf/json/lookup.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

std::vector<std::byte> pngOf(int side)
{
    Image image = makeImage(side, side, PixelType::unorm8, "made");
    std::fill(image.data.begin(), image.data.end(), std::byte(200));
    auto png = encodePng(image);
    EXPECT_TRUE(png);
    return png ? *std::move(png) : std::vector<std::byte>{};
}

// Two images and two meshes. The first material reads image 0 as its normal map and image 1 as its coat's; the second
// reads image 1 as its normal map. The first mesh has two instances, one of them stretched.
GltfDocument document()
{
    Scene scene;
    scene.images = {makeReliefMap(Relief::waves, 8), makeReliefMap(Relief::domes, 4)};
    scene.images[0].name = "waves", scene.images[1].name = "domes";
    scene.meshes = {makePlane(2, 2, 1), makePlane(1, 1, 1)};
    scene.meshes[1].tangents.assign(scene.meshes[1].vertexCount(), {1, 0, 0, 1});
    scene.meshes[1].material = 1;
    scene.materials.resize(2);
    scene.materials[0].name = "first", scene.materials[1].name = "second";
    scene.materials[0].normalMap.image = 0;
    scene.materials[0].normalMap.sampler = {Wrap::clamp, Wrap::mirror, Filter::linear, Filter::linear,
                                            MipFilter::linear};
    scene.materials[0].normalScale = 0.5f;
    scene.materials[1].normalMap.image = 1;
    scene.materials[1].normalMap.sampler.wrapU = Wrap::mirror;
    scene.materials[1].normalScale = 2;
    scene.instances = {{"one", 0, glm::mat4(1)},
                       {"stretched", 0, glm::scale(glm::mat4(1), {3, 1, 1})},
                       {"turned", 0, glm::rotate(glm::mat4(1), 1.0f, glm::vec3(0, 1, 0))},
                       {"other", 1, glm::mat4(1)}};
    auto made = gltfDocumentOf(scene);
    EXPECT_TRUE(made);
    GltfDocument d = *std::move(made);
    const std::size_t second = rootOf(d)["materials"][1]["normalTexture"]["index"];
    rootOf(d)["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {
        {"clearcoatFactor", 0.5}, {"clearcoatNormalTexture", {{"index", second}, {"scale", 0.25}}}};
    return d;
}

TEST(MapJobs, knowTheStrengthWrapTransformsAndTangentsOfEachReader)
{
    std::vector<std::string> notes;
    const auto jobs = mapJobs(document(), notes);
    ASSERT_TRUE(jobs) << jobs.error().message;
    EXPECT_TRUE(notes.empty());
    ASSERT_EQ(jobs->size(), 2u);
    const MapJob &a = (*jobs)[0], &b = (*jobs)[1];
    EXPECT_EQ(a.image, 0u);
    EXPECT_EQ(b.image, 1u);
    EXPECT_EQ(a.name, "waves");
    EXPECT_EQ(b.name, "domes");
    EXPECT_FALSE(a.alsoElsewhere);
    EXPECT_FALSE(b.alsoElsewhere);
    EXPECT_EQ(a.slots, (std::vector<MapSlot>{{0, NormalSlot::surface}}));
    EXPECT_EQ(b.slots, (std::vector<MapSlot>{{0, NormalSlot::coat}, {1, NormalSlot::surface}}));
    ASSERT_EQ(a.readers.size(), 1u);
    ASSERT_EQ(b.readers.size(), 2u);
    const MapReader &r = a.readers[0], &coat = b.readers[0], &own = b.readers[1];
    EXPECT_EQ(r.mesh, 0u);
    EXPECT_EQ(own.mesh, 1u);
    EXPECT_EQ(r.slot, (MapSlot{0, NormalSlot::surface}));
    EXPECT_EQ(coat.slot, (MapSlot{0, NormalSlot::coat}));
    EXPECT_EQ(r.strength, 0.5);
    EXPECT_EQ(coat.strength, 0.25);
    EXPECT_EQ(own.strength, 2);
    EXPECT_TRUE(r.wrapU == Wrap::clamp);
    EXPECT_TRUE(r.wrapV == Wrap::mirror);
    EXPECT_TRUE(own.wrapU == Wrap::mirror);
    EXPECT_TRUE(own.wrapV == Wrap::repeat);
    EXPECT_EQ(r.triangles, 8u); // a plane of 2 x 2 squares
    EXPECT_EQ(r.vertices, 9u);
    EXPECT_EQ(own.triangles, 2u);
    EXPECT_EQ(own.vertices, 4u);
    EXPECT_FALSE(r.stored);
    EXPECT_TRUE(own.stored);
    EXPECT_EQ(r.transforms.size(), 2u); // a rotation makes no other surface
    EXPECT_EQ(coat.transforms.size(), 2u);
    EXPECT_EQ(own.transforms.size(), 1u);
    EXPECT_EQ(surfacesOf(a), 2u);
    EXPECT_EQ(surfacesOf(b), 3u);
}

TEST(MapJobs, usesMatchTheirReaders)
{
    const GltfDocument d = document();
    std::vector<std::string> notes;
    const auto jobs = mapJobs(d, notes);
    ASSERT_TRUE(jobs);
    const auto uses = usesOf(d, (*jobs)[1], {Frame::mikktspace, Frame::cotangent});
    ASSERT_TRUE(uses);
    ASSERT_EQ(uses->size(), 3u);
    EXPECT_EQ((*uses)[0].strength, 0.25);
    EXPECT_EQ((*uses)[2].strength, 2);
    EXPECT_TRUE((*uses)[2].wrapU == Wrap::mirror);
    EXPECT_TRUE((*uses)[2].wrapV == Wrap::repeat);
}

TEST(MapJobs, aCoatWithoutFactorHasStrengthZero)
{
    GltfDocument d = document();
    rootOf(d)["materials"][0]["extensions"]["KHR_materials_clearcoat"].erase("clearcoatFactor");
    std::vector<std::string> notes;
    const auto jobs = mapJobs(d, notes);
    ASSERT_TRUE(jobs);
    EXPECT_EQ((*jobs)[1].readers[0].strength, 0);
}

TEST(MapJobs, anImageThatAnotherSlotReadsIsCopiedForTheNewMap)
{
    GltfDocument d = document();
    const std::size_t old = rootOf(d)["materials"][0]["normalTexture"]["index"];
    rootOf(d)["materials"][1]["occlusionTexture"] = {{"index", old}};
    std::vector<std::string> notes;
    const auto jobs = mapJobs(d, notes);
    ASSERT_TRUE(jobs);
    EXPECT_TRUE((*jobs)[0].alsoElsewhere);
    EXPECT_FALSE((*jobs)[1].alsoElsewhere);
    const auto before = gltfImageBytes(d, 0);
    replaceMap(d, (*jobs)[0], pngOf(3), "image/png", notes);
    EXPECT_EQ(rootOf(d)["materials"][1]["occlusionTexture"]["index"], old);
    const std::size_t made = rootOf(d)["materials"][0]["normalTexture"]["index"];
    EXPECT_NE(made, old);
    ASSERT_EQ(rootOf(d)["images"].size(), 3u);
    EXPECT_EQ(rootOf(d)["textures"][made]["source"], 2);
    EXPECT_EQ(rootOf(d)["textures"][made]["sampler"], rootOf(d)["textures"][old]["sampler"]);
    EXPECT_EQ(*gltfImageBytes(d, 0), *before);
    EXPECT_EQ(*gltfImageBytes(d, 2), pngOf(3));
    const auto second = gltfImageBytes(d, 1);
    replaceMap(d, (*jobs)[1], pngOf(5), "image/png", notes); // no other slot reads it: replaced in place
    EXPECT_EQ(rootOf(d)["images"].size(), 3u);
    EXPECT_EQ(*gltfImageBytes(d, 1), pngOf(5));
    EXPECT_NE(*gltfImageBytes(d, 1), *second);
}

TEST(MapJobs, aMapInWebpRequiresItsExtensionOnce)
{
    GltfDocument d = document();
    std::vector<std::string> notes;
    const auto jobs = mapJobs(d, notes);
    ASSERT_TRUE(jobs);
    for (const MapJob& job : *jobs)
        replaceMap(d, job, pngOf(3), "image/webp", notes);
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        EXPECT_EQ(std::ranges::count(rootOf(d)[list], "EXT_texture_webp"), 1) << list;
    for (const std::size_t m : {0u, 1u}) {
        const auto& texture =
            rootOf(d)["textures"][rootOf(d)["materials"][m]["normalTexture"]["index"].get<std::size_t>()];
        EXPECT_FALSE(texture.contains("source"));
        EXPECT_EQ(texture["extensions"]["EXT_texture_webp"]["source"], m);
    }
}

TEST(MapJobs, primitivesWithoutUvOrTrianglesAreOmittedWithANote)
{
    GltfDocument d = document();
    rootOf(d)["meshes"][1]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    rootOf(d)["meshes"][0]["primitives"][0]["mode"] = 1; // lines
    std::vector<std::string> notes;
    const auto jobs = mapJobs(d, notes);
    ASSERT_TRUE(jobs) << jobs.error().message;
    EXPECT_TRUE(jobs->empty());
    ASSERT_EQ(notes.size(), 3u);
    EXPECT_NE(notes[0].find("meshes[0].primitives[0]: no triangles; its normal map"), std::string::npos) << notes[0];
    EXPECT_NE(notes[1].find("no triangles; its coat's normal map"), std::string::npos) << notes[1];
    EXPECT_NE(notes[2].find("meshes[1].primitives[0]: no uv for its normal map"), std::string::npos) << notes[2];
}

TEST(PutMap, goesOnlyToTheNamedMaterialAndResetsItsScale)
{
    GltfDocument d = document();
    std::vector<std::string> notes;
    PutMapOptions options;
    options.frame = Frame::cotangent;
    options.material = "second";
    ASSERT_TRUE(putNormalMap(d, pngOf(3), options, notes));
    const auto& first = rootOf(d)["materials"][0]["normalTexture"];
    const auto& second = rootOf(d)["materials"][1]["normalTexture"];
    EXPECT_EQ(first["scale"], 0.5);
    EXPECT_FALSE(second.contains("scale"));
    const std::size_t texture = second["index"];
    EXPECT_EQ(*gltfImageBytes(d, rootOf(d)["textures"][texture]["source"].get<std::size_t>()), pngOf(3));
    EXPECT_FALSE(rootOf(d)["meshes"][1]["primitives"][0]["attributes"].contains("TANGENT"));
    ASSERT_FALSE(notes.empty());
    EXPECT_NE(notes.back().find("cotangent"), std::string::npos);
    options.material = "third";
    const Status none = putNormalMap(d, pngOf(3), options, notes);
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("'third' to put the map in; found 0"), std::string::npos);
    rootOf(d)["materials"][0]["name"] = "second";
    options.material = "second";
    const Status two = putNormalMap(d, pngOf(3), options, notes);
    ASSERT_FALSE(two);
    EXPECT_NE(two.error().message.find("found 2"), std::string::npos);
}

TEST(PutMap, withoutANameAllPrimitivesGetIt)
{
    GltfDocument d = document();
    rootOf(d)["meshes"][1]["primitives"][0].erase("material");
    std::vector<std::string> notes;
    PutMapOptions options;
    options.frame = Frame::mikktspace;
    ASSERT_TRUE(putNormalMap(d, pngOf(3), options, notes));
    ASSERT_EQ(rootOf(d)["materials"].size(), 3u);
    EXPECT_EQ(rootOf(d)["meshes"][1]["primitives"][0]["material"], 2);
    EXPECT_EQ(rootOf(d)["materials"][0]["normalTexture"]["index"], rootOf(d)["materials"][2]["normalTexture"]["index"]);
    EXPECT_NE(rootOf(d)["materials"][0]["normalTexture"]["index"], rootOf(d)["materials"][1]["normalTexture"]["index"]);
    for (const std::size_t m : {0u, 1u})
        EXPECT_TRUE(rootOf(d)["meshes"][m]["primitives"][0]["attributes"].contains("TANGENT")) << m;
    EXPECT_TRUE(notes.empty()); // all readers know MikkTSpace
}

TEST(PutMap, mapsOfSurfacesGoToTheirTexturesThroughTheUvOfTheNormalMapAndAtFullStrength)
{
    test::TemporaryFolder folder;
    GltfDocument d = document();
    auto& materials = rootOf(d)["materials"];
    const gltf::Json transform = {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}};
    materials[0]["normalTexture"]["texCoord"] = 1;
    materials[0]["normalTexture"]["extensions"] = transform;
    materials[0]["pbrMetallicRoughness"] = {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                            {"metallicFactor", 0},
                                            {"roughnessFactor", 0.5},
                                            {"baseColorTexture", {{"index", 0}, {"texCoord", 0}}}};
    materials[0]["occlusionTexture"] = {{"index", 0}, {"strength", 0.25}};
    materials[0]["emissiveFactor"] = {0, 0, 0};
    materials[0]["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 9}};
    const gltf::Json other = materials[1], normal = materials[0]["normalTexture"];
    rootOf(d)["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        rootOf(d)["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    const auto filled = [](std::array<std::uint8_t, 4> texel) {
        Image image = makeImage(4, 4, PixelType::unorm8);
        for (std::size_t i = 0; i < image.data.size(); ++i)
            image.data[i] = std::byte(texel[i % 4]);
        return image;
    };
    const Image color = filled({1, 2, 3, 255}), light = filled({4, 5, 6, 255}), open = filled({7, 7, 7, 255}),
                surface = filled({255, 8, 9, 255});
    PutMapOptions options;
    options.material = "first";
    const auto written = writeModelWithMaps(
        d, {.occlusion = &open, .roughnessMetallic = &surface, .baseColor = &color, .emissive = &light}, options,
        folder / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(written->notes,
              std::vector<std::string>{"the low mesh has vertex colours, which multiply the baked base colour"});
    const auto& first = rootOf(d)["materials"][0];
    const auto& pbr = first["pbrMetallicRoughness"];
    const auto texelOf = [&](const gltf::Json& slot) {
        EXPECT_EQ(slot["texCoord"], 1);
        EXPECT_EQ(slot["extensions"], transform);
        const auto source = rootOf(d)["textures"][slot["index"].get<std::size_t>()]["source"].get<std::size_t>();
        const auto image = decodeImage(*gltfImageBytes(d, source), "x");
        EXPECT_TRUE(image);
        const std::uint8_t* c = image->bytes8();
        return std::array<int, 3>{c[0], c[1], c[2]};
    };
    EXPECT_EQ(texelOf(pbr["baseColorTexture"]), (std::array{1, 2, 3}));
    EXPECT_EQ(texelOf(first["emissiveTexture"]), (std::array{4, 5, 6}));
    EXPECT_EQ(texelOf(first["occlusionTexture"]), (std::array{7, 8, 9}));
    EXPECT_EQ(first["occlusionTexture"], pbr["metallicRoughnessTexture"]); // one image, strength 1
    EXPECT_EQ(pbr["baseColorFactor"], gltf::Json({1, 1, 1, 0.4}));
    EXPECT_FALSE(pbr.contains("metallicFactor") || pbr.contains("roughnessFactor"));
    EXPECT_EQ(first["emissiveFactor"], gltf::Json({1, 1, 1}));
    EXPECT_FALSE(first["extensions"].contains("KHR_materials_emissive_strength"));
    EXPECT_EQ(first["normalTexture"], normal);
    EXPECT_EQ(rootOf(d)["materials"][1], other);
}

} // namespace
} // namespace cotan
