// What is wrong with a normal map is named wherever a model with it is read: by lint and its limits, when it is drawn,
// and when it is converted. A sound map beside it is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"
#include "cotan/lint.hpp"
#include "cotan/maps.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

using Change = std::function<void(std::uint8_t* texel)>;

struct Broken {
    const char* kind; // maps::name(Fault::Kind); empty: sound
    Change change;
};

std::uint8_t byteOf(double value) { return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0))); }

double srgbOf(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

const std::vector<Broken>& allBroken()
{
    static const std::vector<Broken> all = {
        {"", [](std::uint8_t*) {}},
        {"two_channels", [](std::uint8_t* t) { t[2] = 0; }},
        {"two_channels", [](std::uint8_t* t) { t[2] = 90; }},
        // x in alpha, and red constant: DXT5nm.
        {"two_channels", [](std::uint8_t* t) { t[3] = t[0], t[0] = 255, t[2] = t[1]; }},
        {"", [](std::uint8_t* t) { t[2] = 255; }}, // a constant z of 1: slopes
        {"bgr", [](std::uint8_t* t) { std::swap(t[0], t[2]); }},
        {"srgb", [](std::uint8_t* t) { std::transform(t, t + 3, t, [](int c) { return byteOf(srgbOf(c / 255.0)); }); }},
        {"washed_out",
         [](std::uint8_t* t) { std::transform(t, t + 3, t, [](int c) { return std::uint8_t(128 + (c - 128) / 2); }); }},
        {"height", [](std::uint8_t* t) { t[1] = t[2] = t[0]; }},
        {"no_normals", [](std::uint8_t* t) { std::fill_n(t, 3, std::uint8_t(0)); }},
        {"no_normals",
         [](std::uint8_t* t) {
             t[0] = std::uint8_t(3 * t[0]), t[1] = std::uint8_t(7 * t[1]), t[2] = std::uint8_t(13 * t[0] + 5 * t[1]);
         }},
        {"object_space", [](std::uint8_t* t) { t[2] = t[0] % 2 == 0 ? t[2] : std::uint8_t(256 - t[2]); }},
    };
    return all;
}

// Two squares with a material each: one with the broken map, the other with a sound one. coat: as the map of a coat.
Scene squares(const Change& change, bool coat)
{
    Scene scene;
    for (const char* const name : {"broken", "sound"}) {
        Image map = makeReliefMap(Relief::waves, 64);
        map.name = name;
        for (std::size_t i = 0; scene.images.empty() && i < map.pixelCount(); ++i)
            change(map.bytes8() + 4 * i);
        const int index = int(scene.images.size());
        scene.images.push_back(std::move(map));
        Material material;
        material.name = name;
        material.coat.strength = 1;
        (coat ? material.coat.normalMap : material.normalMap).image = index;
        scene.materials.push_back(material);
        Mesh mesh = makePlane(1, 1, 1);
        mesh.material = index;
        scene.meshes.push_back(std::move(mesh));
        scene.instances.push_back({name, index, glm::mat4(1)});
    }
    return scene;
}

bool names(const std::vector<std::string>& lines, const std::string& words)
{
    return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

TEST(MapsOfModels, haveTheirFaultsNamedByEveryReader)
{
    for (const bool coat : {false, true})
        for (const Broken& broken : allBroken()) {
            const std::string kind = broken.kind, which = kind + (coat ? ", coat" : "");
            const Scene scene = squares(broken.change, coat);
            const LintReport report = lintScene(scene);
            ASSERT_EQ(report.maps.size(), 2u) << which;
            std::vector<std::string> kinds;
            for (const maps::Fault& fault : report.maps[0].faults)
                kinds.emplace_back(name(fault.kind));
            EXPECT_EQ(kinds, kind.empty() ? std::vector<std::string>() : std::vector{kind}) << which;
            EXPECT_TRUE(report.maps[1].faults.empty()) << which;
            const LintCheck check = checkLimits(report, {.area = 100});
            EXPECT_EQ(std::ranges::count(check.failures, "broken_map", &LintFailure::kind), kind.empty() ? 0 : 1)
                << which;
            const std::vector<std::string> drawn = maps::mapFaults(scene);
            ASSERT_EQ(drawn.size(), kind.empty() ? 0u : 1u) << which;
            EXPECT_TRUE(kind.empty() || names(drawn, "normal map broken: " + report.maps[0].faults[0].text)) << which;
            if (coat) // not written by gltfDocumentOf
                continue;
            auto document = gltfDocumentOf(scene);
            ASSERT_TRUE(document);
            const auto converted = convertModel(*document, {.frames = {Frame::mikktspace, Frame::orthonormal}});
            ASSERT_TRUE(converted) << converted.error().message;
            if (kind.empty())
                continue;
            EXPECT_TRUE(names(converted->notes, "broken: " + report.maps[0].faults[0].text)) << which;
            EXPECT_FALSE(names(converted->notes, "sound: ")) << which;
            EXPECT_EQ(report.advised.find("Nothing has to be changed"), std::string::npos) << report.advised;
        }
}

TEST(MapsOfModels, withAlphaOfZeroAreJudgedLikeOpaqueOnesAndMentioned)
{
    const Scene opaque = squares([](std::uint8_t*) {}, false);
    Scene transparent =
        squares([](std::uint8_t* t) { t[1] = std::uint8_t(256 - std::max<int>(t[1], 1)), t[3] = 0; }, false);
    const LintReport report = lintScene(transparent), other = lintScene(opaque);
    EXPECT_EQ(report.maps[0].verdict.green, maps::Green::down);
    EXPECT_EQ(other.maps[0].verdict.green, maps::Green::up);
    EXPECT_EQ(report.maps[0].verdict.confidence, other.maps[0].verdict.confidence);
    EXPECT_FALSE(checkLimits(report, {.degrees = 2}).passed());
    EXPECT_NE(report.maps[0].note.find("alpha is 0 everywhere"), std::string::npos);
    EXPECT_EQ(report.maps[1].note, "");
    EXPECT_TRUE(names(lintWarnings(report), "alpha is 0 everywhere"));
    EXPECT_TRUE(names(maps::mapFaults(transparent), "normal map broken: alpha is 0 everywhere"));
    // Alpha masks nothing in a model, not even where it is 0 on a part only.
    Scene half = squares([](std::uint8_t* t) { t[3] = t[0] < 128 ? 0 : 255; }, false);
    EXPECT_EQ(lintScene(half).maps[0].verdict.agreement, other.maps[0].verdict.agreement);
}

TEST(MapsOfModels, areNamedOnTheCommandLine)
{
    TemporaryFolder folder;
    auto document = gltfDocumentOf(squares([](std::uint8_t* t) { t[2] = 0; }, false));
    ASSERT_TRUE(document);
    ASSERT_TRUE(writeGltf(*document, folder / "m.glb"));
    const std::string expected = "broken: blue is the same everywhere: only two channels are stored, and glTF reads z "
                                 "from blue; cotan map convert --from gltf,xy --to gltf fixes it.";
    const std::vector<std::vector<std::string>> commands = {
        {"lint", "m.glb"},
        {"render", "m.glb", "-o", "r.png", "--size", "16x16", "--device", "reference"},
        {"compare", "m.glb", "--frames", "smooth,orthonormal", "-o", "c", "--size", "16x16", "--device", "reference"},
        {"convert", "m.glb", "--to-frame", "smooth", "-o", "s.glb"},
        {"convert", "m.glb", "--keep-maps", "-o", "k.glb"}};
    for (const auto& words : commands) {
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_NE((run.out + run.err).find(expected), std::string::npos) << words[0] << ": " << run.out << run.err;
        EXPECT_EQ((run.out + run.err).find("sound: blue"), std::string::npos) << words[0];
    }
    EXPECT_EQ(runTool({"lint", "m.glb", "--limit", "2"}, folder.path()).code, 5);
}

} // namespace
} // namespace cotan::test
