// Images in strips with neighbouring rows; files of mip levels; comparison of two files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "cotan/convention.hpp"
#include "cotan/image.hpp"
#include "map_files/inspect.hpp"
#include "map_files/mips.hpp"
#include "map_files/stream.hpp"
#include "run_tool.hpp"

namespace cotan::maps {

using namespace app;
namespace {

namespace fs = std::filesystem;
using test::readWhole, test::TemporaryFolder;

// An image whose texels hold their row number.
class Rows : public RowReader {
public:
    Rows(int w, int h, int failAt = -1) : failAt_(failAt)
    {
        width = w, height = h;
        name = "rows";
    }
    Status read(Image& strip) override
    {
        EXPECT_EQ(strip.width, width);
        for (int y = 0; y < strip.height; ++y, ++next_) {
            EXPECT_LT(next_, height) << "no more rows remain";
            if (next_ == failAt_)
                return inputError("it is broken");
            std::memset(strip.data.data() + std::size_t(y) * std::size_t(width) * 4, next_ + 1, std::size_t(width) * 4);
        }
        return Done{};
    }

private:
    int next_ = 0, failAt_;
};

using Numbers = std::vector<int>;

// The row numbers in a strip, by the first texel and the last byte of each row.
Numbers rowsBetween(const Image& strip)
{
    Numbers rows;
    const std::size_t bytes = std::size_t(strip.width) * 4;
    for (int y = 0; y < strip.height; ++y) {
        const auto* const row = strip.data.data() + std::size_t(y) * bytes;
        EXPECT_EQ(row[0], row[bytes - 1]);
        rows.push_back(std::to_integer<int>(row[0]));
    }
    return rows;
}

TEST(MapStrips, includeNeighbouringRowsAndBorders)
{
    const int width = 65536; // strips of 16 rows
    for (const int height : {1, 2, 15, 16, 17, 18, 32, 40})
        for (const int kind : {0, 1, 2}) { // without borders, clamped, repeated
            Rows reader(width, height);
            Image lastRow = makeImage(width, 1, PixelType::unorm8);
            std::memset(lastRow.data.data(), height, lastRow.data.size());
            StreamPlan plan{kind > 0, kind == 2 ? Wrap::repeat : Wrap::clamp, kind == 2 ? &lastRow : nullptr};
            RowReader* const readers[] = {&reader};
            int expectedFirst = 0;
            const Status done = streamStrips(readers, plan, {}, [&](std::span<Image> strips, int firstRow) {
                return [&, found = rowsBetween(strips[0]), firstRow, count = strips.size()]() -> Status {
                    EXPECT_EQ(count, 1u);
                    EXPECT_EQ(firstRow, expectedFirst) << "in order";
                    const int last = std::min(firstRow + 16, height), border = kind > 0 ? 1 : 0;
                    Numbers expected;
                    for (int row = firstRow - border; row < last + border; ++row)
                        expected.push_back(kind == 2 ? (row + height) % height + 1
                                                     : std::clamp(row, 0, height - 1) + 1);
                    EXPECT_EQ(found, expected) << height << ' ' << kind;
                    expectedFirst = last;
                    return Done{};
                };
            });
            EXPECT_TRUE(done);
            EXPECT_EQ(expectedFirst, height);
        }
}

// 16 MiB of floats, in multiples of 64 rows or 16; at least 16, at most 4096.
TEST(MapStrips, heightFollowsTheWidth)
{
    for (const auto& [width, rows] : {std::pair(1, 4096),
                                      {256, 4096},
                                      {257, 4032},
                                      {16384, 64},
                                      {16385, 48},
                                      {32768, 32},
                                      {32769, 16},
                                      {65536, 16},
                                      {65537, 16},
                                      {70000, 16}}) {
        Rows reader(width, rows + 1);
        Numbers firsts;
        EXPECT_TRUE(inOrder(reader, {}, [&](const Image& strip, int first) {
            firsts.push_back(first);
            EXPECT_EQ(strip.height, first == 0 ? rows : 1) << width;
        }));
        EXPECT_EQ(firsts, (Numbers{0, rows})) << width;
    }
}

TEST(MapStrips, endAtTheFirstErrorAndReturnIt)
{
    const int width = 65536, height = 80;
    const auto run = [&](int failRead, int failTake, int stopAt, Numbers& taken) {
        Rows a(width, height), b(width, height, failRead);
        RowReader* const readers[] = {&a, &b};
        int steps = 0;
        const Status done = streamStrips(
            readers, {}, [&](double) { return ++steps != stopAt; },
            [&](std::span<Image> strips, int firstRow) {
                EXPECT_EQ(strips.size(), 2u);
                return [&, firstRow]() -> Status {
                    if (firstRow == failTake)
                        return outputError("no room");
                    taken.push_back(firstRow);
                    return Done{};
                };
            });
        return done ? std::string() : done.error().kind == ErrorKind::stopped ? "stopped" : done.error().message;
    };
    Numbers taken;
    EXPECT_EQ(run(-1, -1, -1, taken), "");
    EXPECT_EQ(taken, (Numbers{0, 16, 32, 48, 64}));
    EXPECT_EQ(run(79, -1, -1, taken), "it is broken");
    taken.clear();
    EXPECT_EQ(run(0, -1, -1, taken), "it is broken");
    EXPECT_EQ(taken, Numbers{});
    EXPECT_EQ(run(-1, 32, -1, taken), "no room");
    EXPECT_EQ(taken, (Numbers{0, 16}));
    taken.clear();
    EXPECT_EQ(run(-1, -1, 2, taken), "stopped");
    EXPECT_EQ(taken, (Numbers{0, 16}));
}

TEST(MipFiles, areConfirmedBeforeWritingAndStoreTheRoughnessOfTheirLevel)
{
    const TemporaryFolder folder;
    const StatedConvention gltf = *parseConvention("gltf");
    ASSERT_TRUE(writeImage(folder / "n.png", Image{"", 4, 2, PixelType::unorm8, [] {
                                                       std::vector<std::byte> flat;
                                                       for (int i = 0; i < 8; ++i)
                                                           for (const int c : {128, 128, 255, 255})
                                                               flat.push_back(std::byte(c));
                                                       return flat;
                                                   }()}));
    EXPECT_EQ(firstMipFile("x/a.b.png"), fs::path("x/a.b_0.png"));
    EXPECT_EQ(firstMipFile("x/a.ktx2"), fs::path("x/a.ktx2"));
    std::vector<std::string> asked;
    MipFileOptions o{.from = gltf, .roughness = 0.4};
    o.mayWrite = [&](const fs::path& file) {
        asked.push_back(file.filename().string());
        return asked.size() < 5 ? Status(Done{}) : Status(usageError("not this one"));
    };
    const auto refused = writeMips(folder / "n.png", folder / "m.png", o);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "not this one");
    EXPECT_EQ(asked,
              (std::vector<std::string>{"m_0.png", "m_roughness_0.png", "m_1.png", "m_roughness_1.png", "m_2.png"}));
    EXPECT_FALSE(fs::exists(folder / "m_0.png"));
    const auto inTwo =
        writeMips(folder / "n.png", folder / "two.dds", {.from = gltf, .compress = "bc5", .mayWrite = o.mayWrite});
    ASSERT_FALSE(inTwo);
    EXPECT_EQ(asked.back(), "two_roughness.dds");
    EXPECT_FALSE(fs::exists(folder / "two.dds"));
    for (const char* bits : {"8", "half"}) {
        const std::string end = bits == std::string("8") ? ".png" : ".exr";
        o = {.from = gltf, .roughness = 0.4, .bits = bits};
        const auto done = writeMips(folder / "n.png", folder / ("m" + end), o);
        ASSERT_TRUE(done) << done.error().message;
        ASSERT_EQ(done->levels.size(), 3u);
        const std::pair<int, int> sizes[] = {{4, 2}, {2, 1}, {1, 1}};
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(std::pair(done->levels[i].width, done->levels[i].height), sizes[i]);
            EXPECT_NEAR(done->levels[i].meanLength, 1, 1e-6);
            EXPECT_NEAR(done->levels[i].meanRoughness, 0.4, 1e-6);
            const auto normals = readImage(folder / fmt::format("m_{}{}", i, end)),
                       rough = readImage(folder / fmt::format("m_roughness_{}{}", i, end));
            ASSERT_TRUE(normals && rough) << i << end;
            EXPECT_EQ(std::pair(rough->width, rough->height), sizes[i]);
            if (end == ".png") {
                EXPECT_EQ(normals->bytes8()[2], 255);
                EXPECT_EQ(rough->bytes8()[0], 102); // 0.4 of 255
            } else {
                EXPECT_NEAR(normals->floats()[2], 1, 1e-3);
                EXPECT_NEAR(rough->floats()[0], 0.4, 1e-3);
            }
        }
    }
    EXPECT_EQ(writeMips(folder / "n.png", folder / "k.dds", {.from = gltf, .keepLengths = true, .compress = "bc5"})
                  .error()
                  .message,
              "options.keepLengths: bc5 has no channel for lengths");
    ASSERT_TRUE(writeMips(folder / "n.png", folder / "k.dds", {.from = gltf, .roughness = 0.4}));
    EXPECT_EQ(readWhole(folder / "k.dds").substr(128, 4), std::string("\x80\x80\xff\x66"));
}

