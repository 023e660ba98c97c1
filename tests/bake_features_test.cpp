// Features of `cotan bake` beyond a plain normal map, each on meshes whose answer follows from geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <glm/ext/vector_int3.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

constexpr const char* kFaces = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

// A square with side `side` and its lower left corner at (x, y), tilted by `slope` along x, with uv shifted by (u, v).
// v points up, as in OBJ.
std::string square(double x, double y, double z, double side, double slope = 0, double u = 0, double v = 0)
{
    std::string text;
    for (const auto& [i, j] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
        text += fmt::format("v {} {} {}\n", x + i * side, y + j * side, z + slope * i * side);
    for (const auto& [i, j] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
        text += fmt::format("vt {} {}\n", u + i, v + j);
    return text;
}

std::string faces(int base)
{
    return fmt::format("f {0}/{0} {1}/{1} {2}/{2}\nf {0}/{0} {2}/{2} {3}/{3}\n", base, base + 1, base + 2, base + 3);
}

class BakeFeatures : public testing::Test {
protected:
    TemporaryFolder folder;

    void write(const std::string& file, const std::string& text) { std::ofstream(folder / file) << text; }
    ToolRun bake(std::vector<std::string> words)
    {
        words.insert(words.begin(), {"bake", "--quiet", "--frame", "cotangent", "--json", "r.json"});
        return runTool(words, folder.path());
    }
    nlohmann::json statistics() { return nlohmann::json::parse(readWhole(folder / "r.json"))["bake"]; }
    Image loadImage(const std::string& file)
    {
        auto image = readImage(folder / file);
        EXPECT_TRUE(image) << file;
        return image ? std::move(*image) : makeImage(1, 1, PixelType::float32);
    }
};

TEST_F(BakeFeatures, severalMapsAreWrittenAsTheOutputNamesThemAndEachAsAlone)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("high.obj", square(-1, -1, 0.25, 3) + kFaces);
    const auto words = [&](std::vector<std::string> more) {
        std::vector<std::string> all = {"--high",         "high.obj", "--low",  "low.obj",
                                        "--max-distance", "1",        "--size", "8x8"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    for (const auto& [output, height, position] :
         {std::tuple("out.png", "out-height.png", "out-position.png"),
          {"new/maps/", "new/maps/height.png", "new/maps/position.png"},
          {"flat", "flat/height.png", "flat/position.png"},
          {"new/maps", "new/maps/height.png", "new/maps/position.png"}, // the folder of before
          {"tile_<UDIM>/", "tile_1001/height.png", "tile_1001/position.png"},
          {"a_<MAP>_8.png", "a_height_8.png", "a_position_8.png"}}) {
        const ToolRun r = bake(words({"--maps", "height,position", "-o", output, "--bits", "16"}));
        ASSERT_EQ(r.code, 0) << r.err;
        const auto maps = nlohmann::json::parse(readWhole(folder / "r.json"))["maps"];
        ASSERT_EQ(maps.size(), 2u);
        EXPECT_EQ(maps[0]["output"], height);
        EXPECT_EQ(maps[1]["output"], position);
        EXPECT_EQ(maps[1]["box"], nlohmann::json::parse("[[-1, -1, 0.25], [2, 2, 0.25]]"));
        for (const auto& [kind, file] : {std::pair("height", height), {"position", position}}) {
            ASSERT_EQ(bake(words({"--kind", kind, "-o", "alone.png", "--bits", "16"})).code, 0);
            EXPECT_EQ(readWhole(folder / file), readWhole(folder / "alone.png")) << file;
        }
    }
}

TEST_F(BakeFeatures, mapsOfMaterialsComeFromTheHighMeshAndOnesThatItLacksAreNamed)
{
    // Two squares side by side, a red rough one and a blue smooth one.
    write("paint.mtl", "newmtl red\nKd 1 0 0\nPr 0.8\nPm 0\nnewmtl blue\nKd 0 0 0.5\nPr 0.2\nPm 1\n");
    write("high.obj",
          "mtllib paint.mtl\nusemtl red\n" + square(-0.5, 0, 0, 1) + faces(1) + "usemtl blue\n" + square(0.5, 0, 0, 1)
              + faces(5));
    write("plain.obj", square(-0.5, 0, 0, 2) + kFaces);
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    const std::vector<std::string> words = {"--low", "low.obj", "--size", "4x4", "-o", "m.png", "--high"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return bake(more);
    };
    const ToolRun r = with({"high.obj", "--maps", "base-color,roughness-metallic,id"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Image color = loadImage("m-base-color.png"), surface = loadImage("m-roughness-metallic.png"),
                id = loadImage("m-id.png");
    for (int i = 0; i < 16; ++i) {
        const std::size_t red = i % 4 < 2 ? 4 * i : 4 * (i - 2), blue = i % 4 < 2 ? 4 * (i + 2) : 4 * i;
        const auto at = [](const Image& image, std::size_t first) {
            return glm::ivec3(image.bytes8()[first], image.bytes8()[first + 1], image.bytes8()[first + 2]);
        };
        EXPECT_EQ(at(color, red), glm::ivec3(255, 0, 0));
        EXPECT_EQ(at(color, blue), glm::ivec3(0, 0, 188)); // 255 srgb(0.5) = 187.5
        EXPECT_EQ(at(surface, red), glm::ivec3(255, 204, 0));
        EXPECT_EQ(at(surface, blue), glm::ivec3(255, 51, 255));
        EXPECT_EQ(at(id, red), glm::ivec3(128, 0, 0));
        EXPECT_EQ(at(id, blue), glm::ivec3(0, 128, 0));
    }
    EXPECT_EQ(nlohmann::json::parse(readWhole(folder / "r.json"))["maps"][2]["ids"],
              nlohmann::json::parse(R"([{"name": "red", "color": "#800000"}, {"name": "blue", "color": "#008000"}])"));
    // Packed: beside other maps by its name, alone as the output itself.
    for (const auto& [more, file, name] :
         {std::tuple(std::vector<std::string>{"--maps", "normal,orm"}, "m-orm.png", "orm"),
          {{"--pack", "orm"}, "m.png", "orm"},
          {{"--pack", "R=ao,G=roughness,B=metallic"}, "m.png", "packed"},
          {{"--maps", "id", "--pack", "R=ao,G=roughness,B=metallic"}, "m-packed.png", "packed"},
          {{"--pack", "both:R=ao,G=roughness,B=metallic", "--pack", "R=metallic"}, "m-both.png", "both"},
          {{"--pack", "x:R=ao,G=roughness,B=metallic", "-o", "<MAP>_1.png"}, "x_1.png", "x"}}) {
        std::vector<std::string> all = {"--high", "high.obj", "--low", "low.obj", "--size", "4x4", "--ao-rays", "9"};
        all.insert(all.end(), more.begin(), more.end());
        if (std::ranges::find(more, "-o") == more.end())
            all.insert(all.end(), {"-o", "m.png"});
        const ToolRun packed = bake(all);
        ASSERT_EQ(packed.code, 0) << packed.err;
        const Image image = loadImage(file);
        for (int i = 0; i < 16; ++i) // nothing occludes the plane
            EXPECT_EQ(glm::ivec3(image.bytes8()[4 * i], image.bytes8()[4 * i + 1], image.bytes8()[4 * i + 2]),
                      i % 4 < 2 ? glm::ivec3(255, 204, 0) : glm::ivec3(255, 51, 255));
        bool isReported = false;
        const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
        for (const auto& map : report["maps"])
            isReported = isReported
                || (map["kind"] == name && map["output"] == file
                    && map["channels"] == nlohmann::json::parse(R"(["ao", "roughness", "metallic", "1"])"));
        EXPECT_TRUE(isReported) << file;
    }
    std::filesystem::remove(folder / "m.png");
    for (const char* kind : {"base-color", "roughness", "metallic", "roughness-metallic", "emissive"}) {
        const ToolRun lacks = with({"plain.obj", "--kind", kind});
        EXPECT_EQ(lacks.code, 2);
        EXPECT_EQ(lacks.err.find("cotan: error: plain.obj: expected "), 0u) << lacks.err;
        EXPECT_NE(lacks.err.find(std::string("for a map of kind ") + kind + "; found none\n"), std::string::npos)
            << lacks.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "m.png"));
    }
    const ToolRun unpainted = with({"high.obj", "--kind", "id", "--id-by", "vertex-color"});
    EXPECT_EQ(unpainted.code, 2);
    EXPECT_EQ(unpainted.err, "cotan: error: high.obj: expected vertex colours for a map of kind id; found none\n");
}

TEST_F(BakeFeatures, mapsThatDoNotFitTogetherAreRefusedBeforeAnythingIsTraced)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("high.obj", square(-1, -1, 0.25, 3) + kFaces);
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"--high", "high.obj", "--low", "low.obj",  "--size",
                                          "256",    "-o",       "m.png", "--memory", "2"};
        words.insert(words.end(), more.begin(), more.end());
        return bake(words);
    };
    // A texel takes 4 bytes of the image for each map, 12 of values for heights, and 6 for states and padding: 1.9 MiB
    // for three maps, 2.1 for four. The last case has 16 for a channel, and 4 for its ao and curvature.
    EXPECT_EQ(with({"--maps", "position,height,normal"}).code, 0);
    std::filesystem::remove(folder / "m-height.png");
    for (const auto& [words, message] :
         {std::pair(std::vector<std::string>{"--maps", "position,height,normal,object-normal"},
                    "4 maps of 256x256 take 3 MiB together; the limit is 2 MiB (--memory raises it)"),
          {{"--maps", "position,height,normal", "--bits", "16"}, "3 maps of 256x256 take 3 MiB"},
          {{"--maps", "normal", "--pack", "R=ao,G=height,B=curvature"}, "4 maps of 256x256 take 4 MiB"}}) {
        const ToolRun r = with(words);
        EXPECT_EQ(r.code, 2) << r.err;
        EXPECT_NE(r.err.find(message), std::string::npos) << r.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "m-height.png"));
    }
}

