// Every format gives the same result in a reader process; files that once crashed a reader do not crash the tool.
#include <cstring>
#include <filesystem>
#include <fstream>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "files/file_registry.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/scene_wire.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

using namespace test;

// The whole scene, serialized.
std::vector<std::byte> everyByte(const Scene& scene)
{
    std::vector<std::byte> bytes;
    WireOut out([&](std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
        return true;
    });
    exchangeScene(out, scene);
    out.flush();
    return bytes;
}

Image gradient(int width, int height, PixelType type)
{
    Image image = makeImage(width, height, type);
    for (std::size_t i = 0; i < image.pixelCount() * 4; ++i) {
        if (type == PixelType::unorm8)
            image.bytes8()[i] = std::uint8_t(i * 7);
        else if (type == PixelType::unorm16)
            image.words()[i] = std::uint16_t(i * 1117);
        else
            image.floats()[i] = float(i) * 0.01f;
    }
    return image;
}

LoadLimits inChild()
{
    LoadLimits limits;
    limits.sandbox = {.program = SANDBOX_CHILD};
    return limits;
}

TEST(SandboxFormats, everyModelFormatGivesIdenticalScenes)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "m.obj")
        << "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "usemtl m\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::ofstream(folder / "m.mtl") << "newmtl m\nKd 0.1 0.5 0.9\nNs 30\nmap_Kd c.png\nmap_Bump n.png\n";
    // Written by hand: the exporter of Assimp 6.0.0 declares vertex colours in the header that it does not write.
    std::ofstream(folder / "m.ply") << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                       "property float z\nproperty float s\nproperty float t\nelement face 2\n"
                                       "property list uchar int vertex_index\nend_header\n0 0 0 0 0\n2 0 0 1 0\n"
                                       "2 1 0 1 1\n0 1 1 0 1\n3 0 1 2\n3 0 2 3\n";
    ASSERT_TRUE(writeImage(folder / "c.png", gradient(5, 3, PixelType::unorm8)));
    ASSERT_TRUE(writeImage(folder / "n.png", gradient(4, 4, PixelType::unorm16)));
    Assimp::Importer importer;
    const aiScene* source = importer.ReadFile((folder / "m.obj").string(), 0);
    ASSERT_TRUE(source);
    const std::pair<const char*, const char*> formats[] = {{"obj", ""},        {"ply", ""},     {"stl", "stlb"},
                                                           {"dae", "collada"}, {"fbx", "fbxa"}, {"3ds", "3ds"}};
    for (const auto& [extension, exporterName] : formats) {
        const auto file = folder / fmt::format("m.{}", extension);
        if (*exporterName) {
            Assimp::Exporter exporter;
            ASSERT_EQ(exporter.Export(source, exporterName, file.string()), aiReturn_SUCCESS) << extension;
        }
        const auto here = loadScene(file), there = loadScene(file, inChild());
        ASSERT_TRUE(here) << here.error().message;
        ASSERT_TRUE(there) << there.error().message;
        EXPECT_GE(there->meshes.at(0).triangleCount(), 1u);
        EXPECT_EQ(everyByte(*there), everyByte(*here)) << extension;
    }
    EXPECT_EQ(loadScene(folder / "m.obj", inChild())->images.size(), 2u); // the textures are read too
}

// The triangles of a GLB by the counts of its accessors, each mesh as often as a node shows it.
std::size_t trianglesOfAccessors(const std::filesystem::path& file)
{
    const std::string bytes = readWhole(file);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    const auto root = nlohmann::json::parse(bytes.substr(20, length));
    std::size_t corners = 0;
    for (const auto& node : root["nodes"])
        if (node.contains("mesh"))
            for (const auto& primitive : root["meshes"][node["mesh"].get<std::size_t>()]["primitives"])
                corners += root["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>();
    return corners / 3;
}

TEST(SandboxFormats, dracoModelsGiveIdenticalScenes)
{
    for (const char* const name : {"compressed/heart_draco.glb", "compressed/chess_board_draco.glb"}) {
        COTAN_NEEDS_DATA(name);
        const auto here = loadScene(dataFile(name)), there = loadScene(dataFile(name), inChild());
        ASSERT_TRUE(here) << here.error().message;
        ASSERT_TRUE(there) << there.error().message;
        EXPECT_EQ(everyByte(*here), everyByte(*there)) << name;
        std::size_t found = 0;
        for (const Instance& instance : here->instances)
            found += here->meshes[std::size_t(instance.mesh)].triangleCount();
        EXPECT_EQ(found, trianglesOfAccessors(dataFile(name)));
    }
}

TEST(SandboxFormats, errorsAreTheSameWithAndWithoutAChild)
{
    const TemporaryFolder folder;
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.dae", "a.fbx", "a.3ds"}) {
        std::ofstream(folder / name) << "garbage";
        const auto here = loadScene(folder / name), there = loadScene(folder / name, inChild());
        ASSERT_FALSE(here);
        ASSERT_FALSE(there);
        EXPECT_EQ(there.error().message, here.error().message);
        EXPECT_EQ(there.error().kind, here.error().kind);
    }
    EXPECT_EQ(loadScene(folder / "none.obj", inChild()).error().message,
              loadScene(folder / "none.obj").error().message);
}

