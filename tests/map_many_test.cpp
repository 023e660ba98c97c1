// `cotan map info` and `detect` of several files and of folders.
#include <gtest/gtest.h>

#include <fstream>

#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;

class MapMany : public ::testing::Test {
protected:
    void SetUp() override
    {
        fs::create_directories(folder / "maps/more");
        for (const char* name : {"maps/b.png", "maps/a.png", "maps/more/c.png", "d.png"})
            ASSERT_TRUE(writeImage(folder / name, makeReliefMap(Relief::domes, 64)));
        std::ofstream(folder / "maps/notes.txt") << "no picture";
        std::ofstream(folder / "broken.png") << "no picture";
        fs::create_directory(folder / "empty");
    }

    ToolRun run(std::vector<std::string> words)
    {
        words.insert(words.begin(), "map");
        return runTool(words, folder.path());
    }

    TemporaryFolder folder;
};

TEST_F(MapMany, filesAndFoldersAreJudgedOneAfterTheOther)
{
    for (const std::string command : {"detect", "info"}) {
        const ToolRun text = run({command, "d.png", "maps"});
        EXPECT_EQ(text.code, 0) << text.err;
        std::size_t at = 0;
        for (const std::string file : {"d.png: ", "maps/a.png: ", "maps/b.png: ", "maps/more/c.png: "}) {
            const std::size_t here = text.out.find("\n" + file, at);
            EXPECT_TRUE(here != std::string::npos || text.out.starts_with(file)) << file << text.out;
            at = here == std::string::npos ? 0 : here;
        }
        if (command == "detect") {
            EXPECT_EQ(lines(text.out), 4) << text.out;
        }
        const ToolRun report = run({command, "d.png", "maps", "--json", "-"});
        const auto j = nlohmann::json::parse(report.out);
        ASSERT_EQ(j.at("files").size(), 4u);
        EXPECT_EQ(j["files"][3]["file"], "maps/more/c.png");
        EXPECT_EQ(j["files"][0]["contents"], j["files"][3]["contents"]);
        EXPECT_FALSE(j.contains("file"));
    }
}

TEST_F(MapMany, unreadableFileDoesNotStopTheOthers)
{
    const ToolRun many = run({"detect", "broken.png", "d.png", "gone.png", "--json", "r.json"});
    EXPECT_EQ(many.code, 2);
    EXPECT_NE(many.out.find("d.png: green: up"), std::string::npos) << many.out;
    EXPECT_NE(many.err.find("cotan: error: 2 of 3 files cannot be judged; the first: broken.png: "), std::string::npos)
        << many.err;
    EXPECT_NE(many.err.find("gone.png: no such file"), std::string::npos) << many.err;
    const auto j = nlohmann::json::parse(readWhole(folder / "r.json"));
    EXPECT_TRUE(j["files"][0]["error"].is_string());
    EXPECT_FALSE(j["files"][1].contains("error"));
    const ToolRun one = run({"info", "broken.png"});
    EXPECT_EQ(one.code, 2);
    EXPECT_EQ(lines(one.err), 1) << one.err;
    const ToolRun none = run({"info", "empty"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("empty: expected a folder with images; found none"), std::string::npos) << none.err;
    EXPECT_EQ(run({"info"}).code, 1);
}

} // namespace
} // namespace cotan
