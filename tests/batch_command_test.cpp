// `cotan batch` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "files/sandbox/confine.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;
namespace fs = std::filesystem;

class BatchCommand : public ::testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_TRUE(writeImage(folder / "a.png", makeReliefMap(Relief::domes, 32)));
        ASSERT_TRUE(writeImage(folder / "b.png", makeReliefMap(Relief::domes, 48)));
    }

    void jobs(const std::vector<json>& all, const std::string& file = "jobs.jsonl")
    {
        std::ofstream stream(folder / file);
        for (const json& job : all)
            stream << job.dump() << "\n";
    }

    ToolRun batch(std::vector<std::string> words)
    {
        words.insert(words.begin(), "batch");
        return runTool(words, folder.path(), 120);
    }

    // Runs jobs.jsonl; the report is in r.html and r.json.
    ToolRun batchReport(const std::vector<std::string>& more = {})
    {
        std::vector<std::string> words = {"jobs.jsonl", "-o", "r.html", "--json", "r.json"};
        words.insert(words.end(), more.begin(), more.end());
        return batch(words);
    }

    json read(const std::string& file) { return json::parse(readWhole(folder / file)); }

    // State of each job by name: "done", "failed", ...; " kept" is appended for results from the store.
    std::map<std::string, std::string> states(const std::string& file = "r.json")
    {
        std::map<std::string, std::string> all;
        const json report = read(file);
        for (const json& job : report["jobs"]) {
            const std::string name = job["name"];
            EXPECT_FALSE(all.contains(name)) << name << " is there twice";
            all[name] = job["state"].get<std::string>() + (job["kept"].get<bool>() ? " kept" : "");
        }
        return all;
    }

    // Number of files in the folder whose names contain a text.
    std::ptrdiff_t filesWith(const std::string& text)
    {
        return std::ranges::count_if(fs::directory_iterator(folder.path()), [&](const auto& entry) {
            return entry.path().filename().string().find(text) != std::string::npos;
        });
    }

    TemporaryFolder folder;
};

json flip(const std::string& from, const std::string& to)
{
    return {{"name", to}, {"command", {"map", "convert", from, "--from", "opengl", "--to", "directx", "-o", to}}};
}

using States = std::map<std::string, std::string>;

TEST_F(BatchCommand, runsInFileOrderAndRepeatsOnlyWhatChanged)
{
    jobs({flip("out/ü <i>'\"&.png", "twice.png"),
          flip("a.png", "out/ü <i>'\"&.png"),
          flip("b.png", "c.png"),
          {{"name", "gone"}, {"command", {"map", "info", "gone.png"}}}});
    const ToolRun first = batchReport();
    EXPECT_EQ(first.code, 2);
    EXPECT_EQ(lines(first.err), 1) << first.err;
    EXPECT_NE(first.err.find("1 of 4 jobs are not done; the worst is 'gone': gone.png: no such file"),
              std::string::npos)
        << first.err;
    EXPECT_NE(first.out.find("4 jobs: 3 done, 1 failed"), std::string::npos) << first.out;
    const std::string odd = "out/ü <i>'\"&.png";
    EXPECT_EQ(states(), (States{{"twice.png", "done"}, {odd, "done"}, {"c.png", "done"}, {"gone", "failed"}}));
    EXPECT_EQ(read("r.json")["jobs"][0]["name"], "gone") << "the worst is first";
    EXPECT_TRUE(fs::exists(folder / "r.store"));

    batchReport();
    EXPECT_EQ(
        states(),
        (States{{"twice.png", "done kept"}, {odd, "done kept"}, {"c.png", "done kept"}, {"gone", "failed kept"}}));
    ASSERT_TRUE(writeImage(folder / "a.png", makeReliefMap(Relief::domes, 40)));
    ASSERT_TRUE(writeImage(folder / "gone.png", makeReliefMap(Relief::domes, 8)));
    const ToolRun third = batchReport();
    EXPECT_EQ(third.code, 0) << third.err;
    EXPECT_EQ(states(), (States{{"twice.png", "done"}, {odd, "done"}, {"c.png", "done kept"}, {"gone", "done"}}));
    fs::remove(folder / "c.png");
    batchReport();
    EXPECT_EQ(states()["c.png"], "done");
    batchReport({"--again"});
    EXPECT_EQ(states()["c.png"], "done");
    EXPECT_NE(readWhole(folder / "r.html").find("data:image/jpeg"), std::string::npos);
    EXPECT_EQ(readWhole(folder / "r.html").find("the worst"), std::string::npos);
    batchReport({"--rows", "3"});
    EXPECT_NE(readWhole(folder / "r.html").find("the worst 3 of 4"), std::string::npos);
    EXPECT_EQ(states().size(), 4u);
}

