// The table of image formats agrees with what readers and writers do.
#include "image/format_table.hpp"

#include <algorithm>
#include <cctype>

#include "cotan/image.hpp"
#include "image_io.hpp"

namespace cotan::test {
namespace {

std::string whole(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string upper(std::string text)
{
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

Image ramp(PixelType type)
{
    Image image = makeImage(8, 8, type);
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
        if (type == PixelType::unorm8)
            image.bytes8()[i] = std::uint8_t(i * 3 + 1);
        else if (type == PixelType::unorm16)
            image.words()[i] = std::uint16_t(i * 901 + 7);
        else
            image.floats()[i] = float(i) * 0.021f;
    return image;
}

constexpr std::array kTypes = {PixelType::unorm8, PixelType::unorm16, PixelType::float32};

TEST_F(ImageIo, upperCaseEndingsWriteTheSameFile)
{
    for (const ImageFormat& format : kImageFormats)
        for (const std::string_view ending : format.endings) {
            if (!format.writes || ending.empty())
                continue;
            const std::string small = "a" + std::string(ending), large = "a" + upper(std::string(ending));
            for (const PixelType type : kTypes) {
                ASSERT_TRUE(writeImage(folder / small, ramp(type)));
                ASSERT_TRUE(writeImage(folder / large, ramp(type)));
                EXPECT_EQ(whole(folder / small), whole(folder / large)) << large;
                EXPECT_EQ(readImage(folder / large)->type, readImage(folder / small)->type) << large;
            }
            const PixelType type = format.bits8 ? PixelType::unorm8 : PixelType::float32;
            for (const std::string& name : {small, large}) {
                auto rows = createRows(folder / name, {8, 8, type, format.alpha, format.halfs});
                ASSERT_TRUE(rows) << name;
                ASSERT_TRUE((*rows)->write(ramp(type)));
                ASSERT_TRUE((*rows)->finish());
            }
            EXPECT_EQ(whole(folder / small), whole(folder / large)) << large << " by rows";
        }
}

TEST_F(ImageIo, formatTableStatesStoredBitsAndAlpha)
{
    for (const ImageFormat& format : kImageFormats) {
        const auto file = folder / ("a" + std::string(format.endings[0]));
        if (!format.writes) {
            const Status written = writeImage(file, ramp(PixelType::unorm8));
            ASSERT_FALSE(written) << format.name;
            EXPECT_EQ(written.error().kind, ErrorKind::usage) << format.name;
            EXPECT_EQ(createRows(file, {8, 8}).error().kind, ErrorKind::usage) << format.name;
            continue;
        }
        for (const PixelType type : kTypes) {
            ASSERT_TRUE(writeImage(file, ramp(type))) << format.name;
            const auto back = readImage(file);
            ASSERT_TRUE(back) << format.name;
            const bool keeps = type == PixelType::unorm8 ? format.bits8
                : type == PixelType::unorm16             ? format.bits16
                                                         : format.floats;
            EXPECT_EQ(back->type == type, keeps) << format.name << " " << bitsPerComponent(type);
            EXPECT_EQ(back->channels, format.alpha ? 4 : 3) << format.name;
            if (keeps && format.alpha && !format.lossy) {
                EXPECT_EQ(back->data, ramp(type).data) << format.name;
            }
        }
        Image below = ramp(PixelType::float32);
        below.floats()[0] = -0.5f;
        ASSERT_TRUE(writeImage(file, below));
        const auto back = readImage(file);
        EXPECT_EQ(back->type == PixelType::float32 && back->floats()[0] == -0.5f, format.negative) << format.name;
        below.frame = "smooth";
        ASSERT_TRUE(writeImage(file, below));
        EXPECT_EQ(readImage(file)->frame, format.frame ? "smooth" : "") << format.name;
    }
}

TEST_F(ImageIo, formatTableStatesFileSignatures)
{
    for (const ImageFormat& format : kImageFormats) {
        if (!format.writes)
            continue;
        const auto file = folder / ("a" + std::string(format.endings[0]));
        ASSERT_TRUE(writeImage(file, ramp(PixelType::unorm8)));
        const std::string bytes = whole(file);
        const ImageFormat* const found = imageFormatOf(bytesOf(bytes));
        if (format.name == "TGA")
            EXPECT_EQ(found, nullptr);
        else
            ASSERT_TRUE(found && found->name == format.name) << format.name;
        // Contents decide the format, not the name, except for TGA.
        if (format.name != "TGA") {
            EXPECT_TRUE(decodeImage(bytesOf(bytes), "a.unknown")) << format.name;
        }
        EXPECT_TRUE(decodeImage(bytesOf(bytes), "a" + upper(std::string(format.endings[0])))) << format.name;
    }
    EXPECT_EQ(imageFormatOf(std::span<const std::byte>()), nullptr);
    EXPECT_EQ(imageFormatOf(bytesOf("RIFF1234WAVE")), nullptr);
    EXPECT_EQ(imageFormatOf(bytesOf("RIFF1234WEBP"))->name, "WebP");
}

TEST(ImageFormats, areFoundByEndingIgnoringCase)
{
    EXPECT_EQ(imageFormatOf(std::filesystem::path("a/B.ExR"))->name, "EXR");
    EXPECT_EQ(imageFormatOf(std::filesystem::path("x.TIFF"))->name, "TIFF");
    for (const char* name : {"exr", ".exr", "a.", "a", "", "a.exr.bak", "a.png "})
        EXPECT_EQ(imageFormatOf(std::filesystem::path(name)), nullptr) << name;
    for (const char* name : {"A.EXR", "a.HDR", "a.Tif", "a.TIFF", "a.exr"})
        EXPECT_TRUE(keepsFloats(name)) << name;
    for (const char* name : {"A.PNG", "a.jpg", "a.TGA", "a.webp", "a"})
        EXPECT_FALSE(keepsFloats(name)) << name;
    EXPECT_TRUE(isAnimation("a.WEBP"));
    EXPECT_TRUE(isAnimation("a.GIF"));
    EXPECT_FALSE(isAnimation("a.png"));
}

TEST(ImageFormats, endingsAreListedForMessages)
{
    EXPECT_EQ(imageEndings(&ImageFormat::animation), ".webp .gif");
    EXPECT_EQ(imageEndings(&ImageFormat::animation, ", ", " or "), ".webp or .gif");
    EXPECT_EQ(imageEndings(&ImageFormat::texture, ", ", " and "), ".dds and .ktx2");
    EXPECT_EQ(imageEndings(&ImageFormat::writes, " ", " or "), ".png .exr .tif .tga .jpg or .hdr");
    EXPECT_EQ(imageEndings([](const ImageFormat&) { return false; }), "");
}

TEST(ImageFormats, endingsAndStartsBelongToOneFormatEach)
{
    std::vector<std::string_view> endings;
    for (const ImageFormat& format : kImageFormats)
        for (const std::string_view ending : format.endings)
            if (!ending.empty()) {
                EXPECT_EQ(std::ranges::count(endings, ending), 0) << ending;
                endings.push_back(ending);
            }
    for (const ImageStart& start : kImageStarts) {
        std::string head(start.before);
        head.resize(start.at, 'x');
        head += start.bytes;
        EXPECT_EQ(imageFormatOf(bytesOf(head))->name, start.format);
    }
}

} // namespace
} // namespace cotan::test
