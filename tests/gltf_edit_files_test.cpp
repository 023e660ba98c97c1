// The files that the glTF editor writes, byte by byte: containers, names, counts and joined buffers.
#include "gltf_edit_maker.hpp"

#include <algorithm>

namespace {

using namespace cotan::test;
namespace stdfs = std::filesystem;

std::vector<std::byte> bytesOf(const std::string& text)
{
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

// A model with two image files, the first of them under two names, and its buffer in a file.
stdfs::path writeModel(const TemporaryFolder& folder)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["images"] = {{{"uri", "maps/a%20b.png"}}, {{"uri", "c.png"}}, {{"uri", "maps/a%20b.png"}}};
    g.root["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    g.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
    g.root["materials"][0]["occlusionTexture"] = {{"index", 2}};
    g.root["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "model.bin"}, {"name", "first"}}};
    folder.write("maps/a b.png", flatPng());
    folder.write("c.png", flatPng() + "    "); // different bytes
    folder.write("model.bin", g.bytes);
    return folder.write("model.gltf", g.root.dump());
}

TEST(GltfFiles, aGlbHasAHeaderAndChunksPaddedToFourBytes)
{
    const TemporaryFolder folder;
    for (const std::string extra : {"", "1", "12", "123"}) { // all lengths modulo four of the text and the bytes
        Gltf g = square();
        g.root["asset"]["copyright"] = extra;
        g.bytes += extra;
        g.root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", g.bytes.size() - extra.size()}, {"byteLength", 1}});
        if (extra.empty())
            g.root["bufferViews"].erase(g.root["bufferViews"].size() - 1);
        const auto document = openText(folder, g.text());
        ASSERT_TRUE(document) << document.error().message;
        ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.glb"));
        const std::string bytes = wholeFile(folder.path / "out.glb");
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(wordAt(bytes, 4), 2u);
        EXPECT_EQ(wordAt(bytes, 8), bytes.size());
        const std::size_t text = wordAt(bytes, 12);
        EXPECT_EQ(bytes.substr(16, 4), "JSON");
        EXPECT_EQ(text % 4, 0u);
        const std::string root = bytes.substr(20, text);
        const std::size_t end = root.find_last_not_of(' ') + 1;
        EXPECT_EQ(root[end - 1], '}'); // padded by spaces
        EXPECT_LT(text - end, 4u);
        const std::size_t data = wordAt(bytes, 20 + text);
        EXPECT_EQ(bytes.substr(24 + text, 4), std::string("BIN\0", 4));
        EXPECT_EQ(data % 4, 0u);
        EXPECT_EQ(28 + text + data, bytes.size());
        const std::size_t length = json::parse(root)["buffers"][0]["byteLength"];
        ASSERT_LE(length, data);
        EXPECT_LT(data - length, 4u);
        for (std::size_t i = length; i < data; ++i)
            EXPECT_EQ(bytes[28 + text + i], '\0'); // padded by zeros
    }
    const auto nothing = openText(folder, R"({"asset":{"version":"2.0"}})");
    ASSERT_TRUE(nothing);
    ASSERT_TRUE(cotan::writeGltf(*nothing, folder.path / "out.glb"));
    const std::string bytes = wholeFile(folder.path / "out.glb");
    EXPECT_EQ(20 + wordAt(bytes, 12), bytes.size()); // there is no binary chunk
}

TEST(GltfFiles, sharedImagesAreEmbeddedOnceAndOtherFilesStayExternal)
{
    const TemporaryFolder folder;
    const auto document = cotan::openGltfDocument(writeModel(folder));
    ASSERT_TRUE(document) << document.error().message;
    const auto written = cotan::writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_TRUE(written->notes.empty());
    const ReadBack out = readBack(folder.path / "out.glb");
    const json& images = out.root["images"];
    EXPECT_EQ(images[0]["bufferView"], images[2]["bufferView"]);
    EXPECT_NE(images[0]["bufferView"], images[1]["bufferView"]);
    for (const json& image : images) {
        EXPECT_FALSE(image.contains("uri"));
        const json& view = out.root["bufferViews"][image["bufferView"].get<std::size_t>()];
        EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
        EXPECT_EQ(out.buffer.substr(view["byteOffset"], view["byteLength"]),
                  flatPng() + (&image == &images[1] ? "    " : ""));
    }
    EXPECT_EQ(written->bytesBefore,
              stdfs::file_size(folder.path / "model.gltf") + stdfs::file_size(folder.path / "model.bin")
                  + 2 * flatPng().size() + 4);
    stdfs::remove(folder.path / "c.png");
    folder.write("maps/a b.png", "no image");
    const auto poor = cotan::writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(poor);
    ASSERT_EQ(poor->notes.size(), 3u);
    EXPECT_EQ(poor->notes[0], R"(images[0]: "maps/a%20b.png" is missing or not an image; its URI is kept)");
    EXPECT_EQ(poor->notes[1], R"(images[1]: "c.png" is missing or not an image; its URI is kept)");
    EXPECT_EQ(readBack(folder.path / "out.glb").root["images"][1]["uri"], "c.png");
}

TEST(GltfFiles, imagesAreCopiedToTheSameRelativePaths)
{
    const TemporaryFolder folder, other;
    const auto document = cotan::openGltfDocument(writeModel(folder));
    ASSERT_TRUE(document);
    other.write("c.png", flatPng() + "    "); // an equal file is there and is kept
    const auto written = cotan::writeGltf(*document, other.path / "x.gltf");
    ASSERT_TRUE(written) << written.error().message;
    std::vector<std::string> names;
    for (const stdfs::path& file : written->files)
        names.push_back(file.lexically_relative(other.path).generic_string());
    EXPECT_EQ(names, (std::vector<std::string>{"x.gltf", "x.bin", "maps/a b.png"}));
    EXPECT_EQ(wholeFile(other.path / "maps/a b.png"), flatPng());
    EXPECT_EQ(written->bytesAfter,
              stdfs::file_size(other.path / "x.gltf") + stdfs::file_size(other.path / "x.bin") + 2 * flatPng().size()
                  + 4);
    const auto beside = cotan::writeGltf(*document, folder.path / "y.gltf"); // beside the source no image is copied
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->files.size(), 2u);
    EXPECT_EQ(beside->bytesAfter,
              stdfs::file_size(folder.path / "y.gltf") + stdfs::file_size(folder.path / "y.bin") + 2 * flatPng().size()
                  + 4);
    const std::string text = wholeFile(folder.path / "y.gltf");
    EXPECT_EQ(text.back(), '\n');
    EXPECT_NE(text.find("\n  \"asset\""), std::string::npos); // two spaces per level
}

TEST(GltfFiles, theBufferOfTheSourceIsNotOverwrittenByAnotherModel)
{
    const TemporaryFolder folder;
    const stdfs::path model = writeModel(folder);
    stdfs::rename(model, folder.path / "first.gltf");
    const auto document = cotan::openGltfDocument(folder.path / "first.gltf");
    ASSERT_TRUE(document);
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "model.gltf"));
    EXPECT_EQ(readBack(folder.path / "model.gltf").root["buffers"][0]["uri"], "model_data.bin");
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "other.gltf"));
    EXPECT_EQ(readBack(folder.path / "other.gltf").root["buffers"][0]["uri"], "other.bin");
    EXPECT_EQ(readBack(folder.path / "other.gltf").root["buffers"][0]["name"], "first");
}

