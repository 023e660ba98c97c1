// KTX 2.0 files: formats, supercompression, keys; truncated files and files with false headers.
#include "cotan/image.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "deflate.hpp"
#include "image/dds.hpp"
#include "ktx2_bytes.hpp"
#include "ktx2_maker.hpp"

namespace cotan {
namespace {

using test::deflated;
using test::Ktx2File;
using test::little;
using test::makeKtx2;
using test::ramp;
using test::zstd;
using namespace std::string_literals;

Result<Image> ktx2Image(const std::string& file, const LoadLimits& limits = {})
{
    return decodeImage(std::as_bytes(std::span(file)), "a.ktx2", limits);
}

std::string ktx2Refusal(const std::string& file, const LoadLimits& limits = {})
{
    const auto image = ktx2Image(file, limits);
    return image ? "accepted" : image.error().message;
}

std::vector<double> texel(const Image& image, std::size_t i)
{
    std::vector<double> t;
    for (std::size_t c = 4 * i; c < 4 * i + 4; ++c)
        t.push_back(image.type == PixelType::unorm8        ? image.bytes8()[c]
                        : image.type == PixelType::unorm16 ? image.words()[c]
                                                           : double(image.floats()[c]));
    return t;
}

TEST(Ktx2, everyUncompressedFormatRoundTrips)
{
    using V = std::vector<double>;
    const struct {
        std::uint32_t format;
        std::string texel;
        PixelType type;
        V expected;
    } cases[] = {
        {9, "\x10", PixelType::unorm8, {16, 16, 16, 255}},
        {16, "\x10\x20", PixelType::unorm8, {16, 32, 128, 255}},
        {23, "\x10\x20\x30", PixelType::unorm8, {16, 32, 48, 255}},
        {30, "\x10\x20\x30", PixelType::unorm8, {48, 32, 16, 255}},
        {37, "\x10\x20\x30\x40", PixelType::unorm8, {16, 32, 48, 64}},
        {43, "\x10\x20\x30\x40", PixelType::unorm8, {16, 32, 48, 64}}, // sRGB
        {44, "\x10\x20\x30\x40", PixelType::unorm8, {48, 32, 16, 64}},
        {70, "\x10\x01", PixelType::unorm16, {272, 272, 272, 65535}},
        {77, "\x10\x01\x20\x02", PixelType::unorm16, {272, 544, 32768, 65535}},
        {91, "\1\0\2\0\3\0\4\0"s, PixelType::unorm16, {1, 2, 3, 4}},
        // Halves: 0x3c00 is 1, 0xc000 is -2, 0x3555 is 0.333251953125 (IEEE 754).
        {97, "\x00\x3c\x00\xc0\x55\x35\x00\x38"s, PixelType::float32, {1, -2, 0.333251953125, 0.5}},
        {103, "\0\0\x80\x3f\0\0\x20\xc1"s, PixelType::float32, {1, -10, 0.5, 1}},
    };
    for (const auto& c : cases) {
        const auto image = ktx2Image(makeKtx2({.format = c.format, .levels = {{c.texel}}}));
        ASSERT_TRUE(image) << c.format << image.error().message;
        EXPECT_EQ(image->type, c.type) << c.format;
        EXPECT_EQ(texel(*image, 0), c.expected) << c.format;
    }
}

TEST(Ktx2, supercompressedLevelsAreUnpackedAndTheLargestIsRead)
{
    const std::string large = ramp(4 * 6 * 4), small = ramp(2 * 3 * 4), least = ramp(4);
    const auto plain = ktx2Image(makeKtx2({.width = 6, .height = 4, .levels = {{large}, {ramp(3 * 2 * 4)}, {least}}}));
    ASSERT_TRUE(plain) << plain.error().message;
    EXPECT_EQ(plain->width, 6);
    for (std::size_t i = 0; i < large.size(); ++i)
        ASSERT_EQ(plain->bytes8()[i], std::uint8_t(large[i])) << i;
    const auto z = ktx2Image(makeKtx2({.width = 6, .height = 4, .packing = 2, .levels = {{zstd(large), 96}}}));
    ASSERT_TRUE(z) << z.error().message;
    EXPECT_EQ(z->data, plain->data);
    const auto d = ktx2Image(makeKtx2({.width = 6, .height = 4, .packing = 3, .levels = {{deflated(large), 96}}}));
    ASSERT_TRUE(d) << d.error().message;
    EXPECT_EQ(d->data, plain->data);
}

TEST(Ktx2, orientationAndSwizzleKeysAreApplied)
{
    const auto agNormal =
        ktx2Image(makeKtx2({.format = 16, .levels = {{"\x10\x20"}}, .keys = {"KTXswizzle\0rrrg\0"s}}));
    ASSERT_TRUE(agNormal) << agNormal.error().message;
    EXPECT_EQ(texel(*agNormal, 0), (std::vector<double>{16, 16, 16, 32}));
    const auto normal = ktx2Image(makeKtx2({.format = 16, .levels = {{"\x10\x20"}}, .keys = {"KTXswizzle\0rg01\0"s}}));
    ASSERT_TRUE(normal);
    EXPECT_EQ(texel(*normal, 0), (std::vector<double>{16, 32, 128, 255}));
    const auto swizzled = ktx2Image(makeKtx2({.levels = {{"\x10\x20\x30\x40"}}, .keys = {"KTXswizzle\0a01g\0"s}}));
    ASSERT_TRUE(swizzled);
    EXPECT_EQ(texel(*swizzled, 0), (std::vector<double>{64, 0, 255, 32}));
    const Ktx2File up{.format = 9, .height = 3, .levels = {{"\1\2\3"}}, .keys = {"by\0me\0"s, "KTXorientation\0ru\0"s}};
    const auto flipped = ktx2Image(makeKtx2(up));
    ASSERT_TRUE(flipped) << flipped.error().message;
    EXPECT_EQ(texel(*flipped, 0)[0], 3);
    EXPECT_EQ(texel(*flipped, 1)[0], 2);
    EXPECT_EQ(texel(*flipped, 2)[0], 1);
}

// A BC4 block has two endpoints and sixteen indices of 3 bits. Index 0 is the first endpoint, 1 the second; with the
// larger endpoint first, 2 to 7 interpolate in sevenths.
TEST(Ktx2, blocksAreDecoded)
{
    const auto block = [](int first, int second, std::uint64_t index) {
        std::uint64_t indices = 0;
        for (int i = 0; i < 16; ++i)
            indices |= index << 3 * i;
        return ""s + char(first) + char(second) + little(indices, 6);
    };
    const auto bc5 =
        ktx2Image(makeKtx2({.format = 141,
                            .width = 5,
                            .height = 4,
                            .levels = {{block(240, 30, 0) + block(100, 30, 1) + block(210, 0, 2) + block(7, 0, 7)}}}));
    ASSERT_TRUE(bc5) << bc5.error().message;
    EXPECT_EQ(texel(*bc5, 3), (std::vector<double>{240, 30, 128, 255}));
    EXPECT_EQ(texel(*bc5, 4), (std::vector<double>{180, 1, 128, 255}));
    const auto bc4 = ktx2Image(makeKtx2({.format = 139, .width = 4, .height = 4, .levels = {{block(240, 30, 1)}}}));
    ASSERT_TRUE(bc4) << bc4.error().message;
    EXPECT_EQ(texel(*bc4, 15), (std::vector<double>{30, 30, 30, 255}));
    // BC1: white and black in 5:6:5, all indices 0; BC3 with alpha before it; zstd around it.
    const std::string white = "\xff\xff\0\0"s + std::string(4, '\0');
    const auto bc1 = ktx2Image(makeKtx2({.format = 132, .width = 4, .height = 4, .levels = {{white}}}));
    ASSERT_TRUE(bc1) << bc1.error().message;
    EXPECT_EQ(texel(*bc1, 5), (std::vector<double>{255, 255, 255, 255}));
    const auto bc3 = ktx2Image(makeKtx2(
        {.format = 137, .width = 4, .height = 4, .packing = 2, .levels = {{zstd(block(90, 9, 0) + white), 16}}}));
    ASSERT_TRUE(bc3) << bc3.error().message;
    EXPECT_EQ(texel(*bc3, 5), (std::vector<double>{255, 255, 255, 90}));
    // BC2: 4 bits of alpha for each pixel.
    const auto bc2 =
        ktx2Image(makeKtx2({.format = 135, .width = 4, .height = 4, .levels = {{std::string(8, '\xaa') + white}}}));
    ASSERT_TRUE(bc2) << bc2.error().message;
    EXPECT_EQ(texel(*bc2, 5), (std::vector<double>{255, 255, 255, 170}));
    // BC7, mode 5, with every other bit zero: black with alpha 0.
    const auto bc7 =
        ktx2Image(makeKtx2({.format = 145, .width = 4, .height = 4, .levels = {{"\x20"s + std::string(15, '\0')}}}));
    ASSERT_TRUE(bc7) << bc7.error().message;
    EXPECT_EQ(texel(*bc7, 0), (std::vector<double>{0, 0, 0, 0}));
}

// Random blocks, of BC7 in each of its modes.
TEST(Ktx2, blocksOfBcAreReadAsByOpenImageIO)
{
    struct Format {
        std::uint32_t vulkan;
        DdsCode dds;
    };
    std::mt19937 random(7);
    for (const Format& format :
         {Format{133, {"DXT1", 0, 8}}, Format{135, {"DXT3", 0, 16}}, Format{137, {"DXT5", 0, 16}},
          Format{139, {"DX10", 80, 8}}, Format{141, {"DX10", 83, 16}}, Format{145, {"DX10", 98, 16}}}) {
        constexpr int kWidth = 254, kHeight = 129; // not whole blocks
        std::string blocks(std::size_t(64 * 33) * format.dds.block, '\0');
        for (char& byte : blocks)
            byte = char(random() & 0xff);
        for (std::size_t k = 0; format.vulkan == 145 && k < blocks.size() / 16; ++k) // the lowest bit that is set
            blocks[16 * k] = char((int(blocks[16 * k]) << 1 | 1) << k % 8);
        const auto head = ddsHeader(format.dds, kWidth, kHeight, 1);
        const std::string dds = std::string(reinterpret_cast<const char*>(head.data()), head.size()) + blocks;
        const auto wanted = decodeImage(std::as_bytes(std::span(dds)), "a.dds");
        if (!wanted && wanted.error().kind == ErrorKind::unavailable)
            GTEST_SKIP() << wanted.error().message;
        ASSERT_TRUE(wanted) << wanted.error().message;
        const auto found =
            ktx2Image(makeKtx2({.format = format.vulkan, .width = kWidth, .height = kHeight, .levels = {{blocks}}}));
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_EQ(found->type, wanted->type);
        EXPECT_TRUE(found->data == wanted->data) << format.vulkan;
    }
}

// image_basis_test.cpp has the formats of Basis Universal that are read.
TEST(Ktx2, formatsThatAreNotReadAreNamed)
{
    const std::string basis = makeKtx2({.format = 0, .levels = {{"some"}}, .colourModel = 167});
    const auto image = ktx2Image(basis);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().kind, ErrorKind::unavailable);
    EXPECT_EQ(image.error().message, "a.ktx2: BasisU other than ETC1S and UASTC LDR 4x4 is not supported");
    EXPECT_EQ(unreadableFormat(std::as_bytes(std::span(basis))), "KTX2 with BasisU other than ETC1S and UASTC LDR 4x4");
    EXPECT_NE(
        ktx2Refusal(makeKtx2({.format = 1000066000, .levels = {{"some"}}})).find("ASTC with high dynamic range is"),
        std::string::npos);
}

TEST(Ktx2, truncatedFilesAreRefusedAtEveryLength)
{
    const std::string file = makeKtx2(
        {.width = 6, .height = 4, .packing = 2, .levels = {{zstd(ramp(96)), 96}}, .keys = {"KTXswizzle\0rgba\0"s}});
    ASSERT_EQ(ktx2Refusal(file), "accepted");
    for (std::size_t size = 12; size < file.size(); ++size) {
        const std::string why = ktx2Refusal(file.substr(0, size));
        EXPECT_TRUE(why.starts_with("a.ktx2: ")) << size << why;
        EXPECT_EQ(why.find('\n'), std::string::npos);
    }
}

// The longer side determines the number of levels: 8, 4, 2, 1.
TEST(Ktx2, levelCountFollowsTheLongerSide)
{
    for (const auto& [width, height] : {std::pair{8u, 2u}, {2u, 8u}}) {
        Ktx2File k{.width = width, .height = height};
        for (int level = 0; level < 4; ++level)
            k.levels.push_back({ramp(std::size_t(std::max(width >> level, 1u) * std::max(height >> level, 1u) * 4))});
        const auto image = ktx2Image(makeKtx2(k));
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, int(width));
        EXPECT_EQ(image->height, int(height));
        k.levelCount = 5;
        EXPECT_NE(ktx2Refusal(makeKtx2(k)).find("it has 5 levels"), std::string::npos) << width;
    }
}