// The names that bake derives for several maps, tiles and objects are known before it runs, and checked after it.
TEST_F(BatchCommand, filesOfSeveralMapsTilesAndObjectsAreWaitedForAndChecked)
{
    const std::string square = "o lid\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                               "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::ofstream(folder / "m.obj") << square;
    fs::create_directory(folder / "there");
    const auto bake = [](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> words = {"bake", "--high", "m.obj", "--low", "m.obj", "--size", "4"};
        words.insert(words.end(), more.begin(), more.end());
        return json{{"name", name}, {"command", words}};
    };
    jobs({flip("m-normal.png", "1.png"), flip("there/object-normal.png", "2.png"), flip("t.1001.png", "3.png"),
          flip("p_normal-lid.png", "4.png"), flip("a_object-normal_1001.png", "5.png"),
          bake("maps", {"--maps", "normal,height", "-o", "m.png"}),
          bake("folder", {"--maps", "object-normal,curvature", "-o", "there"}),
          bake("same folder", {"--maps", "position,normal", "-o", "there/"}),
          bake("tiles", {"--udim", "all", "-o", "t.png", "--mask", "t_<UDIM>.mask.png"}),
          bake("objects", {"--per-object", "--maps", "normal", "-o", "p_<MAP>.png"}),
          bake("places", {"--kind", "object-normal", "--udim", "1001", "-o", "a_<MAP>_<UDIM>.png"})});
    const ToolRun first = batchReport();
    EXPECT_EQ(first.code, 0) << first.err << first.out;
    for (const auto& [name, state] : states())
        EXPECT_EQ(state, "done") << name;
    EXPECT_TRUE(fs::exists(folder / "there" / "curvature.png"));
    fs::remove(folder / "m-height.png");
    fs::remove(folder / "t_1001.mask.png");
    batchReport();
    for (const auto& [name, state] : states())
        EXPECT_EQ(state, name == "maps" || name == "tiles" ? "done" : "done kept") << name;
    EXPECT_TRUE(fs::exists(folder / "m-height.png"));
    jobs({bake("all", {"--udim", "all", "-o", "t.png"}), bake("one", {"--udim", "1001", "-o", "t.1001.png"}),
          bake("wrong", {"--maps", "normal,gloss", "-o", "x.png"})});
    EXPECT_NE(batchReport().err.find("found 'gloss'"), std::string::npos);
    jobs({bake("all", {"--udim", "all", "-o", "t.png"}), bake("one", {"--udim", "1001", "-o", "t.1001.png"})});
    EXPECT_NE(batchReport().err.find("line 2: writes t.1001.png, which line 1 also writes"), std::string::npos);
}

// Daemons and some CI runners ignore SIGCHLD, and the programs that they start inherit it.
TEST_F(BatchCommand, failuresAreKeptAsFailuresUnderAParentThatIgnoresItsChildren)
{
    jobs({{{"name", "good"}, {"command", {"map", "info", "a.png"}}},
          {{"name", "bad"}, {"command", {"map", "info", "gone.png"}}}});
    const std::string command = "cd " + folder.path().string()
        + " && exec sh -c \"trap '' CHLD; exec " COTAN_TOOL " batch jobs.jsonl --store s --json r.json > out 2> err\"";
    for (const std::string kept : {"", " kept"}) {
        EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2) << readWhole(folder / "err");
        EXPECT_EQ(states(), (States{{"good", "done" + kept}, {"bad", "failed" + kept}}));
        EXPECT_NE(readWhole(folder / "out").find("2 jobs: 1 done, 1 failed"), std::string::npos);
    }
}

