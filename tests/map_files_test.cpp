// Map files by the calls that `cotan map` makes: their messages, and that a stopped call leaves no file.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "map_files/blend.hpp"
#include "map_files/convert.hpp"
#include "map_files/height.hpp"
#include "map_files/inspect.hpp"
#include "map_files/mips.hpp"
#include "run_tool.hpp"

namespace cotan {

using namespace app;
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

Convention asGltf() { return *parseConvention("gltf,exact"); }
Convention asDirectx() { return *parseConvention("directx"); }

std::vector<fs::path> filesIn(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files.push_back(entry.path().filename());
    std::ranges::sort(files);
    return files;
}

class MapFiles : public ::testing::Test {
protected:
    void SetUp() override { ASSERT_TRUE(writeImage(map, makeReliefMap(Relief::domes, 64))); }

    // Results of every call that takes long, with the given options; those that write a file write `out`.
    std::vector<Status> allCalls(const FileOptions& files) const
    {
        const auto status = [](const auto& result) { return result ? Status(Done{}) : Status(result.error()); };
        const MeshOfMap mesh{folder / "quad.obj"};
        const Convention object = *parseConvention("object");
        return {
            status(convertFile(map, out, {.from = asGltf(), .to = asDirectx()}, files)),
            status(convertFile(map, out, {.from = asGltf(), .to = object, .mesh = mesh}, files)),
            status(blendFiles(map, map, out, {.base = asGltf(), .detail = asGltf(), .to = asGltf()}, files)),
            status(normalsFromHeightFile(map, out, {.to = asGltf()}, files)),
            status(heightFromNormalsFile(map, out, {.from = asGltf()}, files)),
            status(writeMips(map, out, {.from = asGltf(), .to = asGltf()}, files)),
            status(compareFiles(map, asGltf(), map, asDirectx(), out, files)),
            status(surveyFile(map, files)),
            status(greenOfFile(map, files)),
        };
    }

    TemporaryFolder folder;
    const fs::path map = folder / "map.png", out = folder / "out.png";
};

TEST_F(MapFiles, memoryIsLimitedByTheFileSize)
{
    // One colour, which a PNG stores in a few hundred bytes. Decoding is within the budget, processing is not.
    const fs::path flat = folder / "flat.png";
    ASSERT_TRUE(writeImage(flat, Image{"", 512, 512, PixelType::unorm8, std::vector(4 * 512 * 512, std::byte{128})}));
    FileOptions files;
    const double size = double(fs::file_size(flat));
    const auto allowBytes = [&](double bytes) { files.limits.imageBytesBeyond = std::size_t(bytes - 128 * size); };
    ASSERT_GT(4.0 * 512 * 512, 128 * size); // otherwise nothing would be refused

    allowBytes(4.0 * 512 * 512 + 1);
    const auto height = heightFromNormalsFile(flat, out, {.from = asGltf()}, files);
    const auto mips = writeMips(flat, out, {.from = asGltf(), .to = asGltf()}, files);
    ASSERT_FALSE(height);
    ASSERT_FALSE(mips);
    EXPECT_NE(height.error().message.find("the solver takes"), std::string::npos) << height.error().message;
    EXPECT_NE(mips.error().message.find("the chain takes"), std::string::npos) << mips.error().message;
    EXPECT_TRUE(height.error().memory && mips.error().memory);
    files.limits.imageBytes = 1;
    const auto rows = surveyFile(flat, files); // opening a PNG succeeds at any limit; reading it is refused
    ASSERT_FALSE(rows);
    EXPECT_TRUE(rows.error().memory) << rows.error().message;
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(MapFiles, stoppedCallFailsAndLeavesNoFile)
{
    std::ofstream(folder / "quad.obj")
        << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
           "f 1/1/1 2/2/1 3/3/1 4/4/1\n";
    const auto before = filesIn(folder.path());
    std::size_t number = 0;
    for (const Status& done : allCalls({.limits = {}, .threads = 1, .progress = [](double) { return false; }})) {
        ASSERT_FALSE(done) << "call " << number;
        EXPECT_EQ(done.error().kind, ErrorKind::stopped) << "call " << number << ": " << done.error().message;
        ++number;
    }
    EXPECT_EQ(filesIn(folder.path()), before);
    // Without the stop, the same calls succeed.
    for (const Status& done : allCalls({}))
        EXPECT_TRUE(done) << done.error().message;
    EXPECT_GT(filesIn(folder.path()).size(), before.size() + 2);
}

TEST_F(MapFiles, progressEndsAtOne)
{
    double last = 0;
    const FileOptions files{.limits = {}, .threads = 1, .progress = [&](double fraction) {
                                EXPECT_GE(fraction, last);
                                last = fraction;
                                return true;
                            }};
    ASSERT_TRUE(surveyFile(map, files)); // in two passes
    EXPECT_EQ(last, 1);
    last = 0;
    ASSERT_TRUE(convertFile(map, out, {.from = asGltf(), .to = asDirectx()}, files));
    EXPECT_EQ(last, 1);
}

TEST_F(MapFiles, convertedFileHasTheConvertedPixels)
{
    const auto done = convertFile(map, out, {.from = asGltf(), .to = asDirectx()});
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(done->width, 64);
    EXPECT_EQ(done->bits.type, PixelType::unorm8);
    const auto before = readImage(map), after = readImage(out);
    ASSERT_TRUE(before && after);
    for (std::size_t i = 0; i < before->data.size(); ++i) { // 128 is zero: c and 256 - c are opposite
        const int was = before->bytes8()[i];
        ASSERT_EQ(int(after->bytes8()[i]), i % 4 == 1 ? std::min(256 - was, 255) : was) << i;
    }
}

TEST_F(MapFiles, wrongOptionsAreNamed)
{
    const auto refused = [&](const ConvertFileOptions& options, const char* words) {
        const auto done = convertFile(map, out, options);
        ASSERT_FALSE(done) << words;
        EXPECT_EQ(done.error().kind, ErrorKind::usage);
        EXPECT_TRUE(done.error().message.starts_with(words)) << done.error().message;
    };
    Convention stored = asGltf();
    stored.expansion = Expansion::signedValues;
    refused({.from = asGltf(), .to = asGltf(), .bits = "7"}, "options.bits: ");
    refused({.from = asGltf(), .to = asGltf(), .bits = "half"}, "options.bits: ");
    refused({.from = asGltf(), .to = asGltf(), .strength = 0}, "options.strength: ");
    refused({.from = asGltf(), .to = stored}, "options.to: ");
    refused({.from = asGltf(), .to = *parseConvention("object")}, "options.mesh: ");
    EXPECT_FALSE(fs::exists(out));
}

} // namespace
} // namespace cotan
