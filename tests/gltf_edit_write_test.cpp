// Files that the glTF editor writes, and files that it must not touch.
#include "gltf_edit_maker.hpp"

namespace {

namespace fs = std::filesystem;
using namespace cotan::test;

// A model with its buffer and an image in separate files.
fs::path writeWithFiles(const TemporaryFolder& folder)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["images"][0]["uri"] = "maps/bumps%201.png";
    g.root["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "model.bin"}}};
    folder.write("maps/bumps 1.png", flatPng());
    folder.write("model.bin", g.bytes);
    return folder.write("model.gltf", g.root.dump());
}

std::size_t filesIn(const fs::path& folder)
{
    std::size_t n = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        n += entry.is_regular_file();
    return n;
}

TEST(GltfWrite, glbHoldsImagesFromFiles)
{
    const TemporaryFolder folder, other;
    const auto document = cotan::openGltfDocument(writeWithFiles(folder));
    ASSERT_TRUE(document) << document.error().message;
    const auto written = cotan::writeGltf(*document, other.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(filesIn(other.path), 1u);
    EXPECT_EQ(written->bytesAfter, fs::file_size(other.path / "out.glb"));
    EXPECT_EQ(written->bytesBefore,
              fs::file_size(folder.path / "model.gltf") + fs::file_size(folder.path / "model.bin")
                  + fs::file_size(folder.path / "maps/bumps 1.png"));
    COTAN_LOADED(scene, cotan::loadGltf(other.path / "out.glb"));
    EXPECT_EQ(scene.images[0].width, 2);
    EXPECT_EQ(readBack(other.path / "out.glb").root["images"][0]["mimeType"], "image/png");
}

TEST(GltfWrite, gltfCopiesImagesToAnotherFolder)
{
    const TemporaryFolder folder, other;
    const auto document = cotan::openGltfDocument(writeWithFiles(folder));
    ASSERT_TRUE(document);
    const auto written = cotan::writeGltf(*document, other.path / "my model.gltf");
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(written->files.size(), 3u);
    EXPECT_EQ(wholeFile(other.path / "maps/bumps 1.png"), flatPng());
    const json root = json::parse(wholeFile(other.path / "my model.gltf"));
    EXPECT_EQ(root["images"][0]["uri"], "maps/bumps%201.png");
    EXPECT_EQ(root["buffers"][0]["uri"], "my%20model.bin");
    EXPECT_TRUE(cotan::loadGltf(other.path / "my model.gltf"));
}

TEST(GltfWrite, doesNotReplaceADifferentImage)
{
    const TemporaryFolder folder, other;
    const auto document = cotan::openGltfDocument(writeWithFiles(folder));
    ASSERT_TRUE(document);
    other.write("maps/bumps 1.png", "something else");
    const auto written = cotan::writeGltf(*document, other.path / "out.gltf");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, cotan::ErrorKind::output);
    EXPECT_EQ(filesIn(other.path), 1u);
    EXPECT_EQ(wholeFile(other.path / "maps/bumps 1.png"), "something else");
}

// Another model whose name would give its buffer the name of this one's.
TEST(GltfWrite, doesNotReplaceTheBufferOfItsSource)
{
    const TemporaryFolder folder;
    const fs::path model = writeWithFiles(folder);
    fs::rename(model, folder.path / "first.gltf"); // still reads model.bin
    const std::string before = wholeFile(folder.path / "model.bin");
    auto document = cotan::openGltfDocument(folder.path / "first.gltf");
    ASSERT_TRUE(document);
    const cotan::GltfCornerTangents t{0, 0, cornersOf({1, 1, 1, 1, -1, 1})};
    ASSERT_TRUE(cotan::setGltfTangents(*document, std::span(&t, 1)));
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "model.gltf"));
    EXPECT_EQ(wholeFile(folder.path / "model.bin"), before);
    EXPECT_TRUE(cotan::loadGltf(folder.path / "first.gltf"));
    EXPECT_TRUE(cotan::loadGltf(folder.path / "model.gltf"));
}

TEST(GltfWrite, mayReplaceItsSource)
{
    const TemporaryFolder folder;
    const fs::path model = writeWithFiles(folder);
    auto document = cotan::openGltfDocument(model);
    ASSERT_TRUE(document);
    const cotan::GltfCornerTangents t{0, 0, cornersOf({1, 1, 1, 1, -1, 1})};
    ASSERT_TRUE(cotan::setGltfTangents(*document, std::span(&t, 1)));
    ASSERT_TRUE(cotan::writeGltf(*document, model));
    COTAN_LOADED(scene, cotan::loadGltf(model));
    EXPECT_EQ(scene.meshes[0].vertexCount(), 5u);
    EXPECT_EQ(filesIn(folder.path), 3u);
}

TEST(GltfWrite, leavesNothingIfItCannotWrite)
{
    const TemporaryFolder folder, other;
    const auto document = cotan::openGltfDocument(writeWithFiles(folder));
    ASSERT_TRUE(document);
    fs::create_directories(other.path / "out.bin"); // a folder with the name of the buffer
    const auto written = cotan::writeGltf(*document, other.path / "out.gltf");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, cotan::ErrorKind::output);
    EXPECT_EQ(written.error().message.find('\n'), std::string::npos);
    EXPECT_EQ(filesIn(other.path), 0u);
    const auto missing = cotan::writeGltf(*document, other.path / "no folder/out.glb");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().kind, cotan::ErrorKind::output);
    const auto format = cotan::writeGltf(*document, other.path / "out.obj");
    ASSERT_FALSE(format);
    EXPECT_EQ(format.error().kind, cotan::ErrorKind::usage);
}

} // namespace