TEST(Ktx2, inconsistentHeadersAreRefused)
{
    const std::string texels = ramp(96);
    const Ktx2File good{.width = 6, .height = 4, .levels = {{texels}}};
    const auto refused = [](Ktx2File file, const std::string& why) {
        const std::string message = ktx2Refusal(makeKtx2(file));
        EXPECT_NE(message.find(why), std::string::npos) << message;
    };
    Ktx2File k = good;
    k.height = 5, refused(k, "its size requires 120");
    k = good, k.levels[0].plainBytes = 97, refused(k, "level 0 has 97 bytes");
    k = good, k.packing = 2, refused(k, "zstd: ");
    k = good, k.packing = 3, refused(k, "zlib: ");
    k = good, k.packing = 4, refused(k, "supercompression 4");
    k = good, k.packing = 1, refused(k, "supercompression 1");
    k = good, k.faces = 6, refused(k, "6 faces");
    k = good, k.layers = 3, refused(k, "3 layers");
    k = good, k.depth = 2, refused(k, "expected one flat image");
    k = good, k.height = 0, refused(k, "expected one flat image");
    k = good, k.format = 4711, refused(k, "its format 4711");
    k = good, k.levelCount = 4, refused(k, "it has 4 levels, 6 x 4 pixels have 3");
    k = good, k.levelCount = 3, refused(k, "level 1 ");
    k = good, k.keys = {"KTXswizzle\0rgbx\0"s}, refused(k, "KTXswizzle: expected");
    k = good, k.keys = {"KTXorientation\0ld\0"s}, refused(k, "KTXorientation: expected");
    std::string far = makeKtx2(good);
    far.replace(80, 8, little(0xfffffffffffffff0, 8));
    EXPECT_NE(ktx2Refusal(far).find("from 18446744073709551600"), std::string::npos) << ktx2Refusal(far);
    far = makeKtx2(good).replace(60, 4, little(0xfffffff0, 4));
    EXPECT_NE(ktx2Refusal(far).find("its keys take"), std::string::npos) << ktx2Refusal(far);
}

