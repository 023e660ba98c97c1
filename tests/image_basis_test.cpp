// KTX2 with Basis Universal (UASTC and ETC1S): channels, damage, and blocks whose texels follow from the specification.
// tests/python/test_basisu.py compares all modes with Binomial's transcoder.
#include "cotan/image.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "ktx2_bytes.hpp"
#include "ktx2_maker.hpp"

namespace cotan {
namespace {

using test::Ktx2File;
using test::little;
using test::makeKtx2;
using test::zstd;
using namespace std::string_literals;
using Texel = std::array<int, 4>;

Result<Image> basisImage(const Ktx2File& file)
{
    const std::string bytes = makeKtx2(file);
    return decodeImage(std::as_bytes(std::span(bytes)), "a.ktx2", {});
}

std::string basisRefusal(const Ktx2File& file)
{
    const auto image = basisImage(file);
    return image ? "accepted" : image.error().message;
}

Texel basisTexel(const Image& image, int x, int y)
{
    const std::uint8_t* at = image.bytes8() + 4 * (y * image.width + x);
    return {at[0], at[1], at[2], at[3]};
}

// Bits of a stream, the lowest of each byte first.
class BitWriter {
public:
    void put(std::uint32_t value, int count)
    {
        for (int i = 0; i < count; ++i) {
            if (bits_ % 8 == 0)
                bytes_ += '\0';
            bytes_.back() = char(bytes_.back() | (value >> i & 1) << bits_ % 8);
            ++bits_;
        }
    }

