// Faulty map files: the fault is named, and the printed command fixes the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "maps/texels.hpp"
#include "run_tool.hpp"

namespace cotan::maps {
namespace {

using namespace test;

// A relief with green up, whose slopes are a sum of random waves.
Image randomRelief(unsigned seed, PixelType type = PixelType::unorm8)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> anyPhase(0, 6.28f), steep(0.1f, 0.4f);
    std::uniform_int_distribution<int> waves(2, 9);
    struct Wave {
        glm::vec2 k;
        float phase, height;
    };
    std::vector<Wave> relief(5);
    for (Wave& w : relief)
        w = {{float(waves(random)), float(waves(random))}, anyPhase(random), steep(random)};
    Image image = makeImage(256, 256, type);
    std::vector<glm::vec4> row(256);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            glm::vec2 slope(0);
            for (const Wave& w : relief)
                slope += glm::normalize(w.k) * w.height
                    * std::cos(6.28318f * (w.k.x * float(x) - w.k.y * float(y)) / 256 + w.phase);
            row[std::size_t(x)] = encodeTexel(glm::vec3(-slope.x, -slope.y, 1), {}, type);
        }
        storeRow(image, y, row);
    }
    return image;
}

template<class Change> Image brokenBy(Image image, Change change)
{
    std::vector<glm::vec4> row(std::size_t(image.width));
    for (int y = 0; y < image.height; ++y) {
        loadRow(image, y, row);
        std::ranges::for_each(row, change);
        storeRow(image, y, row);
    }
    return image;
}

