// KTX 2.0 files: the size that each format number requires, and the messages for files with false headers.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "cotan/image.hpp"
#include "deflate.hpp"
#include "image_io.hpp"
#include "ktx2_bytes.hpp"
#include "ktx2_maker.hpp"

namespace cotan::test {
namespace {

using namespace std::string_literals;

Result<Image> ktx2Image(const std::string& file) { return decodeImage(bytesOf(file), "a.ktx2"); }

std::string ktx2Refusal(const std::string& file) { return messageOf(ktx2Image(file)); }

const std::string kBrokenKtx2 = "a.ktx2: broken ktx2 image: ";

// VkFormat numbers with the bytes of a pixel or of a 4 x 4 block; 5 x 7 pixels are 2 x 2 blocks.
TEST(Ktx2, everyFormatRequiresItsByteCountAndOthersAreRefused)
{
    const struct {
        std::uint32_t linear, srgb;
        int channels, bytes, block;
    } formats[] = {
        {9, 15, 1, 1, 0},     {16, 22, 2, 2, 0},    {23, 29, 3, 3, 0},    {30, 36, 3, 3, 0},    {37, 43, 4, 4, 0},
        {44, 50, 4, 4, 0},    {51, 57, 4, 4, 0},    {70, 70, 1, 2, 0},    {76, 76, 1, 2, 0},    {77, 77, 2, 4, 0},
        {83, 83, 2, 4, 0},    {84, 84, 3, 6, 0},    {90, 90, 3, 6, 0},    {91, 91, 4, 8, 0},    {97, 97, 4, 8, 0},
        {100, 100, 1, 4, 0},  {103, 103, 2, 8, 0},  {106, 106, 3, 12, 0}, {109, 109, 4, 16, 0}, {131, 132, 4, 0, 8},
        {133, 134, 4, 0, 8},  {135, 136, 4, 0, 16}, {137, 138, 4, 0, 16}, {139, 139, 1, 0, 8},  {140, 140, 1, 0, 8},
        {142, 142, 2, 0, 16}, {143, 143, 3, 0, 16}, {144, 144, 3, 0, 16}, {154, 154, 1, 0, 8},  {156, 156, 2, 0, 16},
        {141, 141, 2, 0, 16}, {145, 146, 4, 0, 16}, {147, 148, 3, 0, 8},  {149, 150, 4, 0, 8},  {151, 152, 4, 0, 16},
        {153, 153, 1, 0, 8},  {155, 155, 2, 0, 16}};
    // 5 x 7 texels are this many blocks.
    constexpr std::pair<std::uint32_t, std::size_t> astc[] = {{157, 4}, {159, 2}, {161, 2}, {163, 2}, {165, 2},
                                                              {167, 2}, {169, 2}, {171, 1}, {173, 2}, {175, 2},
                                                              {177, 1}, {179, 1}, {181, 1}, {183, 1}};
    for (std::uint32_t number = 1; number < 200; ++number) {
        SCOPED_TRACE(number);
        const auto* const format =
            std::ranges::find_if(formats, [&](const auto& f) { return f.linear == number || f.srgb == number; });
        const std::string reason =
            ktx2Refusal(makeKtx2({.format = number, .width = 5, .height = 7, .levels = {{"x"}}}));
        if (const auto* const size =
                std::ranges::find_if(astc, [&](const auto& a) { return number == a.first || number == a.first + 1; });
            size != std::end(astc)) {
            const std::size_t bytes = 16 * size->second;
            EXPECT_EQ(reason,
                      kBrokenKtx2 + "level 0 has 1 bytes, 1 as stored; its size requires " + std::to_string(bytes));
            const auto image =
                ktx2Image(makeKtx2({.format = number, .width = 5, .height = 7, .levels = {{ramp(bytes)}}}));
            ASSERT_TRUE(image) << image.error().message;
            EXPECT_EQ(image->width + 10 * image->height + 100 * image->channels, 475);
            continue;
        }
        if (format == std::end(formats)) {
            EXPECT_EQ(reason, kBrokenKtx2 + "its format " + std::to_string(number) + " (VkFormat) is not supported");
            continue;
        }
        const std::size_t bytes = std::size_t(format->block > 0 ? 4 * format->block : 35 * format->bytes);
        EXPECT_EQ(reason, kBrokenKtx2 + "level 0 has 1 bytes, 1 as stored; its size requires " + std::to_string(bytes));
        const auto sound = [&](std::uint32_t n) {
            return ktx2Image(makeKtx2({.format = n, .width = 5, .height = 7, .levels = {{ramp(bytes)}}}));
        };
        const auto image = sound(number), linear = sound(format->linear);
        ASSERT_TRUE(image && linear) << image.error().message;
        EXPECT_EQ(image->channels, format->channels);
        EXPECT_EQ(image->width, 5);
        EXPECT_EQ(image->height, 7);
        EXPECT_EQ(image->data, linear->data); // stored values are not converted
    }
    for (const auto& [number, name] : {std::pair(1000065999u, ""),
                                       {1000066000u, "KTX2 with ASTC with high dynamic range"},
                                       {1000066013u, "KTX2 with ASTC with high dynamic range"},
                                       {1000066014u, ""},
                                       {146u, ""},
                                       {147u, ""},
                                       {156u, ""},
                                       {157u, ""},
                                       {185u, ""}}) {
        const std::string file = makeKtx2({.format = number, .levels = {{"some"}}});
        EXPECT_EQ(unreadableFormat(std::as_bytes(std::span(file))), name) << number;
    }
}

TEST(Ktx2, errorsStateNumbersAndBeginBeyondEachBound)
{
    const std::string texels = ramp(96);
    const Ktx2File good{.width = 6, .height = 4, .levels = {{texels}}};
    const std::string file = makeKtx2(good);
    const auto messageFor = [](const Ktx2File& k) { return ktx2Refusal(makeKtx2(k)); };
    const auto count = [](std::size_t n) { return std::to_string(n); };
    EXPECT_EQ(ktx2Refusal(file.substr(0, 79)), kBrokenKtx2 + "its header takes 80 bytes, the file has 79");
    for (const std::size_t size : {80u, 90u, 103u})
        EXPECT_EQ(ktx2Refusal(file.substr(0, size)),
                  kBrokenKtx2 + "the list of its levels extends past the end of the file");
    EXPECT_EQ(ktx2Refusal(file.substr(0, file.size() - 1)),
              kBrokenKtx2 + "level 0 takes 96 bytes from " + count(file.size() - 96) + ", the file has "
                  + count(file.size() - 1));
    Ktx2File k = good;
    k.depth = k.layers = 1;
    EXPECT_EQ(messageFor(k), "accepted");
    k = good, k.depth = 2;
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "expected one flat image, found 6 x 4 x 2, 0 layers, 1 faces");
    k = good, k.layers = 2, k.faces = 6;
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "expected one flat image, found 6 x 4 x 0, 2 layers, 6 faces");
    k = good, k.width = 0;
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "expected one flat image, found 0 x 4 x 0, 0 layers, 1 faces");
    k = {.format = 9, .width = (1 << 24) + 1, .height = 2, .levels = {{"x"}}};
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "its size is 16777217 x 2");
    k.width = 2, k.height = (1 << 24) + 1;
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "its size is 2 x 16777217");
    k.height = 1 << 24;
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "level 0 has 1 bytes, 1 as stored; its size requires 33554432");
    k = good, k.packing = 4;
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "its supercompression 4 does not match its format or is unknown");
    k = good, k.levels = {{texels}, {ramp(23)}};
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "level 1 has 23 bytes, 23 as stored; its size requires 24");
    k.levels = {{texels}, {ramp(24)}, {ramp(5), 4}};
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "level 2 has 4 bytes, 5 as stored; its size requires 4");
    k.levelCount = 0; // one level, from which the reader makes the others
    EXPECT_EQ(messageFor(k), "accepted");

    for (const std::uint32_t packing : {2u, 3u}) {
        const std::string library = packing == 2 ? "zstd: " : "zlib: ";
        k = {.width = 6, .height = 4, .packing = packing};
        k.levels = {{packing == 2 ? zstd(ramp(95)) : deflated(ramp(95)), 96}};
        EXPECT_EQ(messageFor(k), kBrokenKtx2 + library + "expected 96 bytes, found 95");
        k.levels = {{packing == 2 ? zstd(texels) : deflated(texels), 96}};
        EXPECT_EQ(messageFor(k), "accepted");
    }
    k.packing = 3, k.levels = {{deflated(ramp(97)), 96}};
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "zlib: the data are too short or too long");
    k.levels = {{"this is no stream", 96}};
    EXPECT_EQ(messageFor(k), kBrokenKtx2 + "zlib: the data are damaged");

    // One key of 5 bytes with three bytes of padding, after 104 bytes of header and level index and 28 of descriptor.
    k = good, k.keys = {"ab\0cd"s};
    const std::string keyed = makeKtx2(k);
    const auto with = [&](std::size_t at, std::uint64_t value) {
        return ktx2Refusal(std::string(keyed).replace(at, 4, little(value, 4)));
    };
    EXPECT_EQ(with(132, 8), "accepted");
    EXPECT_EQ(with(132, 9), kBrokenKtx2 + "a key and its value take 9 bytes, 8 are left");
    EXPECT_EQ(with(60, keyed.size() - 132 + 1),
              kBrokenKtx2 + "its keys take " + count(keyed.size() - 132 + 1) + " bytes from 132, the file has "
                  + count(keyed.size()));
    EXPECT_EQ(with(56, keyed.size() - 12 + 1),
              kBrokenKtx2 + "its keys take 12 bytes from " + count(keyed.size() - 12 + 1) + ", the file has "
                  + count(keyed.size()));
}

} // namespace
} // namespace cotan::test
