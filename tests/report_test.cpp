#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "cotan/report/angles.hpp"
#include "cotan/report/tangent_difference.hpp"

namespace cotan {
namespace {

Image directions(std::vector<std::array<float, 4>> pixels)
{
    Image image = makeImage(int(pixels.size()), 1, PixelType::float32);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        std::copy(pixels[i].begin(), pixels[i].end(), image.floats() + i * 4);
    return image;
}

TEST(Statistics, ofOneToHundredAreItsRanks)
{
    std::vector<float> v;
    for (int i = 100; i >= 1; --i)
        v.push_back(float(i) / 10);
    const AngleStatistics s = statisticsOf(v);
    EXPECT_EQ(s.count, 100u);
    EXPECT_NEAR(s.mean, 5.05, 1e-6);
    EXPECT_FLOAT_EQ(float(s.median), 5.0f);        // rank floor(0.5*99) = 49
    EXPECT_FLOAT_EQ(float(s.percentile95), 9.5f);  // rank 94
    EXPECT_FLOAT_EQ(float(s.percentile99), 9.9f);  // rank 98
    EXPECT_FLOAT_EQ(float(s.maximum), 10.0f);
    EXPECT_NEAR(s.over1, 0.90, 1e-9);
    EXPECT_NEAR(s.over5, 0.50, 1e-9);
}

TEST(Statistics, ofNothingAreZero)
{
    EXPECT_EQ(statisticsOf({}).count, 0u);
    EXPECT_EQ(statisticsOf({}).maximum, 0);
}

TangentDifference difference(std::vector<float> degrees, std::size_t handedness)
{
    TangentDifference d;
    d.corners = degrees.size();
    d.degrees = std::move(degrees);
    d.handedness = handedness;
    return d;
}

TEST(TangentDifferenceText, saysInWordsWhatIsWrongAndPrintsNoRounding)
{
    const auto text = [](const TangentDifference& d) { return toText(d, "MikkTSpace"); };
    EXPECT_EQ(text(difference({0, 1e-6f}, 0)), "equal to MikkTSpace (max under 0.001 degrees)");
    EXPECT_EQ(text(difference({0, 1e-13f, 0, 0}, 1)), "directions equal to MikkTSpace; w different on 1 of 4 corners");
    EXPECT_NE(text(difference({0, 0, 0}, 3)).find("w inverted against MikkTSpace on 100.0 %"), std::string::npos);
    EXPECT_NE(text(difference({0, 180, 0, 180}, 0)).find("half of them turned against MikkTSpace"), std::string::npos);
    EXPECT_NE(text(difference({0, 7, 8, 9}, 0)).find("off MikkTSpace by mean 6"), std::string::npos);
    EXPECT_EQ(text(difference({}, 0)), "nothing to compare");
}

TEST(Angles, areMeasuredWhereBothPicturesHaveADirection)
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

TEST(Angles, interiorLeavesOutTheBorderOfWhatWasCompared)
{
    std::vector<float> d(25, 1.0f);
    keepInterior(d, 5, 5);
    EXPECT_EQ(std::count(d.begin(), d.end(), 1.0f), 9);
    d.assign(25, 1.0f);
    d[12] = -1;
    keepInterior(d, 5, 5);
    EXPECT_EQ(std::count(d.begin(), d.end(), 1.0f), 0);
}

TEST(HeatMap, isBlackAtZeroWhiteAt45AndGreyWhereNothingWasCompared)
{
    const Image h = heatMap({0, 60, -1}, 3, 1);
    EXPECT_EQ(h.bytes8()[0], 0);
    EXPECT_EQ(h.bytes8()[4], 255);
    EXPECT_EQ(h.bytes8()[8], 96);
}

} // namespace
} // namespace cotan
