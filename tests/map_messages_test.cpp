// Messages about maps: faults with their limits, reasons, the commands that fix a map, and counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cotan/maps.hpp"
#include "map_cases.hpp"

namespace cotan::maps {
namespace {

using namespace cases;

NormalStatistics validStatistics()
{
    NormalStatistics s;
    s.content = Content::tangentSpace;
    s.meanLength = 1;
    return s;
}

std::vector<std::string> namesOf(const std::vector<Fault>& faults)
{
    std::vector<std::string> names;
    for (const Fault& fault : faults)
        names.emplace_back(name(fault.kind));
    return names;
}

TEST(FaultRules, beginBeyondTheirBoundsAndStateTheLength)
{
    const auto ofLength = [](double length) {
        NormalStatistics s = validStatistics();
        s.meanLength = length;
        const auto faults = faultsOf(s);
        return faults.empty() ? "" : std::string(name(faults[0].kind)) + ": " + faults[0].text;
    };
    const std::string end = " long on average, not 1";
    EXPECT_EQ(ofLength(0.9), "");
    EXPECT_EQ(ofLength(1.05), "");
    EXPECT_EQ(ofLength(0.899), "washed_out: washed out: vectors are 0.90" + end);
    EXPECT_EQ(ofLength(0.07), "washed_out: washed out: vectors are 0.07" + end);
    EXPECT_EQ(ofLength(0.5), "washed_out: washed out: vectors are 0.50" + end);
    EXPECT_EQ(ofLength(0.8549), "washed_out: washed out: vectors are 0.85" + end);
    EXPECT_EQ(ofLength(1.051), "too_strong: too strong: vectors are 1.05" + end);
    EXPECT_EQ(ofLength(1.696), "too_strong: too strong: vectors are 1.70" + end);
    EXPECT_EQ(ofLength(2.004), "too_strong: too strong: vectors are 2.00" + end);
    // The code of flat (128 of 255) after the sRGB curve and after its inverse.
    const auto curve = [](double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; };
    const auto back = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    NormalStatistics s = validStatistics();
    s.transfer = Transfer::srgb;
    EXPECT_NE(faultsOf(s).at(0).text.find("flat is near " + std::to_string(std::lround(255 * curve(128 / 255.0)))
                                          + " instead of 128"),
              std::string::npos);
    s.transfer = Transfer::linearised;
    EXPECT_NE(faultsOf(s).at(0).text.find("flat is near " + std::to_string(std::lround(255 * back(128 / 255.0)))
                                          + " instead of 128"),
              std::string::npos);
}

TEST(FaultRules, followTheirFiguresInFixedOrder)
{
    using Names = std::vector<std::string>;
    GreenVerdict green;
    NormalStatistics s = validStatistics();
    EXPECT_EQ(namesOf(faultsOf(s, &green)), Names{});
    green.swapped = Swapped::no, green.green = Green::up;
    EXPECT_EQ(namesOf(faultsOf(s, &green)), Names{});
    green.swapped = Swapped::yes;
    EXPECT_EQ(namesOf(faultsOf(s, &green)), Names{"grb"});
    green.green = Green::down;
    EXPECT_EQ(namesOf(faultsOf(s, &green)), (Names{"grb", "green_down"}));
    green.swapped = Swapped::undecidable;
    EXPECT_EQ(namesOf(faultsOf(s, &green)), Names{"green_down"});
    EXPECT_EQ(namesOf(faultsOf(s)), Names{});
    s.eightBits = true, s.meanLength = 0.5;
    EXPECT_EQ(namesOf(faultsOf(s, &green)), (Names{"washed_out", "8_in_16", "green_down"}));
    s.transfer = Transfer::srgb; // lengths are meaningless under a curve
    EXPECT_EQ(namesOf(faultsOf(s)), (Names{"srgb", "8_in_16"}));
    s.transfer = Transfer::linearised, s.redIsZ = true;
    EXPECT_EQ(namesOf(faultsOf(s)), (Names{"linearised", "bgr", "8_in_16"}));
    s.transfer = Transfer::linear;
    EXPECT_EQ(namesOf(faultsOf(s)), (Names{"bgr", "8_in_16"}));
    s.redIsZ = false;
    for (const Content content : {Content::objectSpace, Content::twoChannel, Content::slopes, Content::signedValues})
        for (const double length : {0.5, 1.5}) {
            s.content = content, s.meanLength = length;
            EXPECT_EQ(namesOf(faultsOf(s)), Names{"8_in_16"}) << int(content);
        }
    s.content = Content::other, s.transfer = Transfer::srgb;
    EXPECT_EQ(namesOf(faultsOf(s)), Names{"8_in_16"});
}

TEST(FaultRules, areFixedByOneCommand)
{
    using Kind = Fault::Kind;
    const auto options = [](const std::vector<Kind>& kinds, Centre centre = Centre::exact) {
        std::vector<Fault> faults;
        for (const Kind kind : kinds)
            faults.push_back({kind, "it is " + std::string(name(kind))});
        NormalStatistics s = validStatistics();
        s.centre = centre;
        const std::string sentence = sentenceOf("a.png", faults, s), fix = fixOptions(faults, s);
        std::string expected = faults.empty() ? "" : "a.png: ";
        for (const Fault& fault : faults)
            expected += fault.text + "; ";
        EXPECT_EQ(sentence, faults.empty() ? "" : expected + "cotan map convert " + fix + " fixes it.");
        return fix;
    };
    EXPECT_EQ(options({}), "");
    EXPECT_EQ(options({Kind::srgb}), "--from gltf,srgb --to gltf");
    EXPECT_EQ(options({Kind::linearised}), "--from gltf,linearised --to gltf");
    EXPECT_EQ(options({Kind::redAndBlue}), "--from gltf,bgr --to gltf");
    EXPECT_EQ(options({Kind::redAndGreen}, Centre::biased), "--from gltf,grb --to gltf");
    EXPECT_EQ(options({Kind::tooShort}), "--from gltf --to gltf --normalise");
    EXPECT_EQ(options({Kind::tooLong}), "--from gltf --to gltf --normalise");
    EXPECT_EQ(options({Kind::eightBitsIn16}), "--from gltf --to gltf --bits 8");
    for (const Centre centre : {Centre::exact, Centre::unknown})
        EXPECT_EQ(options({Kind::greenDown}, centre), "--from directx --to opengl");
    EXPECT_EQ(options({Kind::greenDown}, Centre::biased), "--from directx,biased --to opengl,biased");
    EXPECT_EQ(
        options({Kind::greenDown, Kind::redAndGreen, Kind::redAndBlue, Kind::srgb, Kind::tooLong, Kind::eightBitsIn16},
                Centre::biased),
        "--from directx,biased,srgb,bgr,grb --to opengl,biased --normalise --bits 8");
}

TEST(MapContents, areDescribed)
{
    const std::pair<Content, const char*> words[] = {
        {Content::tangentSpace, "tangent space"}, {Content::objectSpace, "object space"},
        {Content::twoChannel, "two channels"},    {Content::slopes, "a slope map"},
        {Content::signedValues, "stored signed"}, {Content::flat, "one value"},
        {Content::grey, "a height map"},          {Content::other, "lengths far from 1"}};
    for (const auto& [content, word] : words)
        EXPECT_NE(describe(content).find(word), std::string::npos) << describe(content);
    EXPECT_EQ(std::string(name(Green::up)) + name(Green::down) + name(Green::undecidable), "updownundecidable");
    EXPECT_EQ(std::string(name(Swapped::no)) + name(Swapped::yes) + name(Swapped::undecidable), "noyesundecidable");
    EXPECT_EQ(std::string(name(Confidence::none)) + name(Confidence::likely) + name(Confidence::certain),
              "nonelikelycertain");
}

// The relief sin(0.9 x) sin(0.3 y), y up, rows down. Red and green differ, so that no exchange is detected.
glm::vec3 waveNormal(double x, double row, double size)
{
    const double y = -row;
    return ofSlopes(size * std::cos(0.9 * x) * std::sin(0.3 * y), size / 3 * std::sin(0.9 * x) * std::cos(0.3 * y));
}

TEST(GreenVerdicts, giveTheReasonForUndecidableImages)
{
    const auto expectReason = [](const Image& map, const char* words) {
        const GreenVerdict verdict = greenOf(map);
        EXPECT_NE(verdict.reason.find(words), std::string::npos) << words << ": " << verdict.reason;
        EXPECT_EQ(verdict.sampled, 1);
        if (std::string(words) != "belong to one relief") {
            EXPECT_EQ(verdict.green, Green::undecidable) << words;
            EXPECT_EQ(verdict.swapped, Swapped::undecidable) << words;
            EXPECT_EQ(verdict.confidence, Confidence::none) << words;
        }
    };
    const auto waves = [](int x, int y) { return waveNormal(x, y, 0.4); };
    for (const auto& [width, height] : {std::pair(2, 64), {64, 2}, {9, 11}, {11, 9}})
        expectReason(floatMap(width, height, waves), "too small");
    for (const auto& [width, height] : {std::pair(10, 10), {3, 34}, {34, 3}})
        EXPECT_EQ(greenOf(floatMap(width, height, waves)).reason.find("too small"), std::string::npos) << width;
    expectReason(floatMap(64, 48, [](int, int) { return ofSlopes(0.2, 0.1); }), "the same value");
    Noise noise(3);
    Image colours = makeImage(64, 48, PixelType::unorm8), grey = colours, ball = colours;
    for (int i = 0; i < 64 * 48; ++i) {
        const double a = (i % 64) * 0.098, b = (i / 64) * 0.065; // directions all around
        const glm::dvec3 n(std::cos(a) * std::sin(b), std::cos(b), std::sin(a) * std::sin(b));
        for (int c = 0; c < 3; ++c) {
            colours.bytes8()[4 * i + c] = std::uint8_t(40 + 150 * noise.next());
            grey.bytes8()[4 * i + c] = std::uint8_t(60 + i % 100);
            ball.bytes8()[4 * i + c] = std::uint8_t(std::lround(128 + 127 * n[c]));
        }
        for (Image* const image : {&colours, &grey, &ball})
            image->bytes8()[4 * i + 3] = 255;
    }
    expectReason(grey, "a height map has no green direction");
    expectReason(ball, "object space");
    expectReason(colours, "the lengths");
    expectReason(floatMap(64, 48, [](int x, int) { return ofSlopes(0.4 * std::sin(0.9 * x), 0); }), "rows and columns");
    expectReason(floatMap(64, 48, [](int, int y) { return ofSlopes(0, 0.4 * std::sin(0.9 * y)); }), "rows and columns");
    expectReason(floatMap(64, 48, [&](int, int) { return ofSlopes(noise.next() - 0.5, noise.next() - 0.5); }),
                 "do not agree on a relief");
    expectReason(floatMap(64, 48, waves), "belong to one relief");
    // Nearly a plane, steep, in 8 bits: only single codes change.
    Image plane = makeImage(64, 48, PixelType::unorm8);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::vec3 n = ofSlopes(1.2 + 0.0012 * x, 0.3 + 0.0009 * y);
            for (int c = 0; c < 4; ++c)
                plane.bytes8()[4 * (y * 64 + x) + c] = std::uint8_t(c == 3 ? 255 : std::lround(128 + 127 * n[c]));
        }
    expectReason(plane, "weaker than the rounding noise");
}

// 64 columns have 63 cells between neighbours; 31 of them lie entirely in the right half.
TEST(GreenVerdicts, countInformativeCells)
{
    const auto halved = [](int firstColumn) {
        Image map = makeImage(64, 48, PixelType::unorm8);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 64; ++x) {
                const glm::vec3 n = waveNormal(x, y, 0.4);
                for (int c = 0; c < 4; ++c)
                    map.bytes8()[4 * (y * 64 + x) + c] =
                        std::uint8_t(c == 3                ? 255
                                         : x < firstColumn ? 0
                                                           : std::lround(128 + 127 * n[c]));
            }
        return greenOf(map);
    };
    EXPECT_DOUBLE_EQ(halved(0).used, 1);
    EXPECT_DOUBLE_EQ(halved(32).used, 31.0 / 63);
    for (const int first : {0, 32}) {
        const GreenVerdict verdict = halved(first);
        EXPECT_EQ(verdict.green, Green::up);
        EXPECT_EQ(verdict.swapped, Swapped::no);
        EXPECT_EQ(verdict.confidence, Confidence::certain);
        EXPECT_GT(verdict.agreement, 0.9);
        EXPECT_LT(std::abs(verdict.exchanged), 0.5);
        EXPECT_GT(verdict.votes, 0.95);
        EXPECT_GT(verdict.deviations, 5);
        EXPECT_EQ(verdict.statistics.content, Content::tangentSpace);
    }
}

