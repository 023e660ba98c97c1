#include <gtest/gtest.h>

#include <set>

#include "cotan/convention.hpp"

namespace cotan {
namespace {

TEST(Convention, presetsAreFoundByTheirDistinctNames)
{
    std::set<std::string_view> names;
    for (const ConventionPreset& p : conventionPresets()) {
        EXPECT_EQ(conventionFromName(p.name), p.convention) << p.name;
        names.insert(p.name);
    }
    EXPECT_EQ(names.size(), conventionPresets().size());
    EXPECT_FALSE(conventionFromName("up"));
}

TEST(Convention, greenAlongVFollowsTheTableOfFour)
{
    Convention c;
    for (auto [up, v, along] : {std::tuple(true, VDirection::down, false), std::tuple(false, VDirection::down, true),
                                std::tuple(true, VDirection::up, true), std::tuple(false, VDirection::up, false)}) {
        c.greenUp = up;
        c.v = v;
        EXPECT_EQ(greenAlongV(c), along);
    }
}

TEST(Convention, knownEnginesPointGreenTheirWay)
{
    EXPECT_FALSE(greenAlongV(*conventionFromName("gltf")));    // green up, v down
    EXPECT_TRUE(greenAlongV(*conventionFromName("opengl")));   // green up, v up
    EXPECT_TRUE(greenAlongV(*conventionFromName("directx")));  // green down, v down
    EXPECT_TRUE(greenAlongV(*conventionFromName("unreal")));
    EXPECT_TRUE(greenAlongV(*conventionFromName("unity")));
}

// What a flat texel is after reading: 128 of 8 bits, 32768 of 16, 0.5 of floats.
TEST(Convention, zeroIsTheMiddleCodeOfEveryPresetAtEveryDepth)
{
    for (const ConventionPreset& p : conventionPresets())
        for (auto [bits, middle] : {std::pair(8, 128.0 / 255), {16, 32768.0 / 65535}, {32, 0.5}}) {
            const auto format = toFormat<f64::cotan_normal_format>(p.convention, 1, bits);
            EXPECT_NEAR(f64::cotan_expand(middle, format.expansion), 0, 1e-15) << p.name << " " << bits;
            EXPECT_NEAR(f64::cotan_compress(0, format.expansion), middle, 1e-15) << p.name << " " << bits;
            EXPECT_NEAR(f64::cotan_expand(1, format.expansion), 1, 1e-15);
        }
    EXPECT_EQ(expansionFor(COTAN_EXPAND_BIASED, 16), COTAN_EXPAND_BIASED);
    EXPECT_EQ(expansionFor(COTAN_EXPAND_SIGNED, 32), COTAN_EXPAND_SIGNED);
}

TEST(Convention, descriptionNamesEveryChoice)
{
    const std::string s = describe(*conventionFromName("unreal"));
    for (const char* part : {"tangent space", "two channels", "green down", "v down", "exact"})
        EXPECT_NE(s.find(part), std::string::npos) << part;
}

TEST(Convention, enumeratorsAreThePortableTextsNumbers)
{
    EXPECT_EQ(int(Expansion::exact), COTAN_EXPAND_EXACT);
    EXPECT_EQ(int(Expansion::biased), COTAN_EXPAND_BIASED);
    EXPECT_EQ(int(Expansion::signedValues), COTAN_EXPAND_SIGNED);
    EXPECT_EQ(int(Expansion::exact16), COTAN_EXPAND_EXACT16);
    EXPECT_EQ(int(Channels::xyz), COTAN_CHANNELS_XYZ);
    EXPECT_EQ(int(Channels::orthographic), COTAN_CHANNELS_ORTHOGRAPHIC);
    EXPECT_EQ(int(Channels::stereographic), COTAN_CHANNELS_STEREOGRAPHIC);
    EXPECT_EQ(int(Channels::slope), COTAN_CHANNELS_SLOPE);
}

} // namespace
} // namespace cotan