float encoded(float c) { return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }
float decoded(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

struct Broken {
    std::string kind;
    void (*change)(glm::vec4&);
};

// None of these changes uses Cotan's own `undo`.
const Broken kBroken[] = {
    {"srgb",
     [](glm::vec4& t) {
         t = {encoded(t.x), encoded(t.y), encoded(t.z), t.w};
     }},
    {"linearised",
     [](glm::vec4& t) {
         t = {decoded(t.x), decoded(t.y), decoded(t.z), t.w};
     }},
    {"bgr", [](glm::vec4& t) { std::swap(t.x, t.z); }},
    {"washed_out", [](glm::vec4& t) { t = glm::vec4(glm::vec3(t) * 0.7f + 0.3f * 128 / 255, t.w); }},
    {"green_down", [](glm::vec4& t) { t.y = 256.0f / 255 - t.y; }},
};

std::vector<std::string> kindsOf(const Image& map)
{
    const GreenVerdict green = greenOf(map);
    std::vector<std::string> kinds;
    for (const Fault& fault : faultsOf(green.statistics, &green))
        kinds.emplace_back(name(fault.kind));
    return kinds;
}

TEST(MapFaults, soundMapsHaveNone)
{
    for (unsigned seed = 1; seed <= 6; ++seed)
        for (const PixelType type : {PixelType::unorm8, PixelType::unorm16})
            EXPECT_EQ(kindsOf(randomRelief(seed, type)), std::vector<std::string>{}) << seed;
}

TEST(MapFaults, eachIsDetectedOnRandomReliefs)
{
    for (unsigned seed = 1; seed <= 6; ++seed)
        for (const Broken& broken : kBroken)
            EXPECT_EQ(kindsOf(brokenBy(randomRelief(seed), broken.change)), std::vector{broken.kind}) << seed;
}

TEST(MapFaults, eightBitsInAFileOf16AreNamed)
{
    const Image eight = randomRelief(3);
    Image wide = makeImage(eight.width, eight.height, PixelType::unorm16);
    std::vector<glm::vec4> row(std::size_t(eight.width));
    for (int y = 0; y < eight.height; ++y) {
        loadRow(eight, y, row);
        storeRow(wide, y, row);
    }
    EXPECT_EQ(kindsOf(wide), std::vector<std::string>{"8_in_16"});
}

// Runs the command as printed and compares the image with the one before the damage.
TEST(MapFaults, printedCommandFixesTheFile)
{
    TemporaryFolder folder;
    const Image sound = randomRelief(7);
    for (const Broken& broken : kBroken) {
        ASSERT_TRUE(writeImage(folder / "a map.png", brokenBy(sound, broken.change)));
        for (const char* command : {"info", "detect"}) {
            if (broken.kind == "green_down" && command == std::string("info"))
                continue; // info does not judge green
            const ToolRun printed = runTool({"map", command, "a map.png"}, folder.path());
            const std::size_t at = printed.out.find("to fix it: cotan ");
            ASSERT_NE(at, std::string::npos) << broken.kind << "\n" << printed.out;
            const std::string line = printed.out.substr(at + 18, printed.out.find('\n', at) - at - 18);
            EXPECT_NE(line.find("'a map.png'"), std::string::npos) << line;
            std::vector<std::string> words{"map", "convert", "a map.png"};
            std::istringstream rest(line.substr(line.find("' ") + 2, line.find(" -o ") - line.find("' ") - 2));
            for (std::string word; rest >> word;)
                words.push_back(word);
            words.insert(words.end(), {"-o", "fixed.png", "--quiet"});
            const ToolRun fixed = runTool(words, folder.path());
            ASSERT_EQ(fixed.code, 0) << fixed.err;
            const auto image = readImage(folder / "fixed.png");
            ASSERT_TRUE(image);
            // Curves and shorter vectors lose up to two of 255 steps. The other faults are undone exactly.
            const int tolerance = broken.kind == "bgr" || broken.kind == "green_down" ? 0 : 2;
            int worst = 0;
            for (std::size_t i = 0; i < 4 * sound.pixelCount(); ++i)
                worst = std::max(worst, std::abs(int(sound.bytes8()[i]) - int(image->bytes8()[i])));
            EXPECT_LE(worst, tolerance) << broken.kind << " " << line;
        }
    }
}

int worstStep(const Image& a, const Image& b)
{
    int worst = a.pixelCount() == b.pixelCount() && a.type == b.type ? 0 : 255;
    for (std::size_t i = 0; worst < 255 && i < 4 * a.pixelCount(); ++i)
        worst = std::max(worst, std::abs(int(a.bytes8()[i]) - int(b.bytes8()[i])));
    return worst;
}

// Green that points up or down, and one fault more.
TEST(MapFaults, autoFindsThemAndGreenAndGivesTheMapBeforeTheDamage)
{
    TemporaryFolder folder;
    unsigned seed = 10;
    for (const Broken& broken : kBroken)
        for (const bool down : {false, true}) {
            const Image sound = randomRelief(++seed);
            const Image turned = down ? brokenBy(sound, kBroken[4].change) : sound;
            const bool twice = broken.kind == "green_down";
            ASSERT_TRUE(writeImage(folder / "a map.png", twice ? turned : brokenBy(turned, broken.change)));
            for (const char* to : {"opengl", "directx"}) {
                const ToolRun fixed = runTool(
                    {"map", "convert", "a map.png", "--from", "auto", "--to", to, "-o", "fixed.png", "--overwrite"},
                    folder.path());
                ASSERT_EQ(fixed.code, 0) << broken.kind << down << fixed.err;
                const auto image = readImage(folder / "fixed.png");
                ASSERT_TRUE(image);
                const Image wanted = to == std::string("opengl") ? sound : brokenBy(sound, kBroken[4].change);
                const int tolerance = twice || broken.kind == "bgr" ? 0 : 2; // of 255 steps, as above
                EXPECT_LE(worstStep(wanted, *image), tolerance) << broken.kind << down << to << fixed.out;
            }
        }
}

// Its own zero stays, unless --to names another.
TEST(MapFaults, autoKeepsTheZeroOfTheMap)
{
    TemporaryFolder folder;
    const Image relief = randomRelief(5, PixelType::float32);
    Image map = makeImage(relief.width, relief.height, PixelType::unorm8);
    for (int y = 0; y < relief.height; ++y) {
        std::vector<glm::vec4> row(std::size_t(relief.width));
        loadRow(relief, y, row);
        for (glm::vec4& t : row)
            t = glm::vec4(glm::normalize(glm::vec3(3, 3, 1) * (2.0f * glm::vec3(t) - 1.0f)) * 0.5f + 0.5f, 1); // steep
        storeRow(map, y, row);
    }
    ASSERT_TRUE(writeImage(folder / "map.png", map));
    for (const auto& [to, same] : {std::pair("opengl", true), {"gltf", true}, {"opengl,exact", false}}) {
        const ToolRun run =
            runTool({"map", "convert", "map.png", "--from", "auto", "--to", to, "-o", "same.png", "--overwrite"},
                    folder.path());
        ASSERT_EQ(run.code, 0) << run.err;
        const auto image = readImage(folder / "same.png");
        ASSERT_TRUE(image);
        EXPECT_EQ(worstStep(map, *image) == 0, same) << to << run.out;
    }
}

TEST(MapFaults, autoRefusesAMapWhoseGreenCannotBeToldAndWritesNothing)
{
    TemporaryFolder folder;
    Image grey = makeImage(64, 64, PixelType::unorm8), flat = grey;
    for (std::size_t i = 0; i < 64 * 64; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            grey.bytes8()[4 * i + c] = c == 3 ? 255 : std::uint8_t(i % 64 * 3);
            flat.bytes8()[4 * i + c] = c < 2 ? 128 : 255;
        }
    for (const Image& image : {grey, flat}) {
        ASSERT_TRUE(writeImage(folder / "map.png", image));
        const ToolRun run =
            runTool({"map", "convert", "map.png", "--from", "auto", "--to", "opengl", "-o", "out.png"}, folder.path());
        EXPECT_EQ(run.code, 2) << run.out;
        EXPECT_NE(run.err.find("map.png: --from: auto: expected a normal map whose green can be told; found: "),
                  std::string::npos)
            << run.err;
        EXPECT_NE(run.err.find("opengl or directx"), std::string::npos);
        EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
    }
}

// Two maps that differ in green, together in one command where it reads two.
TEST(MapFaults, autoReadsMapsInEveryCommandAsTheirStatedConventionDoes)
{
    TemporaryFolder folder;
    const Image up = randomRelief(17);
    ASSERT_TRUE(writeImage(folder / "up.png", up));
    ASSERT_TRUE(writeImage(folder / "down.png", brokenBy(randomRelief(18), [](glm::vec4& t) {
                               t.y = (256 - std::round(t.y * 255)) / 255; // about 128, the exact zero
                           })));
    const std::string isUp = "gltf,exact", isDown = "gltf,exact,green-down";
    const auto bytesOf = [&](std::vector<std::string> words, const std::string& output) {
        words.insert(words.end(), {"-o", output, "--overwrite"});
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.err, "") << ::testing::PrintToString(words);
        return readWhole(folder / output);
    };
    for (const auto& [file, words] : {std::pair("up.png", isUp), {"down.png", isDown}})
        for (const auto& [command, output] : {std::pair("mips", "o.ktx2"), {"to-height", "o.png"}})
            EXPECT_EQ(bytesOf({"map", command, file, "--from", "auto"}, output),
                      bytesOf({"map", command, file, "--from", words}, output))
                << command << file;
    const std::string heat = bytesOf({"map", "diff", "up.png", "down.png", "--from", isUp, "--to", isDown}, "o.png");
    EXPECT_EQ(bytesOf({"map", "diff", "up.png", "down.png", "--from", "auto"}, "o.png"), heat);
    EXPECT_EQ(bytesOf({"map", "diff", "up.png", "down.png", "--from", "auto", "--to", isDown}, "o.png"), heat);
    EXPECT_EQ(bytesOf({"map", "diff", "up.png", "down.png", "--from", isUp, "--to", "auto"}, "o.png"), heat);
    const std::string blend =
        bytesOf({"map", "blend", "up.png", "down.png", "--from", isUp, "--detail-from", isDown}, "o.png");
    EXPECT_EQ(bytesOf({"map", "blend", "up.png", "down.png", "--from", "auto"}, "o.png"), blend);
    EXPECT_EQ(bytesOf({"map", "blend", "up.png", "down.png", "--from", isUp, "--detail-from", "auto"}, "o.png"), blend);
    const ToolRun run = runTool({"map", "diff", "up.png", "down.png", "--from", "auto"}, folder.path());
    EXPECT_NE(run.out.find("up.png: green: up"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("down.png: green: down"), std::string::npos) << run.out;
    for (const char* command : {"convert", "mips"})
        EXPECT_NE(runTool({"map", command, "up.png", "--from", "wrong", "--to", "gltf", "-o", "o.png"}, folder.path())
                      .err.find("--from: expected auto, or gltf "),
                  std::string::npos)
            << command;
}

// Maps of two channels, wherever these are, with green up and down: the command that detect prints for a map, and auto,
// give the relief; a map that needs no command keeps it.
TEST(MapFaults, printedCommandFixesMapsOfTwoChannels)
{
    TemporaryFolder folder;
    for (const unsigned seed : {3u, 4u}) {
        ASSERT_TRUE(writeImage(folder / "relief.png", randomRelief(seed)));
        for (const std::string stored : {"opengl", "directx"})
            for (const std::string swizzle : {"rg", "ra", "ag"}) {
                const std::string what = stored + ", " + swizzle + ", relief " + std::to_string(seed);
                const auto convert = [&](std::vector<std::string> words) {
                    words.insert(words.begin(), {"map", "convert"});
                    words.insert(words.end(), {"--quiet", "--overwrite"});
                    const ToolRun run = runTool(words, folder.path());
                    EXPECT_EQ(run.code, 0) << what << run.err;
                };
                convert({"relief.png", "--from", "opengl", "--to", stored + ",xy", "--swizzle", swizzle, "-o",
                         "two channels.png"});
                convert({"two channels.png", "--from", "auto", "--to", "opengl", "-o", "auto.png"});
                std::vector<std::string> fixed = {"auto.png"};
                const ToolRun detected = runTool({"map", "detect", "two channels.png", "--json", "-"}, folder.path());
                const auto fix = nlohmann::json::parse(detected.out).at("fix");
                EXPECT_EQ(fix.is_null(), stored == "opengl") << what;
                if (!fix.is_null()) {
                    std::istringstream printed(fix.get<std::string>());
                    std::vector<std::string> words = {"two channels.png", "-o", "fixed.png"};
                    for (std::string word; printed >> word;)
                        words.push_back(word);
                    convert(words);
                    fixed.push_back("fixed.png");
                }
                const auto relief = readImage(folder / "relief.png");
                for (const std::string& file : fixed) {
                    const auto image = readImage(folder / file);
                    ASSERT_TRUE(relief && image) << what;
                    EXPECT_LE(worstStep(*relief, *image), 2) << what << ", " << file;
                }
            }
    }
}

// If the zero of a map is 127.5, reversing green about 128 tilts normals by 0.45 degrees.
TEST(MapFaults, greenOfABiasedMapIsReversedAbout127AndAHalf)
{
    TemporaryFolder folder;
    const Image relief = randomRelief(7, PixelType::float32);
    Image sound = makeImage(relief.width, relief.height, PixelType::unorm8), reversed = sound;
    std::vector<glm::vec4> row(std::size_t(relief.width));
    for (int y = 0; y < relief.height; ++y) {
        loadRow(relief, y, row);
        for (glm::vec4& t : row)
            t = glm::vec4(glm::normalize(glm::vec3(3, 3, 1) * (2.0f * glm::vec3(t) - 1.0f)) * 0.5f + 0.5f, 1); // steep
        storeRow(sound, y, row);
        loadRow(sound, y, row);
        for (glm::vec4& t : row)
            t.y = 1 - t.y;
        storeRow(reversed, y, row);
    }
    ASSERT_TRUE(writeImage(folder / "turned.png", reversed));
    const ToolRun printed = runTool({"map", "detect", "turned.png"}, folder.path());
    EXPECT_NE(printed.out.find("convert turned.png --from directx,biased --to opengl,biased"), std::string::npos)
        << printed.out;
    ASSERT_EQ(runTool({"map", "convert", "turned.png", "--from", "directx,biased", "--to", "gltf,biased", "-o",
                       "fixed.png", "--quiet"},
                      folder.path())
                  .code,
              0);
    const auto fixed = readImage(folder / "fixed.png");
    ASSERT_TRUE(fixed);
    EXPECT_TRUE(std::equal(sound.bytes8(), sound.bytes8() + 4 * sound.pixelCount(), fixed->bytes8()));
}

// Each texel on its own, in images wider than high and higher than wide.
TEST(MapFaults, damageIsUndoneTexelByTexel)
{
    std::mt19937 dice(3);
    for (const glm::ivec2 size : {glm::ivec2(7, 3), {2, 9}, {1, 5}}) {
        Image map = makeImage(size.x, size.y, PixelType::unorm16, "map");
        for (std::size_t i = 0; i < map.data.size() / 2; ++i) {
            const auto value = std::uint16_t(dice());
            std::memcpy(&map.data[2 * i], &value, 2);
        }
        for (const char* words : {"gltf,srgb", "gltf,bgr"}) {
            const auto stated = parseStatedConvention(words);
            ASSERT_TRUE(stated) << words;
            Image whole = map;
            maps::undo(stated->damage, whole);
            EXPECT_NE(whole.data, map.data) << words;
            for (std::size_t i = 0; i < map.pixelCount(); ++i) {
                Image one = makeImage(1, 1, PixelType::unorm16, "one");
                std::memcpy(one.data.data(), &map.data[8 * i], 8);
                maps::undo(stated->damage, one);
                EXPECT_EQ(std::memcmp(one.data.data(), &whole.data[8 * i], 8), 0) << words << ' ' << i;
            }
        }
    }
}

// A render or a photograph has no channels to exchange and no curve to undo.
TEST(MapFaults, imagesThatAreNoNormalMapsHaveNoFaults)
{
    for (const Content content : {Content::other, Content::grey})
        for (const Transfer transfer : {Transfer::srgb, Transfer::linearised}) {
            NormalStatistics s;
            s.content = content;
            s.transfer = transfer;
            s.redIsZ = true;
            EXPECT_TRUE(faultsOf(s).empty());
        }
}

TEST(MapFaults, exchangedRedAndBlueMakeGreenUndecidable)
{
    const GreenVerdict verdict = greenOf(brokenBy(randomRelief(2), [](glm::vec4& t) { std::swap(t.x, t.z); }));
    EXPECT_EQ(verdict.green, Green::undecidable);
    EXPECT_NE(verdict.reason.find("red and blue are exchanged"), std::string::npos) << verdict.reason;
}

TEST(MapFaults, brokenConventionsAreRefusedAsTarget)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", randomRelief(1)));
    for (const std::vector<std::string>& words : {std::vector<std::string>{"convert", "map.png", "--from", "gltf"},
                                                  {"blend", "map.png", "map.png"},
                                                  {"mips", "map.png"},
                                                  {"from-height", "map.png"}}) {
        std::vector<std::string> all{"map"};
        all.insert(all.end(), words.begin(), words.end());
        for (const char* word : {"--to", "gltf,srgb", "-o", "out.png"})
            all.push_back(word);
        const ToolRun run = runTool(all, folder.path());
        EXPECT_EQ(run.code, 1) << words.front();
        EXPECT_NE(run.err.find("--to: srgb, linearised, bgr and grb describe broken maps"), std::string::npos)
            << run.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
}

} // namespace
} // namespace cotan::maps