// New images are named MODEL-NAME; invalid characters become underscores, and a name that is in use gets a number.
TEST(GltfFiles, newImagesGetPlainUnusedNames)
{
    const TemporaryFolder folder;
    auto document = cotan::openGltfDocument(writeModel(folder));
    ASSERT_TRUE(document);
    const std::string jpeg = "\xff\xd8\xff\xe0 not looked at";
    const std::string longName(70, 'x');
    const std::vector<std::pair<std::string, std::string>> added = {{"plain-name_1", "image/png"},
                                                                    {"plain-name_1", "image/png"},
                                                                    {"a/b c.\xc3\xa4", "image/jpeg"},
                                                                    {longName, "image/png"},
                                                                    {"", "image/png"},
                                                                    {"other", "image/unknown"},
                                                                    {"Other", "image/png"}};
    for (const auto& [name, mime] : added) {
        const std::size_t image =
            cotan::addGltfImage(*document, bytesOf(mime == "image/jpeg" ? jpeg : flatPng()), mime, name);
        const std::size_t texture = cotan::copyGltfTexture(*document, 0, image);
        const std::size_t material = cotan::copyGltfMaterial(*document, 0);
        rootOf(*document)["materials"][material]["normalTexture"]["index"] = texture;
    }
    cotan::replaceGltfImage(*document, 1, bytesOf(flatPng()), "image/png");
    folder.write("m-plain-name_1-2.png", "someone's");
    const auto written = cotan::writeGltf(*document, folder.path / "m.gltf");
    ASSERT_TRUE(written) << written.error().message;
    std::vector<std::string> uris;
    const ReadBack out = readBack(folder.path / "m.gltf");
    for (const json& image : out.root["images"])
        uris.push_back(image["uri"]);
    EXPECT_EQ(
        uris,
        (std::vector<std::string>{"maps/a%20b.png", "m-c.png", "maps/a%20b.png", "m-plain-name_1.png",
                                  "m-plain-name_1-3.png", "m-a_b_c.%C3%A4.jpg", "m-" + std::string(64, 'x') + ".png",
                                  "m-image7.png", "m-other.png", "m-Other-2.png"}))
        << "some file systems ignore case";
    EXPECT_EQ(wholeFile(folder.path / "m-plain-name_1-2.png"), "someone's");
    EXPECT_EQ(wholeFile(folder.path / "m-a_b_c.\xc3\xa4.jpg"), jpeg);
    EXPECT_EQ(wholeFile(folder.path / "c.png"), flatPng() + "    "); // replaced only in the model
    // Writing over the model again reuses the names that belong to it.
    const auto again = cotan::writeGltf(*document, folder.path / "m.gltf");
    ASSERT_TRUE(again);
    std::vector<std::string> same;
    const ReadBack second = readBack(folder.path / "m.gltf");
    for (const json& image : second.root["images"])
        same.push_back(image["uri"]);
    EXPECT_EQ(same, uris);
}