// The files of its jobs are known from their words, or from what they read.
TEST_F(BatchCommand, replacesNoFileOfAJobAndNoJobReplacesItsFiles)
{
    write(quad(2), folder.path());
    jobs({flip("a.png", "c.png"), {{"name", "lint"}, {"command", {"lint", "quad.gltf"}}}});
    fs::create_hard_link(folder / "jobs.jsonl", folder / "hard.jsonl");
    fs::create_symlink("waves.png", folder / "soft.png");
    std::map<std::string, std::string> before;
    for (const std::string name : {"jobs.jsonl", "a.png", "quad.gltf", "quad.bin", "waves.png"})
        before[name] = readWhole(folder / name);
    const auto refused = [&](const std::vector<std::string>& words, const std::string& why) {
        const ToolRun run = batch(words);
        EXPECT_EQ(run.code, 1) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
        for (const auto& [name, bytes] : before)
            EXPECT_TRUE(readWhole(folder / name) == bytes) << name << " after " << run.err;
    };
    for (const std::string name : {"jobs.jsonl", "hard.jsonl", "a.png", "quad.gltf", "quad.bin", "soft.png"})
        for (const char* option : {"-o", "--json"})
            refused({"jobs.jsonl", "--store", "s", option, name},
                    std::string(option) + " " + name + " would overwrite ");
    refused({"jobs.jsonl", "--store", "s", "-o", "c.png"}, "-o c.png and line 1: ");
    jobs({flip("a.png", "list"), flip("b.png", "c.png")}, "list");
    before["list"] = readWhole(folder / "list");
    refused({"list", "-o", "r.html"},
            "line 1: " + (folder / "list").string() + " would overwrite list, which is an input");
    EXPECT_EQ(batch({"jobs.jsonl", "-o", "a.png", "--overwrite"}).code, 0);
    EXPECT_NE(readWhole(folder / "a.png").find("<html"), std::string::npos);
}

TEST_F(BatchCommand, filesReferencedByTheModelCountAsInputs)
{
    write(quad(2), folder.path());
    jobs({{{"name", "lint"}, {"command", {"lint", "quad.gltf"}}}});
    ASSERT_EQ(batchReport().code, 0);
    std::string other;
    const json report = read("r.json");
    for (const json& input : report["jobs"][0]["inputs"])
        if (input != "quad.gltf")
            other = input;
    ASSERT_FALSE(other.empty());
    batchReport();
    EXPECT_EQ(states()["lint"], "done kept");
    std::ofstream(folder / other, std::ios::app) << "x";
    batchReport();
    EXPECT_EQ(states()["lint"].find("kept"), std::string::npos) << other;
}

TEST_F(BatchCommand, shardsCoverEveryJobAndAMergeHasEachOnce)
{
    std::vector<json> all;
    for (int i = 0; i < 7; ++i)
        all.push_back(flip(i % 2 ? "a.png" : "b.png", fmt::format("{}.png", i)));
    all.push_back(flip("3.png", "three again.png"));
    all.push_back({{"name", "gone"}, {"command", {"map", "info", "gone.png"}}});
    jobs(all);
    // Two shards with a common store, one with its own.
    EXPECT_EQ(batch({"jobs.jsonl", "--shard", "1/3", "--store", "s"}).code, 0);
    batch({"jobs.jsonl", "--merge", "--store", "s", "-o", "m.html", "--json", "r.json"});
    const auto first = states();
    EXPECT_EQ(first.size(), all.size());
    std::size_t notRun = 0;
    for (const auto& [name, state] : first)
        notRun += state == "not run";
    EXPECT_EQ(notRun, 5u);
    batch({"jobs.jsonl", "--shard", "2/3", "--store", "s", "--json", "two.json"});
    batch({"jobs.jsonl", "--shard", "3/3", "--store", "own", "--json", "three.json"});
    EXPECT_EQ(read("two.json")["jobs"].size() + read("three.json")["jobs"].size(), 5u);
    const ToolRun merged =
        batch({"jobs.jsonl", "--merge", "--store", "s", "--store", "own", "-o", "m.html", "--json", "r.json"});
    EXPECT_EQ(merged.code, 2);
    const auto whole = states();
    EXPECT_EQ(whole.size(), all.size());
    for (const auto& [name, state] : whole)
        EXPECT_EQ(state, name == "gone" ? "failed" : "done") << name;
}

