// How map files are read and stored, by the functions themselves: types for formats, textures byte by byte, strips of
// images, limits from both sides.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "cotan/convention.hpp"
#include "cotan/image.hpp"
#include "map_files/height.hpp"
#include "map_files/inspect.hpp"
#include "map_files/map_file.hpp"
#include "map_files/mips.hpp"
#include "map_files/stream.hpp"
#include "maps/textures/texel_code.hpp"
#include "run_tool.hpp"

namespace cotan::maps {

using namespace app;
namespace {

namespace fs = std::filesystem;
using test::readWhole, test::TemporaryFolder;

Convention as(const char* words) { return *parseConvention(words); }

TEST(MapStored, typeIsThatOfTheInputIfTheFormatStoresIt)
{
    struct Row {
        const char *wanted, *file;
        const char* of[3]; // for inputs of 8 bits, 16 bits and floats: the type's name, or the refusal
    };
    const char *const no8 = " files cannot hold 8 bit", *const no16 = " files cannot hold 16 bit",
                      *const noFloats = " files cannot hold float", *const noHalfs = " files cannot hold half";
    for (const Row& row : {Row{"auto", "a.png", {"8 bit", "16 bit", "16 bit"}},
                           {"auto", "a.exr", {"float", "float", "float"}},
                           {"auto", "a.tif", {"8 bit", "16 bit", "float"}},
                           {"auto", "a.tga", {"8 bit", "8 bit", "8 bit"}},
                           {"auto", "a.hdr", {"float", "float", "float"}},
                           {"8", "a.png", {"8 bit", "8 bit", "8 bit"}},
                           {"8", "a.exr", {no8, no8, no8}},
                           {"16", "a.png", {"16 bit", "16 bit", "16 bit"}},
                           {"16", "a.tga", {no16, no16, no16}},
                           {"float", "a.tif", {"float", "float", "float"}},
                           {"float", "a.png", {noFloats, noFloats, noFloats}},
                           {"half", "a.exr", {"half", "half", "half"}},
                           {"half", "a.tif", {noHalfs, noHalfs, noHalfs}}})
        for (const PixelType input : {PixelType::unorm8, PixelType::unorm16, PixelType::float32}) {
            const auto bits = bitsFor(row.wanted, input, row.file);
            const std::string expected = row.of[std::size_t(input)];
            if (expected.starts_with(" files")) {
                ASSERT_FALSE(bits) << row.wanted << row.file;
                EXPECT_EQ(bits.error().kind, ErrorKind::usage);
                EXPECT_EQ(bits.error().message, "options.bits: " + std::string(row.file).substr(1) + expected);
            } else {
                ASSERT_TRUE(bits) << bits.error().message;
                EXPECT_EQ(bitsName(*bits), expected) << row.wanted << row.file << int(input);
                EXPECT_EQ(bits->half, expected == "half");
            }
        }
    EXPECT_EQ(bitsFor("7", PixelType::unorm8, "a.png").error().message,
              "options.bits: expected auto, 8, 16, half or float; found '7'");
    EXPECT_FALSE(bitsFor("8", PixelType::unorm8, "a.xyz"));
}

TEST(MapStored, signedValuesRequireAFloatFormat)
{
    Convention signedOne = as("gltf");
    signedOne.expansion = Expansion::signedValues;
    const auto said = [&](const char* wanted, const char* file) {
        const auto bits = bitsFor(wanted, PixelType::float32, signedOne, file);
        return bits ? bitsName(*bits) : bits.error().message;
    };
    const std::string refused = "options.to: signed values need a .exr or .tif of floats; found ";
    EXPECT_EQ(said("auto", "a.exr"), "float");
    EXPECT_EQ(said("half", "a.exr"), "half");
    EXPECT_EQ(said("float", "a.tif"), "float");
    EXPECT_EQ(said("16", "a.tif"), refused + ".tif, 16 bit");
    EXPECT_EQ(said("8", "a.tiff"), refused + ".tiff, 8 bit");
    EXPECT_EQ(said("float", "a.hdr"), refused + ".hdr, float");
    EXPECT_EQ(said("7", "a.exr"), "options.bits: expected auto, 8, 16, half or float; found '7'");
    EXPECT_TRUE(bitsFor("8", PixelType::unorm8, as("gltf"), "a.tif"));
}

TEST(MapStored, halfFloatsAreRoundedAndWriteErrorsReported)
{
    const TemporaryFolder folder;
    Image image = makeImage(3, 2, PixelType::float32);
    for (std::size_t i = 0; i < 24; ++i)
        image.floats()[i] = i % 4 == 3 ? 1 : 1 + float(i) / 4096; // steps of half floats are 1 / 1024 from 1 on
    image.frame = "smooth";
    for (const bool half : {false, true}) {
        ASSERT_TRUE(writeMap(folder / "a.exr", image, {PixelType::float32, half}));
        const auto back = readImage(folder / "a.exr");
        ASSERT_TRUE(back);
        EXPECT_EQ(back->width, 3);
        EXPECT_EQ(back->frame, "smooth");
        for (std::size_t i = 0; i < 24; ++i)
            EXPECT_NEAR(back->floats()[i], image.floats()[i], half ? 1.0 / 2048 : 0) << i;
        EXPECT_EQ(back->floats()[5] == image.floats()[5], !half);
    }
    for (const bool half : {false, true}) {
        const Status none = writeMap(folder / "gone/a.exr", image, {PixelType::float32, half});
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().kind, ErrorKind::output) << half;
    }
    EXPECT_FALSE(openMap(folder / "gone.png", as("gltf"), "options.from"));
    EXPECT_FALSE(readMap(folder / "gone.png", as("gltf"), "options.from"));
}

// x in red and y in alpha, or x in alpha and y in green: reading whole and by rows moves both to red and green.
TEST(MapStored, twoChannelsAreMovedToRedAndGreen)
{
    const TemporaryFolder folder;
    const auto expectXy = [&](const std::array<int, 4>& order, const char* convention, bool moved) {
        // `order` for red, green, blue and alpha: 0 x, 1 y, 2 constant.
        Image image = makeImage(5, 3, PixelType::unorm8);
        const auto value = [](int i, int what) {
            return std::uint8_t(what == 0 ? 40 + i : what == 1 ? 90 + 3 * i : 7);
        };
        for (int i = 0; i < 15; ++i)
            for (std::size_t c = 0; c < 4; ++c)
                image.bytes8()[4 * std::size_t(i) + c] = value(i, order[c]);
        ASSERT_TRUE(writeImage(folder / "a.png", image));
        const auto read = readMap(folder / "a.png", as(convention), "options.from");
        auto opened = openMap(folder / "a.png", as(convention), "options.from");
        ASSERT_TRUE(read && opened);
        Image strip = makeImage(5, 3, PixelType::unorm8);
        ASSERT_TRUE(opened->rows->read(strip)) << "from the first row on";
        opened->put(strip, 0);
        for (const Image* found : {&read->image, static_cast<const Image*>(&strip)})
            for (int i = 0; i < 15; ++i) {
                const std::uint8_t* p = found->bytes8() + 4 * i;
                EXPECT_EQ(p[0], moved ? value(i, 0) : value(i, order[0])) << i;
                EXPECT_EQ(p[1], moved ? value(i, 1) : value(i, order[1])) << i;
                EXPECT_EQ(p[3], moved ? 255 : value(i, order[3])) << i;
            }
    };
    expectXy({0, 0, 0, 1}, "gltf,orthographic", true);
    expectXy({2, 1, 2, 0}, "gltf,orthographic", true);
    expectXy({0, 1, 2, 2}, "gltf,orthographic", false);
    expectXy({2, 1, 2, 0}, "gltf", false); // three channels are not moved
}

TEST(MapStored, workOverTheBudgetIsRefusedWithBothNumbers)
{
    const TemporaryFolder folder;
    const fs::path flat = folder / "flat.png";
    ASSERT_TRUE(writeImage(flat, Image{"", 512, 384, PixelType::unorm8, std::vector(4 * 512 * 384, std::byte{128})}));
    const std::size_t size = fs::file_size(flat);
    LoadLimits limits;
    limits.imageBytesBeyond = 1000;
    limits.imageBytes = 1000 + 128 * size;
    EXPECT_EQ(workBudget(flat, limits), 1000 + 128 * size);
    limits.imageBytes -= 1;
    EXPECT_EQ(workBudget(flat, limits), 999 + 128 * size);
    EXPECT_EQ(workBudget(folder / "gone.png", limits), 1000u);
    const std::size_t pixels = 512 * 384;
    FileOptions files;
    const auto budget = [&](std::size_t bytes) { files.limits.imageBytesBeyond = bytes - 128 * size; };
    const auto height = [&] {
        const auto done = heightFromNormalsFile(flat, folder / "h.png", {.from = as("gltf")}, files);
        return done ? "" : done.error().message;
    };
    budget(12 * pixels); // a complex number and a height
    EXPECT_EQ(height(), "");
    budget(12 * pixels - 1);
    EXPECT_EQ(height(),
              flat.string()
                  + ": the solver takes 3 MiB for 512 x 384, the limit is 2 MiB for a file of this size"); // 2.25 MiB
    const auto mips = [&](const char* bits, const char* out) {
        const auto done = writeMips(flat, folder / out, {.from = as("gltf"), .bits = bits}, files);
        return done ? "" : done.error().message;
    };
    budget(19 * pixels / 3); // 8 bytes of moments and 11 one-byte components; mips may take three times the budget
    EXPECT_EQ(mips("8", "a.png"), "");
    budget(19 * pixels / 3 - 1);
    const std::string begin = flat.string() + ": the chain takes ", end = " MiB for a file of this size";
    EXPECT_EQ(mips("8", "b.png"), begin + "3 MiB for 512 x 384, the limit is 3" + end);  // 3.56 MiB, limit a bit less
    EXPECT_EQ(mips("16", "c.png"), begin + "5 MiB for 512 x 384, the limit is 3" + end); // 30 bytes: 5.6 MiB
    EXPECT_FALSE(fs::exists(firstMipFile(folder / "b.png")));
    EXPECT_TRUE(fs::exists(firstMipFile(folder / "a.png")));
    EXPECT_EQ(mips("8", "d.dds"), ""); // textures are made in strips
}

TEST(MapStored, unsupportedTextureFormatsAreReported)
{
    const auto said = [](const char* compress, const char* bits, const char* to, const char* file) -> std::string {
        const auto code = codeFor(compress, bits, as(to), file);
        if (code)
            return code->kind == TexelCode::astc
                ? fmt::format("{} x {}{}", code->width, code->height, code->two ? ", two" : "")
                : *code == TexelCode::eacRg11 ? "eac"
                : *code == TexelCode::bc5     ? "bc5"
                : *code == TexelCode::bc7     ? "bc7"
                                              : "rgba8";
        EXPECT_EQ(code.error().kind, ErrorKind::usage);
        return code.error().message;
    };
    for (const char* file : {"a.dds", "a.ktx2"})
        for (const char* bits : {"auto", "8"}) {
            EXPECT_EQ(said("none", bits, "gltf", file), "rgba8");
            EXPECT_EQ(said("none", bits, "gltf,slope", file), "rgba8");
            EXPECT_EQ(said("bc5", bits, "gltf", file), "bc5");
            EXPECT_EQ(said("bc5", bits, "gltf,orthographic", file), "bc5");
            EXPECT_EQ(said("bc7", bits, "gltf", file), "bc7");
        }
    for (const char* bits : {"auto", "8"}) {
        EXPECT_EQ(said("eac-rg11", bits, "gltf", "a.ktx2"), "eac");
        EXPECT_EQ(said("astc-6x5", bits, "gltf", "a.ktx2"), "6 x 5");
        EXPECT_EQ(said("astc-8x8", bits, "gltf,xy", "a.ktx2"), "8 x 8, two");
    }
    for (const char* word : {"eac-rg11", "astc-4x4"}) {
        EXPECT_EQ(said(word, "8", "gltf", "a.dds"),
                  fmt::format("options.compress: {} is for .ktx2 files; found '.dds'", word));
        EXPECT_EQ(
            said(word, "8", "gltf,slope", "a.ktx2"),
            fmt::format("options.to: {} holds x and y of unit vectors; found another form of two channels", word));
    }
    EXPECT_EQ(said("none", "16", "gltf", "a.png"), "rgba8") << "which is not asked about bits";
    EXPECT_EQ(said("bc6", "8", "gltf", "a.dds"),
              "options.compress: expected one of none, bc3, bc5, bc5-snorm, bc7, uastc, eac-rg11, astc-4x4, astc-5x4, "
              "astc-5x5, "
              "astc-6x5, astc-6x6, astc-8x5, astc-8x6, astc-8x8; found 'bc6'");
    EXPECT_EQ(said("bc5", "8", "gltf", "a.png"), "options.compress: blocks are for .dds and .ktx2 files; found '.png'");
    EXPECT_EQ(said("none", "16", "gltf", "a.ktx2"),
              "options.bits: expected 8 or auto, as .ktx2 files have 8 bits; found '16'");
    for (const char* form : {"gltf,slope", "gltf,stereographic"})
        EXPECT_EQ(said("bc5", "8", form, "a.dds"),
                  "options.to: bc5 holds x and y of unit vectors; found another form of two channels");
    for (const char* form : {"gltf,slope", "gltf,orthographic"})
        EXPECT_EQ(said("bc7", "8", form, "a.dds"),
                  "options.to: bc7 holds x, y and z; found two channels, which bc5 is for");
    EXPECT_EQ(said("none", "8", "gltf,signed", "a.dds"), "options.to: signed values need a .exr or .tif of floats");
    EXPECT_EQ(said("none", "8", "gltf,signed", "a.exr"), "rgba8");
    // Blocks store values from 0 to 1 around a half, whatever a shader treats as zero.
    for (const auto& [code, channels, expansion] :
         {std::tuple(TexelCode(TexelCode::rgba8), Channels::xyz, Expansion::exact),
          {TexelCode::bc5, Channels::orthographic, Expansion::biased},
          {TexelCode::eacRg11, Channels::orthographic, Expansion::biased},
          {{6, 6}, Channels::xyz, Expansion::biased},
          {TexelCode::bc7, Channels::xyz, Expansion::biased}}) {
        const Convention taken = codeConvention(code, as("directx,exact"));
        EXPECT_EQ(taken.channels, channels);
        EXPECT_EQ(taken.expansion, expansion);
        EXPECT_EQ(taken.greenUp, as("directx").greenUp);
    }
}

} // namespace
} // namespace cotan::maps