// The tool then names the option that raises the limit, whichever process read the file.
TEST(SandboxFormats, memoryLimitsSetTheMemoryFlag)
{
    const TemporaryFolder folder;
    for (const char* name : {"a.tif", "a.exr", "a.tga"}) {
        ASSERT_TRUE(writeImage(folder / name, gradient(70, 50, PixelType::unorm8)));
        for (LoadLimits limits : {LoadLimits(), inChild()}) {
            limits.imageBytes = 1000;
            const auto whole = readImage(folder / name, limits);
            ASSERT_FALSE(whole) << name;
            EXPECT_TRUE(whole.error().memory) << whole.error().message;
            limits.imageBytes = limits.imageBytesBeyond = 200; // less than a row
            const auto rows = openRows(folder / name, limits);
            ASSERT_FALSE(rows) << name;
            EXPECT_TRUE(rows.error().memory) << rows.error().message;
        }
        std::ofstream(folder / name) << "garbage";
        const auto broken = readImage(folder / name, inChild());
        ASSERT_FALSE(broken);
        EXPECT_FALSE(broken.error().memory);
    }
}

TEST(SandboxFormats, imagesAndTheirRowsAreIdentical)
{
    const TemporaryFolder folder;
    const std::pair<const char*, PixelType> files[] = {
        {"a.tif", PixelType::unorm16}, {"a.exr", PixelType::float32}, {"a.tga", PixelType::unorm8}};
    for (const auto& [name, type] : files) {
        Image map = gradient(70, 50, type);
        map.frame = "smooth";
        ASSERT_TRUE(writeImage(folder / name, map));
        const auto here = readImage(folder / name), there = readImage(folder / name, inChild());
        ASSERT_TRUE(here) << here.error().message;
        ASSERT_TRUE(there) << there.error().message;
        EXPECT_EQ(there->type, here->type);
        EXPECT_EQ(there->name, here->name);
        EXPECT_EQ(there->width, 70);
        EXPECT_EQ(there->data, here->data) << name;
        EXPECT_EQ(there->frame, std::string(name) == "a.exr" ? "smooth" : "");

        auto rows = openRows(folder / name, inChild());
        ASSERT_TRUE(rows) << rows.error().message;
        EXPECT_EQ((*rows)->name, (folder / name).string());
        EXPECT_EQ((*rows)->frame, here->frame);
        EXPECT_EQ((*rows)->height, 50);
        EXPECT_TRUE((*rows)->alpha);
        std::vector<std::byte> all;
        for (const int height : {1, 20, 29}) {
            Image strip = makeImage(70, height, (*rows)->type);
            const Status read = (*rows)->read(strip);
            ASSERT_TRUE(read) << read.error().message;
            all.insert(all.end(), strip.data.begin(), strip.data.end());
        }
        EXPECT_EQ(all, here->data) << name;
    }
}

TEST(SandboxFormats, truncatedImagesFailWhenReadByRows)
{
    const TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "a.exr", gradient(64, 256, PixelType::float32)));
    std::filesystem::resize_file(folder / "a.exr", std::filesystem::file_size(folder / "a.exr") / 2);
    auto rows = openRows(folder / "a.exr", inChild());
    Status read = Done{};
    for (int y = 0; rows && read && y < 256; y += 64) {
        Image strip = makeImage(64, 64, (*rows)->type);
        read = (*rows)->read(strip);
    }
    const std::string message = rows ? read ? "" : read.error().message : rows.error().message;
    EXPECT_NE(message.find("a.exr: broken openexr image"), std::string::npos) << message;
}

std::string colladaTriangle(const std::string& array, const std::string& accessor)
{
    return "<COLLADA version=\"1.4.1\"><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array "
           "id=\"a\" "
        + array + "</float_array><technique_common><accessor " + accessor
        + "><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
          "type=\"float\"/></accessor>"
          "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
          "source=\"#p\"/></vertices><triangles "
          "count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 "
          "2</p></triangles></mesh></geometry>"
          "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"n\"><instance_geometry "
          "url=\"#g\"/>"
          "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

TEST(ColladaAccessors, areRefusedBeyondTheirArray)
{
    const TemporaryFolder folder;
    const std::string nine = "count=\"9\">0 0 0 1 0 0 0 1 0", ten = "count=\"10\">7 0 0 0 1 0 0 0 1 0";
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {nine, "source=\"#a\" count=\"3\" stride=\"3\"", ""},
        {nine, "source='#a'\n count = '3'\tstride='3' ", ""},
        {ten, "source=\"#a\" count=\"3\" stride=\"3\" offset=\"1\"", ""},
        {nine, "source=\"#a\" count=\"3\" stride=\"3\" offset=\"1\"",
         "expected an array of at least 10 numbers, found 9"},
        {nine, "source=\"#a\" count=\"3\" stride=\"4\"",
         "accessor of #a: expected an array of at least 11 numbers, found 9"},
        {nine, "source=\"#a\" count=\"4\" stride=\"3\"", "expected an array of at least 12 numbers, found 9"},
        {nine, "source=\"#a\" count=\"8\"", "expected an array of at least 10 numbers, found 9"}, // default stride 1
        {"count=\"0\">0 0 0 1 0 0 0 1 0", "source=\"#a\" count=\"3\" stride=\"3\"", "at least 9 numbers, found 0"},
    };
    for (const auto& [array, accessor, expected] : cases) {
        std::ofstream(folder / "a.dae") << colladaTriangle(array, accessor);
        const auto scene = loadScene(folder / "a.dae");
        const std::string found = scene ? "" : scene.error().message;
        EXPECT_EQ(found.empty(), expected.empty()) << accessor << ": " << found;
        EXPECT_NE(found.find(expected), std::string::npos) << accessor << ": " << found;
    }
}