// Streams that unpack to more or fewer bytes than the header says, and images over the limit.
TEST(Ktx2, decompressionBombsAreRefusedBeforeAllocation)
{
    const std::string zeros(std::size_t(1) << 20, '\0');
    for (const std::uint32_t packing : {2u, 3u}) {
        const std::string packed = packing == 2 ? zstd(zeros) : deflated(zeros);
        EXPECT_NE(ktx2Refusal(makeKtx2({.packing = packing, .levels = {{packed, 4}}})), "accepted");
        EXPECT_EQ(
            ktx2Refusal(makeKtx2({.width = 512, .height = 512, .packing = packing, .levels = {{packed, 1 << 20}}})),
            "accepted");
        EXPECT_NE(
            ktx2Refusal(makeKtx2({.width = 512, .height = 1024, .packing = packing, .levels = {{packed, 2 << 20}}})),
            "accepted");
        const std::string large = ktx2Refusal(makeKtx2(
            {.width = 16384, .height = 16384, .packing = packing, .levels = {{packed, std::uint64_t(1) << 30}}}));
        EXPECT_NE(large.find("take 1073741824 bytes, the limit is"), std::string::npos) << large;
    }
}

TEST(Ktx2, oversizedUncompressedLevelIsRefused)
{
    EXPECT_NE(
        ktx2Refusal(makeKtx2({.levels = {{"\1\2\3\4\5", 4}}})).find("has 4 bytes, 5 as stored; its size requires 4"),
        std::string::npos);
}

