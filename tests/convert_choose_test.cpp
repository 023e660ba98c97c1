// Converts glTF documents with frames that are chosen primitive by primitive: which tangents stay, what is named, and
// that the new file is read as the old one was.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/convert.hpp"
#include "cotan/frame_choice.hpp"
#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "cotan/lint.hpp"
#include "cotan/scene.hpp"
#include "gltf/json/lookup.hpp"

namespace cotan {
namespace {

// A square of two triangles in xy at x, with tangents at `degrees` from u and this w.
Mesh squareAt(float x, float degrees, float w)
{
    Mesh mesh;
    mesh.positions = {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    const float a = glm::radians(degrees);
    mesh.tangents.assign(4, {std::cos(a), std::sin(a), 0, w});
    return mesh;
}

// A coarse sphere: its tangents, as MikkTSpace makes them, are averages at vertices, which no frame of a pixel is.
Mesh coarseSphere()
{
    Mesh mesh = makeSphere(1, 8);
    return mesh;
}

// All meshes show one map by one material.
GltfDocument documentWith(const std::vector<Mesh>& meshes)
{
    Scene scene;
    scene.images = {makeReliefMap(Relief::waves, 64)};
    scene.materials.resize(1);
    scene.materials[0].normalMap.image = 0;
    for (const Mesh& mesh : meshes) {
        scene.instances.push_back({"", int(scene.meshes.size()), glm::mat4(1)});
        scene.meshes.push_back(mesh);
    }
    auto document = gltfDocumentOf(scene);
    if (!document)
        ADD_FAILURE() << document.error().message;
    return *document;
}

ConvertModelReport chosen(GltfDocument& document, double degrees = ChoiceLimits().mean)
{
    const auto report = convertModel(
        document,
        {.frames = {Frame::mikktspace, Frame::orthonormal}, .choose = ChoiceLimits::of(degrees), .keepMaps = true});
    if (!report)
        ADD_FAILURE() << report.error().message;
    return report ? *report : ConvertModelReport{};
}

std::vector<std::string> namesIn(const GltfDocument& document)
{
    std::vector<std::string> names;
    for (const auto& mesh : rootOf(document)["meshes"])
        names.push_back(gltf::frameText(mesh["primitives"][0]));
    return names;
}

std::vector<bool> keptIn(const GltfDocument& document)
{
    std::vector<bool> found;
    for (const auto& mesh : rootOf(document)["meshes"])
        found.push_back(mesh["primitives"][0]["attributes"].contains("TANGENT"));
    return found;
}

// Tangents at 30 degrees from u are none that a frame without them has; those along u are.
TEST(ConvertChoose, eachPrimitiveOfAMaterialHasItsOwnFrame)
{
    GltfDocument document = documentWith({squareAt(0, 0, 1), squareAt(2, 30, 1), coarseSphere()});
    const auto map = gltfImageBytes(document, 0);
    const ConvertModelReport report = chosen(document);
    EXPECT_EQ(keptIn(document), (std::vector{false, true, false}));
    EXPECT_EQ(namesIn(document), (std::vector<std::string>{"orthonormal", "mikktspace", "mikktspace"}));
    EXPECT_EQ(*gltfImageBytes(document, 0), *map);
    ASSERT_EQ(report.decisions.size(), 3u);
    EXPECT_EQ(report.decisions[0].decision.reason, ChoiceReason::fits);
    EXPECT_EQ(report.decisions[1].decision.reason, ChoiceReason::keeps);
    EXPECT_EQ(report.decisions[2].decision.meaning, MapMeaning::mikktspace); // it has no tangents
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_TRUE(report.notes[0].starts_with("meshes[1].primitives[0]: its tangents stay")) << report.notes[0];
    EXPECT_FALSE(rootOf(document)["materials"][0].contains("extras")); // the maps are still for MikkTSpace
}

// A mesh with `count` variants, each with a material and a scale of normals of its own. All maps are flat but that of
// the variant `last`, which shows where the tangents are.
GltfDocument documentWithVariants(const Mesh& mesh, std::size_t count, std::size_t last)
{
    GltfDocument document = documentWith({mesh});
    auto& root = rootOf(document);
    Image flat = makeReliefMap(Relief::waves, 8);
    for (std::size_t i = 0; i < flat.data.size(); ++i)
        flat.data[i] = std::byte(i % 4 < 2 ? 128 : 255);
    const std::size_t flatImage = addGltfImage(document, *encodePng(flat), "image/png", "flat");
    const std::size_t flatTexture = copyGltfTexture(document, 0, flatImage);
    gltf::Json mappings, variants;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t material = copyGltfMaterial(document, 0);
        auto& map = root["materials"][material]["normalTexture"];
        if (i != last)
            map["index"] = flatTexture;
        map["scale"] = 1 + double(i) / 1e6;
        mappings[i]["material"] = material;
        mappings[i]["variants"] = {i};
        variants[i]["name"] = std::to_string(i);
    }
    root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = mappings;
    root["extensionsUsed"] = {"KHR_materials_variants"};
    root["extensions"]["KHR_materials_variants"]["variants"] = variants;
    root["materials"][0]["normalTexture"]["index"] = flatTexture;
    return document;
}

TEST(ConvertChoose, aLateVariantThatNeedsTangentsKeepsThem)
{
    for (const std::size_t last : {std::size_t(0), std::size_t(11)}) {
        GltfDocument document = documentWithVariants(squareAt(0, 30, 1), 12, last);
        chosen(document);
        EXPECT_EQ(keptIn(document), std::vector{true}) << last;
    }
    GltfDocument without =
        documentWithVariants(squareAt(0, 30, 1), 12, 12); // all maps are flat, whatever the tangents are
    chosen(without);
    EXPECT_EQ(keptIn(without), std::vector{false});
}

// All variants show the same geometry: they share the points that are judged, and the triangles.
TEST(ConvertChoose, thousandsOfVariantsShareTheJudgedPoints)
{
    constexpr std::size_t kVariants = 3000;
    const GltfDocument document = documentWithVariants(squareAt(0, 0, 1), kVariants, kVariants);
    const auto scene = gltfSceneOfVariants(document, {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes.size(), 1 + kVariants);
    std::size_t points = 0;
    for (const FrameDecision& d : chooseFrames(*scene)) {
        ASSERT_EQ(d.candidates.size(), 1u); // the first one fits
        points += d.candidates[0].points;
    }
    EXPECT_LE(points, 128u * 4096);
    EXPECT_GE(points, 16 * kVariants);
}

TEST(ConvertChoose, materialsThatShowTheSameNormalsAreJudgedOnce)
{
    GltfDocument document = documentWithVariants(squareAt(0, 0, 1), 4, 4);
    auto& materials = rootOf(document)["materials"];
    materials[2]["normalTexture"] = materials[1]["normalTexture"]; // another colour only
    materials[2]["pbrMetallicRoughness"]["metallicFactor"] = 0.5;
    materials[3].erase("normalTexture");
    const auto scene = gltfSceneOfVariants(document, {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes.size(), 3u); // its own material, those of the first and of the last variant
    EXPECT_EQ(scene->instances.size(), 3u);
}

// A plane of `side` x `side` squares.
Mesh plane(int side)
{
    Mesh mesh;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) {
            mesh.positions.emplace_back(x, y, 0);
            mesh.normals.emplace_back(0, 0, 1);
            mesh.texcoords[0].emplace_back(float(x) / float(side), 1 - float(y) / float(side));
        }
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto at = [&](int dx, int dy) { return std::uint32_t((y + dy) * (side + 1) + x + dx); };
            mesh.indices.insert(mesh.indices.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
        }
    return mesh;
}

TEST(ConvertChoose, variantsOfALargePrimitiveShareAMillionTriangles)
{
    constexpr std::size_t kVariants = 20; // 20 times 80,000 triangles are over a million
    const auto scene = gltfSceneOfVariants(documentWithVariants(plane(200), kVariants, kVariants), {});
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->meshes.size(), 1 + kVariants);
    EXPECT_EQ(scene->meshes[0].triangleCount(), 80'000u); // its own material: all
    std::size_t triangles = 0;
    for (std::size_t i = 1; i < scene->meshes.size(); ++i)
        triangles += scene->meshes[i].triangleCount();
    EXPECT_LE(triangles, 1'000'000u);
    EXPECT_GE(triangles, 990'000u);
}

TEST(ConvertChoose, nobodyDecidesTwice)
{
    GltfDocument document = documentWith({squareAt(0, 0, 1), squareAt(2, 30, 1), coarseSphere()});
    chosen(document);
    const auto once = glbBytes(document);
    const ConvertModelReport again = chosen(document);
    for (const PrimitiveDecision& d : again.decisions)
        EXPECT_EQ(d.decision.reason, ChoiceReason::named);
    EXPECT_EQ(*glbBytes(document), *once);
    // New maps are for one frame again, whatever primitives named.
    ASSERT_TRUE(convertModel(document, {.frames = {Frame::mikktspace, Frame::cotangent}}));
    EXPECT_EQ(namesIn(document), (std::vector<std::string>{"", "", ""}));
}

TEST(ConvertChoose, aHigherLimitTakesACheaperFrame)
{
    const auto frameAt = [](double degrees) {
        GltfDocument document = documentWith({coarseSphere()});
        return chosen(document, degrees).decisions.at(0).decision.frame;
    };
    EXPECT_EQ(frameAt(0.01), Frame::mikktspace);
    EXPECT_EQ(frameAt(180), Frame::orthonormal);
}

// A fiftieth of the area is far off: little on average, and more than 3 degrees on 1 % of the area.
TEST(ConvertChoose, tangentsStayForAFewPercentThatAreFarOff)
{
    Mesh mesh = squareAt(0, 0, 1);
    const Mesh off = squareAt(2, 30, 1);
    for (std::size_t i = 0; i < 4; ++i) {
        mesh.positions.push_back(off.positions[i] * std::sqrt(1.0f / 49));
        mesh.normals.push_back(off.normals[i]);
        mesh.texcoords[0].push_back(off.texcoords[0][i]);
        mesh.tangents.push_back(off.tangents[i]);
    }
    for (const std::uint32_t i : off.indices)
        mesh.indices.push_back(i + 4);
    GltfDocument document = documentWith({mesh});
    const ConvertModelReport report = chosen(document);
    EXPECT_EQ(keptIn(document), std::vector{true});
    const FrameDecision& decision = report.decisions.at(0).decision;
    EXPECT_EQ(decision.reason, ChoiceReason::keeps);
    EXPECT_LT(decision.candidates.at(0).mean, ChoiceLimits().mean);
}

// The tangents of all reverse green. Of those that stay, w follows the map, so that both are right afterwards.
TEST(ConvertChoose, tangentsThatStayFollowGreenOfTheirMap)
{
    GltfDocument document = documentWith({squareAt(0, 0, -1), squareAt(2, 30, -1)});
    const ConvertModelReport report = chosen(document);
    EXPECT_TRUE(report.maps.at(0).greenReversed);
    EXPECT_LT(report.maps.at(0).figures.error.maximum, 1e-4); // of the square without tangents
    EXPECT_EQ(keptIn(document), (std::vector{false, true}));
    const auto kept = gltfGeometry(document, 1, 0);
    ASSERT_TRUE(kept);
    for (const glm::vec4& t : kept->tangents) {
        EXPECT_FLOAT_EQ(t.w, 1);
        EXPECT_NEAR(t.x, std::cos(glm::radians(30.0f)), 1e-6);
    }
}

// Half of the area has w reversed: no frame shows that, so the tangents stay, and with them the map as it is.
TEST(ConvertChoose, partlyReversedTangentsStay)
{
    Mesh half = squareAt(0, 0, 1);
    const Mesh other = squareAt(2, 0, -1);
    for (std::size_t i = 0; i < 4; ++i) {
        half.positions.push_back(other.positions[i]);
        half.normals.push_back(other.normals[i]);
        half.texcoords[0].push_back(other.texcoords[0][i]);
        half.tangents.push_back(other.tangents[i]);
    }
    for (const std::uint32_t i : other.indices)
        half.indices.push_back(i + 4);
    GltfDocument document = documentWith({half});
    const auto map = gltfImageBytes(document, 0);
    const ConvertModelReport report = chosen(document);
    EXPECT_EQ(keptIn(document), std::vector{true});
    EXPECT_EQ(report.decisions.at(0).decision.reason, ChoiceReason::keeps);
    EXPECT_EQ(*gltfImageBytes(document, 0), *map);
}

TEST(ConvertChoose, mapsThatWereMadeForAnotherFrameAreReadWithIt)
{
    GltfDocument document = documentWith({squareAt(0, 0, 1), squareAt(2, 30, 1)});
    const auto report = convertModel(
        document, {.frames = {Frame::smooth, Frame::orthonormal}, .choose = ChoiceLimits(), .keepMaps = true});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(namesIn(document), (std::vector<std::string>{"smooth", "smooth"}));
    EXPECT_EQ(keptIn(document), (std::vector{false, false}));
    for (const PrimitiveDecision& d : report->decisions)
        EXPECT_EQ(d.decision.reason, ChoiceReason::named);
}

// Each material alone could have its green reversed, but they share the map.
TEST(ConvertChoose, decisionsSayWhereTangentsStayForTheGreenOfASharedMap)
{
    GltfDocument document = documentWith({squareAt(0, 0, 1), squareAt(2, 0, -1)});
    auto& root = rootOf(document);
    root["materials"].push_back(root["materials"][0]);
    root["meshes"][1]["primitives"][0]["material"] = 1u;
    const ConvertModelReport report = chosen(document);
    EXPECT_EQ(keptIn(document), (std::vector{false, true}));
    ASSERT_EQ(report.decisions.size(), 2u);
    EXPECT_TRUE(report.decisions[0].decision.dropsTangents());
    EXPECT_FALSE(report.decisions[1].decision.dropsTangents());
    EXPECT_EQ(namesIn(document), (std::vector<std::string>{"orthonormal", "mikktspace"}));
}

// w is wrong on a third of the area, and the map shows that its green is as declared. Whoever draws the file sees what
// its tangents show, and that is what decisions are for; lint advises a conversion that ignores them.
TEST(ConvertChoose, lintAdvisesAConversionThatIgnoresTangentsWhichAMapProvesWrong)
{
    const GltfDocument document = documentWith({squareAt(0, 0, 1), squareAt(2, 0, 1), squareAt(4, 0, -1)});
    const auto bytes = glbBytes(document);
    LoadLimits limits;
    limits.readFile = [&](const std::string&) { return Result<std::vector<std::byte>>(*bytes); };
    const auto scene = loadGltf("model.glb", limits);
    ASSERT_TRUE(scene);
    const auto lint = lintScene(*scene);
    ASSERT_TRUE(lint.distrustStored) << lint.recommendation;
    EXPECT_EQ(lint.dropping, 3u);
    EXPECT_EQ(lint.keeping, 0u);
    GltfDocument converted = document;
    const auto report = convertModel(converted,
                                     {.frames = {Frame::mikktspace, Frame::orthonormal, TangentOrigin::generated},
                                      .choose = ChoiceLimits(),
                                      .keepMaps = true});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(keptIn(converted), (std::vector{false, false, false}));
    for (const PrimitiveDecision& d : report->decisions)
        EXPECT_EQ(d.decision.meaning, MapMeaning::mikktspace);
}

TEST(ConvertChoose, whatCannotBeJudgedStays)
{
    Mesh collapsed = squareAt(0, 0, 1), bare = squareAt(2, 0, 1);
    collapsed.texcoords[0].assign(4, {0.5f, 0.5f});
    bare.texcoords[0].clear();
    GltfDocument document = documentWith({collapsed, bare, squareAt(4, 0, 1)});
    const ConvertModelReport report = chosen(document);
    EXPECT_EQ(keptIn(document), (std::vector{true, true, false}));
    EXPECT_EQ(namesIn(document), (std::vector<std::string>{"", "", "orthonormal"}));
    EXPECT_EQ(report.decisions.at(0).decision.notJudged, "no triangle has an area both in space and in uv");
    EXPECT_EQ(report.decisions.at(1).decision.notJudged, "no uv");
}

TEST(ConvertChoose, contradictoryOptionsAreRefused)
{
    GltfDocument document = documentWith({squareAt(0, 0, 1)});
    for (const ConvertModelOptions& wrong :
         {ConvertModelOptions{.choose = ChoiceLimits()},
          ConvertModelOptions{.choose = ChoiceLimits(), .keepMaps = true, .readMaps = false},
          ConvertModelOptions{.choose = ChoiceLimits(), .keepMaps = true, .keepTangents = true}}) {
        const auto report = convertModel(document, wrong);
        ASSERT_FALSE(report);
        EXPECT_EQ(report.error().kind, ErrorKind::usage);
    }
}

// Otherwise the file would be read again.
TEST(ConvertChoose, anOpenModelIsJudgedByItsScene)
{
    GltfDocument document = documentWith({squareAt(0, 0, 1), squareAt(2, 30, 1)});
    auto scene = gltfScene(document);
    ASSERT_TRUE(scene) << scene.error().message;
    for (Mesh& mesh : scene->meshes)
        mesh.named = Frame::smooth; // which the document does not say
    OpenGltf model{document, *std::move(scene)};
    const auto report = convertModel(
        model, {.frames = {Frame::mikktspace, Frame::orthonormal}, .choose = ChoiceLimits(), .keepMaps = true});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(namesIn(model.document), (std::vector<std::string>{"smooth", "smooth"}));
    EXPECT_TRUE(model.scene.meshes.empty());
}

} // namespace
} // namespace cotan