TEST_F(BakeFeatures, aModelGetsAllMapsOfItsMaterials)
{
    write("paint.mtl", "newmtl red\nKd 1 0 0\nPr 0.8\nPm 0\nKe 0 0.5 0\n");
    write("high.obj", "mtllib paint.mtl\nusemtl red\n" + square(-1, -1, 0.01, 3) + kFaces);
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    for (const char* maps : {"ao,emissive,normal,roughness-metallic,base-color", "normal,emissive,base-color,orm"}) {
        const ToolRun r = bake({"--high", "high.obj", "--low", "low.obj", "--size", "4x4", "--ao-rays", "9", "--maps",
                                maps, "-o", "out.glb", "--overwrite", "--mask", "mask.png"});
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_TRUE(std::filesystem::exists(folder / "mask.png"));
        const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
        ASSERT_GE(report["maps"].size(), 4u);
        for (const auto& map : report["maps"])
            EXPECT_EQ(map["output"], "out.glb");
        for (const auto& [view, expected] : {std::pair("base-color", glm::ivec3(255, 0, 0)),
                                             {"roughness", glm::ivec3(204, 204, 204)},
                                             {"metallic", glm::ivec3(0, 0, 0)},
                                             {"occlusion", glm::ivec3(255, 255, 255)}}) {
            const ToolRun drawn = runTool({"render", "out.glb", "--view", view, "--size", "8x8", "--device",
                                           "reference", "-o", "view.png", "--ground", "off", "--quiet"},
                                          folder.path());
            ASSERT_EQ(drawn.code, 0) << drawn.err;
            const Image image = loadImage("view.png");
            const std::uint8_t* centre = image.bytes8() + 4 * (4 * 8 + 4);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(centre[c], expected[c], 1) << view;
        }
    }
}

