// Runs the tutorials as a reader would: each line of their `sh` blocks, in a folder that contains only the scripts of
// docs. Commands that need npm, Blender or a build are in `console` blocks and are not run here.
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "run_tool.hpp"

namespace cotan::test {
namespace {

namespace fs = std::filesystem;

const fs::path kDocs = fs::path(COTAN_SOURCE_DIR) / "docs";

std::vector<std::string> blocksOf(const std::string& text, const std::string& language)
{
    std::vector<std::string> blocks;
    const std::string fence = "\n```" + language + "\n";
    for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at + 1)) {
        const std::size_t start = at + fence.size();
        const std::string block = text.substr(start, text.find("\n```", start) + 1 - start);
        blocks.push_back(std::regex_replace(block, std::regex("\\\\\n *"), "")); // a command on two lines is one
    }
    return blocks;
}

struct Lesson {
    std::string text;       // of the page
    std::string printed;    // output of all its commands
    std::size_t steps = 0;  // number of commands run
    TemporaryFolder folder; // where the commands ran
};

// Saves the files that the page introduces by "Save this as `NAME`", then runs every line, none of which may fail.
void follow(const std::string& name, Lesson& lesson)
{
    lesson.text = readWhole(kDocs / "tutorials" / (name + ".md"));
    fs::create_directories(lesson.folder / "docs/tutorials");
    fs::copy_file(kDocs / "tutorials/make-files", lesson.folder / "docs/tutorials/make-files");
    const std::regex saved("Save this as `([a-z.]+)`:\n\n```[a-z]+\n([^`]*)```");
    for (auto it = std::sregex_iterator(lesson.text.begin(), lesson.text.end(), saved); it != std::sregex_iterator();
         ++it)
        std::ofstream(lesson.folder / (*it)[1].str()) << (*it)[2].str();
    for (const std::string& block : blocksOf(lesson.text, "sh")) {
        std::istringstream lines(block);
        for (std::string line; std::getline(lines, line); ++lesson.steps) {
            const std::string call = "cd '" + lesson.folder.path().string()
                + "' && cotan() { '" COTAN_TOOL "' \"$@\"; } && " + line + " >>printed.txt 2>&1";
            EXPECT_EQ(std::system(call.c_str()), 0) << name << ": " << line << "\n"
                                                    << readWhole(lesson.folder / "printed.txt");
        }
    }
    lesson.printed = readWhole(lesson.folder / "printed.txt");
}