TEST(FileConvention, followsTheChannelsOfTheFile)
{
    StatedConvention stated;
    const auto messageFor = [&](int channels) {
        const auto convention = conventionOf(stated, "a.ktx2", channels, "--from");
        return convention ? "" : convention.error().message;
    };
    for (const int channels : {3, 4})
        EXPECT_EQ(conventionOf(stated, "a.ktx2", channels, "--from")->channels, Channels::xyz);
    EXPECT_EQ(conventionOf(stated, "a.ktx2", 2, "--from")->channels, Channels::orthographic);
    EXPECT_EQ(messageFor(1), "a.ktx2: expected a normal map of two or three channels; found one (grey)");
    EXPECT_EQ(conventionOf(stated, "a.ktx2", 1, "--from").error().kind, ErrorKind::input);
    stated.channels = true;
    EXPECT_EQ(messageFor(2), "--from: a.ktx2 stores two channels; found xyz, which needs three; leave it out");
    EXPECT_EQ(conventionOf(stated, "a.ktx2", 2, "--from").error().kind, ErrorKind::usage);
    EXPECT_EQ(messageFor(3), "");
    stated.convention.kind = MapKind::objectSpace;
    EXPECT_EQ(messageFor(2), "--from: a.ktx2 stores two channels; found object, which needs three");
    for (const Channels channels : {Channels::orthographic, Channels::stereographic, Channels::slope}) {
        stated.convention.channels = channels;
        for (const int count : {2, 3, 4})
            EXPECT_EQ(conventionOf(stated, "a.ktx2", count, "--from")->channels, channels);
    }
}