TEST_F(BakeFeatures, allTilesAreBakedAsEachAlone)
{
    // Two squares, on the tiles 1001 and 1012, below high squares at other heights.
    const auto unitSquare = [](double x, double z, double u, double v, int first) {
        std::string text;
        for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
            text += fmt::format("v {} {} {}\nvt {} {}\nvn 0 0 1\n", x + dx, dy, z, u + dx, v + dy);
        const auto face = [&](int a, int b, int c) {
            return fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", first + a, first + b, first + c);
        };
        return text + face(0, 1, 2) + face(0, 2, 3);
    };
    write("low.obj", unitSquare(0, 0, 0, 0, 1) + unitSquare(5, 0, 1, 1, 5));
    write("high.obj", unitSquare(0, 0.1, 0, 0, 1) + unitSquare(5, -0.2, 0, 0, 5));
    const auto reportOf = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"--high", "high.obj", "--low",  "low.obj", "--kind",         "height",
                                          "--bits", "32",       "--size", "4x4",     "--max-distance", "1"};
        words.insert(words.end(), more.begin(), more.end());
        const ToolRun r = bake(words);
        EXPECT_EQ(r.code, 0) << r.err;
        return nlohmann::json::parse(readWhole(folder / "r.json"));
    };
    const auto all = reportOf({"--udim", "all", "-o", "t.exr", "--mask", "m_<UDIM>.png"});
    ASSERT_EQ(all["tiles"].size(), 2u);
    for (const auto& [i, tile, height] : {std::tuple(0, "1001", 0.1), {1, "1012", -0.2}}) {
        const std::string file = std::string("t.") + tile + ".exr", alone = std::string("alone_") + tile + ".exr";
        EXPECT_EQ(all["tiles"][std::size_t(i)]["tile"], std::stoi(tile));
        EXPECT_EQ(all["tiles"][std::size_t(i)]["output"], file);
        EXPECT_TRUE(std::filesystem::exists(folder / (std::string("m_") + tile + ".png")));
        EXPECT_NEAR(double(loadImage(file).floats()[0]), height, 1e-5);
        EXPECT_EQ(reportOf({"--udim", tile, "-o", "alone_%(UDIM)d.exr"})["output"], alone);
        EXPECT_EQ(readWhole(folder / file), readWhole(folder / alone));
    }
    const ToolRun none =
        bake({"--high", "high.obj", "--low", "low.obj", "--size", "4x4", "--udim", "1001,1002", "-o", "n.png"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("no triangle lies on tile 1002"), std::string::npos) << none.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "n.1001.png")) << "it is known before the first bake";
    EXPECT_EQ(reportOf({"-o", "one.exr"})["warnings"][0],
              "low.obj: the low mesh also has triangles on tiles 1012: they are not baked (--udim)");
    EXPECT_EQ(reportOf({"-o", "one.exr", "--udim", "1001"})["warnings"].size(), 0u); // it was chosen
    const ToolRun same = bake({"--high", "high.obj", "--low", "low.obj", "--size", "4x4", "--udim", "1001,1012", "-o",
                               "t_<UDIM>.png", "--mask", "t_<UDIM>.png"});
    EXPECT_EQ(same.code, 1);
    EXPECT_NE(same.err.find("the same file"), std::string::npos) << same.err;
}

