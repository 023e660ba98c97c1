// Checks that --help is right: its examples run, its options are used, and invalid words get a helpful error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>

#include "cotan/frame.hpp"
#include "cotan/image.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

Words split(const std::string& line)
{
    std::istringstream stream(line);
    return {std::istream_iterator<std::string>(stream), {}};
}

// The names of commands in a help text: they have lines of their own that are not options.
Words subcommandsOf(const std::string& help)
{
    Words names;
    std::istringstream text(help.substr(0, help.find("Examples:")));
    if (help.find(" COMMAND [OPTIONS]") != std::string::npos)
        for (std::string line; std::getline(text, line);)
            if (line.size() > 2 && line.starts_with("  ") && std::islower(static_cast<unsigned char>(line[2])))
                names.push_back(split(line)[0]);
    return names;
}

std::vector<Words> examplesOf(const std::string& help)
{
    std::vector<Words> examples;
    std::istringstream text(help.substr(std::min(help.size(), help.find("Examples:"))));
    for (std::string line; std::getline(text, line);)
        if (line.starts_with("  cotan "))
            examples.push_back(split(line));
    return examples;
}

// The help of every command.
std::map<std::string, std::string> helps()
{
    TemporaryFolder folder;
    std::map<std::string, std::string> all;
    const auto ask = [&](Words words) {
        words.push_back("--help");
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0);
        return run.out;
    };
    all[""] = ask({});
    for (const std::string& name : subcommandsOf(all[""])) {
        all[name] = ask({name});
        for (const std::string& inner : subcommandsOf(all[name]))
            all[name + " " + inner] = ask({name, inner});
    }
    return all;
}

// Writes the files that examples name.
void prepare(const TemporaryFolder& folder)
{
    write(quad(2), folder.path());
    ASSERT_EQ(runTool({"tangents", "quad.gltf", "-o", "model.glb"}, folder.path()).code, 0);
    for (const char* name : {"rocks.png", "other.png", "grain.png", "height.png"})
        ASSERT_TRUE(writeImage(folder / name, makeReliefMap(Relief::domes, 64)));
    std::ofstream(folder / "jobs.jsonl") << "{\"command\": [\"lint\", \"model.glb\"]}\n";
    ASSERT_EQ(runTool({"batch", "jobs.jsonl", "--store", "results"}, folder.path()).code, 0);
    for (const char* name : {"statue.obj", "statue_low.obj"})
        std::ofstream(folder / name) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                                        "f 1/1/1 2/2/1 3/3/1 4/4/1\n";
}

TEST(Help, everyCommandHasTwoExamplesAndTheExitCodes)
{
    const auto all = helps();
    EXPECT_GT(all.size(), 20u);
    for (const auto& [name, help] : all) {
        EXPECT_GE(examplesOf(help).size(), 2u) << name;
        EXPECT_NE(help.find("Exit codes"), std::string::npos) << name;
        for (const Words& words : examplesOf(help))
            EXPECT_TRUE(name.empty() || words.at(1) == split(name)[0]) << name << " shows another command";
    }
}

TEST(Help, everyCommandBeginsWithASentenceAboutItsPurpose)
{
    for (const auto& [name, help] : helps()) {
        const std::string first = help.substr(0, help.find("\n\n"));
        EXPECT_TRUE(std::isupper(static_cast<unsigned char>(first[0]))) << name << ": " << first;
        EXPECT_TRUE(first.ends_with('.')) << name << ": " << first;
        EXPECT_NE(help.find("\nUsage: cotan"), std::string::npos) << name;
    }
}

TEST(Help, usageNamesRequiredArguments)
{
    TemporaryFolder folder;
    const auto all = helps();
    EXPECT_NE(all.at("render").find("\nUsage: cotan render [MODEL] -o PATH [OPTIONS]\n"), std::string::npos);
    EXPECT_NE(all.at("bake").find("\nUsage: cotan bake -o PATH --high FILE --low FILE [OPTIONS]\n"), std::string::npos);
    EXPECT_NE(all.at("map convert").find("\nUsage: cotan map convert FILE -o PATH --to WORDS [OPTIONS]\n"),
              std::string::npos);
    EXPECT_NE(all.at("map info").find("\nUsage: cotan map info FILE... [OPTIONS]\n"), std::string::npos);
    // Without it, nothing runs.
    for (const Words& words : std::vector<Words>{{"render"}, {"bake"}, {"map", "convert"}, {"map", "info"}})
        EXPECT_EQ(runTool(words, folder.path()).code, 1) << words[0];
}