// Expects the files that -o options name, at least `least` PNG images among them, and the images that the page links.
void expectPictures(const Lesson& lesson, std::size_t least)
{
    const std::regex output(R"( -o ([A-Za-z0-9_./-]+))"), linked(R"(\]\(\.\./pictures/([a-z-]+\.[a-z]+)\))");
    std::size_t pictures = 0;
    for (const std::string& block : blocksOf(lesson.text, "sh"))
        for (auto it = std::sregex_iterator(block.begin(), block.end(), output); it != std::sregex_iterator(); ++it) {
            const fs::path file = lesson.folder / (*it)[1].str();
            EXPECT_TRUE(fs::exists(file) && fs::file_size(file) > 0) << file;
            pictures += file.extension() == ".png";
        }
    EXPECT_GE(pictures, least);
    std::size_t onPage = 0;
    for (auto it = std::sregex_iterator(lesson.text.begin(), lesson.text.end(), linked); it != std::sregex_iterator();
         ++it, ++onPage)
        EXPECT_LE(fs::file_size(kDocs / "pictures" / (*it)[1].str()), 300'000u) << (*it)[1];
    EXPECT_GE(onPage, 1u);
}

// The sections of a page from "## 1." on.
std::vector<std::string> stepsOf(const std::string& text)
{
    std::vector<std::string> steps;
    for (std::size_t at = text.find("\n## 1."); at != std::string::npos;) {
        const std::size_t next = text.find("\n## ", at + 1);
        steps.push_back(text.substr(at, next == std::string::npos ? next : next - at));
        at = next;
    }
    return steps;
}

TEST(Tutorials, everyStepThatDrawsShowsItsImage)
{
    const std::regex draws(R"( -o [A-Za-z0-9_/-]+\.png)");
    std::size_t checked = 0;
    for (const auto& entry : fs::directory_iterator(kDocs / "tutorials"))
        if (entry.path().extension() == ".md")
            for (const std::string& step : stepsOf(readWhole(entry.path())))
                if (std::regex_search(step, draws)) {
                    EXPECT_NE(step.find("](../pictures/"), std::string::npos)
                        << entry.path() << ": " << step.substr(1, step.find('\n', 1) - 1);
                    ++checked;
                }
    EXPECT_GE(checked, 10u);
}

bool hasPython() { return std::system("python3 -c '' >/dev/null 2>&1") == 0; }

#define COTAN_NEEDS_PYTHON()                                                                                           \
    if (!hasPython())                                                                                                  \
    GTEST_SKIP() << "python3 is missing"

TEST(Tutorials, theWrongMapIsFoundAndFixed)
{
    COTAN_NEEDS_PYTHON();
    Lesson lesson;
    follow("wrong-map", lesson);
    expectPictures(lesson, 4);
    const std::size_t down = lesson.printed.find("green: down (-Y, Direct3D), certain");
    EXPECT_NE(down, std::string::npos) << lesson.printed;
    EXPECT_NE(lesson.printed.find("green: up", down), std::string::npos) << lesson.printed;
    EXPECT_NE(lesson.printed.find("mean 39.7"), std::string::npos) << "the page says 40 degrees\n" << lesson.printed;
}

TEST(Tutorials, theFirstBakeCoversAllTexelsWithinHalfADegree)
{
    COTAN_NEEDS_PYTHON();
    Lesson lesson;
    follow("first-bake", lesson);
    expectPictures(lesson, 5);
    EXPECT_NE(lesson.printed.find("262144 of 262144 texels covered"), std::string::npos) << lesson.printed;
    EXPECT_TRUE(fs::exists(lesson.folder / "check/error-0.png"));
    std::smatch mean;
    ASSERT_TRUE(std::regex_search(lesson.printed, mean, std::regex(R"(against the high mesh: mean ([0-9.]+))")))
        << lesson.printed;
    EXPECT_LT(std::stod(mean[1]), 0.5);
}

TEST(Tutorials, theVaseShrinksBySeventeenPercentWithoutTangents)
{
    COTAN_NEEDS_PYTHON();
    Lesson lesson;
    follow("web-model", lesson);
    expectPictures(lesson, 2);
    EXPECT_NE(lesson.printed.find("w is reversed on 50 %"), std::string::npos) << lesson.printed;
    const double before = double(fs::file_size(lesson.folder / "files/vase-lost-sign.glb")),
                 after = double(fs::file_size(lesson.folder / "free.glb"));
    EXPECT_NEAR(1 - after / before, 0.17, 0.005);
    EXPECT_EQ(readWhole(lesson.folder / "free.glb").find("TANGENT"), std::string::npos);
}

// The page shows the program of the package's README, which tests/web/readme_test.mjs runs in a browser.
TEST(Tutorials, theWebPagesProgramEqualsTheReadmes)
{
    const std::string page = readWhole(kDocs / "tutorials/web-model.md"),
                      readme = readWhole(fs::path(COTAN_SOURCE_DIR) / "bindings/js/README.md");
    const auto blocks = blocksOf(page, "js");
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_NE(readme.find(blocks[0]), std::string::npos);
    // The lines that need npm agree as well, except for the path of the package.
    std::size_t lines = 0;
    for (const std::string& block : blocksOf(page, "console")) {
        std::istringstream stream(
            std::regex_replace(std::regex_replace(block, std::regex("/path/to/"), "./"), std::regex(" +#.*"), ""));
        for (std::string line; std::getline(stream, line); ++lines)
            EXPECT_NE(readme.find(line), std::string::npos) << line;
    }
    EXPECT_GE(lines, 5u);
}

TEST(Tutorials, theShaderOfThePageCompiles)
{
    COTAN_NEEDS_PYTHON();
    if (std::system("glslangValidator --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "glslangValidator is missing";
    Lesson lesson;
    follow("shader-frame", lesson);
    expectPictures(lesson, 2);
    EXPECT_TRUE(fs::exists(lesson.folder / "surface.spv"));
}

TEST(Tutorials, theStoneIsBakedForTheFrameThatGodotsShaderReads)
{
    COTAN_NEEDS_PYTHON();
    Lesson lesson;
    follow("blender-to-godot", lesson);
    expectPictures(lesson, 2);
    EXPECT_NE(readWhole(lesson.folder / "cotan.shader").find("shader_type spatial"), std::string::npos);
    EXPECT_NE(lesson.printed.find("the map is for the frame orthonormal"), std::string::npos) << lesson.printed;
}

// How-to pages use the reader's file names. Here each file is a copy of one that the tutorials start with.
class PageCommands : public testing::TestWithParam<const char*> {};

TEST_P(PageCommands, everyCommandRuns)
{
    COTAN_NEEDS_PYTHON();
    const TemporaryFolder folder;
    const std::string maker =
        fmt::format("python3 '{}' '{}'", (kDocs / "tutorials/make-files").string(), (folder / "files").string());
    ASSERT_EQ(std::system(maker.c_str()), 0);
    const std::pair<const char*, std::vector<const char*>> names[] = {
        {"pebbles.png", {"rock.png", "orange.png", "object.png"}},
        {"stone_high.obj", {"rock.obj", "statue.obj"}},
        {"stone_low.obj", {"rock_low.obj", "statue_low.obj"}},
        {"vase.glb", {"model.glb", "prop.glb"}},
        {"vase-lost-sign.glb", {"vase.glb"}}};
    for (const auto& [made, wanted] : names)
        for (const char* name : wanted)
            fs::copy_file(folder / "files" / made, folder / name);
    std::size_t ran = 0;
    for (const std::string& block : blocksOf(readWhole(fs::path(COTAN_SOURCE_DIR) / GetParam()), "sh")) {
        std::istringstream lines(block);
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("cotan ") || line.starts_with("cotan batch") || line.starts_with("cotan view"))
                continue; // the window needs a display
            std::istringstream stream(line.substr(0, line.find(" #")));
            std::vector<std::string> words;
            stream >> line;
            for (std::string word; stream >> word;)
                words.push_back(word);
            const ToolRun run = runTool(words, folder.path(), 300);
            EXPECT_TRUE(run.code == 0 || (run.code == 5 && block.find("--limit") != std::string::npos))
                << fmt::format("{}\n", fmt::join(words, " ")) << run.err;
            ++ran;
        }
    }
    EXPECT_GE(ran, 1u);
}

INSTANTIATE_TEST_SUITE_P(, PageCommands,
                         testing::Values("README.md", "docs/how-to/choose-a-frame.md", "docs/how-to/fix-a-map.md",
                                         "docs/how-to/bake.md", "docs/how-to/remove-tangents.md",
                                         "docs/how-to/engines.md", "docs/how-to/my-engine.md", "docs/how-to/batch.md",
                                         "docs/reference/errors.md", "docs/explanation/compression.md"),
                         [](const auto& page) {
                             std::string name = fs::path(page.param).stem().string();
                             std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                             return name;
                         });

} // namespace
} // namespace cotan::test