TEST_F(BakeFeatures, mapsThatContradictOtherOptionsAreRefusedBeforeAnythingIsRead)
{
    for (const auto& [words, message] : {
             std::pair<std::vector<std::string>, const char*>({"--maps", "normal,ao,normal"},
                                                              "--maps: expected each map once; found normal twice"),
             {{"--maps", "normal,gloss"}, "found 'gloss'"},
             {{"--maps", "normal,"}, "--maps: expected one of normal, object-normal, height, ao, bent-normal, "},
             {{"--pack", "R=normal"}, "--pack: R: expected a map of one value per texel (height, ao, "},
             {{"--pack", "R=ao", "--pack", "G=ao"}, "--pack: expected each map once; found packed twice"},
             {{"--maps", "orm", "--pack", "orm"}, "--pack: expected each map once; found orm twice"},
             {{"--pack", "orm", "--kind", "ao"}, "--kind ao: makes one map; expected no --pack with it"},
             {{"--pack", "orm", "--verify", "checked"}, "--verify: only maps of the kind normal can be drawn"},
             {{"--maps", "ao", "--kind", "height"}, "--kind height: makes one map; expected no --maps with it"},
             {{"--maps", "normal,ao", "-o", "x_<MAP>"}, "x_normal"},
             {{"--mask", "states"}, "states"},
             {{"--udim", "1001,2000"},
              "--udim: expected numbers from 1001 to 1999, separated by commas, or all; found '2000'"},
             {{"--udim", "1002,1002"}, "--udim: expected each tile once; found 1002 twice"},
             {{"--udim", "1002", "--verify", "checked"},
              "--verify: draws the map of tile 1001 only; found --udim 1002"},
             {{"--maps", "height,ao", "--verify", "checked"}, "--verify: only maps of the kind normal can be drawn"},
             {{"--maps", "normal,curvature", "-o", "x.glb"},
              "-o x.glb: a glTF material has no texture for curvature; expected normal, ao, base-color, "
              "roughness-metallic, emissive or orm"},
             {{"--kind", "id", "-o", "x.glb"}, "has no texture for id"},
             {{"--pack", "R=ao", "-o", "x.glb"}, "has no texture for packed"},
             {{"--maps", "orm,ao", "-o", "x.glb"}, "expected one map for each texture of a material; found ao, orm"},
             {{"--maps", "normal,ao", "-o", "<MAP>.glb"}, "a model holds all maps; expected no <MAP> in its name"},
             {{"--maps", "base-color", "-o", "x.glb", "--bits", "32"},
              "expected --bits 8 or 16 for an image in a model"},
             {{"--kind", "thickness", "--thickness-distance", "-1"}, "--thickness-distance"},
         }) {
        std::vector<std::string> all = {"--high", "none.obj", "--low", "none.obj"};
        if (std::ranges::find(words, "-o") == words.end())
            all.insert(all.end(), {"-o", "x.png"});
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun r = bake(all);
        EXPECT_EQ(r.code, 1) << message;
        EXPECT_NE(r.err.find(message), std::string::npos) << r.err;
    }
}

TEST_F(BakeFeatures, heightIsTheDisplacementInModelUnits)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    for (double height : {0.25, -0.125}) { // both exact in float
        write("high.obj", square(-1, -1, height, 3) + kFaces);
        const ToolRun r = bake({"--high", "high.obj", "--low", "low.obj", "--kind", "height", "--max-distance", "1",
                                "--bits", "32", "--size", "8x8", "-o", "h.exr"});
        ASSERT_EQ(r.code, 0) << r.err;
        const Image image = loadImage("h.exr");
        ASSERT_EQ(image.type, PixelType::float32);
        for (std::size_t i = 0; i < 64; ++i) // rounding of ray starts, which are 1e-5 of the diagonal of 4.2 away
            EXPECT_NEAR(double(image.floats()[4 * i]), height, 1e-5);
    }
}

// Texels on the rims of charts lie on edges that two faces of the high mesh share; each must see its own face.
TEST_F(BakeFeatures, aBlockBakedOntoItselfIsFlatUpToItsChartBorders)
{
    std::string text;
    // Narrower at the top: rays along a side's normal are not parallel to the neighbouring sides.
    const glm::vec3 corners[8] = {{0, 0, 0},          {1, 0, 0},          {1, 1, 0},          {0, 1, 0},
                                  {0.3f, 0.3f, 0.3f}, {0.7f, 0.3f, 0.3f}, {0.7f, 0.7f, 0.3f}, {0.3f, 0.7f, 0.3f}};
    for (const glm::vec3& c : corners)
        text += fmt::format("v {} {} {}\n", c.x, c.y, c.z);
    const int sides[6][4] = {{4, 5, 6, 7}, {1, 0, 3, 2}, {5, 1, 2, 6}, {0, 4, 7, 3}, {7, 6, 2, 3}, {0, 1, 5, 4}};
    const char* const normals[6] = {"0 0 1", "0 0 -1", "1 0 1", "-1 0 1", "0 1 1", "0 -1 1"};
    for (int k = 0; k < 6; ++k) {
        const double u = 0.02 + 0.33 * (k % 3), v = 0.03 + 0.5 * (k / 3.0 >= 1); // six separate charts
        for (const auto& [i, j] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
            text += fmt::format("vt {} {}\n", u + 0.27 * i, v + 0.41 * j);
        text += fmt::format("vn {}\n", normals[k]);
    }
    for (int k = 0; k < 6; ++k) {
        auto corner = [&](int i) { return fmt::format("{}/{}/{}", sides[k][i] + 1, 4 * k + i + 1, k + 1); };
        text +=
            fmt::format("f {} {} {}\nf {} {} {}\n", corner(0), corner(1), corner(2), corner(0), corner(2), corner(3));
    }
    write("block.obj", text);
    const ToolRun r =
        bake({"--high", "block.obj", "--low", "block.obj", "--size", "61x47", "--max-distance", "0.1", "-o", "n.png"});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(statistics()["missed"], 0);
    EXPECT_GT(statistics()["touched"], 100); // the rims: six charts of about 16 x 19 texels
    const Image image = loadImage("n.png");
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        EXPECT_EQ(image.bytes8()[4 * i], 128) << "texel " << i;
        EXPECT_EQ(image.bytes8()[4 * i + 1], 128) << "texel " << i;
    }
}

