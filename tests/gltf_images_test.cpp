// Images of glTF files: their names, which are examined and how far, the errors for invalid ones, and that image files
// count towards the model's size where images are limited relative to it.
#include "gltf_maker.hpp"

namespace {

using namespace cotan::test;
using cotan::Image;
using cotan::LoadLimits;
using cotan::Result;

json asUri(const std::string& bytes) { return {{"uri", "data:image/png;base64," + base64(bytes)}}; }

json asView(Gltf& g, const std::string& bytes)
{
    return {{"mimeType", "image/png"}, {"bufferView", g.view(std::vector<char>(bytes.begin(), bytes.end()))}};
}

// A square whose normal map and base colour are these images.
Gltf imageSquare(const std::string& normals, const std::string& colors)
{
    Gltf g = square();
    g.add("images", asView(g, normals));
    g.add("images", asUri(colors));
    g.root["textures"] = {{{"source", 0}}, {{"source", 1}}};
    g.root["materials"][0]["normalTexture"] = {{"index", 0}};
    g.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 1}};
    return g;
}

std::string refusal(const Result<cotan::Scene>& scene)
{
    const std::string message = scene ? "" : scene.error().message, name = "model.gltf: ";
    return scene ? "" : message.substr(message.find(name) + name.size());
}

TEST(GltfImages, areNamedByFileNameOrIndex)
{
    const TemporaryFolder folder;
    folder.write("maps/flat map.png", flatPng());
    Gltf g = imageSquare(flatPng(), flatPng());
    g.root["images"][1] = {{"uri", "maps/flat%20map.png"}, {"name", "not this"}};
    const auto names = [&] {
        const auto scene = cotan::loadGltf(folder.write("model.gltf", g.text()));
        EXPECT_TRUE(scene) << scene.error().message;
        const cotan::Material& m = scene->materials.at(0);
        return scene->images.at(std::size_t(m.normalMap.image)).name + "|"
            + scene->images.at(std::size_t(m.baseColorMap.image)).name;
    };
    EXPECT_EQ(names(), "image 0|flat map.png");
    g.root["images"][0]["name"] = "bumps\n";
    g.root["images"][1] = asUri(flatPng());
    EXPECT_EQ(names(), "bumps|image 1");
}

TEST(GltfImages, theFirstBrokenUsedOneIsReported)
{
    const std::string none = "no picture";
    EXPECT_EQ(refusal(imageSquare(flatPng(), flatPng()).load()), "");
    EXPECT_EQ(refusal(imageSquare(flatPng(), none).load()), "images[1]: expected PNG or JPEG data in image 1");
    EXPECT_EQ(refusal(imageSquare(none, none).load()), "images[0]: expected PNG or JPEG data in image 0");
    Gltf g = imageSquare(flatPng(), flatPng());
    g.root["images"][1]["bufferView"] = 0;
    EXPECT_EQ(refusal(g.load()), "images[1]: images[1]: expected either uri or bufferView");
    LoadLimits limits;
    limits.pixels = cotan::Pixels::none; // the first bytes are examined nevertheless
    EXPECT_EQ(refusal(imageSquare(flatPng(), none).load(limits)), "images[1]: expected PNG or JPEG data in image 1");
    EXPECT_EQ(refusal(imageSquare(flatPng().substr(0, 32), flatPng()).load(limits)),
              "images[0]: the PNG image 0 ends within its header");
    EXPECT_EQ(refusal(imageSquare(flatPng().substr(0, 33), flatPng()).load(limits)), "");
}

// The signature, and IHDR with its length, type and checksum: 33 bytes.
TEST(GltfImages, unusedOnesTruncatedInTheHeaderAreWarnedOf)
{
    const TemporaryFolder folder;
    const std::string message = "the PNG short.png ends within its header: this unused image is ignored";
    Gltf g = square();
    g.add("images", asUri(flatPng()));
    g.add("images", {{"uri", "short.png"}});
    for (const std::size_t bytes : {0u, 1u, 8u, 32u, 33u}) {
        folder.write("short.png", flatPng().substr(0, bytes));
        COTAN_LOADED(scene, cotan::loadGltf(folder.write("model.gltf", g.text())));
        EXPECT_EQ(scene.warnings,
                  bytes == 8 || bytes == 32 ? std::vector<std::string>{"images[1]: " + message}
                                            : std::vector<std::string>())
            << bytes;
        EXPECT_TRUE(scene.images.empty());
    }
    folder.write("short.png", flatPng().substr(0, 32)); // if nothing is drawn, every image is checked
    g.root["scenes"][0]["nodes"] = json::array();
    EXPECT_EQ(refusal(cotan::loadGltf(folder.write("model.gltf", g.text()))),
              "images[1]: the PNG short.png ends within its header");
    std::filesystem::remove(folder.path / "short.png"); // a missing file is not examined
    EXPECT_EQ(refusal(cotan::loadGltf(folder.write("model.gltf", g.text()))), "");
    // Files that are not on the disk are not fetched only for this check.
    int fetched = 0;
    LoadLimits limits;
    limits.readFile = [&](const std::string&) -> Result<std::vector<std::byte>> {
        ++fetched;
        const std::string text = g.text();
        const auto* const first = reinterpret_cast<const std::byte*>(text.data());
        return std::vector<std::byte>(first, first + text.size());
    };
    EXPECT_TRUE(cotan::loadGltf("model.gltf", limits));
    EXPECT_EQ(fetched, 1);
}

// Images may take 128 times the bytes of the model and of their files, whether or not their names are percent-encoded.
// One byte more is too much.
TEST(GltfImages, theirFilesCountTowardsTheModelsSize)
{
    const TemporaryFolder folder;
    const std::string png = flatPng() + std::string(1000, ' ');
    for (const auto& [name, uri] : {std::pair{"plain.png", "plain.png"}, {"two words.png", "two%20words.png"}}) {
        folder.write(name, png);
        Gltf g = imageSquare(flatPng(), flatPng());
        g.root["materials"][0].erase("normalTexture");
        g.root["images"][1] = {{"uri", uri}};
        const std::string text = g.text();
        const int bytes = int(text.size() + png.size());
        for (const int more : {0, 1}) {
            LoadLimits limits;
            limits.imageBytesBeyond = 0;
            limits.decode = [&](std::span<const std::byte>, const std::string& called) -> Result<Image> {
                return cotan::makeImage(32, bytes + more, cotan::PixelType::unorm8, called); // 128 bytes a row
            };
            const auto scene = cotan::loadGltf(folder.write("model.gltf", text), limits);
            EXPECT_EQ(bool(scene), more == 0) << name << (scene ? "" : ": " + scene.error().message);
            if (!scene) {
                EXPECT_NE(scene.error().message.find("images[1]: "), std::string::npos) << scene.error().message;
                EXPECT_NE(scene.error().message.find(std::to_string(128 * bytes)), std::string::npos)
                    << scene.error().message;
                EXPECT_TRUE(scene.error().memory);
            }
        }
    }
}

} // namespace
