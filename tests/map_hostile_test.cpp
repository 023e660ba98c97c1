// `cotan map` on broken or huge images and on rare storage formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include <jpeglib.h>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "png_maker.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;

void writeBytes(const fs::path& file, const void* data, std::size_t size)
{
    std::ofstream(file, std::ios::binary).write(static_cast<const char*>(data), std::streamsize(size));
}

// Expects that every subcommand refuses `file`.
void expectAllRefuse(const TemporaryFolder& folder, const std::string& file)
{
    const std::vector<std::vector<std::string>> commands = {
        {"info", file},
        {"detect", file},
        {"convert", file, "--from", "gltf", "--to", "directx", "-o", "out.png"},
        {"convert", file, "--from", "unity,xy", "--to", "gltf", "-o", "out.tif"},
        {"diff", file, file, "-o", "out.png"},
        {"from-height", file, "-o", "out.png"},
        {"from-height", file, "--wrap", "clamp", "-o", "out.exr", "--bits", "half"},
        {"to-height", file, "-o", "out.png"},
        {"blend", file, file, "-o", "out.png"},
        {"mips", file, "-o", "out.dds"}};
    for (std::vector<std::string> words : commands) {
        words.insert(words.begin(), "map");
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 2) << words[1] << " " << file << ": " << run.err;
        EXPECT_EQ(lines(run.err), 1) << words[1] << " " << run.err;
        EXPECT_LT(run.megabytes, 600) << words[1]; // two strips of a million columns; the module of formats takes 130
        EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << words[1] << " left a file behind";
    }
}

TEST(MapHostile, a_truncated_image_is_refused_and_leaves_no_file)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::bricks, 200)));
    const std::string bytes = readWhole(folder / "map.png");
    fs::remove(folder / "map.png");
    writeBytes(folder / "short.png", bytes.data(), bytes.size() * 2 / 3);
    expectAllRefuse(folder, "short.png");
}

TEST(MapHostile, a_header_that_claims_a_million_by_a_million_is_refused)
{
    TemporaryFolder folder;
    const Bytes png = makePng({.width = 1'000'000, .height = 1'000'000, .rows = std::string(5000, '\0')});
    writeBytes(folder / "huge.png", png.data(), png.size());
    expectAllRefuse(folder, "huge.png");
}

Image flatStrip(int width, int rows)
{
    Image strip = makeImage(width, rows, PixelType::unorm8);
    for (std::size_t i = 0; i < strip.pixelCount(); ++i) {
        const std::uint8_t texel[4] = {std::uint8_t(120 + i % 16), 128, 255, 255};
        std::copy_n(texel, 4, strip.bytes8() + 4 * i);
    }
    return strip;
}

void writeTall(const fs::path& file, int width, int height)
{
    auto writer = createRows(file, {.width = width, .height = height});
    ASSERT_TRUE(writer);
    for (int y = 0; y < height; y += 64)
        ASSERT_TRUE((*writer)->write(flatStrip(width, 64)));
    ASSERT_TRUE((*writer)->finish());
}

TEST(MapHostile, memory_does_not_grow_with_the_image)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer keeps what was freed";
#endif
    TemporaryFolder folder;
    writeTall(folder / "low.png", 1024, 4096);
    writeTall(folder / "tall.png", 1024, 16384); // 50 MB more when decoded to RGBA
    const auto peak = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "map");
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        return run.megabytes;
    };
    const std::vector<std::vector<std::string>> commands = {
        {"convert", "FILE", "--from", "gltf", "--to", "directx", "-o", "out.png", "--threads", "1"},
        {"from-height", "FILE", "-o", "out.png", "--quiet", "--threads", "1"}};
    for (std::vector<std::string> words : commands) {
        std::array<double, 2> megabytes{};
        for (std::size_t i = 0; i < 2; ++i) {
            std::vector<std::string> these = words;
            std::ranges::replace(these, std::string("FILE"), std::string(i == 0 ? "low.png" : "tall.png"));
            megabytes[i] = peak(these);
        }
        // The number of 8 MB strips, in and out, that are in flight at once varies up to three.
        EXPECT_LT(megabytes[1], megabytes[0] + 25) << words[0];
    }
    // Blocks are held twice until they are written, a texel 2.7 bytes with all levels; as floats it had 16.
    writeTall(folder / "half.png", 1024, 2048);
    for (const auto& [word, out] : {std::pair("bc5", "out.dds"), std::pair("eac-rg11", "out.ktx2")}) {
        const auto of = [&, word = word, out = out](const char* file) {
            return peak({"convert", file, "--from", "gltf", "--to", "gltf,xy", "--compress", word, "--mips", "-o", out,
                         "--overwrite", "--threads", "1"});
        };
        EXPECT_LT(of("low.png"), of("half.png") + 4.0 * 1024 * 2048 / (1 << 20)) << word;
    }
}