TEST(Ktx2, halfAndFloatComponentsAreReadInOrder)
{
    using V = std::vector<double>;
    const std::string halves = "\x00\x3c\x00\xc0\x00\x38\x00\x34"s; // 1, -2, 0.5, 0.25
    const std::string floats = "\0\0\x80\x3f\0\0\0\xc0\0\0\0\x3f\0\0\x80\x3e"s;
    const V all{1, -2, 0.5, 0.25};
    const std::pair<std::uint32_t, std::uint32_t> kinds[] = {{76, 100}, {83, 103}, {90, 106}, {97, 109}};
    for (std::size_t channels = 1; channels <= 4; ++channels) {
        const V expected = channels == 1 ? V{1, 1, 1, 1}
            : channels == 2              ? V{1, -2, 0.5, 1}
            : channels == 3              ? V{1, -2, 0.5, 1}
                                         : all;
        const auto [half, whole] = kinds[channels - 1];
        EXPECT_EQ(texel(*ktx2Image(makeKtx2({.format = half, .levels = {{halves.substr(0, 2 * channels)}}})), 0),
                  expected);
        EXPECT_EQ(texel(*ktx2Image(makeKtx2({.format = whole, .levels = {{floats.substr(0, 4 * channels)}}})), 0),
                  expected);
    }
    EXPECT_EQ(texel(*ktx2Image(makeKtx2({.format = 84, .levels = {{"\1\0\2\0\3\0"s}}})), 0), (V{1, 2, 3, 65535}));
    EXPECT_EQ(texel(*ktx2Image(makeKtx2({.format = 51, .levels = {{"\1\2\3\4"}}})), 0), (V{1, 2, 3, 4}));
    EXPECT_EQ(texel(*ktx2Image(makeKtx2({.format = 70, .levels = {{"\1\2"}}, .keys = {"KTXswizzle\0r01r\0"s}})), 0),
              (V{513, 0, 65535, 513}));
}

// The swizzle of blue and alpha determines the number of channels.
TEST(Ktx2, aSwizzleWithoutBlueAndAlphaLeavesTwoChannels)
{
    const auto channels = [](std::uint32_t format, const std::string& swizzle) {
        const std::size_t bytes = format == 37 ? 4 : format == 16 ? 2 : 1;
        return ktx2Image(
                   makeKtx2({.format = format, .levels = {{ramp(bytes)}}, .keys = {"KTXswizzle\0"s + swizzle + '\0'}}))
            ->channels;
    };
    for (const char* const swizzle : {"rg01", "rg00", "ga11", "br10"})
        EXPECT_EQ(channels(37, swizzle), 2) << swizzle;
    for (const char* const swizzle : {"rgb1", "rg0a", "rg1r", "rgba", "00ba"})
        EXPECT_EQ(channels(37, swizzle), 4) << swizzle;
    EXPECT_EQ(channels(16, "rrrg"), 2);
    EXPECT_EQ(channels(9, "r001"), 1);
}

} // namespace
} // namespace cotan