TEST(Help, fitsTheWidthOfTheTerminal)
{
    for (const int width : {50, 80, 120}) {
        ::setenv("COLUMNS", std::to_string(width).c_str(), 1);
        std::size_t longest = 0;
        for (const auto& [name, help] : helps()) {
            std::istringstream text(help.substr(0, help.find("\nExamples:")));
            for (std::string line; std::getline(text, line);) {
                longest = std::max(longest, line.size());
                // A single word may be longer than the line.
                EXPECT_TRUE(line.size() <= std::size_t(width) || split(line).size() == 1) << name << ": " << line;
            }
        }
        EXPECT_GT(longest, std::size_t(width) * 8 / 10);
    }
    ::unsetenv("COLUMNS");
}

TEST(Help, optionsAreUnderHeadingsWithTheMainOnesFirst)
{
    const std::string help = helps().at("render");
    std::size_t at = 0;
    for (const char* heading :
         {"Main options", "Input", "Output", "Light", "Frame", "Look", "Diagnostics", "General"}) {
        const std::size_t found = help.find("\n" + std::string(heading) + ":\n");
        ASSERT_NE(found, std::string::npos) << heading;
        EXPECT_GT(found, at) << heading;
        at = found;
    }
    const std::string main = help.substr(0, help.find("\nInput:\n"));
    for (const char* option :
         {"  MODEL", "  -o, --output PATH", "  --frame NAME", "  --view NAME", "  --size WxH", "  --camera CAMERA"})
        EXPECT_NE(main.find(option), std::string::npos) << option;
}

TEST(Help, theShortFormHasTheMainOptionsAndCountsTheOthers)
{
    TemporaryFolder folder;
    const ToolRun brief = runTool({"render", "-h"}, folder.path()), full = runTool({"render", "--help"}, folder.path());
    EXPECT_EQ(brief.code, 0);
    EXPECT_NE(brief.out.find("--view"), std::string::npos);
    EXPECT_EQ(brief.out.find("--tone-mapping"), std::string::npos);
    EXPECT_NE(brief.out.find("\"cotan help render\" shows "), std::string::npos);
    EXPECT_NE(full.out.find("--tone-mapping"), std::string::npos);
}

TEST(Help, helpCommandEqualsTheHelpOption)
{
    TemporaryFolder folder;
    for (const Words& words : std::vector<Words>{{}, {"render"}, {"map"}, {"map", "convert"}, {"help"}}) {
        Words before = {"help"}, behind = words;
        before.insert(before.end(), words.begin(), words.end());
        behind.emplace_back("--help");
        const ToolRun run = runTool(before, folder.path());
        EXPECT_EQ(run.code, 0);
        EXPECT_EQ(run.out, runTool(behind, folder.path()).out) << ::testing::PrintToString(words);
    }
    const ToolRun wrong = runTool({"help", "redner"}, folder.path());
    EXPECT_EQ(wrong.code, 1);
    EXPECT_EQ(wrong.err, "cotan: error: unknown command 'redner'; did you mean render?\n");
}

TEST(Help, historicalFramesAreListedOnlyOnRequest)
{
    TemporaryFolder folder;
    for (const auto& [name, help] : helps()) {
        EXPECT_EQ(help.find("paper-nodet"), std::string::npos) << name;
        if (help.find("--list-frames") == std::string::npos)
            continue;
        Words words = split(name);
        words.emplace_back("--list-frames");
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << name << run.err;
        for (const FrameInfo& frame : frames())
            EXPECT_NE(run.out.find("\n  " + std::string(frame.name) + " "), std::string::npos) << name << frame.name;
        EXPECT_LT(run.out.find("orthonormal "), run.out.find("Historical")) << name;
        EXPECT_GT(run.out.find("paper-nodet "), run.out.find("Historical")) << name;
    }
}

// cost may have no driver, and view has no display: exit code 3.
TEST(Help, everyExampleRunsAsPrinted)
{
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    for (const auto& [name, help] : helps())
        for (Words words : examplesOf(help)) {
            TemporaryFolder folder;
            prepare(folder);
            words.erase(words.begin());
            const ToolRun run = runTool(words, folder.path(), 120);
            EXPECT_TRUE(run.code == 0 || ((name == "cost" || name == "view") && run.code == 3))
                << ::testing::PrintToString(words) << run.err;
        }
}

TEST(Help, unusedOptionsAreNotListedAndOutputIsRefused)
{
    const auto all = helps();
    for (const char* name : {"lint", "map info", "map detect"}) {
        EXPECT_EQ(all.at(name).find("--output"), std::string::npos) << name;
        TemporaryFolder folder;
        prepare(folder);
        Words words = split(name);
        words.insert(words.end(), {name == std::string("lint") ? "model.glb" : "rocks.png", "-o", "x.png"});
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 1) << name;
        EXPECT_NE(run.err.find("leave out -o"), std::string::npos) << run.err;
    }
    for (const char* name : {"lint", "shader", "cost"})
        if (all.contains(name)) {
            EXPECT_EQ(all.at(name).find("--threads"), std::string::npos) << name;
        }
    EXPECT_NE(all.at("render").find("--threads"), std::string::npos);
}