TEST(MapComparison, requiresEqualSizesAndCountsTexelsWithoutDirection)
{
    const TemporaryFolder folder;
    const StatedConvention gltf = *parseConvention("gltf");
    const auto file = [&](const std::string& name, int width, int height, int without) {
        Image image = makeImage(width, height, PixelType::float32);
        for (int i = 0; i < width * height; ++i)
            for (int c = 0; c < 4; ++c) // the first ones are not finite
                image.floats()[4 * i + c] = i < without ? NAN : c > 1 ? 1.0f : 0.5f;
        EXPECT_TRUE(writeImage(folder / name, image));
        return folder / name;
    };
    const fs::path a = file("a.exr", 6, 5, 0), b = file("b.exr", 6, 5, 4);
    for (const auto& [width, height] : {std::pair(7, 5), {6, 4}, {5, 6}}) {
        const auto none = compareFiles(a, gltf, file("c.exr", width, height, 0), gltf, {}, {});
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().message,
                  fmt::format("{}: expected 6 x 5 as {} has, found {} x {}", (folder / "c.exr").string(), a.string(),
                              width, height));
    }
    const auto same = compareFiles(a, gltf, b, gltf, folder / "heat.png", {});
    ASSERT_TRUE(same);
    EXPECT_EQ(same->angles.count, 26u);
    EXPECT_EQ(same->skipped, 4u);
    EXPECT_EQ(same->angles.maximum, 0);
    const auto heat = readImage(folder / "heat.png");
    ASSERT_TRUE(heat);
    EXPECT_EQ(std::pair(heat->width, heat->height), std::pair(6, 5));
    const auto none = compareFiles(a, gltf, b, gltf, folder / "gone/heat.png", {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().kind, ErrorKind::output);
}

} // namespace
} // namespace cotan::maps
