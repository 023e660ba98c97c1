// What commands share: option words in errors, lists of names, images of a comparison and the messages about it.
#include <gtest/gtest.h>

#include <cmath>

#include "cotan/image.hpp"
#include "loading.hpp"
#include "parse.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "smooth_report.hpp"
#include "terminal/command_words.hpp"
#include "up_mismatch.hpp"
#include "verify.hpp"

namespace cotan::app {
namespace {

using test::TemporaryFolder;
using Words = std::vector<std::string>;

TEST(CommandErrors, nameTheOptionAsItIsTyped)
{
    const auto errorText = [](const Error& error) {
        const Error worded = withOptionNames(error);
        EXPECT_EQ(worded.kind, error.kind);
        EXPECT_FALSE(worded.memory) << "a second call says the same";
        return worded.message;
    };
    EXPECT_EQ(errorText(about("options.maxDistance", usageError("expected 1; found 2"))),
              "--max-distance: expected 1; found 2");
    EXPECT_EQ(errorText(about("options.to", usageError("none"))), "--to: none");
    EXPECT_EQ(errorText(about("scene.up", inputError("none"))), "scene.up: none");
    EXPECT_EQ(errorText(memoryError("a.png: too large")), "a.png: too large (--memory raises it)");
    EXPECT_EQ(errorText(inputError("a.png: broken")), "a.png: broken");
    const std::vector<std::string_view> known = {"red", "green", "blue"};
    EXPECT_EQ(unknownWord("--colour", known, "grey").message, "--colour: expected red, green or blue; found 'grey'");
    EXPECT_EQ(notOneOf("--colour", known, "grey").message, "--colour: expected one of red, green, blue; found 'grey'");
    EXPECT_EQ(parseFrame("x", "--frame").error().message,
              "--frame: expected one of " + std::string(frameNames()) + "; found 'x'");
    EXPECT_EQ(*parseFrame("smooth", "--frame"), Frame::smooth);
}

TEST(CommandWordsSplit, atEachComma)
{
    EXPECT_EQ(splitAtCommas(""), Words{});
    EXPECT_EQ(splitAtCommas("a"), Words{"a"});
    EXPECT_EQ(splitAtCommas("ab,c,def"), (Words{"ab", "c", "def"}));
    EXPECT_EQ(splitAtCommas(",a,"), (Words{"", "a", ""}));
    const auto files = plannedIn("--verify", "f/g", {"a", "b"});
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].option, "--verify");
    EXPECT_EQ(files[0].file, std::filesystem::path("f/g/a"));
    EXPECT_EQ(files[1].file, std::filesystem::path("f/g/b"));
    EXPECT_TRUE(files[0].makesFolder && files[1].makesFolder);
}

TEST(CommandWordsSplit, shortOptionsFromTheirValuesUpToTwoDashes)
{
    EXPECT_EQ(withoutEquals({"-o=a", "-o=", "--x=y", "-o", "-p=-q=r", "x=y", "-=", "--", "-o=b"}),
              (Words{"-o", "a", "-o", "", "--x=y", "-o", "-p", "-q=r", "x=y", "-=", "--", "-o=b"}));
    const CommandNames tool{"tool", {{"render", {}}, {"help", {}}}}, other{"tool", {{"render", {}}}};
    const auto asks = [](const CommandNames& names, const Words& words) { return asksForHelp(names, words); };
    EXPECT_TRUE(asks(tool, {"help"}));
    EXPECT_TRUE(asks(tool, {"help", "render"}));
    for (const Words& words : {Words{}, {"help", "-h"}, {"help", "--help"}, {"render", "help"}})
        EXPECT_FALSE(asks(tool, words));
    EXPECT_FALSE(asks(other, {"help"}));
    for (const auto& [a, b, distance] : {std::tuple("", "", 0),
                                         {"ab", "ba", 1},
                                         {"ca", "abc", 3},
                                         {"abc", "abd", 1},
                                         {"abc", "xabc", 1},
                                         {"abcx", "abc", 1},
                                         {"abcd", "dcba", 3}})
        EXPECT_EQ(editDistance(a, b), std::size_t(distance)) << a << b;
}

TEST(BoxesRotated, haveZWhereYWas)
{
    const Bounds box = rotatedZUp({{1, 2, 3}, {5, 7, 11}}); // y becomes -z, z becomes y
    EXPECT_EQ(box.low, glm::vec3(1, 3, -7));
    EXPECT_EQ(box.high, glm::vec3(5, 11, -2));
}