TEST_F(BatchCommand, wrongArgumentsGetOneLineBeforeAnythingRuns)
{
    jobs({flip("a.png", "x.png")});
    jobs({flip("a.png", "x.png"), {{"command", {"map", "convert", "a.png"}}}}, "words.jsonl");
    jobs({{{"command", {"batch", "jobs.jsonl", "-o", "x.html"}}}}, "batch.jsonl");
    jobs({{{"command", {"view", "model.glb"}}}}, "view.jsonl");
    jobs({{{"command", {"map", "info", "a.png", "--json", "-"}}}}, "stdout.jsonl");
    jobs({{{"command", {"lint", "--help"}}}}, "help.jsonl");
    jobs({flip("a.png", "x.png"), flip("b.png", "./x.png")}, "one.jsonl");
    jobs({flip("y.png", "x.png"), flip("x.png", "y.png")}, "circle.jsonl");
    const std::tuple<std::vector<std::string>, int, std::string> cases[] = {
        {{"jobs.jsonl"}, 1, "expected -o REPORT.html, or --store FOLDER"},
        {{"nothere.jsonl", "-o", "r.html"}, 2, "no such file"},
        {{"jobs.jsonl", "-o", "jobs.jsonl"}, 1, "would overwrite"},
        {{"jobs.jsonl", "-o", "no/such/r.html"}, 4, "does not exist"},
        {{"jobs.jsonl", "-o", "r.html", "--shard", "3/2"}, 1, "--shard: expected K/N"},
        {{"jobs.jsonl", "-o", "r.html", "--merge", "--again"}, 1, "--merge runs nothing"},
        {{"jobs.jsonl", "-o", "r.html", "--merge", "--store", "none"}, 2, "expected a store"},
        {{"jobs.jsonl", "-o", "r.html", "--store", "s", "--store", "t"}, 1, "--store: expected one folder"},
        {{"jobs.jsonl", "-o", "r.html", "--limit-seconds", "0"}, 1, "--limit-time"},
        {{"jobs.jsonl", "-o", "r.html", "--limit-processor-time", "-1"}, 1, "--limit-processor-time"},
        {{"jobs.jsonl", "-o", "r.html", "--retries", "many"}, 1, "--retries"},
        {{"jobs.jsonl", "-o", "r.html", "--store", "a.png"}, 4, "cannot create this folder"},
        {{"words.jsonl", "-o", "r.html"}, 2, "words.jsonl:2: map convert needs --to WORDS"},
        {{"batch.jsonl", "-o", "r.html"}, 2, "batch.jsonl:1: batch cannot run in a batch"},
        {{"view.jsonl", "-o", "r.html"}, 2, "view cannot run in a batch"},
        {{"stdout.jsonl", "-o", "r.html"}, 2, "--json -: expected a file"},
        {{"help.jsonl", "-o", "r.html"}, 2, "found --help"},
        {{"one.jsonl", "-o", "r.html"}, 2, "line 2: writes ./x.png, which line 1 also writes"},
        {{"circle.jsonl", "-o", "r.html"}, 2, "waits for"},
    };
    for (const auto& [words, code, message] : cases) {
        const ToolRun run = batch(words);
        EXPECT_EQ(run.code, code) << ::testing::PrintToString(words) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
        EXPECT_FALSE(fs::exists(folder / "x.png"));
        EXPECT_FALSE(fs::exists(folder / "r.html"));
    }
}

TEST_F(BatchCommand, anUnwritableStoreGetsOneLineAndExitCodeFour)
{
    jobs({flip("a.png", "x.png")});
    fs::create_directory(folder / "s");
    if (::geteuid() == 0) { // root may write anywhere, but a file cannot be a folder
        std::ofstream(folder / "s/results") << "in the way";
    } else {
        ::chmod((folder / "s").c_str(), 0500);
    }
    const ToolRun run = batch({"jobs.jsonl", "--store", "s", "-o", "r.html"});
    EXPECT_EQ(run.code, 4) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_FALSE(fs::exists(folder / "r.html"));
}