// Rows are processed sixteen at a time: texels at the boundaries count once.
TEST(SolvedHeights, countTexelsWithoutDirectionOnce)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const int row : {0, 1, 15, 16, 17, 31, 32, 39}) {
        const Image map = floatMap(5, 40, [&](int x, int y) {
            return y == row && x > 1 ? glm::vec3(nan, 0, 1) : ofSlopes(0.1 * x, 0.02 * y);
        });
        for (const Boundary boundary : {Boundary::periodic, Boundary::free})
            for (const Kernel kernel : {Kernel::spectral, Kernel::central}) {
                const Heights heights =
                    heightFromNormals(map, {.from = kFloats, .boundary = boundary, .kernel = kernel});
                EXPECT_EQ(heights.invalid, 3u) << row << int(boundary) << int(kernel);
                EXPECT_EQ(heights.texels.size(), 200u);
                EXPECT_EQ(heights.lowest, double(*std::ranges::min_element(heights.texels)));
                EXPECT_EQ(heights.highest, double(*std::ranges::max_element(heights.texels)));
            }
    }
    EXPECT_EQ(heightWorkBytes(3, 5), 15 * (2 * sizeof(float) + sizeof(float))); // complex numbers, and heights
}

// A wave down the image and one to the right, of texels that are twice and half as high as wide.
TEST(SolvedHeights, followTheTexelAspect)
{
    const int width = 12, height = 16;
    const double twoPi = 2 * 3.14159265358979;
    for (const double aspect : {1.0, 2.0, 0.5}) {
        const Image map = floatMap(width, height, [&](int x, int y) {
            return ofSlopes(0.3 * std::cos(twoPi * x / width), -0.4 * std::cos(twoPi * y / height));
        });
        const Heights heights = heightFromNormals(map, {.from = kFloats, .aspect = aspect});
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                EXPECT_NEAR(double(heights.texels[std::size_t(y * width + x)]),
                            0.3 * width / twoPi * std::sin(twoPi * x / width)
                                + 0.4 * aspect * height / twoPi * std::sin(twoPi * y / height),
                            1e-5);
        EXPECT_NEAR(heights.slope, std::sqrt(0.3 * 0.3 / 2 + 0.4 * 0.4 * aspect * aspect / 2), 1e-6);
        EXPECT_NEAR(heights.residual, 0, 1e-6);
        EXPECT_NEAR(heights.meanTilt, 0, 1e-5);
    }
}

