// What commands refuse: for each rule one case that breaks only that rule, and the nearest case that does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

struct OutputCase {
    std::string line; // words separated by single spaces
    int code;
    const char* message; // in the one line of standard error, or in standard output for code 0
};

std::vector<std::string> wordsOf(const std::string& line)
{
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
        words.push_back(word == "''" ? "" : word);
    return words;
}

// Writes the quad with its map of waves, a colour map, a height map and a mesh without materials.
void fill(const TemporaryFolder& folder)
{
    write(quad(2), folder.path());
    Image heights = makeImage(16, 8, PixelType::unorm16);
    for (std::size_t i = 0; i < heights.pixelCount(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            heights.words()[4 * i + c] = c < 3 ? std::uint16_t(1000 * (i % 16) + 300 * (i / 16)) : 65535;
    ASSERT_TRUE(writeImage(folder / "h.png", heights));
    ASSERT_TRUE(writeImage(folder / "n.png", makeReliefMap(Relief::domes, 32)));
    std::ofstream(folder / "m.obj") << "o part\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                       "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::ofstream(folder / "notes.txt") << "hello";
}

void expectMessage(const std::vector<OutputCase>& cases)
{
    TemporaryFolder folder;
    fill(folder);
    for (const OutputCase& c : cases) {
        const ToolRun run = runTool(wordsOf(c.line), folder.path());
        EXPECT_EQ(run.code, c.code) << c.line << "\n" << run.err;
        const std::string& text = c.code == 0 ? run.out : run.err;
        EXPECT_NE(text.find(c.message), std::string::npos) << c.line << "\nsays " << text;
        if (c.code != 0) {
            EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << c.line << "\n" << run.err;
        }
    }
}

TEST(CommandErrors, mapErrorsStateTheRule)
{
    expectMessage({
        {"map blend n.png n.png -o b.png --tiles 0", 1, "--tiles: expected N or NxM, each 1 to 4096; found '0'"},
        {"map blend n.png n.png -o b.png --tiles 1x0", 1, "--tiles: expected N or NxM"},
        {"map blend n.png n.png -o b.png --tiles 4097", 1, "--tiles: expected N or NxM"},
        {"map blend n.png n.png -o b.png --tiles 1x4097", 1, "--tiles: expected N or NxM"},
        {"map blend n.png n.png -o b.png --tiles 2y", 1, "--tiles: expected N or NxM"},
        {"map blend n.png n.png -o b.png --tiles 2x3x", 1, "--tiles: expected N or NxM"},
        {"map blend n.png n.png -o b.png --tiles 4096x1", 0, "b.png: 32 x 32, 8 bit"},
        {"map blend n.png n.png -o b.png --mode glue", 1,
         "--mode: expected reoriented, whiteout, udn, slopes or linear"},
        {"map blend n.png n.png -o b.png --from rgb", 1, "--from: "},
        {"map blend n.png n.png -o b.png --detail-from rgb", 1, "--detail-from: "},
        {"map blend n.png n.png -o b.png --to rgb", 1, "--to: "},
        {"map blend n.png n.png", 1, "map blend needs -o FILE"},
        {"map convert n.png --from gltf --to srgb -o c.png", 1,
         "describe broken maps; expected a convention without them, found 'srgb'"},
        {"map convert n.png --from srgb --to gltf -o c.png", 0, "c.png: 32 x 32, 8 bit"},
        {"map convert n.png --from gltf --to gltf,object -o c.png", 1, "--mesh"},
        {"map convert n.png --from gltf --to gltf,object -o c.png --mesh quad.gltf --frame x", 1, "'x'"},
        {"map convert n.png --from gltf --to gltf,object -o c.png --mesh quad.gltf", 0,
         "quad.gltf: the mesh uses 100.0 % of the map"},
        {"map convert n.png --from gltf --to gltf -o c.png", 0, "c.png: 32 x 32, 8 bit"},
        {"map from-height h.png -o f.png --metres 2", 1, "expected --metres and --range together"},
        {"map from-height h.png -o f.png --range 2", 1, "expected --metres and --range together"},
        {"map from-height h.png -o f.png --metres 2x3 --range 1", 0, "f.png: 16 x 8, 16 bit"},
        {"map from-height h.png -o f.png --metres 0 --range 1", 1,
         "--metres: expected metres as W or WxH, each over 0; found '0'"},
        {"map from-height h.png -o f.png --metres 2x0 --range 1", 1, "--metres: expected metres as W or WxH"},
        {"map from-height h.png -o f.png --metres 0x2 --range 1", 1, "--metres: expected metres as W or WxH"},
        {"map from-height h.png -o f.png --metres 2x --range 1", 1, "--metres: expected metres as W or WxH"},
        {"map from-height h.png -o f.png --metres 2m --range 1", 1, "--metres: expected metres as W or WxH"},
        {"map from-height h.png -o f.png --metres 1e300x1e300 --range 1", 1, "--metres: expected metres as W or WxH"},
        {"map from-height h.png -o f.png --kernel prewitt", 1,
         "--kernel: expected forward, central, sobel or scharr; found 'prewitt'"},
        {"map from-height h.png -o f.png --wrap border", 1, "--wrap: expected repeat, clamp or mirror; found 'border'"},
        {"map from-height h.png -o f.png --to rgb", 1, "--to: "},
        {"map from-height h.png", 1, "map from-height needs -o FILE"},
        {"map info gone.png", 2, "gone.png"},
    });
}

TEST(CommandErrors, foldersAreReadInOrderAndRefusedWithoutMaps)
{
    TemporaryFolder folder;
    fill(folder);
    std::filesystem::create_directories(folder / "maps/sub");
    std::filesystem::create_directories(folder / "empty");
    for (const char* name : {"maps/b.png", "maps/sub/a.png", "maps/a.png"})
        std::filesystem::copy_file(folder / "n.png", folder / name);
    std::ofstream(folder / "maps/notes.txt") << "no map";
    const ToolRun all = runTool({"map", "info", "maps", "n.png", "--json", "r.json"}, folder.path());
    ASSERT_EQ(all.code, 0) << all.err;
    const json report = json::parse(readWhole(folder / "r.json"));
    std::vector<std::string> files;
    for (const json& each : report["files"])
        files.push_back(each["file"]);
    EXPECT_EQ(files, (std::vector<std::string>{"maps/a.png", "maps/b.png", "maps/sub/a.png", "n.png"}));
    const ToolRun none = runTool({"map", "info", "empty"}, folder.path());
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("empty: expected a folder with images; found none"), std::string::npos) << none.err;
    std::ofstream(folder / "maps/c.png") << "no png";
    const ToolRun some = runTool({"map", "detect", "maps", "--json", "r.json", "--overwrite"}, folder.path());
    EXPECT_EQ(some.code, 2);
    EXPECT_NE(some.err.find("1 of 4 files cannot be judged; the first: maps/c.png"), std::string::npos) << some.err;
    const json partly = json::parse(readWhole(folder / "r.json"));
    ASSERT_EQ(partly["files"].size(), 4u); // the others are judged anyway
    for (const json& each : partly["files"])
        EXPECT_EQ(each.contains("error"), each["file"] == "maps/c.png") << each;
    for (const char* name : {"maps/a.png: ", "maps/b.png: ", "maps/sub/a.png: "})
        EXPECT_NE(("\n" + some.out).find(std::string("\n") + name), std::string::npos) << some.out;
}

TEST(CommandErrors, bakeErrorsStateTheRule)
{
    const std::string bake = "bake --high m.obj --low m.obj --size 8x8 ";
    expectMessage({
        {bake, 1, "bake needs -o FILE"},
        {bake + "-o b.png --kind ao --verify v", 1, "--verify: only maps of the kind normal can be drawn"},
        {bake + "-o b.glb --kind height", 1, "-o b.glb: a glTF material has no texture for height"},
        {bake + "-o b.glb --bits 32", 1, "-o b.glb: expected --bits 8 or 16 for an image in a model; found 32"},
        {bake + "-o b.glb --udim 1002", 1,
         "-o b.glb: one map covers tile 1001 of the texture coordinates only; found --udim 1002"},
        {bake + "-o b.glb --convention directx", 1,
         "--convention: a glTF model has three channels, green up; found directx"},
        {bake + "-o b.glb --object part", 1, "-o b.glb: expected an image with --object; found a model"},
        {bake + "-o b.glb --per-object", 1, "-o b.glb: expected an image with --per-object; found a model"},
        {bake + "-o b.png --per-object --object part", 1,
         "--per-object: makes a map for each object; expected no --object with it"},
        {bake + "-o b.png --per-object --cage m.obj", 1,
         "--per-object: expected no --cage, which belongs to one object"},
        {bake + "-o b.png --bits 32", 1, "--bits 32: expected a file that ends in "},
        {bake + "-o b.png --search nearest --extrusion 1", 1,
         "--extrusion: expected --search first with it; found nearest"},
        {bake + "-o b.png --cage m.obj --extrusion 1", 1,
         "--cage: rays start on it and stop at the first surface; expected no --extrusion with it"},
        {bake + "-o b.png --cage m.obj --search nearest", 1, "expected no --search nearest with it"},
        {bake + "-o b.png --high-map n.png", 1, "--high-map: expected --high-normals map with it; found smooth"},
        {bake + "-o b.png --high-convention gltf", 1, "--high-convention: expected --high-normals map with it"},
        {bake + "-o b.png --high-frame smooth", 1, "--high-frame: expected --high-normals map with it"},
        {bake + "-o b.png --high-normals map --high-map n.png --high-frame x", 1, "--high-frame: expected one of "},
        {bake + "-o b.png --high-normals map --high-map n.png --high-frame nonperspective", 1,
         "--high-frame: the frame nonperspective depends on the view"},
        {"bake --high m.obj --high m.obj --high m.obj --low m.obj -o b.png --high-normals map --high-map n.png "
         "--high-map n.png",
         1, "--high-map: expected one, or one for each of the 3 --high; found 2"},
        {bake + "-o b.png --convention gltf,object", 1,
         "--convention: expected a tangent-space map; found 'gltf,object'"},
        {bake + "-o b.png --convention gltf,signed", 1, "--convention: expected exact or biased; found signed"},
        {bake + "-o b.png --object lid", 2, "--object: m.obj has no object 'lid'; expected 'part'"},
        {bake + "-o b.png", 0, "map in b.png (normal, mikktspace, opengl, 8 bit)"},
        {bake + "-o o.png --object part --frame smooth", 0, "the map is for the frame smooth: read it with that"},
        {bake + "-o h.exr --kind height --bits 32", 0, "map in h.exr (height, in units, 32 bit)"},
        {bake + "-o b.glb --unsigned exact", 0, "map in b.glb (normal, mikktspace, opengl, 8 bit)"},
    });
}

TEST(CommandErrors, convertErrorsStateTheRule)
{
    const std::string convert = "convert quad.gltf ";
    expectMessage({
        {convert + "-o d.glb", 0, "d.glb: "},
        {convert + "--bits 8 -o c.glb", 1, "--bits: convert without --to-frame drops only the tangents"},
        {convert + "--to-frame smooth --max-degrees 1 -o c.glb", 1,
         "--max-degrees: applies to frames that are chosen; leave out --to-frame"},
        {convert + "--to-frame smooth", 1, "convert needs -o FILE"},
        {convert + "--to-frame x -o c.glb", 1, "--to-frame: "},
        {convert + "--from-frame x --to-frame smooth -o c.glb", 1, "--from-frame: "},
        {convert + "--to-frame nonperspective -o c.glb", 1,
         "--to-frame: expected a frame that does not depend on the view; found nonperspective"},
        {convert + "--to-frame smooth -o c.obj", 1, "-o: expected a file that ends in .glb or .gltf; found 'c.obj'"},
        {"convert m.obj --to-frame smooth -o c.glb", 1, "m.obj: expected a .gltf or .glb model"},
        {convert + "--keep-maps --keep-tangents -o c.glb", 1, "--keep-tangents: --keep-maps drops only the tangents"},
        {convert + "--keep-maps --bits 8 -o c.glb", 1, "--bits: --keep-maps drops only the tangents"},
        {convert + "--keep-maps --to-frame mikktspace -o c.glb", 1,
         "--to-frame: expected a frame that reads no tangents, since --keep-maps drops them; found mikktspace"},
        {convert + "--provoking last --from-frame smooth -o c.glb", 1, "--from-frame: applies to converted maps only"},
        {convert + "--provoking last --tangents generated -o c.glb", 1, "--tangents: applies to converted maps only"},
        {convert + "--provoking last --keep-tangents -o c.glb", 1, "--keep-tangents: applies to converted maps only"},
        {convert + "--provoking last --bits 16 -o c.glb", 1, "--bits: applies to converted maps only"},
        {convert + "--provoking last --unsigned exact -o c.glb", 1, "--unsigned: applies to converted maps only"},
        {convert + "--provoking last --verify v -o c.glb", 1, "--verify: applies to converted maps only"},
        {convert + "--to-frame smooth --verify v --overwrite -o quad.gltf", 1,
         "--verify: compares with quad.gltf, which -o replaces"},
        {convert + "--provoking last -o p.glb", 0, "p.glb: "},
        {convert + "--keep-maps -o k.glb", 0, " less"},
        {"tangents quad.gltf --frame exact", 1,
         "--frame: expected mikktspace, area-weighted, vertex or smooth; found 'exact'"},
        {"tangents quad.gltf --frame smooth -o t.glb", 1,
         "--frame smooth is derived when a model is loaded and never stored"},
        {"tangents quad.gltf --replace", 1, "--replace needs -o FILE"},
        {"tangents m.obj", 1, "m.obj: expected a .gltf or .glb model"},
    });
}

TEST(CommandErrors, imageErrorsStateTheRule)
{
    const std::string render = "render quad.gltf --device reference --size 16x12 ";
    expectMessage({
        {render, 1, "render needs -o FILE"},
        {render + "-o r.png --turntable 3 --frames 0..2", 1,
         "--turntable: expected neither --frames nor --json with it"},
        {render + "-o r.png --turntable 3 --json r.json", 1,
         "--turntable: expected neither --frames nor --json with it"},
        {render + "-o r.png --animation a --frames 3", 1, "--frames: expected A..B, numbers from 0 up"},
        {render + "-o r.png --animation a --frames -1..3", 1, "--frames: expected A..B, numbers from 0 up"},
        {render + "-o r.png --animation a --frames 3..2", 1, "--frames: expected A..B, numbers from 0 up"},
        {render + "-o r.png --animation a --frames 1..100001", 1, "at most 100000 images; found '1..100001'"},
        {render + "-o r.png --frames 1..2", 1, "--frames: expected --animation with it, and neither --time nor --json"},
        {render + "-o r.png --animation a --time 1 --frames 1..2", 1, "--frames: expected --animation with it"},
        {render + "-o r.png --animation a --json r.json --frames 1..2", 1, "--frames: expected --animation with it"},
        {render + "-o r.jpg --background none", 1, "--background none: .jpg files keep no transparency"},
        {render + "-o r.png --background none", 0, "r.png: 16x12, 2 triangles, frame orthonormal, on "},
        {render + "-o s.png --frame smooth", 0, "s.png: 16x12, 2 triangles, frame smooth, on "},
        {render + "-o r.gif", 1, "files hold the images of --turntable or --frames; found neither"},
        {"compare quad.gltf", 1, "compare needs -o FOLDER"},
        {"compare quad.gltf -o c --frames smooth", 1, "--frames: expected two names A,B; found 'smooth'"},
        {"compare quad.gltf -o c --frames smooth,x", 1, "--frames: "},
        {"compare quad.gltf -o c --frames x,smooth", 1, "--frames: "},
        {"lint quad.gltf --distance -1", 1, "--distance: expected a number from 0 to 1e9; found -1"},
        {"lint quad.gltf --distance 1.1e9", 1, "--distance: expected a number from 0 to 1e9"},
        {"lint quad.gltf --distance 1e9", 0, "quad.gltf: 1 primitive, 1 with a normal map, 1 with stored tangents"},
        {"lint quad.gltf --limit 181", 1, "--limit: expected degrees from 0 to 180; found 181"},
        {"lint quad.gltf --limit 180", 0, "check: passed"},
        {"lint quad.gltf --limit-area 101", 1, "--limit-area: expected percent from 0 to 100; found 101"},
        {"lint quad.gltf --limit-area 100", 0, "check: passed"},
        {"lint quad.gltf --strict", 1, "--strict: expected --limit DEGREES or --limit-area PERCENT; found neither"},
        {"accuracy --tables flat,round", 1, "--tables: expected names from flat, "},
        {"accuracy --tables flat --scene moon", 1, "nothing was measured: no chosen table has that scene"},
        {"accuracy --tables half --against gone.csv", 2, "gone.csv"},
        {"figures", 1, "figures needs -o FOLDER"},
        {"figures -o f --only moon", 1, "--only: expected one of "},
        {"shader --lang glsl --frame smooth --functions", 1, "--functions: only for --lang godot"},
        {"shader --lang glsl --frame smooth --two-sided", 1, "--two-sided: only for a whole shader of --lang godot"},
        {"shader --lang godot --two-sided --functions", 1, "--two-sided: only for a whole shader of --lang godot"},
        {"shader --lang glsl --frame x", 1, "'x'"},
        {"shader --lang glsl --frame smooth --set x", 1, "--set: "},
        {"batch jobs.txt", 1, "expected -o REPORT.html, or --store FOLDER and no report; found neither"},
        {"batch jobs.txt --merge --shard 1/2 -o b.html", 1, "--merge runs nothing: expected no --shard with it"},
        {"batch jobs.txt --merge --again -o b.html", 1, "--merge runs nothing: expected no --again with it"},
        {"batch jobs.txt --merge --store s", 1, "--merge: expected -o REPORT.html or --json FILE; found neither"},
        {"batch jobs.txt --store s --store t", 1, "--store: expected one folder (several with --merge); found several"},
    });
}

TEST(CommandErrors, lossyMapFormatsAreWarnedOfUnlessQuiet)
{
    TemporaryFolder folder;
    fill(folder);
    const auto run = [&](const std::string& line) { return runTool(wordsOf(line), folder.path()); };
    const std::string convert = "map convert n.png --from gltf --to gltf --overwrite -o ";
    EXPECT_NE(run(convert + "c.jpg").err.find("cotan: warning: JPEG adds errors of degrees to normal maps"),
              std::string::npos);
    EXPECT_EQ(run(convert + "c.png").err, "");
    const ToolRun quiet = run(convert + "c.jpg --quiet");
    EXPECT_EQ(quiet.out + quiet.err, "");
    const ToolRun piped = run(convert + "c.png --json -"); // only the report
    EXPECT_EQ(piped.out[0], '{') << piped.out;
    EXPECT_EQ(json::parse(piped.out)["command"], "map convert");
}

} // namespace
} // namespace cotan::test