TEST(Help, eachNameHasOneMeaningAndOlderNamesStillWork)
{
    const auto all = helps();
    for (const auto& [name, text] : all) {
        const std::string help = text.substr(0, text.find("Examples:"));
        if (help.find("--size ") != std::string::npos) {
            EXPECT_NE(help.find("--size WxH"), std::string::npos) << name << ": --size is pixels or texels";
        }
        if (help.find("--from ") != std::string::npos) {
            EXPECT_NE(help.find("--from WORDS"), std::string::npos) << name << ": --from is a convention";
        }
    }
    TemporaryFolder folder;
    prepare(folder);
    for (const Words& words : std::vector<Words>{
             {"convert", "model.glb", "--from", "mikktspace", "--to", "orthonormal", "-o", "a.glb"},
             {"convert", "model.glb", "--from-frame", "mikktspace", "--to-frame", "orthonormal", "-o", "b.glb"},
             {"map", "from-height", "height.png", "--size", "2", "--range", "0.05", "-o", "a.png"},
             {"map", "from-height", "height.png", "--metres", "2", "--range", "0.05", "-o", "b.png"}})
        EXPECT_EQ(runTool(words, folder.path()).code, 0) << words[0];
    EXPECT_EQ(readWhole(folder / "a.glb"), readWhole(folder / "b.glb"));
    EXPECT_EQ(readWhole(folder / "a.png"), readWhole(folder / "b.png"));
    EXPECT_EQ(
        runTool({"map", "from-height", "height.png", "--metres", "2", "--size", "2", "--range", "1", "-o", "c.png"},
                folder.path())
            .code,
        1);
}

// For each command: words with which it would work, and the options that accept any text.
struct Usual {
    Words words;
    std::set<std::string> anyText;
};
const std::map<std::string, Usual> kUsual = {
    {"render", {{"model.glb", "-o", "a.png"}, {"--variant", "--animation", "--device", "--camera", "--environment"}}},
    {"compare", {{"model.glb", "-o", "a"}, {"--variant", "--animation", "--device", "--camera", "--environment"}}},
    {"bake",
     {{"--high", "statue.obj", "--low", "statue_low.obj", "-o", "a.png"},
      {"--object", "--device", "--high-convention", "--high-frame"}}}, // the last two need a map of the high mesh
    {"convert", {{"model.glb", "-o", "a.glb", "--to-frame", "orthonormal"}, {"--device"}}},
    {"lint", {{"model.glb"}, {}}},
    {"tangents", {{"model.glb"}, {}}},
    {"shader", {{"--lang", "glsl", "--frame", "cotangent"}, {}}},
    {"view",
     {{"model.glb"}, {"--variant", "--animation", "--device", "--camera", "--environment", "--do", "--convention"}}},
    {"batch", {{"jobs.jsonl", "-o", "a.html"}, {}}},
    {"cost", {{}, {"--device", "--family", "--name"}}},
    {"accuracy", {{}, {"--device", "--scene"}}},
    {"figures", {{"-o", "figures"}, {"--device"}}},
    {"map convert", {{"rocks.png", "-o", "a.png", "--from", "gltf", "--to", "directx"}, {"--frame"}}}, // needs --mesh
    {"map blend", {{"rocks.png", "grain.png", "-o", "a.png"}, {}}},
    {"map diff", {{"rocks.png", "other.png"}, {}}},
    {"map mips", {{"rocks.png", "-o", "a.dds"}, {}}},
    {"map info", {{"rocks.png"}, {}}},
    {"map detect", {{"rocks.png"}, {}}},
    {"map from-height", {{"height.png", "-o", "a.png", "--metres", "1", "--range", "1"}, {}}},
    {"map to-height", {{"rocks.png", "-o", "a.png"}, {}}},
};