// A source image is never replaced, not even if it belongs to the model.
TEST(GltfFiles, newImagesDoNotReplaceThoseOfTheSource)
{
    const TemporaryFolder folder;
    const stdfs::path source = writeModel(folder), model = folder.path / "m.gltf";
    json root = json::parse(wholeFile(source));
    root["images"][1] = {{"uri", "m-c.png"}, {"name", "c"}};
    const std::string before = flatPng() + "read";
    folder.write("m-c.png", before);
    folder.write("m.gltf", root.dump());
    auto document = cotan::openGltfDocument(model);
    ASSERT_TRUE(document);
    cotan::replaceGltfImage(*document, 1, bytesOf(flatPng()), "image/png");
    ASSERT_TRUE(cotan::writeGltf(*document, model));
    EXPECT_EQ(readBack(model).root["images"][1]["uri"], "m-c-2.png");
    EXPECT_EQ(wholeFile(folder.path / "m-c.png"), before);
    EXPECT_EQ(wholeFile(folder.path / "m-c-2.png"), flatPng());
}

// Whatever file is there is replaced; of its images only those that belong to it may be removed with it.
TEST(GltfFiles, aReplacedFileMayHaveNoImagesOrBeNoModel)
{
    const TemporaryFolder folder;
    auto document = cotan::openGltfDocument(writeModel(folder));
    ASSERT_TRUE(document);
    cotan::replaceGltfImage(*document, 1, bytesOf(flatPng()), "image/png");
    for (const char* const before :
         {R"({"asset":{"version":"2.0"}})", R"({"images":3})", R"({"images":[1,{"uri":2}]})", "[1]", "no model", ""}) {
        folder.write("m.gltf", before);
        folder.write("m-c.png", "someone's");
        ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "m.gltf")) << before;
        EXPECT_EQ(wholeFile(folder.path / "m-c.png"), "someone's") << before;
        EXPECT_EQ(readBack(folder.path / "m.gltf").root["images"][1]["uri"], "m-c-2.png") << before;
        stdfs::remove(folder.path / "m-c-2.png");
    }
}

