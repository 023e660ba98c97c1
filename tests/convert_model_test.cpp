// Converts a whole glTF document to another frame with one call and without files: texels worked out by hand, the
// contents of the report, and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "bake/lint/map_fit.hpp"
#include "cotan/convention.hpp"
#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "gltf/json/lookup.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {
namespace {

const auto kStored = toFormat<f64::cotan_normal_format>(Convention());

Image mapOf(glm::dvec3 m)
{
    Image image = makeImage(16, 16, PixelType::unorm8, "map");
    const glm::dvec3 stored = f64::cotan_encode_texel(glm::normalize(m), kStored);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.bytes8()[i] = i % 4 == 3 ? std::uint8_t(255) : std::uint8_t(std::lround(255 * stored[int(i % 4)]));
    return image;
}

// A rectangle in xy with a map; its uv fill the unit square, v down.
GltfDocument documentOf(float width, const Image& map, float uvScale = 1, bool tangents = false, float w = 1)
{
    Scene scene;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {width, 0, 0}, {width, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    if (tangents)
        mesh.tangents.assign(4, {1, 0, 0, w});
    mesh.texcoords[0] = {{0, uvScale}, {uvScale, uvScale}, {uvScale, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes = {mesh};
    scene.images = {map};
    scene.materials.emplace_back();
    scene.materials[0].normalMap.image = 0;
    scene.instances.push_back({});
    auto document = gltfDocumentOf(scene);
    if (!document)
        ADD_FAILURE() << document.error().message;
    return *document;
}

Image normalMapIn(const GltfDocument& document, std::size_t image = 0)
{
    const auto bytes = gltfImageBytes(document, image);
    const auto decoded = bytes ? decodeImage(*bytes, "map") : Result<Image>(bytes.error());
    if (!decoded) {
        ADD_FAILURE() << decoded.error().message;
        return {};
    }
    return *decoded;
}

glm::dvec3 directionAt(const Image& image, int x, int y)
{
    const auto format = toFormat<f64::cotan_normal_format>(Convention(), image.type);
    return glm::normalize(f64::cotan_decode(storedTexel(image, x, y), format));
}

double largestAngle(const Image& a, const Image& b)
{
    double largest = a.width == b.width && a.height == b.height ? 0 : 180;
    for (int y = 0; y < a.height && largest < 180; ++y)
        for (int x = 0; x < a.width; ++x) {
            const glm::dvec3 p = directionAt(a, x, y), q = directionAt(b, x, y);
            largest = std::max(largest, glm::degrees(std::atan2(glm::length(glm::cross(p, q)), glm::dot(p, q))));
        }
    return largest;
}

bool has(const GltfDocument& document, const char* attribute)
{
    return rootOf(document)["meshes"][0]["primitives"][0]["attributes"].contains(attribute);
}

constexpr FramePair kThere{Frame::mikktspace, Frame::cotangent};
constexpr FramePair kBack{Frame::cotangent, Frame::mikktspace};

TEST(ConvertModel, aFlatMapStaysFlatInEveryFrame)
{
    for (const FrameInfo& to : frames()) {
        if (to.dependsOnView)
            continue;
        GltfDocument document = documentOf(2, mapOf({0, 0, 1}));
        const auto before = gltfImageBytes(document, 0);
        const auto kept =
            convertModel(document, {.frames = {Frame::mikktspace, to.frame}, .expansion = Expansion::exact});
        ASSERT_TRUE(kept) << kept.error().message;
        ASSERT_EQ(kept->maps.size(), 1u);
        EXPECT_TRUE(kept->maps[0].kept) << to.name;
        EXPECT_LT(kept->maps[0].figures.unconverted.maximum, 1e-4) << to.name; // float positions and tangents
        EXPECT_EQ(*before, *gltfImageBytes(document, 0)) << to.name;
        document = documentOf(2, mapOf({0, 0, 1})); // the converted document names its frame
        const auto anew = convertModel(
            document, {.frames = {Frame::mikktspace, to.frame}, .bits = 16, .expansion = Expansion::exact});
        ASSERT_TRUE(anew) << anew.error().message;
        EXPECT_EQ(anew->maps[0].bits, 16);
        const Image map = normalMapIn(document);
        ASSERT_EQ(map.type, PixelType::unorm16);
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            EXPECT_NEAR(map.words()[4 * i], 32768, 1) << to.name; // the code of zero
            EXPECT_NEAR(map.words()[4 * i + 1], 32768, 1) << to.name;
            EXPECT_EQ(map.words()[4 * i + 2], 65535) << to.name;
        }
    }
}

TEST(ConvertModel, twiceTheWidthDoublesTheSlopeAlongUForCotangent)
{
    const Image map = mapOf({0.3, 0.2, 1});
    GltfDocument document = documentOf(2, map);
    const auto report = convertModel(document, {.frames = kThere, .bits = 16, .expansion = Expansion::exact});
    ASSERT_TRUE(report) << report.error().message;
    const glm::dvec3 old = directionAt(map, 3, 3), found = directionAt(normalMapIn(document), 3, 3);
    EXPECT_NEAR(found.x / found.z, 2 * old.x / old.z, 2e-4); // 16 bits: 1.5e-5 a component, slopes below 1
    EXPECT_NEAR(found.y / found.z, old.y / old.z, 2e-4);
    const ConvertedMap& m = report->maps.at(0);
    EXPECT_EQ(m.width, 16);
    EXPECT_EQ(m.height, 16);
    EXPECT_EQ(m.surfaces, 1u);
    EXPECT_EQ(m.figures.covered, 256u);
    EXPECT_EQ(m.bytesAfter, gltfImageBytes(document, 0)->size());
    EXPECT_LT(m.figures.error.maximum, 0.01); // 16 bits
    EXPECT_GT(m.figures.unconverted.mean, 3);
}

TEST(ConvertModel, roundTripIsWithinRounding)
{
    const Image map = makeReliefMap(Relief::waves, 32);
    GltfDocument document = documentOf(2, map);
    ASSERT_TRUE(convertModel(document, {.frames = kThere, .bits = 16, .expansion = Expansion::exact}));
    EXPECT_GT(largestAngle(map, normalMapIn(document)), 3); // the conversion has an effect
    ASSERT_TRUE(convertModel(document, {.frames = kBack, .bits = 16, .expansion = Expansion::exact}));
    EXPECT_LT(largestAngle(map, normalMapIn(document)), 0.02); // 16 bits, twice
}

// ---- maps that are kept -----------------------------------------------------------------------

struct Sheet {
    std::optional<float> w; // of TANGENT, which it lacks without one
    int material = 0;
};

// Squares beside each other, all of which show one map; material 1 is a second one with the same map.
GltfDocument sheetsOf(const std::vector<Sheet>& sheets, const Image& map)
{
    Scene scene;
    scene.images = {map};
    scene.materials.resize(2);
    for (Material& m : scene.materials)
        m.normalMap.image = 0;
    for (const Sheet& sheet : sheets) {
        Mesh mesh;
        mesh.material = sheet.material;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        mesh.normals.assign(4, {0, 0, 1});
        if (sheet.w)
            mesh.tangents.assign(4, {1, 0, 0, *sheet.w});
        mesh.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        scene.instances.push_back({"", int(scene.meshes.size()), glm::mat4(1)});
        scene.meshes.push_back(std::move(mesh));
    }
    auto document = gltfDocumentOf(scene);
    if (!document)
        ADD_FAILURE() << document.error().message;
    return *document;
}

std::vector<bool> tangentsIn(const GltfDocument& document)
{
    std::vector<bool> found;
    for (const auto& mesh : rootOf(document)["meshes"])
        found.push_back(mesh["primitives"][0]["attributes"].contains("TANGENT"));
    return found;
}

constexpr FramePair kWithoutTangents{Frame::mikktspace, Frame::orthonormal};

TEST(KeptMaps, haveGreenReversedWhereAllTheirTangentsReverseIt)
{
    for (const Expansion expansion : {Expansion::biased, Expansion::exact}) {
        const Image map = makeReliefMap(Relief::waves, 32);
        GltfDocument document = sheetsOf({{-1.0f, 0}, {-1.0f, 1}}, map);
        const auto report =
            convertModel(document, {.frames = kWithoutTangents, .expansion = expansion, .keepMaps = true});
        ASSERT_TRUE(report) << report.error().message;
        const ConvertedMap& m = report->maps.at(0);
        EXPECT_TRUE(m.greenReversed);
        EXPECT_FALSE(m.kept);
        EXPECT_LT(m.figures.error.maximum, 1e-4); // lit as with its tangents
        EXPECT_GT(m.figures.unconverted.mean, 3); // it would not be without the change
        EXPECT_EQ(tangentsIn(document), (std::vector{false, false}));
        ASSERT_EQ(report->notes.size(), 1u);
        EXPECT_EQ(report->notes[0],
                  "waves: the tangents of the file reverse its green; without them, the map has its green reversed");
        const Image after = normalMapIn(document);
        const int zeroTwice = expansion == Expansion::exact ? 256 : 255;
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            const std::uint8_t *a = map.bytes8() + 4 * i, *b = after.bytes8() + 4 * i;
            ASSERT_EQ(int(b[1]), std::min(zeroTwice - a[1], 255)) << i;
            ASSERT_EQ(b[0], a[0]);
            ASSERT_EQ(b[2], a[2]);
        }
    }
}

TEST(KeptMaps, stayWhereAnotherMeshShowsThemAsDeclared)
{
    const Image map = makeReliefMap(Relief::waves, 32);
    const auto without = std::optional<float>();
    // The second mesh has no tangents, or right ones; it shares the material, or has one of its own.
    for (const Sheet& second : {Sheet{without, 0}, Sheet{without, 1}, Sheet{1.0f, 0}, Sheet{1.0f, 1}}) {
        GltfDocument document = sheetsOf({{-1.0f, 0}, second}, map);
        const auto before = gltfImageBytes(document, 0);
        const auto report = convertModel(document, {.frames = kWithoutTangents, .keepMaps = true});
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_TRUE(report->maps.at(0).kept);
        EXPECT_LT(report->maps[0].figures.unconverted.maximum, 1e-4); // of the surface that lost its tangents
        EXPECT_EQ(*gltfImageBytes(document, 0), *before);
        EXPECT_EQ(tangentsIn(document), (std::vector{true, false}));
        ASSERT_EQ(report->notes.size(), 1u);
        EXPECT_EQ(report->notes[0],
                  "materials[0]: its tangents reverse green of waves, which other surfaces show as "
                  "declared; TANGENT is kept");
    }
}

// Their tangents stay in any case, and show the map: its green must not be reversed too.
TEST(KeptMaps, stayWhereACoatOrAnisotropyNeedsTheTangents)
{
    const Image map = makeReliefMap(Relief::waves, 32);
    for (const bool ofCoat : {false, true})
        for (const bool read : {true, false}) {
            GltfDocument document = sheetsOf({{-1.0f, 0}}, map);
            auto& material = rootOf(document)["materials"][0];
            if (ofCoat) {
                material["extensions"]["KHR_materials_clearcoat"] = {
                    {"clearcoatFactor", 1}, {"clearcoatNormalTexture", material["normalTexture"]}};
                material.erase("normalTexture");
            } else {
                material["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.5}};
            }
            const auto before = gltfImageBytes(document, 0);
            const auto report =
                convertModel(document, {.frames = kWithoutTangents, .keepMaps = true, .readMaps = read});
            ASSERT_TRUE(report) << report.error().message;
            EXPECT_EQ(*gltfImageBytes(document, 0), *before) << ofCoat << read;
            EXPECT_EQ(tangentsIn(document), std::vector{true}) << ofCoat << read;
            EXPECT_EQ(report->notes.size(), 1u) << ofCoat << read;
        }
}

TEST(KeptMaps, stayWhereTangentsAreGeneratedOrAnotherFrameIsNamed)
{
    const Image map = makeReliefMap(Relief::waves, 32);
    for (const FramePair& frames : {FramePair{Frame::mikktspace, Frame::orthonormal, TangentOrigin::generated},
                                    FramePair{Frame::orthonormal, Frame::orthonormal}}) {
        GltfDocument document = sheetsOf({{-1.0f, 0}}, map);
        const auto report = convertModel(document, {.frames = frames, .keepMaps = true});
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_TRUE(report->maps.at(0).kept);
        EXPECT_FALSE(report->maps[0].greenReversed);
        EXPECT_EQ(tangentsIn(document), std::vector{false});
    }
}

// Readers that decode with 2c - 1 tilt flat texels towards red and green. Stored tangents with reversed w reverse
// green, so the tilt must be against the new green: code 127 does that, 128 does not.
TEST(ConvertModel, flatTexelsKeepTheirTiltInEngines)
{
    const auto texelOf = [](Expansion expansion) {
        GltfDocument document = documentOf(1, mapOf({0, 0, 1}), 1, true, -1);
        rootOf(document)["materials"][0]["extras"]["mine"] = 7;
        EXPECT_TRUE(convertModel(document, {.frames = kThere, .bits = 8, .expansion = expansion}));
        const nlohmann::ordered_json extras = rootOf(document)["materials"][0]["extras"];
        EXPECT_EQ(extras["mine"], 7);
        EXPECT_EQ(extras.contains("cotanUnsigned"), expansion == Expansion::biased);
        const Image map = normalMapIn(document);
        return std::pair(int(map.bytes8()[0]), int(map.bytes8()[1]));
    };
    EXPECT_EQ(texelOf(Expansion::biased), std::pair(128, 127));
    EXPECT_EQ(texelOf(Expansion::exact), std::pair(128, 128));
}

TEST(ConvertModel, decodesByTheMaterialsExtrasAndRemovesOutdatedOnes)
{
    GltfDocument document = documentOf(1, mapOf({0, 0, 1}));
    rootOf(document)["materials"][0]["extras"]["cotanUnsigned"] = "biased";
    ASSERT_TRUE(convertModel(document, {.frames = kThere, .bits = 16, .expansion = Expansion::exact}));
    EXPECT_FALSE(rootOf(document)["materials"][0].value("extras", nlohmann::ordered_json()).contains("cotanUnsigned"));
    // 128 of 255 is 1 / 255 above the middle, which 16 bits represent.
    EXPECT_NEAR(normalMapIn(document).words()[0], 32768 + 32767.0 / 255, 1);
}

TEST(ConvertModel, tangentsAreDroppedGeneratedOrKept)
{
    const Image map = mapOf({0.3, 0.2, 1});
    GltfDocument document = documentOf(2, map, 1, true);
    const auto kept = convertModel(document, {.frames = kThere, .keepTangents = true});
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(kept->tangents, TangentsAfter::kept);
    EXPECT_TRUE(has(document, "TANGENT"));
    const auto dropped = convertModel(document, {.frames = {Frame::cotangent, Frame::orthonormal}});
    ASSERT_TRUE(dropped) << dropped.error().message;
    EXPECT_EQ(dropped->tangents, TangentsAfter::dropped);
    EXPECT_EQ(dropped->dropped.primitives, 1u);
    EXPECT_EQ(dropped->dropped.vertices, 4u);
    EXPECT_EQ(dropped->dropped.bytes, 4u * 16u);
    EXPECT_FALSE(has(document, "TANGENT"));
    const auto given = convertModel(document, {.frames = {Frame::orthonormal, Frame::vertex}});
    ASSERT_TRUE(given) << given.error().message;
    EXPECT_EQ(given->tangents, TangentsAfter::given);
    EXPECT_EQ(given->primitivesGiven, 1u);
    EXPECT_TRUE(has(document, "TANGENT"));
}

TEST(ConvertModel, progressRunsToOne)
{
    GltfDocument document = documentOf(2, mapOf({0.3, 0.2, 1}));
    std::mutex mutex;
    double last = 0, highest = 0;
    const auto report = convertModel(document, {.frames = kThere, .threads = 2, .progress = [&](double fraction) {
                                                    const std::lock_guard lock(mutex);
                                                    last = fraction;
                                                    highest = std::max(highest, fraction);
                                                    return true;
                                                }});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(last, 1);
    EXPECT_EQ(highest, 1);
}

TEST(ConvertModel, aStopByItsProgressChangesNothing)
{
    for (const double limit : {0.0, 0.5, 0.999}) {
        GltfDocument document = documentOf(2, mapOf({0.3, 0.2, 1}));
        const auto before = rootOf(document);
        const auto done =
            convertModel(document, {.frames = kThere, .progress = [=](double fraction) { return fraction <= limit; }});
        ASSERT_FALSE(done) << limit;
        EXPECT_EQ(done.error().kind, ErrorKind::stopped);
        EXPECT_EQ(done.error().message, stoppedError().message);
        EXPECT_EQ(rootOf(document), before);
    }
}

TEST(GiveTangents, aStopByTheirProgressChangesNothing)
{
    GltfDocument document = documentOf(2, mapOf({0.3, 0.2, 1}));
    const auto before = rootOf(document);
    const auto given = giveTangents(document, {.replace = true, .progress = [](double) { return false; }});
    ASSERT_FALSE(given);
    EXPECT_EQ(given.error().kind, ErrorKind::stopped);
    EXPECT_EQ(rootOf(document), before);
}

TEST(ConvertModel, refusalsAreOneLineAndChangeNothing)
{
    const auto refused = [](GltfDocument document, const ConvertModelOptions& options, ErrorKind kind,
                            const char* word) {
        const auto before = rootOf(document);
        const auto result = convertModel(document, options);
        ASSERT_FALSE(result) << word;
        EXPECT_EQ(result.error().kind, kind) << word;
        EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
        EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
        EXPECT_EQ(rootOf(document), before) << word;
    };
    const Image map = mapOf({0.3, 0.2, 1});
    for (const FrameInfo& f : frames())
        if (f.dependsOnView) {
            refused(documentOf(2, map), {.frames = {Frame::mikktspace, f.frame}}, ErrorKind::usage,
                    "depends on the view");
            refused(documentOf(2, map), {.frames = {f.frame, Frame::cotangent}}, ErrorKind::usage,
                    "depends on the view");
        }
    refused(documentOf(2, map), {.frames = kThere, .bits = 12}, ErrorKind::usage, "found 12");
    ConvertModelOptions small{.frames = kThere};
    small.limits.imageSide = 8;
    refused(documentOf(2, map), small, ErrorKind::input, "16 x 16");
    GltfDocument broken = documentOf(2, map);
    replaceGltfImage(broken, 0, std::vector<std::byte>(5), "image/png");
    refused(broken, {.frames = kThere}, ErrorKind::input, "map");
}

// ---- tangents only --------------------------------------------------------------------------

TEST(GiveTangents, aFlatRectangleGetsTheDirectionOfU)
{
    for (const Frame frame : {Frame::mikktspace, Frame::vertex}) {
        GltfDocument document = documentOf(2, mapOf({0, 0, 1}));
        const auto bare = compareTangents(document, {.frame = frame});
        ASSERT_TRUE(bare);
        EXPECT_EQ(bare->without, 1u);
        EXPECT_EQ(verdictOf(bare->whole), TangentVerdict::nothing);
        const auto given = giveTangents(document, {.frame = frame});
        ASSERT_TRUE(given) << given.error().message;
        EXPECT_EQ(given->generated, 1u);
        EXPECT_EQ(given->verticesAdded, 0u);
        const auto geometry = gltfGeometry(document, 0, 0);
        ASSERT_TRUE(geometry);
        ASSERT_EQ(geometry->tangents.size(), 4u);
        for (const glm::vec4& t : geometry->tangents)
            EXPECT_LT(glm::length(t - glm::vec4(1, 0, 0, 1)), 1e-6f); // u along x; cross(n, t) up the image
        const auto compared = compareTangents(document, {.frame = frame});
        ASSERT_TRUE(compared);
        EXPECT_EQ(compared->whole.corners, 6u);
        EXPECT_EQ(verdictOf(compared->whole), TangentVerdict::equal);
    }
}

TEST(GiveTangents, existingTangentsAreKeptUnlessReplacementIsRequested)
{
    GltfDocument document = documentOf(2, mapOf({0, 0, 1}), 1, true);
    GltfCornerTangents turned{0, 0, std::vector<glm::vec4>(6, {-1, 0, 0, -1})};
    ASSERT_TRUE(setGltfTangents(document, {&turned, 1}));
    const auto kept = giveTangents(document, {});
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->kept, 1u);
    EXPECT_EQ(kept->generated, 0u);
    const auto off = compareTangents(document, {});
    ASSERT_TRUE(off);
    EXPECT_EQ(verdictOf(off->whole), TangentVerdict::inverted);
    EXPECT_EQ(reversedFraction(off->whole), 1);
    const auto replaced = giveTangents(document, {.replace = true});
    ASSERT_TRUE(replaced);
    EXPECT_TRUE(replaced->primitives.at(0).stored);
    EXPECT_TRUE(replaced->primitives.at(0).generated);
    EXPECT_EQ(verdictOf(compareTangents(document, {})->whole), TangentVerdict::equal);
}

TEST(GiveTangents, framesWithoutTangentsAreRefused)
{
    GltfDocument document = documentOf(2, mapOf({0, 0, 1}));
    for (const FrameInfo& f : frames()) {
        const auto given = giveTangents(document, {.frame = f.frame});
        EXPECT_EQ(bool(given), readsTangents(f.frame)) << f.name;
        if (!given) {
            EXPECT_EQ(given.error().kind, ErrorKind::usage);
        }
    }
}

} // namespace
} // namespace cotan
