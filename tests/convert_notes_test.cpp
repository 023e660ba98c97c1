// What a conversion reports: each note, warning and refusal as a whole, with its numbers, and on which side of its
// bound it appears.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "bake/convert/map_jobs.hpp"
#include "cotan/convention.hpp"
#include "cotan/convert.hpp"
#include "cotan/image.hpp"
#include "gltf/json/lookup.hpp"
#include "ktx2_maker.hpp"

namespace cotan {
namespace {

using Lines = std::vector<std::string>;

// A 16-bit map with the same direction in all texels.
Image slopeMap(glm::dvec3 m, int width = 8, int height = 8)
{
    Image image = makeImage(width, height, PixelType::unorm16, "slope");
    const glm::dvec3 stored =
        f64::cotan_encode_texel(glm::normalize(m), toFormat<f64::cotan_normal_format>(Convention(), 1, 16));
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
        image.words()[i] = i % 4 == 3 ? std::uint16_t(65535) : std::uint16_t(std::lround(65535 * stored[int(i % 4)]));
    return image;
}

// A rectangle in xy of width `width` and height 1, facing +z; uv from `low` to `high`, v down.
Mesh wide(float width, glm::vec2 low = {0, 0}, glm::vec2 high = {1, 1})
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {width, 0, 0}, {width, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.texcoords[0] = {{low.x, high.y}, high, {high.x, low.y}, low};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// A document in which each mesh has its own material and all materials read the same map.
GltfDocument sheets(std::vector<Mesh> meshes, const Image& map)
{
    Scene scene;
    scene.images = {map};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        scene.materials.emplace_back();
        scene.materials[i].normalMap.image = 0;
        meshes[i].material = int(i);
        scene.instances.push_back({"", int(i), glm::mat4(1)});
    }
    scene.meshes = std::move(meshes);
    auto made = gltfDocumentOf(scene);
    EXPECT_TRUE(made);
    return *std::move(made);
}

ConvertModelOptions towards(Frame to)
{
    ConvertModelOptions options;
    options.frames.to = to;
    options.expansion = Expansion::exact;
    return options;
}

Lines notesOf(GltfDocument document, const ConvertModelOptions& options)
{
    const auto report = convertModel(document, options);
    return report ? report->notes : Lines{report.error().message};
}

std::string refusalOf(GltfDocument document, const ConvertModelOptions& options)
{
    const auto report = convertModel(document, options);
    return report ? "converted" : report.error().message;
}

const std::string kNowFor = "the maps are now for the frame cotangent; readers that generate MikkTSpace tangents where "
                            "TANGENT is missing, as glTF specifies, will shade them incorrectly";

TEST(ConvertNotes, areOnlyWhatReadersMustKnow)
{
    const Image map = slopeMap({0.3, 0.2, 1});
    EXPECT_EQ(notesOf(sheets({wide(2)}, map), towards(Frame::cotangent)), Lines{kNowFor});
    ConvertModelOptions back = towards(Frame::mikktspace); // glTF's default: no note
    back.frames.from = Frame::cotangent;
    EXPECT_EQ(notesOf(sheets({wide(2)}, map), back), Lines{});
    EXPECT_EQ(notesOf(sheets({wide(1)}, map), towards(Frame::cotangent)), Lines{}); // fits unconverted: kept
    ConvertModelOptions keeping = towards(Frame::cotangent);
    keeping.keepTangents = true;
    EXPECT_EQ(notesOf(sheets({wide(2)}, map), keeping),
              (Lines{"TANGENT is kept; a reader that uses it will shade the converted maps incorrectly", kNowFor}));
    GltfDocument bare = sheets({wide(2)}, map);
    rootOf(bare)["materials"][0].erase("normalTexture");
    EXPECT_EQ(notesOf(bare, towards(Frame::cotangent)),
              Lines{"no primitive has a normal map and uv: nothing to convert"});
}

TEST(ConvertNotes, stateTheErrorOfKeptMapsFromHalfADegree)
{
    ConvertModelOptions keeping = towards(Frame::cotangent);
    keeping.keepMaps = true;
    // Read with cotangent, the slope along u is halved on a rectangle twice as wide.
    for (const double slope : {0.016, 0.019, 0.4}) {
        const double degrees = glm::degrees(std::atan(slope) - std::atan(slope / 2)); // 0.46, 0.54, 10.5
        const Lines expected = degrees < 0.5
            ? Lines{}
            : Lines{fmt::format("slope: unchanged and read with cotangent, its error is {:.1f} degrees on average",
                                degrees)};
        EXPECT_EQ(notesOf(sheets({wide(2)}, slopeMap({slope, 0, 1})), keeping), expected) << slope;
    }
}

TEST(ConvertNotes, stateTheFractionAndErrorOfConflictingTexels)
{
    // The second rectangle is four times as wide and reads only the left quarter of the map.
    const Image map = slopeMap({0.4, 0, 1});
    GltfDocument document = sheets({wide(1), wide(1, {0, 0}, {0.25f, 1})}, map);
    const auto report = convertModel(document, towards(Frame::cotangent));
    ASSERT_TRUE(report);
    const ReencodeFigures& figures = report->maps.at(0).figures;
    EXPECT_EQ(figures.covered, 64u);
    EXPECT_EQ(figures.several, 16u);
    EXPECT_EQ(figures.disagreeing, 16u);
    // They need slopes of 0.4 and 4 * 0.4: the best is in between.
    EXPECT_GT(figures.disagreement.mean, 5);
    EXPECT_LT(figures.disagreement.mean, 36);
    EXPECT_EQ(
        report->notes,
        (Lines{fmt::format("slope: on 25 % of it several surface points share a texel but need different values; the "
                           "error is {:.1f} degrees on average at the worst of them. No single map fits; give these "
                           "parts their own texels",
                           figures.disagreement.mean),
               kNowFor}));
    // A surface that changes under one texel: its right part is stretched by four.
    Mesh bent = wide(1, {0, 0}, {0.75f, 1});
    const Mesh right = wide(4, {0.75f, 0}, {1, 1});
    for (std::size_t v = 0; v < 4; ++v) {
        bent.positions.push_back(right.positions[v] + glm::vec3(1, 0, 0));
        bent.normals.push_back(right.normals[v]);
        bent.texcoords[0].push_back(right.texcoords[0][v]);
    }
    for (const std::uint32_t i : right.indices)
        bent.indices.push_back(4 + i);
    GltfDocument coarse = sheets({bent}, slopeMap({0.4, 0, 1}, 1, 1));
    const auto coarseReport = convertModel(coarse, towards(Frame::cotangent));
    ASSERT_TRUE(coarseReport);
    EXPECT_GT(coarseReport->maps.at(0).figures.error.mean, 5);
    EXPECT_EQ(
        coarseReport->notes,
        (Lines{fmt::format("slope: after conversion the error is still {:.1f} degrees on average: its texels are too "
                           "coarse for the surface",
                           coarseReport->maps[0].figures.error.mean),
               kNowFor}));
}

// ---- refusals -------------------------------------------------------------------------------

TEST(ConvertNotes, sayIfTheTrianglesTakeMoreMemory)
{
    Mesh mesh = makePlane(200, 120, 1);
    mesh.tangents.assign(mesh.vertexCount(), {1, 0, 0, 1});
    const std::size_t v = mesh.vertexCount(), t = mesh.triangleCount();
    const GltfDocument document = sheets({mesh}, slopeMap({0.3, 0.2, 1}));
    Lines notes;
    const auto jobs = mapJobs(document, notes);
    ASSERT_TRUE(jobs);
    // Positions, normals, uv and tangents, a copy of the uv for the map, indices of 4 bytes; for the raster, uv and
    // indices again and 20 bytes a triangle.
    const std::size_t expected = v * (12 + 12 + 8 + 16 + 8) + 12 * t + 20 * t + 8 * v + 12 * t;
    EXPECT_EQ(bytesOf(jobs->at(0), {}), expected);
    FramePair generated; // replaces the file's: 16 bytes a vertex, and temporarily 80 a triangle
    generated.fromTangents = TangentOrigin::generated;
    EXPECT_EQ(bytesOf(jobs->at(0), generated), v * (12 + 12 + 8 + 16 + 8 + 16) + 12 * t + 80 * t);
    ConvertModelOptions options = towards(Frame::cotangent);
    options.progress = [](double) { return false; };
    options.memory = expected;
    EXPECT_EQ(refusalOf(document, options), stoppedError().message); // passes that check
    options.memory = 0;
    EXPECT_EQ(refusalOf(document, options), stoppedError().message);
    options.memory = std::size_t(1) << 20;
    ASSERT_GE(expected, std::size_t(2) << 20);
    EXPECT_EQ(refusalOf(document, options),
              fmt::format("slope: the triangles that use it take {} MiB, the limit is 1 MiB", expected / 1048576));
    options.memory = expected - 1;
    EXPECT_NE(refusalOf(document, options).find("MiB, the limit is"), std::string::npos);
}

TEST(ConvertNotes, sayIfManyTrianglesRepeatTheMap)
{
    // Eleven columns of copies with eleven copies of 512 rows each and one more row per copy: 11 * (11 * 512 + 11) =
    // 62,073 rows under a triangle. 700 triangles: 43 million.
    Mesh mesh = wide(2, {0, 0}, {11, 11});
    const std::vector<std::uint32_t> once = mesh.indices;
    for (int i = 1; i < 350; ++i)
        mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
    EXPECT_EQ(refusalOf(sheets({mesh}, slopeMap({0.4, 0.2, 1}, 1, 512)), towards(Frame::cotangent)),
              "slope: its triangles cover 4.35e+07 rows of its texels in total; expected at most 4e+07: use fewer "
              "triangles that repeat the map, or a smaller map");
}

TEST(ConvertNotes, mapsOver65535TexelsASideAreRefused)
{
    ConvertModelOptions options = towards(Frame::cotangent);
    options.limits.imageSide = 1 << 17; // a caller's; the default is less
    options.bits = 8;
    for (const auto& [width, height] : {std::pair(65536, 1), std::pair(1, 65536)})
        EXPECT_EQ(refusalOf(sheets({wide(2)}, slopeMap({0.4, 0.2, 1}, width, height)), options),
                  fmt::format("slope: expected a map of at most 65535 texels a side; found {} x {}", width, height));
}

TEST(ConvertNotes, nameConflictingFramesWithTheirMaterial)
{
    const Image map = slopeMap({0.3, 0.2, 1});
    GltfDocument document = sheets({wide(1), wide(2), wide(3), wide(4)}, map);
    EXPECT_EQ(*namedFrame(document), std::nullopt);
    rootOf(document)["materials"][0].erase("normalTexture");
    nameFrame(document, 0, Frame::exact); // has no map: ignored
    EXPECT_EQ(*namedFrame(document), std::nullopt);
    nameFrame(document, 1, Frame::smooth);
    nameFrame(document, 3, Frame::smooth);
    EXPECT_EQ(*namedFrame(document), Frame::smooth);
    EXPECT_EQ(refusalOf(document, towards(Frame::cotangent)),
              "its materials say that the normal maps are for the frame smooth; expected that as the frame to convert "
              "from, found mikktspace");
    nameFrame(document, 3, Frame::orthonormal);
    const auto named = namedFrame(document);
    ASSERT_FALSE(named);
    EXPECT_EQ(named.error().message,
              "materials[3].extras.cotanFrame: expected smooth, as in materials[1]; found orthonormal");
    nameFrame(document, 1, Frame::mikktspace); // the default: ignored
    EXPECT_EQ(*namedFrame(document), Frame::orthonormal);

    Image saying = map;
    saying.frame = "smooth";
    const GltfDocument ofImage = sheets({wide(2)}, saying);
    EXPECT_EQ(
        refusalOf(ofImage, towards(Frame::cotangent)),
        "slope: the image says that it is for the frame smooth; expected that as the frame to convert from, found "
        "mikktspace");
    ConvertModelOptions right = towards(Frame::cotangent);
    right.frames.from = Frame::smooth;
    EXPECT_EQ(refusalOf(ofImage, right), "converted");
    GltfDocument both = ofImage; // the material takes precedence
    nameFrame(both, 0, Frame::orthonormal);
    right.frames.from = Frame::orthonormal;
    EXPECT_EQ(refusalOf(both, right), "converted");
}

TEST(ConvertNotes, optionErrorsSayWhatIsExpected)
{
    const GltfDocument document = sheets({wide(2)}, slopeMap({0.3, 0.2, 1}));
    ConvertModelOptions options = towards(Frame::cotangent);
    for (const int bits : {-8, 1, 12, 32}) {
        options.bits = bits;
        EXPECT_EQ(refusalOf(document, options),
                  fmt::format("convert: expected 8 or 16 bits, or 0 for those of the old maps; found {}", bits));
    }
    for (const int bits : {0, 8, 16}) {
        options.bits = bits;
        EXPECT_EQ(refusalOf(document, options), "converted");
    }
    options = towards(Frame::nonperspective);
    EXPECT_EQ(refusalOf(document, options),
              "convert: the frame nonperspective depends on the view: no map can be made for it");
    options = towards(Frame::cotangent);
    options.keepMaps = options.keepTangents = true;
    EXPECT_EQ(refusalOf(document, options),
              "convert: with keepMaps the tangents are dropped; expected a frame that reads none, found keepTangents");
    options.keepTangents = false;
    options.frames.to = Frame::vertex;
    EXPECT_EQ(refusalOf(document, options),
              "convert: with keepMaps the tangents are dropped; expected a frame that reads none, found vertex");
}

// ---- maps that are not read -----------------------------------------------------------------

TEST(ConvertNotes, nameTheFormatOfUnreadableMapsAndTheRemedy)
{
    // Image 0 can be read; 1 is AVIF and named "second"; 2 is an unnamed packed KTX2, used by material 2.
    Scene scene;
    scene.images = {slopeMap({0.3, 0, 1}), slopeMap({0.2, 0, 1}), slopeMap({0.1, 0, 1})};
    for (int i = 0; i < 3; ++i) {
        scene.materials.emplace_back();
        scene.materials.back().normalMap.image = i;
        scene.meshes.push_back(wide(2));
        scene.meshes.back().material = i;
        scene.meshes.back().tangents.assign(4, {1, 0, 0, 1});
        scene.instances.push_back({"", i, glm::mat4(1)});
    }
    scene.images[1].name = "second";
    auto made = gltfDocumentOf(scene);
    ASSERT_TRUE(made);
    GltfDocument document = *std::move(made);
    const auto bytes = [](const std::string& text) {
        const auto* const begin = reinterpret_cast<const std::byte*>(text.data());
        return std::vector(begin, begin + text.size());
    };
    replaceGltfImage(document, 1, bytes(std::string("\0\0\0\x20", 4) + "ftypavif" + std::string(20, '\0')),
                     "image/avif");
    replaceGltfImage(document, 2, bytes(test::makeKtx2({.format = 0, .levels = {{"some"}}, .colourModel = 167})),
                     "image/ktx2");
    rootOf(document)["images"][1]["name"] = "second";
    rootOf(document)["images"][2].erase("name");
    EXPECT_EQ(foreignNormalMaps(document), (std::vector<MapSlot>{{1, NormalSlot::surface}, {2, NormalSlot::surface}}));
    const std::vector<UnreadMap> unread = unreadNormalMaps(document);
    ASSERT_EQ(unread.size(), 2u);
    EXPECT_EQ(unread[0].image, 1u);
    EXPECT_EQ(unread[0].name, "second");
    EXPECT_EQ(unread[0].format, "AVIF");
    EXPECT_EQ(unread[0].advice, "make it PNG or JPEG, and convert again");
    EXPECT_EQ(unread[1].image, 2u);
    EXPECT_EQ(unread[1].name, "image 2");
    EXPECT_EQ(unread[1].format, "KTX2 with BasisU other than ETC1S and UASTC LDR 4x4");
    EXPECT_EQ(unread[1].advice,
              "make it PNG with \"gltf-transform ktxdecompress IN.glb OUT.glb\", convert, and compress it again");
    const auto report = convertModel(document, towards(Frame::cotangent));
    ASSERT_TRUE(report) << report.error().message;
    const auto left = [](int m) {
        return fmt::format("meshes[{}].primitives[0]: its normal map is in an unsupported format; left unchanged", m);
    };
    const auto stays = [](const UnreadMap& map) {
        return fmt::format("{}: a normal map in {} is not supported; it and its tangents are unchanged: {}", map.name,
                           map.format, map.advice);
    };
    const auto tangents = [](int m) {
        return fmt::format(
            "materials[{}]: its normal map is in an unsupported format and is not converted; TANGENT is kept", m);
    };
    EXPECT_EQ(report->notes,
              (Lines{left(1), left(2), stays(unread[0]), stays(unread[1]), tangents(1), tangents(2), kNowFor}));
    EXPECT_EQ(report->dropped.primitives, 1u);
    EXPECT_EQ(report->dropped.vertices, 4u);
    EXPECT_EQ(report->dropped.bytes, 64u);
    for (const std::size_t m : {0u, 1u, 2u})
        EXPECT_EQ(rootOf(document)["meshes"][m]["primitives"][0]["attributes"].contains("TANGENT"), m > 0) << m;
}

TEST(ConvertNotes, nameTheTextureAndExtensionOfAlternativeImages)
{
    // Two textures use image 0. For readers that know an extension, texture 1 has another image by one extension and
    // the same image by another.
    GltfDocument document = sheets({wide(1), wide(2)}, slopeMap({0.3, 0.2, 1}));
    auto& root = rootOf(document);
    root["images"].push_back({{"uri", "other.webp"}});
    root["textures"] = {{{"source", 0}}, {{"source", 0}}};
    root["textures"][1]["extensions"]["MSFT_texture_dds"]["source"] = 1;
    root["textures"][1]["extensions"]["EXT_texture_avif"]["source"] = 0;
    root["textures"][1]["extensions"]["VENDOR_kept"]["mine"] = 7;
    root["extensionsUsed"] = {"MSFT_texture_dds", "EXT_texture_avif", "VENDOR_kept"};
    root["materials"][0]["normalTexture"]["index"] = 0;
    root["materials"][1]["normalTexture"]["index"] = 1;
    MapJob job;
    job.image = 0;
    job.textures = {0, 1};
    Lines notes;
    replaceMap(document, job, *encodePng(slopeMap({0, 0.5, 1})), "image/png", notes);
    EXPECT_EQ(notes, Lines{"textures[1]: MSFT_texture_dds removed: its image is not converted"});
    EXPECT_EQ(rootOf(document)["textures"][1]["extensions"].dump(), R"({"VENDOR_kept":{"mine":7}})");
    EXPECT_EQ(rootOf(document)["textures"][1]["source"], 0);
    EXPECT_FALSE(rootOf(document)["textures"][0].contains("extensions"));
    EXPECT_EQ(rootOf(document)["extensionsUsed"].dump(), R"(["VENDOR_kept"])");
}

TEST(ConvertNotes, sayWhichReadersMisreadAnInsertedMap)
{
    PutMapOptions options;
    for (const auto& [frame, noted] :
         {std::pair(Frame::mikktspace, false), {Frame::vertex, true}, {Frame::smooth, true}}) {
        GltfDocument document = sheets({wide(2)}, slopeMap({0.3, 0.2, 1}));
        options.frame = frame;
        Lines notes;
        ASSERT_TRUE(putNormalMap(document, *encodePng(slopeMap({0, 0, 1})), options, notes));
        EXPECT_EQ(notes,
                  noted ? Lines{fmt::format("the map is for the frame {}; readers that generate MikkTSpace tangents "
                                            "where TANGENT is missing, as glTF specifies, will shade it incorrectly",
                                            name(frame))}
                        : Lines{});
        EXPECT_EQ(*namedFrame(document), noted ? std::optional(frame) : std::nullopt);
    }
}

} // namespace
} // namespace cotan
