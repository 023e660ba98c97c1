// Files that `cotan view` opens, and errors for those that it cannot open.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cotan/scene.hpp"
#include "quad_model.hpp"
#include "view_window.hpp"

namespace cotan::test {
namespace {

TEST(ViewWindow, badFilesAreReportedAndTheLastModelStays)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::ofstream(folder / "bad.glb") << "glTF nonsense";
    const ToolRun run = play(folder,
                             "0 wait\n0 drop bad.glb\n0 wait\n0 do report a.txt\n0 drop missing.obj\n0 wait\n"
                             "0 do report b.txt\n0 do window w.png\n",
                             {"quad.gltf", "--size", "200x150"});
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string a = readWhole(folder / "a.txt");
    EXPECT_EQ(lineOf(a, "model"), "quad.gltf");
    EXPECT_EQ(lineOf(a, "loads"), "1 failed 1");
    EXPECT_NE(lineOf(a, "problem").find("bad.glb"), std::string::npos);
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "loads"), "1 failed 2");
}

TEST(ViewWindow, reloadingKeepsTheCamera)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const ToolRun run =
        play(folder, "0 wait\n0 do orbit 20 10\n0 wait\n0 do report a.txt\n0 key f5\n0 wait\n0 do report b.txt\n",
             {"quad.gltf", "--size", "200x150"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string a = readWhole(folder / "a.txt"), b = readWhole(folder / "b.txt");
    EXPECT_EQ(lineOf(b, "loads"), "2 failed 0");
    EXPECT_EQ(lineOf(a, "eye"), lineOf(b, "eye"));
}

Image greySky()
{
    Image sky = makeImage(16, 8, PixelType::float32);
    std::fill_n(sky.floats(), 4 * sky.pixelCount(), 0.5f);
    return sky;
}

TEST(ViewWindow, droppedEnvironmentsAreUsedAndBadOnesReported)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "sky.hdr", greySky()));
    std::ofstream(folder / "bad.hdr") << "#?RADIANCE nonsense";
    const ToolRun run = play(folder,
                             "0 wait\n0 drop sky.hdr\n0 wait\n0 do report a.txt\n0 drop bad.hdr\n0 wait\n0 wait\n"
                             "0 do report b.txt\n",
                             {"--shape", "sphere", "--size", "100x80"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "a.txt"), "environment"), "sky.hdr");
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "environment"), "sky.hdr");
    EXPECT_NE(lineOf(readWhole(folder / "b.txt"), "problem").find("bad.hdr"), std::string::npos);
}

// Writing the large images takes longer than a file must stay unchanged before it is reloaded.
TEST(ViewWindow, aChangedEnvironmentFileIsReloaded)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "sky.exr", greySky()));
    const std::string pause = "0 do picture pause.png 2000 2000\n";
    const ToolRun run = play(folder,
                             "0 wait\n0 do set environment sky.exr\n0 wait\n0 do report a.txt\n"
                             "0 do picture sky.exr 64 32\n"
                                 + pause + pause + pause + pause + "0 wait\n0 do report b.txt\n",
                             {"--shape", "sphere", "--size", "100x80", "--overwrite"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "a.txt"), "loads"), "1 failed 0");
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "loads"), "2 failed 0");
}

// Nobody looks at a recording before the session ends, so it ends at once, played or not.
TEST(ViewWindow, aSessionThatWouldOverwriteAFileOfItsFirstModelEndsWithExitCode1)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::ofstream(folder / "session.txt") << "0 wait\n";
    ::setenv("DISPLAY", display().c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--forget"}, {"--play", "session.txt"}})
        for (const char* option : {"--record", "--json"})
            for (const char* name : {"quad.gltf", "quad.bin", "waves.png"}) {
                const std::string before = readWhole(folder / name);
                std::vector<std::string> words = {"view", "quad.gltf", "--size", "64x48", option, name};
                words.insert(words.end(), more.begin(), more.end());
                const ToolRun run = runTool(words, folder.path());
                EXPECT_EQ(run.code, 1) << run.err;
                EXPECT_EQ(lines(run.err), 1) << run.err;
                EXPECT_NE(run.err.find(std::string(option) + " " + name + " would overwrite"), std::string::npos)
                    << run.err;
                EXPECT_TRUE(readWhole(folder / name) == before) << option << " " << name;
            }
}

TEST(ViewWindow, aRecordingAppearsAlsoIfTheSessionFailsAndReplacesItsInputOnlyWithOverwrite)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const std::string session = "0 wait\n0 do window no/such/w.png\n";
    EXPECT_EQ(play(folder, session, {"--size", "64x48", "--record", "recorded.txt"}).code, 2);
    EXPECT_NE(readWhole(folder / "recorded.txt").find("do window no/such/w.png"), std::string::npos);
    const ToolRun kept = play(folder, "0 wait\n", {"--size", "64x48", "--record", "session.txt"});
    EXPECT_EQ(kept.code, 1) << kept.err;
    EXPECT_EQ(readWhole(folder / "session.txt"), "0 wait\n");
    const ToolRun replaced = play(folder, "0 wait\n", {"--size", "64x48", "--record", "session.txt", "--overwrite"});
    EXPECT_EQ(replaced.code, 0) << replaced.err;
    EXPECT_TRUE(readWhole(folder / "session.txt").starts_with("0.000 resize 64 48\n"));
}