    std::string bytes(std::size_t size = 0) const
    {
        return bytes_ + std::string(std::max(size, bytes_.size()) - bytes_.size(), '\0');
    }

private:
    std::string bytes_;
    std::size_t bits_ = 0;
};

// ---- UASTC ----------------------------------------------------------------------------------

// Mode 8: a code of 5 bits and one colour.
std::string solidBlock(const Texel& color)
{
    BitWriter bits;
    bits.put(0x17, 5);
    for (const int c : color)
        bits.put(std::uint32_t(c), 8);
    return bits.bytes(16);
}

Ktx2File uastc(const std::string& blocks, int channelType, std::uint32_t width = 4, std::uint32_t height = 4)
{
    return {.format = 0,
            .width = width,
            .height = height,
            .levels = {{blocks}},
            .colourModel = 166,
            .channelTypes = {channelType}};
}

TEST(Uastc, theChannelsAreThoseOfTheDescriptor)
{
    const struct {
        int type;
        Texel stored, read;
        int channels;
    } cases[] = {
        {0, {10, 20, 30, 255}, {10, 20, 30, 255}, 3}, // RGB
        {3, {10, 20, 30, 40}, {10, 20, 30, 40}, 4},   // RGBA
        {4, {10, 10, 10, 255}, {10, 10, 10, 255}, 1}, // RRR
        {5, {10, 10, 10, 40}, {10, 40, 128, 255}, 2}, // RRRG
        {6, {10, 20, 30, 40}, {10, 20, 128, 255}, 2}, // RG: blue and alpha mean nothing
    };
    for (const auto& c : cases) {
        const auto image = basisImage(uastc(solidBlock(c.stored), c.type));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(basisTexel(*image, 3, 2), c.read) << c.type;
        EXPECT_EQ(image->channels, c.channels) << c.type;
    }
}

// Mode 18 has one subset: 15 bits of hints, endpoints of 5 bits, and weights of 5 bits, the first one of 4.
TEST(Uastc, endpointsAreInterpolatedByWeights)
{
    BitWriter bits;
    bits.put(9, 4);
    bits.put(0, 15);
    for (const int value : {0, 31, 31, 0, 16, 16}) // 0 to 255, 255 to 0, and 16 of 31, which is 132 of 255
        bits.put(std::uint32_t(value), 5);
    bits.put(0, 4);
    for (int i = 1; i < 16; ++i)
        bits.put(std::uint32_t(i == 15 ? 31 : i), 5);
    const auto image = basisImage(uastc(bits.bytes(16), 0));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(basisTexel(*image, 0, 0), (Texel{0, 255, 132, 255}));
    EXPECT_EQ(basisTexel(*image, 3, 3), (Texel{255, 0, 132, 255}));
    // The weight 8 of 31 is 16 of 64: 255 * 257 * 16 / 64 is 16383.75, rounded 16384, of which 64 are the upper 8 bits.
    EXPECT_EQ(basisTexel(*image, 0, 2), (Texel{64, 191, 132, 255}));
}

TEST(Uastc, blocksThatReachOverTheEdgeAndPackedLevelsAreRead)
{
    const std::string blocks = solidBlock({1, 2, 3, 255}) + solidBlock({4, 5, 6, 255});
    const auto image = basisImage(uastc(blocks, 0, 5, 3));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(basisTexel(*image, 3, 2), (Texel{1, 2, 3, 255}));
    EXPECT_EQ(basisTexel(*image, 4, 2), (Texel{4, 5, 6, 255}));
    Ktx2File packed = uastc(zstd(blocks), 0, 5, 3);
    packed.packing = 2;
    packed.levels[0].plainBytes = 32;
    const auto unpacked = basisImage(packed);
    ASSERT_TRUE(unpacked) << unpacked.error().message;
    EXPECT_EQ(unpacked->data, image->data);
}

TEST(Uastc, swizzlesOfTwoChannelsNameThemByAnyOfTheirNames)
{
    Ktx2File file = uastc(solidBlock({10, 10, 10, 40}), 5);
    for (const std::string swizzle : {"rg01", "ra01", "rrrg", "rgb1"}) {
        file.keys = {"KTXswizzle\0"s + swizzle + '\0'};
        const auto image = basisImage(file);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(basisTexel(*image, 0, 0), (Texel{10, 40, 128, 255})) << swizzle;
        EXPECT_EQ(image->channels, 2);
    }
    file.keys = {"KTXswizzle\0gr01\0"s};
    EXPECT_EQ(basisRefusal(file),
              "a.ktx2: broken ktx2 image: KTXswizzle gr01 contradicts its descriptor, whose channels are RRRG");
    file = uastc(solidBlock({10, 20, 30, 40}), 3); // RGBA: applied as in other files
    file.keys = {"KTXswizzle\0ra01\0"s};
    EXPECT_EQ(basisTexel(*basisImage(file), 0, 0), (Texel{10, 40, 0, 255}));
    EXPECT_EQ(basisImage(file)->channels, 2);
}

TEST(Uastc, damageAndContradictionsAreRefused)
{
    const std::string good = solidBlock({1, 2, 3, 255});
    const auto refused = [](const Ktx2File& file, const std::string& why) {
        const std::string message = basisRefusal(file);
        EXPECT_TRUE(message.starts_with("a.ktx2: broken ktx2 image: ")) << message;
        EXPECT_NE(message.find(why), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    };
    refused(uastc(good + "\x45"s + std::string(15, '\0'), 0, 8, 4), "block 1, 0 has no mode"); // mode 19 is reserved
    // Mode 2 has 30 partition patterns: number 30 after 5 bits of code and 15 of hints.
    BitWriter bits;
    bits.put(0x1d, 5), bits.put(0, 15), bits.put(30, 5);
    refused(uastc(bits.bytes(16), 0), "partition pattern");
    refused(uastc(solidBlock({1, 2, 3, 40}), 0),
            "texel 0, 0 has the alpha 40 of 255, its descriptor has the channels RGB");
    refused(uastc(solidBlock({1, 2, 3, 40}), 4), "its descriptor has the channels RRR");
    refused(uastc(good, 1), "channel type 1; expected 0, 3, 4, 5 or 6");
    Ktx2File file = uastc(good, 0);
    file.channelTypes = {};
    refused(file, "its descriptor has 0 channels");
    file.channelTypes = {0, 15};
    refused(file, "its descriptor has 2 channels");
    file = uastc(good, 0), file.colourModel = 1;
    refused(file, "colour model 1; expected 163 (ETC1S) or 166 (UASTC)");
    file = uastc(good, 0), file.packing = 1;
    refused(file, "its supercompression is 1; expected 0, 2 or 3 for UASTC");
    refused(uastc(good + good, 0), "its size requires 16");
    refused(uastc(good.substr(1), 0), "its size requires 16");
    std::string far = makeKtx2(uastc(good, 0));
    far.replace(48, 4, little(0xfffffff0, 4));
    const auto image = decodeImage(std::as_bytes(std::span(far)), "a.ktx2", {});
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("its descriptor takes 44 bytes from 4294967280"), std::string::npos)
        << image.error().message;
}

// ---- ETC1S ----------------------------------------------------------------------------------

// A table in which all of `symbols`, one or a power of two of them in rising order, have codes of one length; and codes
// of such tables.
struct EqualCodes {
    std::vector<std::uint32_t> symbols;

