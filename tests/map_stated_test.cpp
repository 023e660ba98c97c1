// Maps that certainly are not what the command line says: one line each, wherever a convention is stated.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "cotan/scene.hpp"
#include "maps/patches.hpp"
#include "run_tool.hpp"

namespace cotan::maps {
namespace {

using namespace test;
using Words = std::vector<std::string>;

constexpr int kLarge = 1040; // above 16 * 64 texels patches no longer cover the image, and it is read in many strips

Image reversed(Image map)
{
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        std::uint8_t& green = map.bytes8()[4 * i + 1];
        green = std::uint8_t(std::min(256 - int(green), 255));
    }
    return map;
}

// Colours without any relation, as in a photograph.
Image photograph(int side)
{
    Image image = makeImage(side, side, PixelType::unorm8);
    unsigned state = 1;
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
        image.bytes8()[i] = i % 4 == 3 ? 255 : std::uint8_t((state = state * 1664525u + 1013904223u) >> 24);
    return image;
}

class MapStated : public testing::Test {
protected:
    MapStated()
    {
        write("up.png", makeReliefMap(Relief::domes, 128));
        write("down.png", reversed(makeReliefMap(Relief::domes, 128)));
        write("photo.png", photograph(128));
    }
    void write(const char* file, const Image& image) { EXPECT_TRUE(writeImage(folder / file, image)); }

    // The warnings of a command, which must succeed.
    std::string warnings(const Words& words)
    {
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << testing::PrintToString(words) << run.err;
        std::string found;
        for (std::size_t at = 0; (at = run.err.find("cotan: warning: ", at)) != std::string::npos;) {
            at += 16;
            found += run.err.substr(at, run.err.find('\n', at) + 1 - at);
        }
        return found;
    }

