#include <gtest/gtest.h>

#include <set>

#include "cotan/convention.hpp"

namespace cotan {
namespace {

TEST(Convention, presetsAreFoundByTheirUniqueNames)
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

TEST(Convention, theFormatFlipsGreenByTheDirectionOfV)
{
    Convention c;
    for (auto [up, v, sign] : {std::tuple(true, VDirection::down, -1.0), std::tuple(false, VDirection::down, 1.0),
                               std::tuple(true, VDirection::up, 1.0), std::tuple(false, VDirection::up, -1.0)}) {
        c.greenUp = up;
        c.v = v;
        EXPECT_EQ(toFormat<f64::cotan_normal_format>(c).green, sign);
        EXPECT_EQ(toFormat<f64::cotan_normal_format>(c, 0.5).strength, 0.5);
    }
}

TEST(Convention, knownEnginesPointGreenTheirWay)
{
    EXPECT_FALSE(greenAlongV(*conventionFromName("gltf")));   // green up, v down
    EXPECT_TRUE(greenAlongV(*conventionFromName("opengl")));  // green up, v up
    EXPECT_TRUE(greenAlongV(*conventionFromName("directx"))); // green down, v down
    EXPECT_TRUE(greenAlongV(*conventionFromName("unreal")));
    EXPECT_TRUE(greenAlongV(*conventionFromName("unity")));
}

// What a flat texel decodes from: 128 of 8 bits, 32768 of 16, 0.5 of floats.
TEST(Convention, flatDecodesFromTheMiddleCodeAtEveryDepth)
{
    for (auto [bits, middle] : {std::pair(8, 128.0 / 255), {16, 32768.0 / 65535}, {32, 0.5}}) {
        const auto format = toFormat<f64::cotan_normal_format>(*parseConvention("exact"), 1, bits);
        EXPECT_NEAR(f64::cotan_expand(middle, format.expansion), 0, 1e-15) << bits;
        EXPECT_NEAR(f64::cotan_compress(0, format.expansion), middle, 1e-15) << bits;
        EXPECT_NEAR(f64::cotan_expand(1, format.expansion), 1, 1e-15);
    }
    EXPECT_EQ(expansionFor(Expansion::biased, 16), COTAN_EXPAND_BIASED);
    EXPECT_EQ(expansionFor(Expansion::signedValues, 32), COTAN_EXPAND_SIGNED);
}

TEST(Convention, descriptionNamesEveryChoice)
{
    const std::string s = describe(*parseConvention("unreal,xy"));
    for (const char* part : {"tangent space", "two channels", "green down", "v down", "biased"})
        EXPECT_NE(s.find(part), std::string::npos) << part;
}

TEST(Convention, enumeratorsEqualTheConstantsOfThePortableText)
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

TEST(Convention, presetsMatchTheEnginesImporters)
{
    struct Expected {
        const char* name;
        bool greenUp;
        VDirection v;
        bool twoOnGpu;
        Expansion expansion;
    };
    using enum VDirection;
    using enum Expansion;
    // From each program's own documentation, which src/core/convention.cpp cites: the direction of green, where v = 0
    // is, whether the import drops blue, and how its shader expands bytes. All importers are given three channels.
    const Expected table[] = {
        {"gltf", true, down, false, biased},    {"opengl", true, up, false, exact},
        {"directx", false, down, false, exact}, {"unity", true, up, true, biased},
        {"unreal", false, down, true, biased},  {"blender", true, up, false, biased},
        {"godot", true, down, true, biased},    {"maya", true, up, false, exact},
        {"3dsmax", false, up, false, exact},    {"source", false, down, false, exact},
    };
    EXPECT_EQ(conventionPresets().size(), std::size(table));
    for (const Expected& e : table) {
        const auto c = conventionFromName(e.name);
        ASSERT_TRUE(c) << e.name;
        EXPECT_EQ(c->kind, MapKind::tangentSpace) << e.name;
        EXPECT_EQ(c->greenUp, e.greenUp) << e.name;
        EXPECT_EQ(c->v, e.v) << e.name;
        EXPECT_EQ(c->channels, Channels::xyz) << e.name;
        EXPECT_EQ(c->expansion, e.expansion) << e.name;
        EXPECT_EQ(parseConvention(std::string(e.name) + ",exact")->expansion, exact) << e.name;
        Convention onGpu = *c;
        onGpu.channels = e.twoOnGpu ? Channels::orthographic : Channels::xyz;
        EXPECT_EQ(*parseSampledConvention(e.name), onGpu) << e.name;
        EXPECT_EQ(parseConvention(std::string(e.name) + ",xy")->channels, Channels::orthographic) << e.name;
    }
}

TEST(Convention, channelWordsAreDistinguishedFromPresets)
{
    for (const char* words : {"gltf", "unity", "directx,biased", "green-down", "unreal,green-up,signed"}) {
        EXPECT_FALSE(parseStatedConvention(words)->channels) << words;
        EXPECT_EQ(parseStatedConvention(words)->convention, *parseConvention(words)) << words;
    }
    for (const char* words : {"gltf,xyz", "unity,xy", "orthographic", "gltf,stereographic", "slope,biased", "object"})
        EXPECT_TRUE(parseStatedConvention(words)->channels) << words;
    EXPECT_EQ(*parseConvention("unity,xy"), *parseConvention("unity,orthographic"));
    EXPECT_EQ(parseSampledConvention("unity,xyz")->channels, Channels::xyz);
    EXPECT_EQ(parseSampledConvention("unity,biased")->channels, Channels::orthographic);
    EXPECT_FALSE(parseStatedConvention("unity,xz"));
    EXPECT_FALSE(parseSampledConvention(""));
}

TEST(Convention, everyValueHasAWord)
{
    Convention c;
    const auto says = [&](const char* word) { return describe(c).find(word) != std::string::npos; };
    c.kind = MapKind::objectSpace;
    c.channels = Channels::stereographic;
    c.greenUp = true;
    c.v = VDirection::up;
    c.expansion = Expansion::signedValues;
    for (const char* word : {"object space", "stereographic", "green up", "v up", "signed"})
        EXPECT_TRUE(says(word)) << word << " in " << describe(c);
    c.kind = MapKind::height;
    c.channels = Channels::slope;
    c.expansion = Expansion::exact;
    for (const char* word : {"height", "slopes", "exact"})
        EXPECT_TRUE(says(word)) << word << " in " << describe(c);
    c.channels = Channels::xyz;
    EXPECT_TRUE(says("xyz")) << describe(c);
}

TEST(Convention, convertsToTheFormatOfThePortableText)
{
    Convention c;
    c.expansion = Expansion::biased;
    c.channels = Channels::slope;
    c.greenUp = false; // v points up: green is opposite
    c.v = VDirection::up;
    const auto f = toFormat<f32::cotan_normal_format>(c, 2.5);
    EXPECT_EQ(f.expansion, COTAN_EXPAND_BIASED);
    EXPECT_EQ(f.channels, COTAN_CHANNELS_SLOPE);
    EXPECT_EQ(f.green, -1);
    EXPECT_EQ(f.strength, 2.5f);
    EXPECT_EQ(toFormat<f64::cotan_normal_format>(Convention{}).strength, 1);
}

} // namespace
} // namespace cotan