TEST_F(BatchCommand, limitsEndAJobAndTheOthersContinue)
{
    jobs({{{"name", "slow"}, {"command", {"accuracy", "--tables", "curved", "--device", "reference"}}},
          {{"name", "large"},
           {"limit-time", 60}, // a busy machine takes seconds to reach the allocation
           {"command", {"render", "--device", "reference", "--size", "8000x8000", "-o", "l.png"}}},
          flip("a.png", "fine.png")});
    const ToolRun run = batchReport({"--jobs", "3", "--limit-seconds", "2", "--limit-memory", "200"});
    EXPECT_EQ(run.code, 2) << run.err;
    const auto all = states();
    EXPECT_EQ(all.at("fine.png"), "done");
    EXPECT_EQ(all.at("slow"), "too slow");
    if (!kSanitized) {
        EXPECT_EQ(all.at("large"), "out of memory");
    }
    EXPECT_EQ(filesWith(".part"), 0);
}

TEST_F(BatchCommand, anInterruptEndsTheJobsAndTheNextRunContinues)
{
    std::vector<json> all;
    for (int i = 0; i < 6; ++i)
        all.push_back({{"name", std::to_string(i)},
                       {"command",
                        {"render", "--device", "reference", "--size", fmt::format("{}x160", 160 + i), "-o",
                         fmt::format("{}.png", i)}}});
    jobs(all);
    for (const int signal : {SIGINT, SIGKILL}) {
        const pid_t child = ::fork();
        if (child == 0) {
            const bool there = ::chdir(folder.path().c_str()) == 0;
            ::execl(COTAN_TOOL, COTAN_TOOL, "batch", "jobs.jsonl", "-o", "r.html", "--quiet", nullptr);
            ::_exit(there ? 127 : 126);
        }
        // Interrupt after the first image, then after the next one.
        const auto ended = [child] { // ended but not yet reaped
            siginfo_t which{};
            return ::waitid(P_PID, id_t(child), &which, WEXITED | WNOHANG | WNOWAIT) != 0 || which.si_pid != 0;
        };
        for (const auto before = filesWith(".png"); filesWith(".png") == before && !ended();)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    }
    const ToolRun run = batchReport();
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(states().size(), 6u);
    EXPECT_EQ(filesWith(".part"), 0);
}