TEST(GltfFiles, viewsKeepTheirBytesAndGapsAreRemoved)
{
    Gltf g = square();
    const std::size_t used = g.bytes.size();
    g.bytes += std::string(40, 'g'); // no view covers these bytes
    const int times = g.floats({0, 1}, "SCALAR"), values = g.floats({0, 0, 0, 1, 2, 3}, "VEC3");
    g.root["animations"] = {{{"samplers", {{{"input", times}, {"output", values}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const TemporaryFolder folder;
    const auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.buffer.size(), g.bytes.size() - 40);
    EXPECT_EQ(out.buffer.substr(0, used), g.bytes.substr(0, used));
    EXPECT_EQ(floatsOf(out, times, 1), (std::vector<float>{0, 1}));
    EXPECT_EQ(floatsOf(out, values, 3), (std::vector<float>{0, 0, 0, 1, 2, 3}));
}

TEST(GltfFiles, viewsThatShareBytesStillShareThem)
{
    Gltf g = square();
    const std::size_t start = (g.bytes.size() + 3) / 4 * 4;
    const int whole = g.floats({1, 2, 3, 4, 5, 6, 7, 8}, "SCALAR");
    const std::size_t view = g.root["accessors"][std::size_t(whole)]["bufferView"];
    const std::size_t at = g.root["bufferViews"][view].value("byteOffset", start);
    g.root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at + 8}, {"byteLength", 12}}); // 3 4 5
    g.root["accessors"].push_back(
        {{"bufferView", g.root["bufferViews"].size() - 1}, {"componentType", 5126}, {"type", "SCALAR"}, {"count", 3}});
    const int part = int(g.root["accessors"].size()) - 1;
    const int rotations = g.floats(std::vector<float>(32, 0.5f), "VEC4"),
              moves = g.floats({0, 0, 0, 1, 2, 3, 4, 5, 6}, "VEC3");
    g.root["animations"] = {
        {{"samplers", {{{"input", whole}, {"output", rotations}}, {{"input", part}, {"output", moves}}}},
         {"channels", json::array()}}};
    const TemporaryFolder folder;
    const auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(floatsOf(out, whole, 1), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(floatsOf(out, part, 1), (std::vector<float>{3, 4, 5}));
    EXPECT_EQ(out.buffer.size(), g.bytes.size());
}

TEST(GltfFiles, severalBuffersAreJoinedWithANote)
{
    const TemporaryFolder folder;
    Gltf g = square();
    const std::string second = word(0x3f800000) + word(0x40000000) + "tail";
    g.root["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "one.bin"}, {"name", "one"}},
                         {{"byteLength", second.size()}, {"uri", "two.bin"}, {"name", "two"}}};
    g.root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 8}});
    g.root["accessors"].push_back(
        {{"bufferView", g.root["bufferViews"].size() - 1}, {"componentType", 5126}, {"type", "SCALAR"}, {"count", 2}});
    const int times = int(g.root["accessors"].size()) - 1;
    g.root["animations"] = {{{"samplers", {{{"input", times}, {"output", times}}}}, {"channels", json::array()}}};
    folder.write("one.bin", g.bytes);
    folder.write("two.bin", second);
    const auto document = openText(folder, g.root.dump());
    ASSERT_TRUE(document) << document.error().message;
    const auto written = cotan::writeGltf(*document, folder.path / "out.gltf");
    ASSERT_TRUE(written);
    ASSERT_EQ(written->notes.size(), 1u);
    EXPECT_EQ(written->notes[0], "buffers: 2 were joined into one; names and extras of the first are kept");
    const ReadBack out = readBack(folder.path / "out.gltf");
    ASSERT_EQ(out.root["buffers"].size(), 1u);
    EXPECT_EQ(out.root["buffers"][0]["name"], "one");
    EXPECT_EQ(out.root["buffers"][0]["byteLength"], out.buffer.size());
    EXPECT_EQ(floatsOf(out, times, 1), (std::vector<float>{1, 2}));
    EXPECT_EQ(written->bytesBefore, stdfs::file_size(folder.path / "model.gltf") + g.bytes.size() + second.size());
}

} // namespace