// Toksvig's and the von Mises-Fisher formulas as published, at lengths of all sizes.
TEST(MipRoughness, followsItsFormulasUpToOne)
{
    for (const double roughness : {0.0, 0.2, 0.45, 0.9, 1.0})
        for (const double length : {0.02, 0.3, 0.7, 0.95, 0.9999}) {
            const double alpha2 = std::pow(roughness, 4), s = 2 / std::max(alpha2, 1e-9) - 2;
            const double toksvig = 2 / (s * length / (length + s * (1 - length)) + 2);
            const double kappa = (3 * length - std::pow(length, 3)) / (1 - length * length);
            EXPECT_NEAR(roughnessFromLength(roughness, length, VarianceModel::toksvig),
                        std::pow(std::clamp(toksvig, alpha2, 1.0), 0.25), 1e-12)
                << roughness << ' ' << length;
            EXPECT_NEAR(roughnessFromLength(roughness, length, VarianceModel::vmf),
                        std::pow(std::min(alpha2 + 2 / kappa, 1.0), 0.25), 1e-12)
                << roughness << ' ' << length;
        }
    EXPECT_EQ(roughnessFromLength(0.3, 0, VarianceModel::vmf), 1);
    EXPECT_NEAR(roughnessFromVariance(0.5, 0.1), std::pow(0.0625 + 0.1, 0.25), 1e-12);
    EXPECT_EQ(roughnessFromVariance(0.5, 0.95), 1);
    EXPECT_NEAR(roughnessFromVariance(0.5, 0), 0.5, 1e-12);
}