    TemporaryFolder folder;
};

TEST_F(MapStated, greenThatPointsTheOtherWayGetsOneLineInEveryCommand)
{
    write("large.png", reversed(makeReliefMap(Relief::domes, kLarge)));
    const std::string end = " (cotan map detect)\n", down = ".png: green points down, not up" + end;
    for (const auto& [words, expected] : std::vector<std::pair<Words, std::string>>{
             {{"convert", "up.png", "--from", "directx", "--to", "gltf", "-o", "o.png"},
              "--from: up.png: green points up, not down" + end},
             {{"convert", "large.png", "--from", "gltf", "--to", "directx", "-o", "o.png"}, "--from: large" + down},
             {{"convert", "down.png", "--from", "gltf", "--to", "gltf", "-o", "o.dds"}, "--from: down" + down},
             {{"blend", "down.png", "up.png", "-o", "o.png"}, "--from: down" + down},
             {{"blend", "up.png", "down.png", "-o", "o.png"}, "--detail-from: down" + down},
             {{"blend", "down.png", "down.png", "-o", "o.png"}, "--from: down" + down + "--detail-from: down" + down},
             {{"diff", "up.png", "down.png"}, "--to: down" + down},
             {{"mips", "down.png", "-o", "o.dds"}, "--from: down" + down},
             {{"to-height", "down.png", "-o", "h.exr"}, "--from: down" + down},
             {{"convert", "up.png", "--from", "gltf", "--to", "directx", "-o", "o.png"}, ""},
             {{"convert", "large.png", "--from", "directx", "--to", "gltf", "-o", "o.png"}, ""},
             {{"blend", "up.png", "down.png", "--detail-from", "directx", "-o", "o.png"}, ""},
             {{"diff", "up.png", "down.png", "--to", "directx"}, ""},
             {{"mips", "down.png", "--from", "directx", "-o", "o.dds"}, ""},
             {{"to-height", "down.png", "--from", "directx", "-o", "h.exr"}, ""}}) {
        Words all = words;
        all.insert(all.begin(), "map");
        EXPECT_EQ(warnings(all), expected) << testing::PrintToString(words);
        all.insert(all.end(), {"--json", "r.json", "--quiet"});
        EXPECT_EQ(warnings(all), "") << testing::PrintToString(words);
        std::string listed;
        const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
        for (const auto& line : report["warnings"])
            listed += line.get<std::string>() + end;
        EXPECT_EQ(listed, expected);
    }
}

TEST_F(MapStated, aMapOnAModelGetsALineToo)
{
    std::ofstream(folder / "square.obj")
        << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    const Words render{"render", "square.obj", "--normal-map", "down.png", "--size", "16", "-o", "o.png"};
    const std::string line = "down.png: green points down, not up; it is read as tangent space, xyz, green up";
    EXPECT_NE(warnings(render).find(line), std::string::npos) << warnings(render);
    Words right = render;
    right.insert(right.end(), {"--convention", "directx"});
    EXPECT_EQ(warnings(right).find("down.png"), std::string::npos);
    const Words bake{"bake",   "--high", "square.obj", "--low", "square.obj", "--high-normals", "map",
                     "--size", "8",      "-o",         "m.png", "--high-map", "down.png"};
    EXPECT_NE(warnings(bake).find(line), std::string::npos) << warnings(bake);
    right = bake;
    right.insert(right.end(), {"--high-convention", "directx"});
    EXPECT_EQ(warnings(right).find("down.png"), std::string::npos);
}

TEST_F(MapStated, imagesThatAreNoNormalMapGetALine)
{
    const Words convert{"map", "convert", "photo.png", "--from", "directx", "--to", "gltf", "-o", "o.png"};
    EXPECT_NE(warnings(convert).find("--from: photo.png: not a normal map: lengths far from 1"), std::string::npos);
    Image grey = photograph(64);
    for (std::size_t i = 0; i < grey.pixelCount(); ++i)
        std::fill_n(grey.bytes8() + 4 * i, 3, grey.bytes8()[4 * i]);
    write("grey.png", grey);
    EXPECT_NE(warnings({"map", "mips", "grey.png", "-o", "g.dds"}).find("grey.png: grey: a height map"),
              std::string::npos);
    // Blue that is not read may hold anything.
    EXPECT_EQ(warnings({"map", "convert", "photo.png", "--from", "gltf,xy", "--to", "gltf", "-o", "o.png"})
                  .find("not a normal map"),
              std::string::npos);
}

TEST_F(MapStated, whatIsRepairedOrUndecidableGetsNoLine)
{
    // Red and blue exchanged, which --from names, in a map whose green points down.
    Image damaged = reversed(makeReliefMap(Relief::domes, 128));
    for (std::size_t i = 0; i < damaged.pixelCount(); ++i)
        std::swap(damaged.bytes8()[4 * i], damaged.bytes8()[4 * i + 2]);
    write("bgr.png", damaged);
    EXPECT_EQ(warnings({"map", "convert", "bgr.png", "--from", "directx,bgr", "--to", "gltf", "-o", "o.png"}), "");
    EXPECT_NE(warnings({"map", "convert", "bgr.png", "--from", "directx", "--to", "gltf", "-o", "o.png"})
                  .find("red and blue are exchanged"),
              std::string::npos);
    // Grooves along the columns look the same with green up and down.
    Image grooves = makeImage(128, 128, PixelType::unorm8);
    for (std::size_t i = 0; i < grooves.pixelCount(); ++i) {
        const int x = i % 8 < 4 ? 30 : -30; // of 127, so that z is 123
        const std::uint8_t texel[4] = {std::uint8_t(128 + x), 128, 128 + 123, 255};
        std::copy_n(texel, 4, grooves.bytes8() + 4 * i);
    }
    write("grooves.png", grooves);
    for (const char* from : {"gltf", "directx"})
        EXPECT_EQ(warnings({"map", "convert", "grooves.png", "--from", from, "--to", "gltf", "-o", "o.png"}), "");
}

TEST_F(MapStated, aBlendKeepsTheAlphaOfItsBaseAsConvertDoes)
{
    Image base = makeReliefMap(Relief::domes, 64);
    for (std::size_t i = 0; i < base.pixelCount(); ++i)
        base.bytes8()[4 * i + 3] = std::uint8_t(i * 7);
    write("alpha.png", base);
    for (const Words& more : {Words{}, {"--strength", "0"}, {"--dither"}}) {
        Words words{"map", "blend", "alpha.png", "up.png", "-o", "o.png"};
        words.insert(words.end(), more.begin(), more.end());
        ASSERT_EQ(warnings(words), "");
        const auto blended = readImage(folder / "o.png");
        ASSERT_TRUE(blended);
        for (std::size_t i = 0; i < base.pixelCount(); ++i)
            ASSERT_EQ(blended->bytes8()[4 * i + 3], base.bytes8()[4 * i + 3]) << i;
    }
    // In memory, and where alpha holds x there is no other alpha to keep.
    std::size_t invalid = 0;
    const Image kept = blend(base, base, {}, invalid);
    EXPECT_EQ(kept.bytes8()[4 * 5 + 3], 35);
    const Convention two{.channels = Channels::orthographic};
    EXPECT_EQ(blend(base, base, {.base = two, .detail = two, .to = two}, invalid).bytes8()[4 * 5 + 3], 255);
}

TEST(QuickSample, agreesWithAllPatches)
{
    const Image up = makeReliefMap(Relief::domes, kLarge);
    const Convention stated{.greenUp = false};
    EXPECT_EQ(contradictionOf(up, stated), "green points up, not down");
    EXPECT_EQ(contradictionOf(greenOf(up), stated), "green points up, not down");
    PatchSampler quick(4096, 4096, PixelType::unorm8, PatchSampler::kQuickSide);
    std::size_t texels = 0;
    for (const Patch& patch : quick.patches())
        texels += patch.texels.pixelCount();
    EXPECT_LE(texels, std::size_t(16 * 16 * 65 * 65)) << "whatever the size of the map";
}

} // namespace
} // namespace cotan::maps