TEST_F(BakeFeatures, objectNormalsAreThoseOfTheHighMeshInWorldAxes)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("high.obj", square(-1, -1, -0.75, 3, 0.75) + kFaces); // the plane z = 0.75 x: normal (-3, 0, 4) / 5
    const ToolRun r = bake({"--high", "high.obj", "--low", "low.obj", "--kind", "object-normal", "--max-distance", "2",
                            "--bits", "16", "--size", "4x4", "-o", "n.png"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Image image = loadImage("n.png");
    const double expected[3] = {-0.6, 0, 0.8};
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t k = 0; k < 3; ++k) // half a step of 16 bits is 1.5e-5 of [-1,1]
            EXPECT_NEAR((image.words()[4 * i + k] - 32768.0) / 32767, expected[k], 3e-5);
}

TEST_F(BakeFeatures, occlusionIsOneInTheOpenAndHalfAtTheFootOfAWall)
{
    // A wall along y, practically infinite, hides exactly half of the cosine-weighted hemisphere at its foot.
    write("low.obj", square(0, 0, 0, 0.001) + kFaces);
    const std::string ground = square(-1, -1, 0, 3) + kFaces;
    write("open.obj", ground);
    write("wall.obj",
          ground
              + "v -0.0001 -1000 0\nv -0.0001 1000 0\nv -0.0001 1000 1000\nv -0.0001 -1000 1000\n"
                "vt 0 0\nf 5/5 6/5 7/5\nf 5/5 7/5 8/5\n");
    for (const auto& [file, expected, tolerance] : {std::tuple("open.obj", 1.0, 0.0), {"wall.obj", 0.5, 0.02}}) {
        const ToolRun r = bake({"--high", file, "--low", "low.obj", "--kind", "ao", "--ao-rays", "1024",
                                "--max-distance", "0.1", "--bits", "32", "--size", "2x2", "-o", "ao.exr"});
        ASSERT_EQ(r.code, 0) << r.err;
        const Image image = loadImage("ao.exr");
        for (std::size_t i = 0; i < 4; ++i) // 1024 random directions would have 1 / sqrt(4 * 1024) = 0.016
            EXPECT_NEAR(double(image.floats()[4 * i]), expected, tolerance) << file;
    }
}

TEST_F(BakeFeatures, raysFromACageTakeTheOutermostSurface)
{
    // Two sheets: a hidden one at 0.1 and an outer one at 0.3. The nearest to the low mesh is the hidden one. Rays meet
    // the outer one first, from a cage at 0.5 as from the measured extent of the high mesh.
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("cage.obj", square(0, 0, 0.5, 1) + kFaces);
    write("high.obj", square(-1, -1, 0.1, 3) + square(-1, -1, 0.3, 3) + faces(1) + faces(5));
    for (const auto& [option, height] :
         {std::pair("--search", 0.1), {"--cage", 0.3}, {"--extrusion", 0.3}, {"", 0.3}}) {
        std::vector<std::string> words{"--high", "high.obj", "--low", "low.obj",        "--kind", "height", "--bits",
                                       "32",     "--size",   "4x4",   "--max-distance", "1",      "-o",     "h.exr"};
        if (const std::string word = option; !word.empty())
            words.insert(words.end(), {word, word == "--cage" ? "cage.obj" : word == "--search" ? "nearest" : "0.5"});
        const ToolRun r = bake(words);
        ASSERT_EQ(r.code, 0) << r.err;
        const Image image = loadImage("h.exr");
        for (std::size_t i = 0; i < 16; ++i)
            EXPECT_NEAR(double(image.floats()[4 * i]), height, 2e-5); // rays start 1e-5 of the diagonal away
    }
}

TEST_F(BakeFeatures, aUdimTileShowsTheTrianglesInIt)
{
    // Two squares in tiles 1001 and 1011 (one up); above the second the high mesh is higher.
    write("low.obj", square(0, 0, 0, 1) + square(5, 0, 0, 1, 0, 0, 1) + faces(1) + faces(5));
    write("high.obj", square(-1, -1, 0.1, 3) + square(4, -1, 0.2, 3) + faces(1) + faces(5));
    for (const auto& [tile, height, covered] : {std::tuple("1001", 0.1, 16), {"1011", 0.2, 16}}) {
        const ToolRun r = bake({"--high", "high.obj", "--low", "low.obj", "--kind", "height", "--bits", "32", "--size",
                                "4x4", "--max-distance", "1", "--udim", tile, "-o", "h.exr"});
        ASSERT_EQ(r.code, 0) << tile << r.err;
        EXPECT_EQ(statistics()["covered"], covered) << tile;
        const Image image = loadImage("h.exr");
        for (std::size_t i = 0; i < 16; ++i)
            EXPECT_NEAR(double(image.floats()[4 * i]), height, 1e-4) << tile; // rays start 1e-5 of the diagonal away
    }
    const ToolRun empty = bake({"--high", "high.obj", "--low", "low.obj", "--udim", "1003", "-o", "empty.png"});
    EXPECT_EQ(empty.code, 2); // no triangle is in that tile
    EXPECT_NE(empty.err.find("1003"), std::string::npos) << empty.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "empty.png"));
    for (const char* tile : {"1000", "2000", "0", "-1", "first"}) {
        const ToolRun r = bake({"--high", "high.obj", "--low", "low.obj", "--udim", tile, "-o", "bad.png"});
        EXPECT_EQ(r.code, 1) << tile;
        EXPECT_FALSE(std::filesystem::exists(folder / "bad.png"));
    }
}

