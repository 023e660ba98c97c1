// The tangent frame that a normal map was made for, as image files store it under the key cotanFrame.
#include <array>

#include <gtest/gtest.h>

#include "image/component_types.hpp"
#include "image_io.hpp"
#include "ktx2_maker.hpp"
#include "png_maker.hpp"

namespace cotan::test {
namespace {

using namespace std::string_literals;

std::string wholeFile(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Image flatMap(PixelType type, const std::string& frame)
{
    Image image = makeImage(5, 4, type);
    image.frame = frame;
    return image;
}

// One pixel of 8 bits after the given chunks.
Result<Image> pngWith(const std::string& chunks)
{
    Png png;
    png.rows = "\0\1\2\3"s;
    png.before = chunks;
    return decodeImage(makePng(png), "a.png");
}

TEST_F(ImageIo, pngAndExrStoreTheFrameWholeAndByRows)
{
    for (const char* name : {"a.png", "a.exr"})
        for (const PixelType type : {PixelType::unorm8, PixelType::unorm16, PixelType::float32}) {
            ASSERT_TRUE(writeImage(folder / name, flatMap(type, "smooth")));
            EXPECT_EQ(readImage(folder / name)->frame, "smooth") << name;
            EXPECT_EQ((*openRows(folder / name))->frame, "smooth") << name;
            const bool floats = std::string(name) == "a.exr";
            const PixelType stored = floats  ? PixelType::float32
                : type == PixelType::float32 ? PixelType::unorm8
                                             : type;
            auto writer = createRows(folder / name, {5, 4, stored, false, floats, "orthonormal"});
            ASSERT_TRUE(writer);
            ASSERT_TRUE((*writer)->write(flatMap(stored, "")));
            ASSERT_TRUE((*writer)->finish());
            EXPECT_EQ(readImage(folder / name)->frame, "orthonormal") << name;
        }
}

TEST_F(ImageIo, frameIsStoredInStandardMetadata)
{
    ASSERT_TRUE(writeImage(folder / "a.png", flatMap(PixelType::unorm8, "smooth")));
    EXPECT_NE(wholeFile(folder / "a.png").find(chunk("tEXt", "cotanFrame\0smooth"s)), std::string::npos);
    const auto encoded = encodePng(flatMap(PixelType::unorm16, "smooth"));
    EXPECT_EQ(decodeImage(*encoded, "a")->frame, "smooth");
    ASSERT_TRUE(writeImage(folder / "a.exr", flatMap(PixelType::float32, "smooth")));
    EXPECT_NE(wholeFile(folder / "a.exr").find("cotanFrame\0string\0\6\0\0\0smooth"s), std::string::npos);
}

TEST_F(ImageIo, mapWithoutFrameIsStoredWithoutTheKey)
{
    for (const char* name : {"a.png", "a.exr", "a.tif", "a.tga", "a.jpg", "a.hdr"}) {
        ASSERT_TRUE(writeImage(folder / name, flatMap(PixelType::float32, "")));
        EXPECT_EQ(wholeFile(folder / name).find("cotanFrame"), std::string::npos) << name;
        EXPECT_EQ(readImage(folder / name)->frame, "") << name;
    }
}

TEST_F(ImageIo, formatsWithoutFrameMetadataAreWrittenUnchanged)
{
    for (const char* name : {"a.tif", "a.tga", "a.jpg", "a.hdr"}) {
        ASSERT_TRUE(writeImage(folder / name, flatMap(PixelType::unorm8, "")));
        const std::string without = wholeFile(folder / name);
        ASSERT_TRUE(writeImage(folder / name, flatMap(PixelType::unorm8, "smooth")));
        EXPECT_EQ(wholeFile(folder / name), without) << name;
    }
}

TEST(ImageFrame, pngFrameIsReadFromUncompressedTextChunks)
{
    EXPECT_EQ(pngWith(chunk("tEXt", "cotanFrame\0smooth"s))->frame, "smooth");
    EXPECT_EQ(pngWith(chunk("iTXt", "cotanFrame\0\0\0\0\0smooth"s))->frame, "smooth");
    EXPECT_EQ(pngWith(chunk("iTXt", "cotanFrame\0\0\0de\0Rahmen\0smooth"s))->frame, "smooth");
    EXPECT_EQ(pngWith(chunk("tEXt", "Title\0x"s) + chunk("tEXt", "cotanFrame\0gradient"s))->frame, "gradient");
}

TEST(ImageFrame, invalidFrameNamesAreIgnored)
{
    for (const std::string& value : {""s, std::string(65, 'x'), "two words"s, "line\nbreak"s, "\x1b[31m"s, "h\xe9"s}) {
        EXPECT_EQ(pngWith(chunk("tEXt", "cotanFrame\0"s + value))->frame, "") << value;
        EXPECT_EQ(pngWith(chunk("iTXt", "cotanFrame\0\0\0\0\0"s + value))->frame, "") << value;
    }
    EXPECT_EQ(pngWith(chunk("tEXt", "cotanFrame\0"s + std::string(64, 'x')))->frame, std::string(64, 'x'));
    // Truncated, compressed, or under another key.
    for (const std::string& data : {"cotanFrame"s, "cotanFrame\0"s, "cotanFrame\0\0"s, "cotanFrame\0\0\0de"s,
                                    "cotanFrame\0\1\0\0\0x\x9c"s, "cotanFramed\0\0\0\0\0smooth"s, ""s})
        EXPECT_EQ(pngWith(chunk("iTXt", data))->frame, "") << data;
    EXPECT_EQ(pngWith(chunk("zTXt", "cotanFrame\0\0smooth"s))->frame, "");
}

TEST(ImageFrame, ktx2FrameIsAKeyAndItsValue)
{
    const auto frameOf = [](const std::string& key) {
        const std::string file = makeKtx2({.levels = {{"rgba"}}, .keys = {"KTXorientation\0rd\0"s, key}});
        return decodeImage(bytesOf(file), "a.ktx2")->frame;
    };
    EXPECT_EQ(frameOf("cotanFrame\0smooth\0"s), "smooth");
    EXPECT_EQ(frameOf("cotanFrame\0smooth"s), "smooth");
    EXPECT_EQ(frameOf("cotanFrame"s), "");
    EXPECT_EQ(frameOf("cotanFrame\0two words\0"s), "");
}

TEST(ImageFrame, isKeptByConversionTo8Bits)
{
    EXPECT_EQ(toUnorm8(flatMap(PixelType::float32, "smooth")).frame, "smooth");
    EXPECT_EQ(toUnorm8(flatMap(PixelType::unorm16, "smooth")).frame, "smooth");
}

} // namespace
} // namespace cotan::test