// Levels without any direction keep the roughness and have no length; with some, those determine both.
TEST(MipRoughness, isKeptAtLevelsWithoutDirections)
{
    const auto chain = [](int without) {
        return mipChain(
            floatMap(6, 3, [&](int x, int) { return x < without ? glm::vec3(0) : ofSlopes(x % 2 ? 0.6 : 0, 0); }),
            {.from = kFloats, .to = kFloats, .roughness = 0.4, .type = PixelType::float32});
    };
    for (const MipLevel& level : chain(6)) {
        EXPECT_EQ(level.meanLength, 0);
        EXPECT_NEAR(level.meanRoughness, 0.4, 1e-12);
    }
    // 6 x 3 becomes 3 x 1: pairs of slopes 0 and 0.6, of variance 0.09; the left pair is empty.
    const auto half = chain(2);
    ASSERT_EQ(half.size(), 3u);
    const double roughness = std::pow(0.0256 + 0.09, 0.25);
    EXPECT_NEAR(half[1].meanRoughness, (0.4 + 2 * roughness) / 3, 1e-6);
    EXPECT_NEAR(half[1].meanLength, std::cos(std::atan(0.6) / 2), 1e-6);
    EXPECT_NEAR(half[2].meanRoughness, roughness, 1e-6);
    EXPECT_NEAR(half[2].meanLength, std::cos(std::atan(0.6) / 2), 1e-6);
    EXPECT_NEAR(half[0].meanLength, 1, 1e-6);
    const float* const rough = half[1].roughness.floats();
    EXPECT_NEAR(double(rough[0]), 0.4, 1e-6);
    EXPECT_NEAR(double(rough[4]), roughness, 1e-6);
    EXPECT_EQ(rough[3], 1);
}

} // namespace
} // namespace cotan::maps