TEST(ViewWindow, aMapAloneIsShownOnAShapeAndTheDialogOpensAModel)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::domes, 64)));
    std::ofstream(folder / "zenity") << "#!/bin/sh\necho " << (folder / "quad.gltf").string() << "\n";
    std::filesystem::permissions(folder / "zenity", std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", (folder.path().string() + ":" + path).c_str(), 1);
    const ToolRun run = play(folder,
                             "0 wait\n0 do report a.txt\n0 do set shape torus\n0 wait\n0 do report b.txt\n"
                             "0 key ctrl+o\n0 wait\n0 do report c.txt\n",
                             {"map.png", "--size", "100x80"});
    ::setenv("PATH", path.c_str(), 1);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "a.txt"), "model"), "plane");
    EXPECT_NE(lineOf(readWhole(folder / "a.txt"), "first").find("map.png"), std::string::npos);
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "model"), "torus");
    EXPECT_EQ(lineOf(readWhole(folder / "c.txt"), "model"), "quad.gltf");
}

TEST(ViewWindow, srgbEncodedMapsAreReportedOnceAsByLint)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    Image map = makeReliefMap(Relief::domes, 128);
    for (std::size_t i = 0; i < 4 * map.pixelCount(); ++i)
        if (i % 4 != 3) {
            const double c = map.bytes8()[i] / 255.0;
            map.bytes8()[i] =
                std::uint8_t(std::lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
        }
    ASSERT_TRUE(writeImage(folder / "waves.png", map));
    const ToolRun run = play(folder, "0 wait\n0 do orbit 20 10\n0 wait\n", {"quad.gltf", "--size", "100x80"});
    ASSERT_EQ(run.code, 0) << run.err;
    const ToolRun lint = runTool({"lint", "quad.gltf"}, folder.path());
    const std::string fault = "waves.png: it was saved as a colour, through the sRGB curve";
    const std::size_t first = run.err.find(fault);
    ASSERT_NE(first, std::string::npos) << run.err;
    EXPECT_EQ(run.err.find(fault, first + 1), std::string::npos) << run.err;
    const std::string sentence = run.err.substr(first, run.err.find('\n', first) - first);
    EXPECT_NE((lint.out + lint.err).find(sentence), std::string::npos) << lint.out << lint.err;
}

TEST(ViewWindow, problemAreasMatchLintAndMoveTheCamera)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const ToolRun run = play(folder,
                             "0 do toggle hot-spots\n0 wait\n0 do hot-spot 0\n0 wait\n0 do copy camera\n"
                             "0 do report r.txt\n",
                             {"quad.gltf", "--size", "100x80"});
    ASSERT_EQ(run.code, 0) << run.err;
    const ToolRun lint = runTool({"lint", "quad.gltf", "--json", "lint.json"}, folder.path());
    ASSERT_EQ(lint.code, 0) << lint.err;
    const json spots = json::parse(readWhole(folder / "lint.json"))["problem_areas"];
    ASSERT_FALSE(spots.empty());
    const std::string report = readWhole(folder / "r.txt");
    EXPECT_EQ(lineOf(report, "problem areas"), std::to_string(spots.size()));
    EXPECT_EQ(lineOf(report, "problem area"), spots[0]["text"].get<std::string>());
    EXPECT_NE(run.out.find(spots[0]["camera"].get<std::string>()), std::string::npos) << run.out;
}

TEST(ViewWindow, anUnreadableFirstModelEndsASessionWithExitCode2)
{
    TemporaryFolder folder;
    std::ofstream(folder / "bad.glb") << "glTF nonsense";
    std::ofstream(folder / "session.txt") << "0 do report r.txt\n";
    for (const std::string& on : {display(), std::string()}) {
        for (const char* model : {"bad.glb", "missing.obj"}) {
            ::setenv("DISPLAY", on.c_str(), 1);
            ::unsetenv("WAYLAND_DISPLAY");
            std::vector<std::string> words = {"view", model, "--forget"};
            if (!on.empty())
                words.insert(words.end(), {"--play", "session.txt"});
            const ToolRun run = runTool(words, folder.path());
            EXPECT_EQ(run.code, 2) << model << run.err;
            EXPECT_EQ(lines(run.err), 1) << run.err;
            EXPECT_NE(run.err.find(model), std::string::npos) << run.err;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "r.txt"));
}

TEST(ViewWindow, badArgumentsEndAtOnce)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    struct Case {
        std::vector<std::string> words;
        int code;
    };
    std::ofstream(folder / "broken.txt") << "0 wiat\n";
    ::setenv("DISPLAY", display().c_str(), 1);
    for (const Case& c : {Case{{"--frame", "none"}, 1},
                          {{"--play", "missing.txt"}, 2},
                          {{"--play", "broken.txt"}, 2},
                          {{"--do", "nonsense"}, 1},
                          {{"--size", "0x0"}, 1},
                          {{"-o", "x.png"}, 1}}) {
        std::vector<std::string> words = c.words;
        words.insert(words.begin(), "view");
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, c.code) << ::testing::PrintToString(c.words) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
    }
    const ToolRun run = play(folder, "0 do frame none\n");
    EXPECT_EQ(run.code, 2) << run.err;
}

} // namespace
} // namespace cotan::test