// Names from a file appear in messages without their line breaks.
TEST(ColladaAccessors, errorsAreOneLine)
{
    const TemporaryFolder folder;
    std::string text = colladaTriangle("count=\"9\">0 0 0 1 0 0 0 1 0", "source=\"#a\nb\" count=\"4\" stride=\"3\"");
    text.replace(text.find("id=\"a\""), 6, "id=\"a\nb\"");
    std::ofstream(folder / "a.dae") << text;
    const auto scene = loadScene(folder / "a.dae");
    ASSERT_FALSE(scene);
    EXPECT_NE(scene.error().message.find("at least 12 numbers, found 9"), std::string::npos) << scene.error().message;
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << scene.error().message;
}

TEST(SandboxFormats, filesThatTheChildOpensCountAsInputs)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "m.obj") << "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    std::ofstream(folder / "m.mtl") << "newmtl m\nmap_Kd c.png\n";
    ASSERT_TRUE(writeImage(folder / "c.png", gradient(5, 3, PixelType::unorm8)));
    for (const char* name : {"m.obj", "m.mtl", "c.png"}) {
        guardInputs(/*overwrite*/ false);
        ASSERT_TRUE(loadScene(folder / "m.obj", inChild()));
        EXPECT_FALSE(planOutput("-o", folder / name)) << name;
        guardInputs(/*overwrite*/ false);
        ASSERT_TRUE(planOutput("-o", folder / name));
        const auto scene = loadScene(folder / "m.obj", inChild());
        ASSERT_FALSE(scene) << name;
        EXPECT_EQ(scene.error().kind, ErrorKind::usage);
        EXPECT_NE(scene.error().message.find(std::string(name) + ", which is an input"), std::string::npos)
            << scene.error().message;
    }
    guardInputs(/*overwrite*/ true);
}

TEST(SandboxTool, doesNotOverwriteFilesThatTheReaderOpened)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "m.obj") << "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    std::ofstream(folder / "m.mtl") << "newmtl m\nmap_Kd c.png\n";
    ASSERT_TRUE(writeImage(folder / "c.png", gradient(5, 3, PixelType::unorm8)));
    const std::string before = readWhole(folder / "c.png");
    const ToolRun run =
        runTool({"render", "m.obj", "-o", "c.png", "--device", "reference", "--size", "32x32"}, folder.path());
    EXPECT_EQ(run.code, 1) << run.err;
    EXPECT_NE(run.err.find("-o c.png would overwrite"), std::string::npos) << run.err;
    EXPECT_EQ(readWhole(folder / "c.png"), before);
}

TEST(SandboxTool, filesThatCrashedReadersGiveOneLine)
{
    COTAN_NEEDS_DATA("found/cycle.fbx");
    const std::filesystem::path found = dataFile("found");
    const std::pair<const char*, const char*> files[] = {
        {"cycle.fbx",
         kSanitized ? "cycle.fbx: the reader of FBX files" : "cycle.fbx: the reader of FBX files crashed (signal 11"},
        {"accessor_beyond_array.dae", "accessor of #a: expected an array of at least 9 numbers, found 0"},
        {"statements_before_newmtl.obj", ""}}; // exactly one line on stderr, whether it loads or not
    for (const auto& [name, expected] : files) {
        const TemporaryFolder folder;
        const ToolRun run =
            runTool({"render", (found / name).string(), "-o", "out.png", "--device", "reference", "--size", "32x32"},
                    folder.path(), 20);
        EXPECT_TRUE(run.code == 2 || (*expected == '\0' && run.code == 0)) << run.code;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(expected), std::string::npos) << run.err;
        EXPECT_LT(run.seconds, 5);
        EXPECT_LT(run.megabytes, 1024);
        EXPECT_EQ(std::filesystem::exists(folder / "out.png"), run.code == 0);
    }
}

} // namespace
} // namespace cotan