// A job's own options for threads and report take precedence.
TEST_F(BatchCommand, aJobsOwnThreadAndReportOptionsTakePrecedence)
{
    jobs({{{"name", "threads"}, {"command", {"map", "info", "a.png", "--threads", "2"}}},
          {{"name", "report"}, {"command", {"map", "diff", "a.png", "a.png", "--json", "own.json"}}},
          {{"name", "none"}, {"command", {"map", "diff", "b.png", "b.png"}}}});
    const ToolRun run = batchReport({"--shard", "1/1", "--store", "kept"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(states(), (States{{"threads", "done"}, {"report", "done"}, {"none", "done"}}));
    EXPECT_EQ(read("own.json")["command"], "map diff");
    const json report = read("r.json");
    EXPECT_EQ(report["jobs_file"], "jobs.jsonl");
    EXPECT_EQ(report["shard"], "1/1");
    EXPECT_GT(report["seconds"].get<double>(), 0);
    for (const json& job : report["jobs"])
        EXPECT_EQ(job["degrees"], job["name"] == "threads" ? json() : json(0.0)) << job;
    EXPECT_TRUE(std::regex_match(run.out, std::regex("3 jobs: 3 done; \\d+\\.\\d s; report: r\\.html\n"))) << run.out;
    const std::string page = readWhole(folder / "r.html");
    EXPECT_NE(page.find("<title>jobs.jsonl, shard 1/1</title>"), std::string::npos);
    EXPECT_TRUE(std::regex_search(page, std::regex("<footer>cotan [0-9.]+: 3 jobs: 3 done; \\d+\\.\\d s</footer>")));
    EXPECT_TRUE(fs::exists(folder / "kept/results"));
    EXPECT_FALSE(fs::exists(folder / "r.store"));
    const ToolRun merged = batch({"jobs.jsonl", "--merge", "--store", "kept", "--json", "-"});
    EXPECT_EQ(merged.code, 0) << merged.err;
    EXPECT_EQ(json::parse(merged.out)["jobs"].size(), 3u);
}

TEST_F(BatchCommand, exitCodeIsTheWorstAndThumbnailsOfModelsAreOptional)
{
    write(quad(2), folder.path());
    jobs({{{"name", "lint"}, {"command", {"lint", "quad.gltf", "--limit", "0"}}}, flip("a.png", "x.png")});
    const ToolRun limit = batchReport({"--thumbnails", "models"});
    EXPECT_EQ(limit.code, 5);
    EXPECT_NE(limit.err.find("1 of 2 jobs are over a limit; the worst is 'lint': "), std::string::npos) << limit.err;
    const auto thumbnails = [&] {
        const std::string page = readWhole(folder / "r.html");
        const std::string begin = "id=\"data\">";
        const std::size_t at = page.find(begin) + begin.size();
        States all;
        const json data = json::parse(page.substr(at, page.find("</script>", at) - at));
        for (const json& row : data["rows"])
            all[row[0]] = row[11].is_null() ? "none" : "one";
        return all;
    };
    EXPECT_EQ(thumbnails(), (States{{"lint", "one"}, {"x.png", "one"}}));
    jobs({{{"name", "lint"}, {"command", {"lint", "quad.gltf", "--limit", "0"}}}, // from the store
          {{"name", "tangents"}, {"command", {"tangents", "quad.gltf"}}},
          {{"name", "gone"}, {"command", {"map", "info", "gone.png"}}},
          flip("b.png", "y.png")});
    const ToolRun bad = batchReport();
    EXPECT_EQ(thumbnails(), (States{{"lint", "one"}, {"tangents", "none"}, {"y.png", "one"}, {"gone", "none"}}));
    EXPECT_EQ(bad.code, 2); // a job over its limit counts as done
    EXPECT_NE(bad.err.find("1 of 4 jobs are not done; the worst is 'gone': gone.png: no such file"), std::string::npos)
        << bad.err;
    jobs({flip("a.png", "z.png")});
    batchReport({"--thumbnails", "none"});
    EXPECT_EQ(thumbnails(), (States{{"z.png", "none"}}));
}

std::vector<std::string> split(const std::string& text)
{
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

// For every option that takes a file, by its help, the table of options must say whether it is read or written.
TEST(BatchArguments, everyFileOptionSaysWhetherItReadsOrWrites)
{
    const TemporaryFolder folder;
    const std::regex option(R"((?:^|\n)  (?:-o, )?(--[a-z-]+) (?:FILE|PATH|DIR|FOLDER)\b)");
    std::size_t checked = 0;
    // Commands, and what they need. An option given before is the one that is asked about.
    for (const auto& [command, needed] : {std::pair("render", ""),
                                          {"compare", ""},
                                          {"figures", ""},
                                          {"accuracy", ""},
                                          {"bake", "--high h.obj --low l.obj"},
                                          {"tangents", "m.glb"},
                                          {"lint", "m.glb"},
                                          {"convert", "m.glb --to-frame smooth --from-frame mikktspace"},
                                          {"shader", "--lang glsl --frame cotangent"},
                                          {"map convert", "f.png --from opengl --to directx"},
                                          {"map blend", "b.png d.png"},
                                          {"map diff", "a.png b.png"},
                                          {"map info", "f.png"},
                                          {"map detect", "f.png"},
                                          {"map mips", "f.png"},
                                          {"map from-height", "f.png"},
                                          {"map to-height", "f.png"}}) {
        const std::string text = runTool(split(std::string(command) + " --help"), folder.path()).out;
        for (auto it = std::sregex_iterator(text.begin(), text.end(), option); it != std::sregex_iterator(); ++it) {
            // Another job writes the file and waits for this one: a cycle, if the file is known as input or output.
            const std::string name = (*it)[1];
            const std::string rest = std::regex_replace(std::string(needed), std::regex(name + " \\S+"), "");
            std::ofstream(folder / "jobs.jsonl")
                << json{{"command", split(fmt::format("{} {} NAMED {}", command, name, rest))}, {"outputs", {"TOKEN"}}}
                << "\n"
                << json{{"command", {"map", "info", "x"}}, {"inputs", {"TOKEN"}}, {"outputs", {"NAMED"}}} << "\n";
            const ToolRun run = runTool({"batch", "jobs.jsonl", "-o", "r.html"}, folder.path());
            EXPECT_TRUE(run.err.find("waits for") != std::string::npos
                        || run.err.find("writes NAMED, which line 1 also writes") != std::string::npos)
                << command << " " << name << ": " << run.err;
            ++checked;
        }
    }
    EXPECT_GT(checked, 40u);
}

} // namespace
} // namespace cotan