// Gives each option of each command an invalid value once.
TEST(Help, everyOptionErrorNamesTheOptionAndTheInvalidValue)
{
    TemporaryFolder folder;
    prepare(folder);
    const std::string wrong = "nonsense!";
    std::size_t tried = 0;
    for (const auto& [command, help] : helps()) {
        if (command.empty() || command == "map" || command == "help")
            continue;
        const auto usual = kUsual.find(command);
        ASSERT_NE(usual, kUsual.end()) << command << ": say with which words it works";
        std::istringstream text(help);
        for (std::string line; std::getline(text, line);) {
            Words words = split(line);
            if (words.size() < 2 || !line.starts_with("  "))
                continue;
            if (words[0].ends_with(",") && words[0].size() == 3) // -o, --output
                words.erase(words.begin());
            if (!words[0].starts_with("--") || words.size() < 2)
                continue;
            const std::string option = words[0], value = words[1];
            if (option.ends_with(",") || line.find(option + " " + value) == std::string::npos)
                continue; // two names of one option, or no value but the help text
            const bool takesFile = value.starts_with("FILE") || value == "PATH" || value == "DIR" || value == "FOLDER";
            if (!std::isupper(static_cast<unsigned char>(value[0])) || takesFile
                || usual->second.anyText.contains(option))
                continue;
            Words all = split(command);
            bool replaced = false;
            for (const std::string& word : usual->second.words) {
                const bool isValue = !all.empty() && all.back() == option;
                all.push_back(isValue ? wrong : word);
                replaced = replaced || isValue;
            }
            if (!replaced)
                all.insert(all.end(), {option, wrong});
            const ToolRun run = runTool(all, folder.path());
            const std::string message = command + " " + option + ": " + run.err;
            EXPECT_EQ(run.code, 1) << message;
            EXPECT_TRUE(run.err.starts_with("cotan: error: " + option + ": expected ")) << message;
            const std::string found = "; found '" + wrong + "'";
            EXPECT_TRUE(run.err.ends_with(found + "\n")
                        || run.err.ends_with(found + " (see cotan " + command + " --help)\n"))
                << message;
            EXPECT_EQ(run.out, "") << message;
            ++tried;
        }
    }
    EXPECT_GT(tried, 150u);
}

TEST(Help, anUnknownCommandSuggestsTheNearestOne)
{
    TemporaryFolder folder;
    const std::vector<std::pair<Words, std::string>> cases = {{{"rendr"}, "did you mean render?"},
                                                              {{"redner", "a.glb"}, "did you mean render?"},
                                                              {{"comp"}, "did you mean compare?"},
                                                              {{"accurracy"}, "did you mean accuracy?"},
                                                              {{"map", "detct", "a.png"}, "did you mean detect?"},
                                                              {{"map", "form-height"}, "did you mean from-height?"},
                                                              {{"xyzzyplugh"}, "expected one of view, render, "}};
    for (const auto& [words, answer] : cases) {
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 1) << words.back();
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find("'" + words[words[0] == "map" ? 1 : 0] + "'"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find(answer), std::string::npos) << run.err;
    }
}

TEST(Help, mapsInJpegAreWarnedOf)
{
    TemporaryFolder folder;
    prepare(folder);
    for (const Words& words :
         std::vector<Words>{{"bake", "--high", "statue.obj", "--low", "statue_low.obj", "--size", "8x8", "-o", "x.jpg"},
                            {"map", "from-height", "height.png", "--bits", "8", "-o", "x.JPEG"},
                            {"map", "convert", "rocks.png", "--from", "gltf", "--to", "directx", "-o", "y.jpg"},
                            {"map", "blend", "rocks.png", "grain.png", "-o", "z.jpg"}}) {
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        const std::size_t first = run.err.find("JPEG adds errors");
        EXPECT_NE(first, std::string::npos) << words[0] << run.err;
        EXPECT_EQ(run.err.find("JPEG adds errors", first + 1), std::string::npos) << run.err;
    }
}

TEST(Help, unwritableStandardOutputExitsFourUnlessTheReaderClosedIt)
{
    TemporaryFolder folder;
    prepare(folder);
    for (const std::string line :
         {"--help", "--version", "lint model.glb", "lint model.glb --json -", "map info rocks.png", "accuracy --list",
          "shader --lang glsl --frame smooth", "tangents model.glb", "render --size 16x16 --device reference -o a.png"})
        // A full disk, and a pipe whose reader, like head, has ended: that reader had enough.
        for (const std::string sink : {">/dev/full", "> >(true); wait $!"}) {
            const bool full = sink == ">/dev/full";
            const std::string script = "exec 3" + sink + "; \"" COTAN_TOOL "\" " + line + " >&3";
            const std::string shell = "bash -c '" + script + "' 2>" + (folder / "err").string();
            const int status = std::system(("cd " + folder.path().string() + " && " + shell).c_str());
            EXPECT_EQ(WEXITSTATUS(status), full ? 4 : 0) << line << sink;
            const std::string err = readWhole(folder / "err");
            EXPECT_EQ(lines(err), full ? 1 : 0) << line << err;
            EXPECT_EQ(err.find("no space left") != std::string::npos, full) << line << err;
        }
}

TEST(Help, theTablesAreListedAsJson)
{
    TemporaryFolder folder;
    const ToolRun run = runTool({"accuracy", "--list", "--json", "-"}, folder.path());
    EXPECT_EQ(run.code, 0);
    const auto report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report.at("tables").back().at("name"), "rendered");
    EXPECT_GT(report.at("tables").size(), 5u);
}

} // namespace
} // namespace cotan
