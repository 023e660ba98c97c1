// What `cotan bake` prints about a bake: whole lines with their numbers, and that each appears only when it applies.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "run_tool.hpp"

namespace cotan::test {
namespace {

// A rectangle at height z, from x = `from` to `to` and y = 0 to 1; uv are x + `u` and y.
std::string square(double z, double from = 0, double to = 1, double u = 0)
{
    std::string text;
    for (const auto& [x, y] : {std::pair(from, 0), {to, 0}, {to, 1}, {from, 1}})
        text += fmt::format("v {} {} {}\nvt {} {}\n", x, y, z, x + u, y);
    return text + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
}

class BakeMessages : public ::testing::Test {
protected:
    BakeMessages()
    {
        write("low.obj", square(0));
        write("high.obj", square(0));
        write("above.obj", square(0.5));
        write("half.obj", square(0, 0, 0.5));
        write("third.obj", square(0, 0, 1, 2));  // its uv are in the third tile
        write("sliver.obj", square(0, 0, 0.01)); // between texel centres
    }
    void write(const char* name, const std::string& text) { std::ofstream(folder / name) << text; }

    ToolRun bake(const std::string& words)
    {
        std::vector<std::string> all = {"bake", "--size", "8", "--overwrite", "-o", "m.png"};
        std::istringstream stream(words);
        for (std::string word; stream >> word;)
            all.push_back(word);
        return runTool(all, folder.path());
    }

    // Expects exactly these lines, each once, on standard error.
    void expectWarned(const std::string& words, const std::vector<std::string>& lines)
    {
        std::string expected;
        for (const std::string& line : lines)
            expected += "cotan: warning: " + line + "\n";
        const ToolRun run = bake(words);
        EXPECT_EQ(run.code, 0) << words;
        EXPECT_EQ(run.err, expected) << words;
    }

    TemporaryFolder folder;
};

TEST_F(BakeMessages, aSoundBakeIsDescribedWithoutWarnings)
{
    for (const auto& [words, covered] :
         {std::pair("", "64 of 64 texels covered, 0 more filled at the edges of charts; "), {"--low half.obj", ""}}) {
        const ToolRun run =
            bake("--high high.obj --frame mikktspace " + std::string(*covered ? "--low low.obj" : words));
        EXPECT_EQ(run.err, "") << words;
        EXPECT_NE(run.out.find(*covered ? covered : "32 of 64 texels covered, "), std::string::npos) << run.out;
        EXPECT_NE(run.out.find("map in m.png (normal, mikktspace, opengl, 8 bit); peak memory "), std::string::npos);
        const std::string last = "usable: " + std::string(*covered ? "64" : "32")
            + " texels covered; 0 without a high surface, 0 below the horizon and 0 shared by triangles that differ\n";
        EXPECT_TRUE(run.out.ends_with(last)) << run.out;
        EXPECT_NE(run.out.find("the map is for the frame mikktspace: Unity, Unreal, Godot, Blender and glTF viewers"),
                  std::string::npos);
    }
    const ToolRun smooth = bake("--high high.obj --low low.obj --frame smooth --bits 16 --convention directx");
    EXPECT_NE(smooth.out.find("map in m.png (normal, smooth, directx, 16 bit)"), std::string::npos) << smooth.out;
    EXPECT_NE(smooth.out.find("the map is for the frame smooth: read it with that; engines use MikkTSpace tangents "
                              "and show it wrongly (--frame mikktspace is for them)"),
              std::string::npos);
    const ToolRun occlusion = bake("--high high.obj --low low.obj --kind ao --ao-rays 4");
    EXPECT_NE(occlusion.out.find("map in m.png (ao, 0 to 1, 8 bit)"), std::string::npos) << occlusion.out;
    EXPECT_EQ(occlusion.out.find("the map is for"), std::string::npos);
}

TEST_F(BakeMessages, missesAreCountedAndWarningsNameTheOptions)
{
    expectWarned(
        "--high above.obj --low low.obj --search nearest --max-distance 0.25",
        {"64 of 64 covered texels, most of them around texel 1, 1, found no high surface within 0.25 units; there is "
         "one further away: search further, or use a cage (--max-distance, --cage; --mask shows where)"});
    expectWarned(
        "--high half.obj --low low.obj",
        {"32 of 64 covered texels, most of them around texel 5, 1, have no high surface in front or behind at any "
         "distance: it has holes, or ends before the low mesh does (--mask shows where)"});
    write("cage.obj", square(0.25));
    expectWarned("--high above.obj --low low.obj --cage cage.obj --max-distance 0.125",
                 {"64 of 64 covered texels, most of them around texel 1, 1, found no high surface within the reach of "
                  "the cage; there "
                  "is one further away: move the cage further out (--mask shows where)"});
    expectWarned("--high above.obj --high high.obj --low low.obj --extrusion 1",
                 {}); // a part that floats is the first surface, as it should be
}

TEST_F(BakeMessages, anExtrusionThatReachesBeyondAnotherPartIsWarnedOf)
{
    // A floor in the left half of the map, below a slab with its bottom and top.
    std::string parts;
    for (const auto& [z, u, width, faces] : {std::tuple(0.0, 0.0, 0.5, "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"),
                                             {0.3, 0.5, 0.25, "f 5/5 7/7 6/6\nf 5/5 8/8 7/7\n"},
                                             {0.5, 0.75, 0.25, "f 9/9 10/10 11/11\nf 9/9 11/11 12/12\n"}}) {
        for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
            parts += fmt::format("v {} {} {}\nvt {} {}\n", x, y, z, u + width * x, y);
        parts += faces;
    }
    write("parts.obj", parts);
    const std::string words = "--high parts.obj --low parts.obj --json r.json --extrusion ";
    expectWarned(words + "0.2", {});
    expectWarned(words + "0.4", {}); // starts in the slab, whose bottom faces away
    expectWarned(words + "0.6",
                 {"32 of 64 covered texels, most of them around texel 1, 1, show another part: rays start 0.6 units in "
                  "front of the low mesh, beyond that part: start them nearer, or give no distance, so that it is "
                  "measured (--extrusion)"});
    EXPECT_NE(readWhole(folder / "r.json").find(R"("kind": "beyond_part")"), std::string::npos);
}

TEST_F(BakeMessages, framesOfTrianglesAndTilesWithoutTexelsAreWarnedOf)
{
    const std::string crease =
        " changes from triangle to triangle: filtering shows a crease one texel wide at edges of "
        "curved meshes; bake and draw with smooth to avoid it";
    for (const char* frame : {"cotangent", "gradient"})
        expectWarned("--high high.obj --low low.obj --frame " + std::string(frame),
                     {"the frame " + std::string(frame) + crease});
    for (const char* frame : {"vertex", "orthonormal"})
        expectWarned("--high high.obj --low low.obj --frame " + std::string(frame), {});
    expectWarned("--high high.obj --low low.obj --frame cotangent --kind height", {});
    expectWarned("--high high.obj --low third.obj --udim 1003", {});
    expectWarned("--high sliver.obj --low sliver.obj",
                 {"no triangle covers the centre of a texel on tile 1001; only edges touch it (--udim, --size)"});
    expectWarned("--high high.obj --low low.obj --kind height --high-normals map",
                 {"--high-normals map has no effect on a map of kind height"});
    write("twice.obj", square(0) + "f 1/1 2/2 3/3\n");
    expectWarned("--high high.obj --low twice.obj", {}); // both triangles want the same
}

} // namespace
} // namespace cotan::test