TEST(MapHostile, strip_height_does_not_change_texels_and_borders_repeat)
{
    // The wide image is cut into strips of another height, and reads rows beyond top and bottom.
    TemporaryFolder folder;
    const auto heights = [](int width, int height, int period) {
        Image image = makeImage(width, height, PixelType::unorm16);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 4; ++c)
                    image.words()[4 * (y * width + x) + c] = c == 3
                        ? std::uint16_t(0xffff)
                        : std::uint16_t((x % period) * 1237 + y * 331 + (x % period) * y * 17);
        return image;
    };
    ASSERT_TRUE(writeImage(folder / "narrow.png", heights(32, 100, 32)));
    ASSERT_TRUE(writeImage(folder / "wide.png", heights(32 * 1024, 100, 32)));
    for (const std::string wrap : {"repeat", "clamp", "mirror"}) {
        std::array<Image, 2> out;
        for (std::size_t i = 0; i < 2; ++i) {
            const std::string name = i == 0 ? "narrow" : "wide", strength = i == 0 ? "1024" : "1"; // of the width
            ASSERT_EQ(runTool({"map", "from-height", name + ".png", "--wrap", wrap, "--strength", strength, "--kernel",
                               "sobel", "-o", name + "-out.png"},
                              folder.path())
                          .code,
                      0);
            LoadLimits limits;
            limits.imageSide = 1 << 20;
            const auto image = readImage(folder / (name + "-out.png"), limits);
            ASSERT_TRUE(image);
            out[i] = *image;
        }
        for (int y = 0; y < 100; ++y) // 30 columns in the middle
            EXPECT_EQ(
                std::memcmp(out[0].words() + 4 * (y * 32) + 4, out[1].words() + 4 * (y * 32768 + 16384) + 4, 30 * 8), 0)
                << wrap << " row " << y;
    }
}

// A BC5 block of two BC4 halves; every index is 0, which selects the first endpoint.
std::string bc5Block(int red, int green)
{
    std::string block(16, '\0');
    block[0] = char(red), block[8] = char(green);
    return block;
}

std::string ddsHeader(int width, int height, const char* fourCc)
{
    std::array<std::uint32_t, 32> header{};
    header[0] = 0x20534444, header[1] = 124, header[2] = 0x1007; // caps, height, width, pixel format
    header[3] = std::uint32_t(height), header[4] = std::uint32_t(width);
    header[19] = 32, header[20] = 0x4; // the format is a FourCC
    std::memcpy(&header[21], fourCc, 4);
    header[27] = 0x1000;
    return {reinterpret_cast<const char*>(header.data()), sizeof header};
}

TEST(MapHostile, bc5_files_are_read_as_x_and_y)
{
    TemporaryFolder folder;
    for (const bool vary : {true, false}) { // a constant y must not be mistaken for an opaque alpha
        const std::string dds = ddsHeader(8, 4, "ATI2") + bc5Block(200, 60) + bc5Block(40, vary ? 180 : 60);
        writeBytes(folder / "map.dds", dds.data(), dds.size());
        const ToolRun run = runTool({"map", "convert", "map.dds", "--from", "gltf,orthographic", "--to",
                                     "gltf,orthographic", "--bits", "8", "-o", "out.png"},
                                    folder.path());
        ASSERT_EQ(run.code, 0) << run.err;
        const auto out = readImage(folder / "out.png");
        ASSERT_TRUE(out);
        EXPECT_EQ(int(out->bytes8()[0]), 200);
        EXPECT_EQ(int(out->bytes8()[1]), 60);
        EXPECT_EQ(int(out->bytes8()[4 * 5]), 40);
        EXPECT_EQ(int(out->bytes8()[4 * 5 + 1]), vary ? 180 : 60);
    }
    const std::string half = ddsHeader(8, 4, "ATI2") + bc5Block(200, 60);
    writeBytes(folder / "short.dds", half.data(), half.size());
    EXPECT_EQ(runTool({"map", "info", "short.dds"}, folder.path()).code, 2);
}

TEST(MapHostile, cmyk_jpeg_is_read_as_a_map_and_as_a_texture)
{
    TemporaryFolder folder;
    const fs::path file = folder / "cmyk.jpg";
    std::FILE* out = std::fopen(file.c_str(), "wb");
    ASSERT_NE(out, nullptr);
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_stdio_dest(&jpeg, out);
    jpeg.image_width = jpeg.image_height = 16;
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    std::array<JSAMPLE, 64> row{};
    JSAMPROW rows = row.data();
    for (int y = 0; y < 16; ++y)
        jpeg_write_scanlines(&jpeg, &rows, 1);
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::fclose(out);
    write(quad(2), folder.path());
    std::string model = readWhole(folder / "quad.gltf");
    model.replace(model.find("waves.png"), 9, "cmyk.jpg");
    std::ofstream(folder / "quad.gltf") << model;
    const std::vector<std::string> small = {"--device", "reference", "--size", "16x16", "-o", "a.png"};
    for (std::vector<std::string> words : {std::vector<std::string>{"map", "info", "cmyk.jpg"},
                                           {"map", "detect", "cmyk.jpg"},
                                           {"lint", "quad.gltf"},
                                           {"render", "quad.gltf"},
                                           {"render", "--normal-map", "cmyk.jpg"}}) {
        if (words[0] == "render")
            words.insert(words.end(), small.begin(), small.end());
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << words[0] << " " << words[1] << ": " << run.err;
    }
}

TEST(MapHostile, grey_and_alpha_of_16_bits_are_x_and_y_for_two_channel_maps)
{
    TemporaryFolder folder;
    std::string rows;
    for (int y = 0; y < 4; ++y) {
        rows += '\0';
        for (int x = 0; x < 4; ++x) // x rises to the right, y downwards
            rows += std::string{char(128 + 20 * x), 0, char(100 + 20 * y), 0};
    }
    const Bytes png = makePng({.width = 4, .height = 4, .bits = 16, .colour = 4, .rows = rows});
    writeBytes(folder / "map.png", png.data(), png.size());
    ASSERT_EQ(runTool({"map", "convert", "map.png", "--from", "gltf,orthographic", "--to", "gltf,orthographic", "-o",
                       "out.png"},
                      folder.path())
                  .code,
              0);
    const auto out = readImage(folder / "out.png");
    ASSERT_TRUE(out);
    EXPECT_NEAR(out->words()[4 * 6], 168 * 256, 1); // texel (2, 1); one step of rounding
    EXPECT_NEAR(out->words()[4 * 6 + 1], 120 * 256, 1);
}

} // namespace
} // namespace cotan