// One pixel in a hundred of each view may differ.
TEST(BakeViews, matchIfAtMostOnePercentOfEachViewDiffers)
{
    const auto shows = [](std::initializer_list<std::pair<std::size_t, std::size_t>> views) {
        ComparedViews compared;
        for (const auto& [others, pixels] : views) {
            compared.views.emplace_back();
            compared.views.back().others = others;
            compared.views.back().pixels = pixels;
        }
        return showsHighSurface(compared);
    };
    EXPECT_TRUE(shows({}));
    EXPECT_TRUE(shows({{0, 0}}));
    EXPECT_TRUE(shows({{1, 100}, {10, 1000}}));
    EXPECT_FALSE(shows({{2, 199}, {0, 1000}}));
    EXPECT_FALSE(shows({{0, 1000}, {11, 1000}}));
    EXPECT_EQ(
        imageNames(kConversionNames, 2),
        (Words{"before-0.png", "after-0.png", "difference-0.png", "before-1.png", "after-1.png", "difference-1.png"}));
    EXPECT_EQ(imageNames(kBakeNames, 1), (Words{"high-0.png", "low-0.png", "error-0.png"}));
    EXPECT_EQ(imageNames(kBakeNames, 0), Words{});
}

// A quad whose uv are stretched by 3 along x and sheared: the cotangents are not perpendicular.
TEST(SmoothFigures, areTheAnglesAndLengthsOfTheCotangents)
{
    const std::vector<packed::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}};
    const std::vector<packed::vec3> normals(5, {0, 0, 1});
    std::vector<packed::vec2> texcoords;
    for (const packed::vec3& p : positions) // grad u = (3, 0), grad v = (1, 1)
        texcoords.emplace_back(3 * p.x, p.x + p.y);
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3};
    const SmoothStatistics s = smoothStatistics({positions, normals, texcoords, indices});
    EXPECT_EQ(s.vertices, 5u);
    EXPECT_EQ(s.added, 0u);
    EXPECT_EQ(s.without, 1u); // the vertex without triangles
    EXPECT_EQ(s.shear.count, 4u);
    EXPECT_NEAR(s.shear.mean, 45, 1e-4);
    EXPECT_NEAR(s.shear.maximum, 45, 1e-4);
    EXPECT_NEAR(s.stretchMedian, 3 / std::sqrt(2.0), 1e-5);
    EXPECT_NEAR(s.stretchMaximum, 3 / std::sqrt(2.0), 1e-5);
    SmoothStatistics found;
    found.vertices = 7, found.added = 2, found.without = 1;
    EXPECT_EQ(toText(found),
              "7 vertices (2 added where mirrored charts meet), 1 without a frame; no shear or stretch to "
              "measure");
    found.shear.count = 1;
    found.stretchMedian = 1.5, found.stretchMaximum = 2.25;
    EXPECT_TRUE(toText(found).ends_with("; stretch median 1.5, max 2.25")) << toText(found);
}

class VerifiedFiles : public ::testing::Test {
protected:
    void SetUp() override
    {
        test::write(test::quad(2), folder.path());
        common.quiet = true;
        common.threads = 1;
        options.before = options.after = folder / "quad.gltf";
        options.from = Frame::cotangent;
        options.to = Frame::cotangent;
        options.folder = folder / "v";
        options.device = "reference";
        options.memory = 100;
    }

    // Returns the error message, or an empty text.
    std::string refused()
    {
        const auto done = verifyConversion(options, common);
        return done ? "" : done.error().message;
    }

    TemporaryFolder folder;
    CommonOptions common;
    VerifyOptions options;
};

TEST_F(VerifiedFiles, errorsNameTheMissingFileFolderOrDevice)
{
    options.before = folder / "gone.gltf";
    EXPECT_NE(refused().find("gone.gltf"), std::string::npos) << refused();
    options.before = folder / "quad.gltf";
    options.after = folder / "lost.gltf";
    EXPECT_NE(refused().find("lost.gltf"), std::string::npos) << refused();
    options.after = options.before;
    options.device = "moon";
    EXPECT_NE(refused().find("moon"), std::string::npos) << refused();
    options.device = "reference";
    options.folder = folder / "quad.gltf";
    EXPECT_NE(refused().find("quad.gltf: cannot create"), std::string::npos) << refused();
}

} // namespace
} // namespace cotan::app
