// Animated WebP and GIF, read back by libwebp's demuxer and by OpenImageIO, which reads GIF with another library than
// it writes GIF with.
#include "cotan/image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <webp/demux.h>

#include "gltf_maker.hpp"

namespace cotan {
namespace {

using test::TemporaryFolder;

constexpr int kWidth = 64, kHeight = 48;

// Smooth colours that change with each frame; alpha falls to the right.
Image frameImage(int number, bool alpha)
{
    Image image = makeImage(kWidth, kHeight, PixelType::unorm8, "picture");
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            std::uint8_t* const p = image.bytes8() + 4 * (y * kWidth + x);
            p[0] = std::uint8_t(2 * x + 20 * number);
            p[1] = std::uint8_t(4 * y);
            p[2] = std::uint8_t(200 - 30 * number);
            p[3] = std::uint8_t(alpha ? 255 - 2 * x : 255);
        }
    return image;
}

void writeFive(const std::filesystem::path& file, double rate, bool alpha = false)
{
    auto writer = createAnimation(file, {kWidth, kHeight, 5, rate});
    ASSERT_TRUE(writer) << writer.error().message;
    for (int i = 0; i < 5; ++i)
        ASSERT_TRUE((*writer)->add(frameImage(i, alpha)));
    EXPECT_FALSE(std::filesystem::exists(file));
    const Status done = (*writer)->finish();
    ASSERT_TRUE(done) << done.error().message;
}

std::size_t filesIn(const std::filesystem::path& folder)
{
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder))
        ++count;
    return count;
}

// Mean difference of one channel over the pixels that are not fully transparent.
double meanChannelDifference(const Image& expected, const std::uint8_t* found, std::size_t channel)
{
    double sum = 0;
    for (std::size_t i = 0; i < expected.pixelCount(); ++i)
        sum += std::abs(int(expected.bytes8()[4 * i + channel]) - int(found[4 * i + channel]));
    return sum / double(expected.pixelCount());
}

TEST(Animation, webpStoresEveryFrameWithItsTimeAndAlpha)
{
    for (const bool alpha : {false, true}) {
        TemporaryFolder folder;
        writeFive(folder.path / "a.webp", 24, alpha);
        std::ifstream stream(folder.path / "a.webp", std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(stream), {});
        const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
        const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(
            WebPAnimDecoderNew(&data, nullptr), WebPAnimDecoderDelete);
        ASSERT_TRUE(decoder);
        WebPAnimInfo info;
        ASSERT_TRUE(WebPAnimDecoderGetInfo(decoder.get(), &info));
        EXPECT_EQ(info.canvas_width, std::uint32_t(kWidth));
        EXPECT_EQ(info.canvas_height, std::uint32_t(kHeight));
        EXPECT_EQ(info.frame_count, 5u);
        EXPECT_EQ(info.loop_count, 0u);
        for (int i = 0; i < 5; ++i) {
            std::uint8_t* pixels = nullptr;
            int until = 0;
            ASSERT_TRUE(WebPAnimDecoderGetNext(decoder.get(), &pixels, &until));
            EXPECT_EQ(until, std::lround(1000 * (i + 1) / 24.0)) << i;
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_LT(meanChannelDifference(frameImage(i, alpha), pixels, c), 3) << i << c; // quality 90
            EXPECT_EQ(meanChannelDifference(frameImage(i, alpha), pixels, 3), 0) << i;
        }
        EXPECT_FALSE(WebPAnimDecoderHasMoreFrames(decoder.get()));
    }
}

TEST(Animation, gifStoresEveryFrameInHundredthsOfASecond)
{
    TemporaryFolder folder;
    if (std::system("command -v oiiotool > /dev/null") != 0)
        GTEST_SKIP() << "no oiiotool";
    EXPECT_EQ(animationRate("a.gif", 24), 25);
    EXPECT_EQ(animationRate("a.webp", 24), 24);
    writeFive(folder.path / "a.gif", 24);
    const std::string gif = (folder.path / "a.gif").string(), log = (folder.path / "log").string();
    ASSERT_EQ(std::system(fmt::format("oiiotool --info -v '{}' > '{}'", gif, log).c_str()), 0);
    std::ifstream stream(log);
    const std::string facts(std::istreambuf_iterator<char>(stream), {});
    EXPECT_NE(facts.find("5 subimages: 64x48"), std::string::npos) << facts;
    EXPECT_NE(facts.find("FramesPerSecond: 100/4 (25)"), std::string::npos) << facts;
    for (int i = 0; i < 5; ++i) {
        const std::string png = (folder.path / "frame.png").string();
        ASSERT_EQ(std::system(fmt::format("oiiotool '{}' --subimage {} -o '{}'", gif, i, png).c_str()), 0);
        const auto frame = readImage(png);
        ASSERT_TRUE(frame);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_LT(meanChannelDifference(frameImage(i, false), frame->bytes8(), c), 8) << i << c; // 256 colours
    }
}

TEST(Animation, unfinishedAnimationLeavesNoFile)
{
    for (const char* name : {"a.webp", "a.gif"}) {
        TemporaryFolder folder;
        {
            auto writer = createAnimation(folder.path / name, {kWidth, kHeight, 5, 24});
            ASSERT_TRUE(writer) << writer.error().message;
            ASSERT_TRUE((*writer)->add(frameImage(0, false)));
            const Status other = (*writer)->add(makeImage(8, 8, PixelType::unorm8));
            ASSERT_FALSE(other);
            EXPECT_NE(other.error().message.find("expected images of 64 x 48; found 8 x 8"), std::string::npos);
        }
        EXPECT_EQ(filesIn(folder.path), 0u) << name;
    }
}

TEST(Animation, unsupportedSizesAndRatesAreRefusedInOneLine)
{
    TemporaryFolder folder;
    const std::pair<const char*, AnimationFormat> cases[] = {{"a.webp", {16384, 8, 1, 24}}, {"a.webp", {0, 8, 1, 24}},
                                                             {"a.webp", {8, 8, 1, 2000}},   {"a.webp", {8, 8, 1, 0}},
                                                             {"a.gif", {8, 70000, 1, 24}},  {"a.gif", {8, 8, 1, 60}}};
    for (const auto& [name, format] : cases) {
        const auto writer = createAnimation(folder.path / name, format);
        ASSERT_FALSE(writer) << name;
        EXPECT_EQ(writer.error().kind, ErrorKind::usage);
        EXPECT_EQ(writer.error().message.find('\n'), std::string::npos);
    }
    EXPECT_EQ(createAnimation(folder.path / "no/a.webp", {8, 8, 1, 24}).error().kind, ErrorKind::output);
    EXPECT_EQ(filesIn(folder.path), 0u);
}

} // namespace
} // namespace cotan