    int bits() const
    {
        int count = 1;
        while (std::size_t(1) << count < symbols.size())
            ++count;
        return count;
    }

    void putTable(BitWriter& out) const
    {
        constexpr std::array<int, 21> order{17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
        out.put(symbols.back() + 1, 14);
        out.put(order.size(), 5);
        const bool gaps = symbols.back() + 1 > symbols.size();
        for (const int length : order)
            out.put(length == bits() || (length == 0 && gaps) ? 1 : 0, 3);
        for (std::uint32_t s = 0; s <= symbols.back(); ++s)
            out.put(gaps && std::ranges::binary_search(symbols, s) ? 1 : 0, 1);
    }

    // Codes start with their highest bit.
    void put(BitWriter& out, std::uint32_t symbol) const
    {
        const auto code = std::uint32_t(std::ranges::lower_bound(symbols, symbol) - symbols.begin());
        for (int i = bits() - 1; i >= 0; --i)
            out.put(code >> i & 1, 1);
    }
};

// Two selectors, and four endpoints: the first colour is at (16, 16, 16), others differ from the one before.
std::string endpointCodebook()
{
    const EqualCodes low{{0, 5}}, middle{{0, 2, 4, 31}}, high{{0, 9}}, tables{{0, 1, 3, 7}};
    BitWriter out;
    for (const EqualCodes* codes : {&low, &middle, &high, &tables})
        codes->putTable(out);
    out.put(0, 1);
    tables.put(out, 1), middle.put(out, 4), middle.put(out, 0), middle.put(out, 31); // (20, 16, 15), table 1
    tables.put(out, 3), middle.put(out, 4), middle.put(out, 2), middle.put(out, 2);  // (24, 18, 17), table 4
    tables.put(out, 7), high.put(out, 9), middle.put(out, 0), middle.put(out, 31);   // (1, 18, 16), table 3
    tables.put(out, 0), low.put(out, 5), middle.put(out, 4), middle.put(out, 2);     // (6, 22, 18), table 3
    return out.bytes();
}

struct TestEndpoint {
    std::array<int, 3> color; // of 5 bits v: v * 8 + v / 4
    int small, large;
};
constexpr std::array<TestEndpoint, 4> kEndpoints{
    {{{165, 132, 123}, 5, 17}, {{198, 148, 140}, 18, 60}, {{8, 148, 132}, 13, 42}, {{49, 181, 148}, 13, 42}}};

std::string selectorCodebook()
{
    const EqualCodes rows{{0, 0xff}};
    BitWriter out;
    out.put(0, 3);
    rows.putTable(out);
    for (const std::uint32_t row : {0xe4, 0x1b, 0x00, 0xff})
        out.put(row, 8);
    for (const std::uint32_t change : {0xff, 0, 0xff, 0xff})
        rows.put(out, change);
    return out.bytes();
}

// Indices by rows: 0xe4 is 0, 1, 2, 3 from the left.
constexpr std::array<std::array<int, 16>, 2> kSelectors{
    {{0, 1, 2, 3, 3, 2, 1, 0, 0, 0, 0, 0, 3, 3, 3, 3}, {3, 2, 1, 0, 3, 2, 1, 0, 3, 3, 3, 3, 0, 0, 0, 0}}};

// A group of 2 x 2 blocks has two bits for each: 3 from the stream, 0 as on the left, 1 as above, 2 as above left.
const EqualCodes kSources{{3 | 3 << 4, 3 | 0 << 2 | 1 << 4 | 2 << 6}}, kDeltas{{1, 3}},
    kSelectorCodes{{0, 1, 3, 5}}, // two selectors; 3 is the second of a history of three, 5 a run
    kRuns{{0, 1}};

std::string sliceTables(std::uint32_t history = 3)
{
    BitWriter out;
    for (const EqualCodes* codes : {&kSources, &kDeltas, &kSelectorCodes, &kRuns})
        codes->putTable(out);
    out.put(history, 13);
    return out.bytes();
}

// 3 x 2 blocks. Endpoints: 1, 1, 0; 1, 1, 2. Selectors: 1, and the same from the history; 0; a run of 3 from the
// history.
std::string colorSlice()
{
    BitWriter out;
    kSources.put(out, kSources.symbols[1]), kDeltas.put(out, 1), kSelectorCodes.put(out, 1);
    kSelectorCodes.put(out, 3);
    kSources.put(out, kSources.symbols[0]), kDeltas.put(out, 3), kSelectorCodes.put(out, 0);
    kSelectorCodes.put(out, 5), kRuns.put(out, 0);
    kDeltas.put(out, 1);
    return out.bytes();
}

// Endpoints: 3, 3, 0; 3, 3, 2. Selectors: 0, 0, 0; 1, 1, 1.
std::string alphaSlice()
{
    BitWriter out;
    kSources.put(out, kSources.symbols[1]), kDeltas.put(out, 3), kSelectorCodes.put(out, 0);
    kSelectorCodes.put(out, 0);
    kSources.put(out, kSources.symbols[0]), kDeltas.put(out, 1), kSelectorCodes.put(out, 0);
    kSelectorCodes.put(out, 1), kSelectorCodes.put(out, 1);
    kDeltas.put(out, 3), kSelectorCodes.put(out, 1);
    return out.bytes();
}

struct Etc1s {
    std::vector<int> channelTypes = {0, 15};
    std::uint32_t endpointCount = 4, selectorCount = 2, flags = 0, extended = 0;
    std::string endpoints = endpointCodebook(), selectors = selectorCodebook(), tables = sliceTables();
    std::string color = colorSlice(), alpha = alphaSlice();
    int colorAt = 0; // of the level, instead of its start
};

Ktx2File fileOf(const Etc1s& e)
{
    const bool two = e.channelTypes.size() == 2;
    const std::string alpha = two ? e.alpha : "";
    const std::string image = little(e.flags, 4) + little(std::uint64_t(e.colorAt), 4) + little(e.color.size(), 4)
        + little(two ? e.color.size() : 0, 4) + little(alpha.size(), 4);
    return {.format = 0,
            .width = 11,
            .height = 7,
            .packing = 1,
            .levels = {{e.color + alpha}},
            .colourModel = 163,
            .channelTypes = e.channelTypes,
            .global = little(e.endpointCount, 2) + little(e.selectorCount, 2) + little(e.endpoints.size(), 4)
                + little(e.selectors.size(), 4) + little(e.tables.size(), 4) + little(e.extended, 4) + image
                + e.endpoints + e.selectors + e.tables};
}

std::array<int, 3> colorOf(int endpoint, int selector, int x, int y)
{
    const TestEndpoint& e = kEndpoints[std::size_t(endpoint)];
    const int index = kSelectors[std::size_t(selector)][std::size_t(4 * (y % 4) + x % 4)];
    const int change = std::array{-e.large, -e.small, e.small, e.large}[std::size_t(index)];
    std::array<int, 3> color{};
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = std::clamp(e.color[c] + change, 0, 255);
    return color;
}

TEST(Etc1s, slicesAreDecodedAsTheirStreamsSay)
{
    constexpr std::array<int, 6> colors{1, 1, 0, 1, 1, 2}, colorSelectors{1, 1, 0, 1, 1, 1};
    constexpr std::array<int, 6> alphas{3, 3, 0, 3, 3, 2}, alphaSelectors{0, 0, 0, 1, 1, 1};
    for (const bool two : {false, true}) {
        const auto image = basisImage(fileOf({.channelTypes = two ? std::vector{0, 15} : std::vector{0}}));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->channels, two ? 4 : 3);
        for (int y = 0; y < 7; ++y)
            for (int x = 0; x < 11; ++x) {
                const auto block = std::size_t(3 * (y / 4) + x / 4);
                const auto color = colorOf(colors[block], colorSelectors[block], x, y);
                const int alpha = two ? colorOf(alphas[block], alphaSelectors[block], x, y)[0] : 255;
                EXPECT_EQ(basisTexel(*image, x, y), (Texel{color[0], color[1], color[2], alpha})) << x << ' ' << y;
            }
    }
}

TEST(Etc1s, twoSlicesOfOneChannelAreXAndY)
{
    const auto rgba = basisImage(fileOf({})), xy = basisImage(fileOf({.channelTypes = {3, 4}})),
               grey = basisImage(fileOf({.channelTypes = {3}}));
    ASSERT_TRUE(rgba && xy && grey);
    const Texel stored = basisTexel(*rgba, 6, 5);
    EXPECT_EQ(basisTexel(*xy, 6, 5), (Texel{stored[0], stored[3], 128, 255}));
    EXPECT_EQ(xy->channels, 2);
    EXPECT_EQ(basisTexel(*grey, 6, 5), (Texel{stored[0], stored[0], stored[0], 255}));
    EXPECT_EQ(grey->channels, 1);
}

TEST(Etc1s, damageAndContradictionsAreRefused)
{
    const auto refused = [](const Etc1s& e, const std::string& why) {
        const std::string message = basisRefusal(fileOf(e));
        EXPECT_TRUE(message.starts_with("a.ktx2: broken ktx2 image: ")) << message;
        EXPECT_NE(message.find(why), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    };
    ASSERT_EQ(basisRefusal(fileOf({})), "accepted");
    refused({.endpointCount = 60000}, "the codebook of 60000 endpoints in");
    refused({.selectorCount = 60000}, "the codebook of 60000 selectors in");
    refused({.endpointCount = 1}, "block 2, 0 of the first slice"); // refers to the third one after the first
    refused({.flags = 2}, "image 0 is a predicted frame of a video; expected a still image");
    refused({.extended = 1}, "its global data have");
    refused({.tables = sliceTables(0)}, "block 1, 0 of the first slice"); // from a history that is empty
    refused({.alpha = ""}, "slice 1 of level 0 has 0 bytes; its descriptor has 2 slices");
    refused({.colorAt = 100}, "slice 0 of level 0 takes");
    refused({.channelTypes = {0, 4}}, "channel type 0 and 4; expected 0, 0 and 15, 3, or 3 and 4");
    refused({.channelTypes = {15}}, "channel type 15");
    // A run has at least three groups of 2 x 2 blocks; here it starts at the second of two.
    BitWriter tables, run;
    const EqualCodes sources{{3 | 0 << 2 | 1 << 4 | 2 << 6, 256}};
    for (const EqualCodes* codes : {&sources, &kDeltas, &kSelectorCodes, &kRuns})
        codes->putTable(tables);
    tables.put(3, 13);
    sources.put(run, sources.symbols[0]), kDeltas.put(run, 1), kSelectorCodes.put(run, 0), kSelectorCodes.put(run, 0);
    sources.put(run, 256), run.put(0, 5), kDeltas.put(run, 1), kSelectorCodes.put(run, 0);
    for (int block = 0; block < 3; ++block)
        kSelectorCodes.put(run, 0);
    refused({.tables = tables.bytes(), .color = run.bytes()},
            "a run of the first slice has more than its 3 x 2 blocks");
    // The first block of a slice has nothing to its left; the first group says so of it.
    BitWriter left;
    const EqualCodes groups{{0, 3}};
    for (const EqualCodes* codes : {&groups, &kDeltas, &kSelectorCodes, &kRuns})
        codes->putTable(left);
    left.put(3, 13);
    refused({.tables = left.bytes(), .color = std::string(8, '\0')}, "block 0, 0 of the first slice");
    for (const auto part : {&Etc1s::endpoints, &Etc1s::selectors, &Etc1s::tables, &Etc1s::color, &Etc1s::alpha})
        for (std::size_t size = 0; size + 1 < (Etc1s{}.*part).size(); ++size) {
            Etc1s e;
            (e.*part).resize(size);
            const std::string message = basisRefusal(fileOf(e));
            EXPECT_TRUE(message.starts_with("a.ktx2: broken ktx2 image: ")) << size << message;
        }
    Ktx2File file = fileOf({});
    file.packing = 2;
    EXPECT_NE(basisRefusal(file).find("its supercompression is 2; expected 1 (BasisLZ) for ETC1S"), std::string::npos);
    file = fileOf({}), file.global.pop_back();
    EXPECT_NE(basisRefusal(file).find("its global data have"), std::string::npos) << basisRefusal(file);
    file = fileOf({}), file.global.clear();
    EXPECT_NE(basisRefusal(file).find("its global data have 0 bytes"), std::string::npos) << basisRefusal(file);
}

// Lengths of codes that are no prefix code: three symbols of one bit, and two of two bits.
TEST(Etc1s, tablesThatAreNoPrefixCodesAreRefused)
{
    for (const std::vector<int>& lengths : {std::vector{1, 1, 1}, {2, 2}, {1, 2}}) {
        constexpr std::array<int, 21> order{17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16};
        BitWriter out;
        out.put(std::uint32_t(lengths.size()), 14);
        out.put(order.size(), 5);
        for (const int length : order)
            out.put(length == 1 || length == 2 ? 1 : 0, 3);
        for (const int length : lengths)
            out.put(length == 2 ? 1 : 0, 1);
        const std::string message = basisRefusal(fileOf({.endpoints = out.bytes(64)}));
        EXPECT_NE(message.find("the codebook of 4 endpoints in 64 bytes"), std::string::npos) << message;
    }
}

} // namespace
} // namespace cotan