TEST_F(BakeFeatures, outputsThatCannotBeWrittenAreRefusedBeforeTheBake)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("high.obj", square(-1, -1, 0.1, 3) + kFaces);
    struct Case {
        std::vector<std::string> arguments;
        int code;
    };
    for (const Case& c : {Case{{"--kind", "ao", "--verify", "views", "-o", "a.png"}, 1},
                          {{"--bits", "32", "-o", "b.png"}, 1},
                          {{"--mask", "none/m.png", "-o", "c.png"}, 4},
                          {{"-o", "none/d.png"}, 4}}) {
        std::vector<std::string> arguments{"--high", "high.obj", "--low", "low.obj"};
        arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
        const ToolRun r = bake(arguments);
        EXPECT_EQ(r.code, c.code) << r.err;
        EXPECT_EQ(r.err.find("covered"), std::string::npos) << r.err; // no bake was reported
        EXPECT_FALSE(std::filesystem::exists(folder / c.arguments.back()));
    }
}

TEST_F(BakeFeatures, severalHighMeshesAreOneSurface)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("left.obj", square(-1.5, -1, 0.1, 2) + kFaces); // x < 0.5
    write("right.obj", square(0.5, -1, 0.2, 2) + kFaces); // x > 0.5
    const ToolRun r = bake({"--high", "left.obj", "--high", "right.obj", "--low", "low.obj", "--kind", "height",
                            "--bits", "32", "--size", "4x1", "--max-distance", "1", "-o", "h.exr"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Image image = loadImage("h.exr");
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(double(image.floats()[4 * i]), i < 2 ? 0.1 : 0.2, 1e-4);
}

TEST_F(BakeFeatures, matchingByNameKeepsRaysOnTheirOwnPartner)
{
    // The partner of the low mesh is at 0.1; an unrelated mesh at 0.3 is in front of it.
    write("low.obj", "o door_low\n" + square(0, 0, 0, 1) + kFaces);
    write("high.obj",
          "o wall_high\n" + square(-1, -1, 0.3, 3) + faces(1) + "o door_high\n" + square(-1, -1, 0.1, 3) + faces(5));
    for (const auto& [match, height] : {std::pair(false, 0.3), {true, 0.1}}) {
        std::vector<std::string> words{"--high", "high.obj", "--low", "low.obj",        "--kind", "height", "--bits",
                                       "32",     "--size",   "4x4",   "--max-distance", "1",      "-o",     "h.exr"};
        if (match)
            words.push_back("--match-by-name");
        const ToolRun r = bake(words);
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_NEAR(double(loadImage("h.exr").floats()[0]), height, 1e-4);
    }
    write("low.obj", "o roof_low\n" + square(0, 0, 0, 1) + kFaces);
    const ToolRun alone = bake({"--high", "high.obj", "--low", "low.obj", "--match-by-name", "-o", "none.png"});
    EXPECT_EQ(alone.code, 2);
    EXPECT_EQ(lines(alone.err), 1) << alone.err;
    EXPECT_NE(alone.err.find("roof_low"), std::string::npos) << alone.err;
}

// Two squares at one place with uv side by side, each with its own detail: at 0.1 and at 0.2.
TEST_F(BakeFeatures, namesWithNumbersOfBlenderPair)
{
    write("low.obj",
          "o wall_low\n" + square(0, 0, 0, 1) + faces(1) + "o wall_low.001\n" + square(0, 0, 0, 1, 0, 1) + faces(5));
    write("high.obj",
          "o wall_high\n" + square(-1, -1, 0.1, 3) + faces(1) + "o wall_high.001\n" + square(-1, -1, 0.2, 3)
              + faces(5));
    const std::vector<std::string> words{"--high",
                                         "high.obj",
                                         "--low",
                                         "low.obj",
                                         "--match-by-name",
                                         "--kind",
                                         "height",
                                         "--bits",
                                         "32",
                                         "--size",
                                         "4x4",
                                         "--udim",
                                         "1001",
                                         "-o",
                                         "a.exr",
                                         "--max-distance",
                                         "1"};
    auto other = words;
    other[12] = "1002";
    other[14] = "b.exr";
    for (const auto& [run, file, height] : {std::tuple(words, "a.exr", 0.1), {other, "b.exr", 0.2}}) {
        const ToolRun r = bake(run);
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_NEAR(double(loadImage(file).floats()[0]), height, 1e-4);
    }
    EXPECT_TRUE(nlohmann::json::parse(readWhole(folder / "r.json"))["warnings"].empty());
    // One object alone: the detail of the others does not become its own.
    auto alone = words;
    alone.insert(alone.end(), {"--object", "wall_low"});
    ASSERT_EQ(bake(alone).code, 0);
    EXPECT_NEAR(double(loadImage("a.exr").floats()[0]), 0.1, 1e-4);
}

TEST_F(BakeFeatures, pairsByNameShadeOnlyThemselvesUnlessAsked)
{
    // A square under another pair's, which covers all of its sky.
    write("low.obj",
          "o a_low\n" + square(0, 0, 0, 1) + faces(1) + "o b_low\n" + square(0, 0, 0.01, 1, 0, 1) + faces(5));
    write("high.obj",
          "o a_high\n" + square(-9, -9, 0, 19) + faces(1) + "o b_high\n" + square(-9, -9, 0.01, 19) + faces(5));
    const std::vector<std::string> words{"--high",          "high.obj", "--low", "low.obj", "--kind", "ao",
                                         "--match-by-name", "--size",   "4x4",   "-o",      "ao.png"};
    ASSERT_EQ(bake(words).code, 0);
    EXPECT_EQ(int(loadImage("ao.png").bytes8()[0]), 255);
    auto all = words;
    all.insert(all.end(), {"--ao-occluders", "all"});
    ASSERT_EQ(bake(all).code, 0);
    EXPECT_LE(int(loadImage("ao.png").bytes8()[0]), 10);
}

TEST_F(BakeFeatures, namesThatPairSuggestMatching)
{
    write("low.obj", "o a_low\n" + square(0, 0, 0, 1) + faces(1) + "o b_low\n" + square(2, 0, 0, 1, 0, 1) + faces(5));
    write("high.obj", "o a_high\n" + square(0, 0, 0, 1) + faces(1) + "o b_high\n" + square(2, 0, 0, 1) + faces(5));
    std::vector<std::string> words{"bake", "--high", "high.obj", "--low",       "low.obj", "--size",
                                   "4x4",  "-o",     "m.png",    "--overwrite", "--udim",  "1001"};
    const std::string hint = "--match-by-name: the names of the meshes pair, such as 'a_low' with 'a_high'";
    EXPECT_NE(runTool(words, folder.path()).err.find(hint), std::string::npos);
    words.push_back("--match-by-name");
    EXPECT_EQ(runTool(words, folder.path()).err.find("--match-by-name"), std::string::npos);
    // What the names leave open is a warning, and in the report.
    write("high.obj",
          "o a_high\n" + square(0, 0, 0, 1) + faces(1) + "o b_high\n" + square(2, 0, 0, 1) + faces(5) + "o c_high\n"
              + square(4, 0, 0, 1) + faces(9));
    words.insert(words.end(), {"--json", "r.json"});
    const std::string left = "no low mesh has the name of 'c_high': not baked";
    EXPECT_NE(runTool(words, folder.path()).err.find(left), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(readWhole(folder / "r.json"))["warnings"], nlohmann::json::array({left}));
}

TEST_F(BakeFeatures, theMaskShowsMissedAndOverlappedTexels)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("half.obj", square(-1.5, -1, 0.1, 2) + kFaces); // only over x < 0.5
    ASSERT_EQ(bake({"--high", "half.obj", "--low", "low.obj", "--size", "8x8", "--max-distance", "1", "--mask",
                    "mask.png", "-o", "m.png"})
                  .code,
              0);
    EXPECT_EQ(statistics()["missed"], 32);
    const Image mask = loadImage("mask.png");
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(int(mask.bytes8()[4 * i]), i % 8 < 4 ? 0 : 255);     // red where missed
        EXPECT_EQ(int(mask.bytes8()[4 * i + 1]), i % 8 < 4 ? 179 : 0); // green 0.7 where found
    }
    write("twice.obj", square(0, 0, 0, 1) + square(5, 0, 0, 1) + faces(1) + faces(5)); // both have the same uv
    write("wide.obj", square(-1, -1, 0.1, 9) + kFaces);
    ASSERT_EQ(bake({"--high", "wide.obj", "--low", "twice.obj", "--size", "8x8", "--max-distance", "1", "--mask",
                    "mask.png", "-o", "m.png"})
                  .code,
              0);
    EXPECT_EQ(statistics()["claimed_twice"], 64);
    EXPECT_EQ(statistics()["disputed"], 0);
    EXPECT_EQ(int(loadImage("mask.png").bytes8()[0]), 0); // green: both are flat
    write("apart.obj", square(-1, -1, 0.1, 3) + square(4.5, -1, 0, 3, 1) + faces(1) + faces(5));
    ASSERT_EQ(bake({"--high", "apart.obj", "--low", "twice.obj", "--size", "8x8", "--max-distance", "2", "--mask",
                    "mask.png", "-o", "m.png"})
                  .code,
              0);
    EXPECT_EQ(statistics()["disputed"], 64);
    const Image yellow = loadImage("mask.png");
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(int(yellow.bytes8()[4 * i]), 255);
        EXPECT_EQ(int(yellow.bytes8()[4 * i + 1]), 255);
        EXPECT_EQ(int(yellow.bytes8()[4 * i + 2]), 0);
    }
}

