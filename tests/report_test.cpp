#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "inspect/angles.hpp"
#include "report/measurements.hpp"
#include "tangents_report.hpp"

namespace cotan {

using namespace app;
namespace {

Image directions(std::vector<std::array<float, 4>> pixels)
{
    Image image = makeImage(int(pixels.size()), 1, PixelType::float32);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        std::copy(pixels[i].begin(), pixels[i].end(), image.floats() + i * 4);
    return image;
}

nlohmann::json writtenOf(const Json& json) { return nlohmann::json::parse(toText(json)); }

TEST(Statistics, percentilesOfOneToHundredAreRanks)
{
    std::vector<float> v;
    for (int i = 100; i >= 1; --i)
        v.push_back(float(i) / 10);
    const AngleStatistics s = angleStatistics(v);
    EXPECT_EQ(s.count, 100u);
    EXPECT_NEAR(s.mean, 5.05, 1e-6);
    EXPECT_FLOAT_EQ(float(s.median), 5.0f); // 50 of 100 do not exceed it
    EXPECT_FLOAT_EQ(float(s.percentile95), 9.5f);
    EXPECT_FLOAT_EQ(float(s.percentile99), 9.9f);
    EXPECT_FLOAT_EQ(float(s.maximum), 10.0f);
    EXPECT_NEAR(s.over1, 0.90, 1e-9);
    EXPECT_NEAR(s.over5, 0.50, 1e-9);
}

TEST(Statistics, emptyInputGivesNaN)
{
    for (const AngleStatistics& s :
         {angleStatistics({}), AngleCounter().statistics(), angleStatistics({-1, -1}), AngleStatistics{}}) {
        EXPECT_EQ(s.count, 0u);
        for (double x : {s.mean, s.median, s.percentile95, s.percentile99, s.maximum, s.over1, s.over5})
            EXPECT_TRUE(std::isnan(x));
        EXPECT_FALSE(s.mean < 1 || s.maximum <= 0); // NaN passes no limit
        EXPECT_EQ(toText(s), "nothing was compared");
        const auto written = writtenOf(toJson(s));
        EXPECT_EQ(written["pixels"], 0);
        for (const char* figure : {"mean_degrees", "median_degrees", "percentile95_degrees", "percentile99_degrees",
                                   "max_degrees", "fraction_over_1_degree", "fraction_over_5_degrees"})
            EXPECT_TRUE(written[figure].is_null()) << figure;
    }
    EXPECT_TRUE(std::isnan(shareOpposed({-1, -1})));
}

TEST(Statistics, oneAngleGivesThatAngle)
{
    AngleCounter counter;
    counter.add(3.0f);
    for (const AngleStatistics& s : {counter.statistics(), angleStatistics({3.0f})}) {
        EXPECT_EQ(s.count, 1u);
        for (const double x : {s.mean, s.median, s.percentile95, s.percentile99, s.maximum})
            EXPECT_EQ(x, 3);
        EXPECT_EQ(s.over1, 1);
        EXPECT_EQ(s.over5, 0);
    }
}

TEST(Statistics, areWrittenUnderTheirNames)
{
    const AngleStatistics s = angleStatistics({0.5f, 0.25f, 2, 8});
    EXPECT_EQ(toText(s),
              "mean 2.688, median 0.500, 95 % 8.000, 99 % 8.000, max 8.00 degrees; over 1: 50.0 %, over 5: 25.0 %");
    const auto written = writtenOf(toJson(s));
    EXPECT_EQ(written["pixels"], 4);
    EXPECT_EQ(written["mean_degrees"], 2.6875);
    EXPECT_EQ(written["median_degrees"], 0.5);
    EXPECT_EQ(written["percentile95_degrees"], 8); // 95 % of four are more than three
    EXPECT_EQ(written["percentile99_degrees"], 8);
    EXPECT_EQ(written["max_degrees"], 8);
    EXPECT_EQ(written["fraction_over_1_degree"], 0.5);
    EXPECT_EQ(written["fraction_over_5_degrees"], 0.25);
}

TEST(Statistics, ignoreInvalidAngles)
{
    const AngleStatistics s = angleStatistics({3, -1, NAN, INFINITY, 1, -0.5f, 5});
    EXPECT_EQ(s.count, 3u);
    EXPECT_EQ(s.mean, 3);
    EXPECT_EQ(s.maximum, 5);
    EXPECT_EQ(s.over1, 2 / 3.0); // exactly 1 does not count
    EXPECT_EQ(s.over5, 0);
}

TEST(Measurements, withoutFiniteResultsAreNullInJson)
{
    const auto written = writtenOf(toJson(std::vector<Measurement>{{"t", "s", "x", "f", "S", "half", 10, 1, 2, 3, 0.5},
                                                                   {"t", "s", "y", "f", "S", "half", 10, 0, 0, 0, 1}}));
    EXPECT_EQ(written[0]["mean"], 1);
    EXPECT_EQ(written[0]["percentile95"], 2);
    EXPECT_EQ(written[0]["maximum"], 3);
    for (const char* figure : {"mean", "percentile95", "maximum"})
        EXPECT_TRUE(written[1][figure].is_null()) << figure;
}

TangentDifference difference(std::vector<float> degrees, std::size_t handedness)
{
    TangentDifference d;
    d.corners = degrees.size();
    d.degrees = std::move(degrees);
    d.handedness = handedness;
    return d;
}

TEST(TangentDifferenceText, describesTheDifferenceAndHidesRounding)
{
    const auto text = [](const TangentDifference& d) { return toText(d, "MikkTSpace"); };
    EXPECT_EQ(text(difference({0, 1e-6f}, 0)), "equal to MikkTSpace (max under 0.001 degrees)");
    EXPECT_EQ(text(difference({0, 1e-13f, 0, 0}, 1)), "directions equal to MikkTSpace; w differs on 1 of 4 corners");
    EXPECT_NE(text(difference({0, 0, 0}, 3)).find("w inverted against MikkTSpace on 100.0 %"), std::string::npos);
    EXPECT_NE(text(difference({0, 180, 0, 180}, 0)).find("half reversed against MikkTSpace"), std::string::npos);
    EXPECT_NE(text(difference({0, 7, 8, 9}, 0)).find("differs from MikkTSpace by mean 6"), std::string::npos);
    EXPECT_EQ(text(difference({}, 0)), "nothing to compare");
}

TEST(TangentDifferenceVerdict, changesExactlyAtItsLimits)
{
    const auto verdict = [](int opposed, int w) { // of 100 corners
        std::vector<float> degrees(100, 10.0f);
        std::fill_n(degrees.begin(), opposed, 170.0f);
        return verdictOf(difference(degrees, std::size_t(w)));
    };
    EXPECT_EQ(verdict(0, 90), TangentVerdict::inverted);
    EXPECT_EQ(verdict(0, 89), TangentVerdict::off);
    EXPECT_EQ(verdict(39, 0), TangentVerdict::off);
    EXPECT_EQ(verdict(40, 0), TangentVerdict::turned);
    EXPECT_EQ(verdict(60, 0), TangentVerdict::turned);
    EXPECT_EQ(verdict(61, 0), TangentVerdict::off);
    EXPECT_EQ(verdict(50, 95), TangentVerdict::inverted); // w is checked first
    EXPECT_EQ(verdictOf(difference({0, 0.049f}, 0)), TangentVerdict::equal);
    EXPECT_EQ(verdictOf(difference({0, 0.051f}, 0)), TangentVerdict::off);
    EXPECT_EQ(verdictOf(difference({0, 0.01f}, 1)), TangentVerdict::off);
    EXPECT_EQ(verdictOf(difference({}, 0)), TangentVerdict::nothing);
}

TEST(TangentDifferenceVerdict, isWrittenWithItsFractions)
{
    TangentDifference d = difference({10, 170, 20, 30}, 1);
    d.corners = 6;
    d.degenerate = 2;
    const auto written = writtenOf(toJson(d));
    EXPECT_EQ(written["verdict"], "off");
    EXPECT_EQ(written["corners"], 6);
    EXPECT_EQ(written["degenerate"], 2);
    EXPECT_EQ(written["w_different"], 0.25);
    EXPECT_EQ(written["reversed"], 0.25);
    EXPECT_EQ(written["directions"]["max_degrees"], 170);
    EXPECT_FALSE(written["directions"].contains("pixels"));
    EXPECT_NE(toText(d, "X").find("; 2 of 6 corners are degenerate"), std::string::npos) << toText(d, "X");
    TangentDifference sum = difference({1, 2}, 1);
    append(sum, d);
    EXPECT_EQ(sum.degrees.size(), 6u);
    EXPECT_EQ(sum.corners, 8u);
    EXPECT_EQ(sum.degenerate, 2u);
    EXPECT_EQ(sum.handedness, 2u);
}

TEST(Angles, areMeasuredWhereBothImagesHaveADirection)
{
    const Image a = directions({{1, 0, 0, 1}, {0, 0, 1, 1}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0, 0, 2, 1}});
    const Image b = directions({{0, 1, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 1}, {0, 0, 1, 1}, {0, 1, 1, 1}});
    const auto d = anglesBetween(a, b);
    EXPECT_FLOAT_EQ(d[0], 90);
    EXPECT_FLOAT_EQ(d[1], 180);
    EXPECT_EQ(d[2], -1); // no surface in a
    EXPECT_EQ(d[3], -1); // no direction in a
    EXPECT_FLOAT_EQ(d[4], 45);
    EXPECT_EQ(angleStatistics(d).count, 3u);
    EXPECT_NEAR(shareOpposed(d), 1.0 / 3, 1e-9);
}

TEST(Angles, interiorExcludesTheBorderOfTheComparedPixels)
{
    std::vector<float> d(25, 1.0f);
    keepInterior(d, 5, 5);
    EXPECT_EQ(std::count(d.begin(), d.end(), 1.0f), 9);
    d.assign(25, 1.0f);
    d[12] = -1;
    keepInterior(d, 5, 5);
    EXPECT_EQ(std::count(d.begin(), d.end(), 1.0f), 0);
}

TEST(Angles, interiorKeepsPixelsWithoutMissingNeighbours)
{
    std::vector<float> d(7 * 4, 1.0f);
    d[1 * 7 + 4] = -1; // (4,1)
    keepInterior(d, 7, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 7; ++x) {
            const bool inside = x > 0 && x < 6 && y > 0 && y < 3 && !(std::abs(x - 4) <= 1 && y <= 2);
            EXPECT_EQ(d[std::size_t(y * 7 + x)], inside ? 1.0f : -1.0f) << x << " " << y;
        }
}

TEST(HeatMap, interpolatesItsColourStops)
{
    const auto color = [](float degrees) {
        const Image h = heatMap({degrees}, 1, 1);
        return std::array{int(h.bytes8()[0]), int(h.bytes8()[1]), int(h.bytes8()[2])};
    };
    EXPECT_EQ(color(0.5f), (std::array{20, 60, 200}));
    EXPECT_EQ(color(2), (std::array{30, 180, 80}));
    EXPECT_EQ(color(5), (std::array{250, 220, 40}));
    EXPECT_EQ(color(15), (std::array{220, 30, 20}));
    EXPECT_EQ(color(45), (std::array{255, 255, 255}));
    EXPECT_EQ(color(3.5f), (std::array{140, 200, 60})); // half way
}

TEST(OutputColours, encodeDirectionsUvAndDepthOnSurfaces)
{
    const Image d = asColor(Output::normal, directions({{1, -1, 0, 1}, {0, 0, 1, 0}}));
    EXPECT_EQ(d.bytes8()[0], 255);
    EXPECT_EQ(d.bytes8()[1], 0);
    EXPECT_EQ(d.bytes8()[2], 128);
    EXPECT_EQ(d.bytes8()[3], 255);
    EXPECT_EQ(d.bytes8()[7], 0); // no surface
    const Image uv = asColor(Output::uv, directions({{1.2f, -0.2f, 0, 1}}));
    EXPECT_EQ(uv.bytes8()[0], 51);
    EXPECT_EQ(uv.bytes8()[1], 204);
    const Image depth = asColor(Output::depth, directions({{2, 0, 0, 1}, {4, 0, 0, 1}, {3, 0, 0, 1}, {9, 0, 0, 0}}));
    EXPECT_EQ(depth.bytes8()[0], 255);
    EXPECT_EQ(depth.bytes8()[4], 40);
    EXPECT_EQ(depth.bytes8()[8], 148); // 147.5 rounded
}

TEST(HeatMap, isBlackAtZeroWhiteAt45AndGreyWithoutComparison)
{
    const Image h = heatMap({0, 60, -1}, 3, 1);
    EXPECT_EQ(h.bytes8()[0], 0);
    EXPECT_EQ(h.bytes8()[4], 255);
    EXPECT_EQ(h.bytes8()[8], 96);
}

} // namespace
} // namespace cotan
