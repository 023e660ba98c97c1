// The lines that `map info` and `map detect` print for their figures, and the names of the figures in reports.
#include <gtest/gtest.h>

#include "files/json.hpp"
#include "map_files/inspect.hpp"

namespace cotan::maps {

using namespace app;
namespace {

using Texts = std::vector<std::string>;

// No two figures are equal.
SurveyedFile surveyed()
{
    SurveyedFile file;
    file.width = 30;
    file.height = 20;
    NormalStatistics& s = file.statistics;
    s.content = Content::tangentSpace;
    s.centre = Centre::exact;
    s.meanLength = 0.99;
    s.lengthDeviation = 0.0123;
    s.shortened = 0.034;
    s.invalid = 0.011;
    s.belowHorizon = 0.022;
    s.outsideDisc = 0.033;
    s.mean = {0.1, -0.2, 0.9};
    s.meanTilt = 12.345;
    s.tilt = {0.5, 0.2, 0.1, 0.05, 0.04, 0.03, 0.02, 0.04, 0.02};
    s.rmsExact = 0.0011;
    s.rmsBiased = 0.0022;
    return file;
}

TEST(MapLines, printEveryFigureOfAMap)
{
    SurveyedFile file = surveyed();
    const Texts rest = {"invalid (not finite, or no length): 1.10 %; below the horizon: 2.20 %; x^2+y^2 over 1: 3.30 %",
                        "length: mean 0.9900, standard deviation 0.0123; under 0.9: 3.40 %",
                        "tilt from flat: mean 12.35 degrees; fraction from  0 50.0 %  10 20.0 %  20 10.0 %  30 5.0 %  "
                        "40 4.0 %  50 3.0 %  60 2.0 %  70 4.0 %  80+ 2.0 %",
                        "mean direction: 0.1000 -0.2000 0.9000"};
    const auto expectLines = [&](Texts expected, bool measured = true) {
        expected.insert(expected.end(), rest.begin(), measured ? rest.end() : rest.begin() + 1);
        if (!measured)
            expected.emplace_back("no texel has a direction to measure");
        Texts found = linesOf(file, "a b.png");
        found.at(0) = found.at(0).substr(0, found[0].find(", "));
        EXPECT_EQ(found, expected);
    };
    const std::string head = "a b.png: 30 x 20", tangent = "contents: tangent space";
    expectLines({head, tangent, "centre: 128 is zero (exact expansion): length error 0.0011, with 127.5 0.0022"});
    file.statistics.centre = Centre::biased;
    file.channels = 2;
    file.frame = "smooth";
    file.statistics.background = 0.125;
    expectLines({head, tangent, "the file stores two channels", "made for the frame: smooth",
                 "background (alpha 0, black, white, or areas of a colour that is not a normal): 12.50 %; left out "
                 "below",
                 "centre: 127.5 is zero (biased expansion, 2c-1): length error 0.0022, with 128 0.0011"});
    file = surveyed();
    file.statistics.centre = Centre::unknown;
    expectLines({head, tangent, "centre: 128 or 127.5: undecidable from the lengths"});
    file.statistics.content = Content::objectSpace;
    expectLines({head, "contents: object space (directions on both sides)",
                 "centre: 128 or 127.5: undecidable from the lengths"});
    file.statistics.content = Content::twoChannel;
    file.statistics.swizzle = Swizzle::greyAlpha;
    const std::string two = "contents: two channels (x and y; z is reconstructed)";
    expectLines({head, two, "channels: two (x as grey, y as alpha)"});
    file.statistics.swizzle = Swizzle::alphaGreen;
    expectLines({head, two, "channels: two (x in alpha, y in green)"});
    file.statistics.tilt = {};
    expectLines({head, two, "channels: two (x in alpha, y in green)"}, false);
    file = surveyed();
    file.statistics.tilt = {};
    file.statistics.tilt[8] = 0.01; // one measured figure suffices
    EXPECT_NE(linesOf(file, "a").back(), "no texel has a direction to measure");
    file.statistics.content = Content::grey;
    EXPECT_EQ(linesOf(file, "a").size(), 2u);
    EXPECT_EQ(linesOf(file, "a")[1], "contents: grey: a height map, not a normal map");
    file = surveyed();
    file.statistics.redIsZ = true;
    const Texts wrong = linesOf(file, "some where/a b.png");
    ASSERT_EQ(wrong.size(), 9u);
    EXPECT_EQ(wrong[3], "wrong: red and blue are exchanged: red points outwards everywhere, blue does not");
    EXPECT_TRUE(wrong[4].starts_with("to fix it: cotan map convert 'some where/a b.png' --from gltf,")) << wrong[4];
    EXPECT_TRUE(wrong[4].ends_with(" --to gltf -o 'a b-fixed.png'")) << wrong[4];
}

TEST(MapLines, jsonHasNullForUndefinedFigures)
{
    SurveyedFile file = surveyed();
    const Texts figures = {"mean_length", "length_deviation",  "shortened",
                           "mean",        "mean_tilt_degrees", "tilt_by_10_degrees"};
    const std::string whole = toText(toJson(file));
    for (const auto& [name, value] : {std::pair("mean_length", "0.99"),
                                      {"length_deviation", "0.0123"},
                                      {"shortened", "0.034"},
                                      {"invalid", "0.011"},
                                      {"below_horizon", "0.022"},
                                      {"outside_disc", "0.033"},
                                      {"mean_tilt_degrees", "12.345"},
                                      {"width", "30"},
                                      {"height", "20"},
                                      {"fix", "null"},
                                      {"stored_channels", "4"},
                                      {"centre", "\"exact\""},
                                      {"transfer", "\"linear\""},
                                      {"channels", "\"rg\""}})
        EXPECT_NE(whole.find("\"" + std::string(name) + "\": " + value), std::string::npos) << name << whole;
    EXPECT_EQ(whole.find("\"frame\""), std::string::npos);
    file.statistics.tilt = {};
    file.frame = "smooth";
    const std::string none = toText(toJson(file));
    for (const std::string& name : figures)
        EXPECT_NE(none.find("\"" + name + "\": null"), std::string::npos) << name;
    EXPECT_NE(none.find("\"frame\": \"smooth\""), std::string::npos);
    EXPECT_NE(none.find("\"invalid\": 0.011"), std::string::npos);
}

TEST(MapLines, explainTheVerdict)
{
    GreenOfFile found;
    GreenVerdict& v = found.verdict;
    v.green = Green::up;
    v.swapped = Swapped::no;
    v.confidence = Confidence::likely;
    const std::string bump =
        "bumps and dents look alike in a normal map: this assumes that red points right, as every convention does";
    EXPECT_EQ(linesOf(found, "a"), (Texts{"green: up (+Y, OpenGL, glTF), likely", bump}));
    v.swapped = Swapped::undecidable;
    v.used = 0.5;
    v.agreement = 0.876;
    v.deviations = 12.4;
    v.exchanged = -0.123;
    v.residualRatio = 3.456;
    v.votes = 0.789;
    v.sampled = 0.125;
    found.patches = 17;
    EXPECT_EQ(
        linesOf(found, "a"),
        (Texts{"green: up (+Y, OpenGL, glTF), likely; this relief does not show whether red and green are exchanged",
               "judged by 17 patches of 128 x 128 texels, evenly distributed: 12 % of the image",
               "agreement +0.88 (12 times its uncertainty; exchanged -0.12); the other way leaves 3.46 times as "
               "much unexplained; 79 % of the image agrees",
               bump}));
    v.green = Green::down;
    v.swapped = Swapped::yes;
    v.confidence = Confidence::certain;
    v.used = 0;
    v.sampled = 1;
    EXPECT_EQ(linesOf(found, "a.png"),
              (Texts{"green: down (-Y, Direct3D), certain; red and green are exchanged (the answer is for the map with "
                     "them exchanged back)",
                     "wrong: red and green are exchanged",
                     "wrong: green points down (DirectX), which glTF and OpenGL read as dents",
                     linesOf(found, "a.png").at(3), bump}));
    EXPECT_TRUE(linesOf(found, "a.png").at(3).starts_with("to fix it: cotan map convert a.png --from directx,"));
    v = {};
    v.reason = "It is too small.";
    EXPECT_EQ(linesOf(found, "a"), Texts{"green: undecidable; It is too small."});
}

} // namespace
} // namespace cotan::maps