TEST_F(BakeFeatures, theMaskShowsTexelsBelowTheHorizonAndTouchedOnes)
{
    // A low square tilted by 45 degrees (slope 1 along x), under a wall tilted further the other way: normals (-1, 0,
    // 1) and (4, 0, -1), more than 90 degrees apart.
    write("low.obj", square(0, 0, 0, 1, 1) + kFaces);
    write("wall.obj", "v 0.4 -9 -1.6\nv 1.4 -9 2.4\nv 1.4 9 2.4\nv 0.4 9 -1.6\nvt 0 0\nf 1/1 4/1 3/1\nf 1/1 3/1 2/1\n");
    ASSERT_EQ(bake({"--high", "wall.obj", "--low", "low.obj", "--size", "4x4", "--max-distance", "9", "--mask",
                    "mask.png", "-o", "m.png"})
                  .code,
              0);
    EXPECT_EQ(statistics()["negative_z"], 16);
    const Image blue = loadImage("mask.png");
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(int(blue.bytes8()[4 * i]), 0);
        EXPECT_EQ(int(blue.bytes8()[4 * i + 2]), 255);
    }
    // uv from 0 to 0.3, four texels a side. The first texel has its centre (1/8) covered; the second's (3/8) is 0.3
    // texels from an edge, within half a diagonal; the others are further away.
    write("part.obj",
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.3 0\nvt 0.3 0.3\nvt 0 0.3\n" + std::string(kFaces));
    ASSERT_EQ(bake({"--high", "part.obj", "--low", "part.obj", "--size", "4x4", "--max-distance", "1", "--mask",
                    "mask.png", "-o", "m.png"})
                  .code,
              0);
    EXPECT_EQ(statistics()["covered"], 1);
    EXPECT_EQ(statistics()["touched"], 3);
    const Image green = loadImage("mask.png");
    for (std::size_t y = 0; y < 4; ++y)
        for (std::size_t x = 0; x < 4; ++x) {
            const bool near = x < 2 && y > 1, covered = x == 0 && y == 3;
            EXPECT_EQ(int(green.bytes8()[4 * (4 * y + x) + 1]),
                      covered    ? 179
                          : near ? 89
                                 : 0)
                << x << " " << y; // 0.7, 0.35
        }
}

TEST_F(BakeFeatures, aCageFindsWhatTheDefaultDistanceMisses)
{
    // The high sheet is 0.4 away; 10 % of the low mesh's diagonal is 0.14.
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("cage.obj", square(0, 0, 0.5, 1) + kFaces);
    write("high.obj", square(-1, -1, 0.4, 3) + kFaces);
    std::vector<std::string> words{"--high", "high.obj", "--low",  "low.obj", "--kind", "height",
                                   "--bits", "32",       "--size", "4x4",     "-o",     "h.exr"};
    ASSERT_EQ(bake(words).code, 0);
    EXPECT_EQ(statistics()["missed"], 16);
    words.insert(words.end(), {"--cage", "cage.obj"});
    ASSERT_EQ(bake(words).code, 0);
    EXPECT_EQ(statistics()["missed"], 0);
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_NEAR(double(loadImage("h.exr").floats()[4 * i]), 0.4, 1e-5); // float rounding
}

TEST_F(BakeFeatures, supersamplesAverageWhatOneSampleMisses)
{
    // The step at x = 0.5 runs through the middle of the only texel: half of the samples see each side.
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    write("left.obj", square(-1.5, -1, 0.1, 2) + kFaces);
    write("right.obj", square(0.5, -1, 0.3, 2) + kFaces);
    for (const char* samples : {"4", "16"}) {
        ASSERT_EQ(bake({"--high", "left.obj", "--high", "right.obj", "--low", "low.obj", "--kind", "height", "--bits",
                        "32", "--size", "1x1", "--samples", samples, "--max-distance", "1", "-o", "h.exr"})
                      .code,
                  0);
        EXPECT_NEAR(double(loadImage("h.exr").floats()[0]), 0.2, 1e-4) << samples;
    }
}

TEST_F(BakeFeatures, hugeSizesAreRefusedWithoutMemory)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    for (const char* size : {"1000000x1000000", "99999999999x8", "16385x1", "-4x4", "16385", "8x", "x8"}) {
        const ToolRun r =
            bake({"--high", "low.obj", "--low", "low.obj", fmt::format("--size={}", size), "-o", "m.png"});
        EXPECT_EQ(r.code, 1) << size;
        EXPECT_EQ(lines(r.err), 1) << size << r.err;
        EXPECT_LT(r.megabytes, 300) << size; // the program and its libraries; a map of that size would take terabytes
    }
}

TEST_F(BakeFeatures, oneTriangleIsEnoughAndNonFinitePositionsAreRefused)
{
    write("low.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    const ToolRun one = bake({"--high", "low.obj", "--low", "low.obj", "--size", "8x8", "-o", "m.png"});
    EXPECT_EQ(one.code, 0) << one.err;
    write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    for (const auto& [high, low] : {std::pair("nan.obj", "low.obj"), {"low.obj", "nan.obj"}}) {
        const ToolRun r = bake({"--high", high, "--low", low, "--size", "8x8", "-o", "bad.png"});
        EXPECT_EQ(r.code, 2) << high;
        EXPECT_EQ(lines(r.err), 1) << r.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "bad.png"));
    }
}

TEST_F(BakeFeatures, interruptedBakesLeaveNoFile)
{
    write("low.obj", square(0, 0, 0, 1) + kFaces);
    const pid_t child = ::fork();
    if (child == 0) {
        // About 2 million texels of 65536 rays take hours, so the signal always arrives during the bake.
        if (::chdir(folder.path().c_str()) == 0)
            ::execl(COTAN_TOOL, COTAN_TOOL, "bake", "--quiet", "--high", "low.obj", "--low", "low.obj", "--kind", "ao",
                    "--ao-rays", "65536", "--size", "2048x1024", "-o", "m.png", static_cast<char*>(nullptr));
        ::_exit(127);
    }
    ASSERT_GT(child, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, WNOHANG), 0) << "ended before the signal";
    ::kill(child, SIGINT);
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    std::vector<std::string> left;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        left.push_back(entry.path().filename().string());
    EXPECT_EQ(left, std::vector<std::string>{"low.obj"}); // and no partial file under another name
}

} // namespace
} // namespace cotan::test
