// The process of a job from both sides: what it is passed and answers, and how its end is classified. Shell scripts
// stand in for the tool.
#include <gtest/gtest.h>

#include <csignal>

#include <fmt/format.h>

#include "batch_fixture.hpp"
#include "cotan/image.hpp"
#include "files/file_registry.hpp"
#include "files/output.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/request.hpp"

namespace cotan {
namespace {

using namespace app;
using namespace test;
namespace fs = std::filesystem;

std::vector<const char*> pointersOf(const Words& words)
{
    std::vector<const char*> pointers;
    for (const std::string& word : words)
        pointers.push_back(word.c_str());
    return pointers;
}

TEST(BatchChild, argumentsStartWithTheChildMarker)
{
    Words words = toWords({"/w x", 12, 34, 56, Thumbnails::models, {"lint", "a b"}});
    EXPECT_EQ(words, (Words{"run-for-batch", "/w x", "12", "34", "2", "56", "lint", "a b"}));
    words.insert(words.begin(), "cotan");
    const auto pointers = pointersOf(words);
    EXPECT_TRUE(isJobProcess(9, pointers.data()));
    EXPECT_TRUE(isJobProcess(7, pointers.data()));
    EXPECT_FALSE(isJobProcess(6, pointers.data()));
    words[1] = "run";
    EXPECT_FALSE(isJobProcess(9, pointersOf(words).data()));
}

class BatchAnswer : public ::testing::Test {
protected:
    using Command = std::function<int(const Words&)>;

    // The exit code of a job process that runs `command` in the folder.
    int run(const Command& command)
    {
        request.work = folder / "work";
        request.parent = ::getpid();
        const pid_t child = ::fork();
        if (child == 0) {
            Words words = toWords(request);
            words.insert(words.begin(), "cotan");
            const auto pointers = pointersOf(words);
            if (::chdir(folder.path().c_str()) != 0)
                ::_exit(99);
            ::_exit(runJobProcess(int(pointers.size()), pointers.data(), command));
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    void SetUp() override { fs::create_directory(folder / "work"); }

    TemporaryFolder folder;
    ChildRequest request;
};

TEST_F(BatchAnswer, hasEachFileOnceInOrderAndLimitsAreSet)
{
    request.words = {"do", "it"};
    request.megabytes = 1000;
    request.processorSeconds = 77;
    EXPECT_EQ(run([](const Words& words) {
                  rlimit memory{}, time{}, core{};
                  ::getrlimit(RLIMIT_DATA, &memory);
                  ::getrlimit(RLIMIT_CPU, &time);
                  ::getrlimit(RLIMIT_CORE, &core);
                  for (const char* file : {"b", "a", "b", "c"})
                      (void)noteInput(file);
                  for (const char* file : {"z", "y"})
                      if (!writeFileWhole(file, "x"))
                          return 90;
                  return words != Words{"do", "it"}                                 ? 91
                      : !kSanitized && memory.rlim_cur != std::uint64_t(1000) << 20 ? 92
                      : time.rlim_cur != 77 || time.rlim_max < 78                   ? 93
                      : core.rlim_cur != 0                                          ? 94
                                                                                    : 3;
              }),
              3);
    const ChildAnswer answer = readAnswer(folder / "work");
    EXPECT_EQ(answer.inputs, (Words{"b", "a", "c"}));
    EXPECT_EQ(answer.outputs, (Words{"z", "y"}));
    EXPECT_EQ(answer.thumbnail.jpeg, "");
    fs::remove_all(folder / "work"); // the answer cannot be written
    EXPECT_EQ(run([](const Words&) { return 0; }), int(ErrorKind::output));
    EXPECT_EQ(run([](const Words&) { return 2; }), 2);
    EXPECT_TRUE(readAnswer(folder / "work").inputs.empty());
}

TEST_F(BatchAnswer, hasAThumbnailOfTheFirstImageThatASuccessfulJobWrites)
{
    const auto width = [&](int code, Thumbnails thumbnails, int failing = 0) {
        request.thumbnails = thumbnails;
        const Command command = [=, this](const Words& words) {
            if (!words.empty() && words[0] == "render") { // renders the thumbnail of a model
                const bool right = words.size() == 9 && words[1] == "b.GLB" && words[2] == "-o"
                    && words[3] == (folder / "work/thumbnail.png").string() && words[4] == "--size"
                    && words[5] == "128x128" && words[6] == "--samples" && words[7] == "1" && words[8] == "--quiet";
                return right && writeImage(words[3], makeImage(5, 6, PixelType::unorm8)) ? failing : 9;
            }
            for (const char* file : {"a.txt", "b.GLB", "c.obj"})
                (void)noteInput(file);
            (void)writeFileWhole("t.txt", "x");
            if (!request.words.empty())
                for (const int size : {7, 9})
                    (void)writeImage(fmt::format("{}.png", size), makeImage(size, size + 1, PixelType::unorm8));
            return code;
        };
        EXPECT_EQ(run(command), code);
        const Thumbnail t = readAnswer(folder / "work").thumbnail;
        EXPECT_EQ(t.jpeg.empty(), t.width == 0);
        EXPECT_EQ(t.height, t.width == 0 ? 0 : t.width + 1);
        return t.width;
    };
    request.words = {"draws"};
    for (const int code : {0, 5}) // done, and over its limit
        for (const auto thumbnails : {Thumbnails::pictures, Thumbnails::models})
            EXPECT_EQ(width(code, thumbnails), 7) << code;
    EXPECT_EQ(width(0, Thumbnails::none), 0);
    for (const int code : {1, 2, 4, 6})
        EXPECT_EQ(width(code, Thumbnails::pictures), 0) << code;
    request.words = {};
    EXPECT_EQ(width(0, Thumbnails::pictures), 0);
    EXPECT_EQ(width(0, Thumbnails::models), 5) << "of the first model that it read";
    EXPECT_EQ(width(0, Thumbnails::models, 4), 0) << "which cannot be drawn";
}

TEST_F(BatchAnswer, incompleteAnswersAreIgnored)
{
    const auto reply = [&](const std::string& text) {
        write(folder / "work/answer.json", text);
        const ChildAnswer a = readAnswer(folder / "work");
        return fmt::format("{} {} {}x{} {}", a.inputs.size(), a.outputs.size(), a.thumbnail.width, a.thumbnail.height,
                           a.thumbnail.jpeg);
    };
    const std::string files = R"({"inputs": ["a", "b"], "outputs": ["c"])", none = "0 0 0x0 ";
    EXPECT_EQ(reply(files + "}"), "2 1 0x0 ");
    EXPECT_EQ(reply(files + R"(, "thumbnail": {"width": 3, "height": 4, "jpeg": "AA"}})"), "2 1 3x4 AA");
    for (const std::string& part : {std::string(R"({"inputs": ["a"]})"), files, files + R"(, "thumbnail": {}})",
                                    std::string("{}"), std::string()})
        EXPECT_EQ(reply(part), none) << part;
}

// A job whose process is a script: $2 is its work folder, and its words start at $7.
class BatchScript : public BatchRun {
protected:
    BatchScript() { options.program = (folder / "tool").string(); }

    std::vector<JobResult> run(const std::string& script)
    {
        write(options.program, "#!/bin/sh\n" + script);
        fs::permissions(options.program, fs::perms::owner_all);
        return BatchRun::run();
    }
};

TEST_F(BatchScript, getsTheLimitsTheThreadsAndAReportPath)
{
    options.threads = 3;
    options.megabytes = 900;
    options.processorSeconds = 4.2; // rounded up
    options.thumbnails = Thumbnails::none;
    add({"one", "a b"});
    Job& two = add({"two", "--threads", "7", "--json", "own.json"});
    two.threads = true;
    two.json = "own.json";
    two.options.megabytes = 12;
    two.options.processorSeconds = 0;
    const auto results = run("pwd > $7.txt; for w in \"$@\"; do echo \"$w\" >> $7.txt; done\n"
                             "echo '{\"command\":\"compare\",\"normals\":{\"mean_degrees\":5}}' > $2/report.json\n"
                             "echo '{\"command\":\"compare\",\"normals\":{\"mean_degrees\":6}}' > own.json\n");
    std::istringstream first(readWhole(folder / "one.txt"));
    std::string here, word, work;
    std::getline(first, here);
    EXPECT_EQ(fs::canonical(here), fs::canonical(folder.path()));
    std::getline(first, word);
    std::getline(first, work);
    EXPECT_EQ(word, "run-for-batch");
    EXPECT_EQ(fs::path(work).parent_path().parent_path(), folder / "store/work");
    const std::string parent = std::to_string(::getpid());
    EXPECT_EQ(readWhole(folder / "one.txt"),
              here + "\nrun-for-batch\n" + work + "\n" + parent + "\n900\n0\n5\none\na b\n--threads\n3\n--json\n" + work
                  + "/report.json\n");
    const std::string second = readWhole(folder / "two.txt");
    EXPECT_TRUE(second.ends_with("\n" + parent + "\n12\n0\n0\ntwo\n--threads\n7\n--json\nown.json\n")) << second;
    for (const std::size_t i : {0u, 1u}) {
        EXPECT_EQ(results[i].record.state, JobState::done) << results[i].record.reason;
        ASSERT_TRUE(results[i].record.degrees);
        EXPECT_EQ(results[i].record.degrees->mean, i == 0 ? 5 : 6);
    }
}

// The program undoes a parent's choice to ignore its children; a host of its functions may make that choice again.
TEST_F(BatchScript, anUnknownEndIsAFailureThatIsTriedAgain)
{
    add({"one"});
    ::signal(SIGCHLD, SIG_IGN);
    const auto results = run("exit 0\n");
    ::signal(SIGCHLD, SIG_DFL);
    EXPECT_EQ(results[0].record.state, JobState::failed);
    EXPECT_NE(results[0].record.reason.find("unknown"), std::string::npos) << results[0].record.reason;
    EXPECT_FALSE(repeatable(results[0].record));
    EXPECT_EQ(run("exit 0\n")[0].record.state, JobState::done);
}

TEST_F(BatchScript, failureReasonIsItsLastOutput)
{
    struct Row {
        const char* script;
        JobState state;
        std::string reason;
    };
    const Row rows[] = {
        {"printf 'x\\ncotan: error: a\\ncotan: error: b c\\nmore'; exit 2", JobState::failed, "b c"},
        {"printf 'cotan: error: the end'; exit 5", JobState::limit, "the end"},
        {"printf 'first\\n the last one \\n\\r\\n\\t\\n'; exit 7", JobState::failed, " the last one"},
        {"printf 'alone'; exit 1", JobState::failed, "alone"},
        {"printf '\\nsecond'; exit 1", JobState::failed, "second"},
        {"printf ' \\n\\t'; exit 1", JobState::failed, "it printed nothing"},
        {"exit 3", JobState::failed, "it printed nothing"},
        {"echo no reason; exit 0", JobState::done, ""},
        {"exit 71", JobState::memory, "needed more memory than is available"},
        {"echo 'what():  std::bad_alloc'; kill -ABRT $$", JobState::memory, "needed more memory than is available"},
        {"echo 'what():  std::bad_alloc'; exit 1", JobState::failed, "what():  std::bad_alloc"},
        {"echo words; kill -TERM $$", JobState::crashed, "crashed (signal 15, Terminated) with"},
    };
    static_assert(kNoMemoryCode == 71);
    std::string script = "case $7 in\n";
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        add({std::to_string(i)});
        script += fmt::format("{}) {} ;;\n", i, rows[i].script);
    }
    add({"over"}).options.megabytes = 345;
    const auto results = run(script + "over) exit 71 ;;\nesac\n");
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const JobRecord& r = results[i].record;
        EXPECT_EQ(r.state, rows[i].state) << rows[i].script << r.reason;
        if (r.state == JobState::crashed) {
            EXPECT_TRUE(r.reason.starts_with(rows[i].reason)) << r.reason;
            EXPECT_TRUE(r.reason.ends_with(" MiB in use: words")) << r.reason;
        } else {
            EXPECT_EQ(r.reason, rows[i].reason) << rows[i].script;
        }
        EXPECT_EQ(r.runs, 1);
    }
    EXPECT_EQ(results.back().record.reason, "needed more memory than 345 MiB");
}

// The first 4096 bytes, and of the rest the last 8192 to 16384.
TEST_F(BatchScript, keepsTheBeginningAndTheEndOfWhatItPrints)
{
    std::string numbers;
    for (int i = 1; i <= 20000; ++i)
        numbers += std::to_string(i) + "\n";
    write(folder / "all", numbers);
    write(folder / "most", numbers.substr(0, 4096 + 16384));
    add({"all"});
    add({"most"});
    const auto results = run("cat $7\n");
    const std::string& output = results[0].record.output;
    EXPECT_EQ(output.substr(0, 4096), numbers.substr(0, 4096));
    EXPECT_EQ(output.substr(4096, 5), "\n...\n");
    const std::string end = output.substr(4101);
    EXPECT_GE(end.size(), 8192u);
    EXPECT_LE(end.size(), 16384u);
    EXPECT_TRUE(numbers.ends_with(end));
    EXPECT_EQ(results[1].record.output, numbers.substr(0, 4096 + 16384));
}

TEST_F(BatchScript, filesAreNamedRelativeToTheFolderWithoutWorkFiles)
{
    for (const char* file : {"a", "b", "..c", "made"})
        write(folder / file, file);
    const fs::path outside = folder.path().parent_path() / (folder.path().filename().string() + "-outside");
    write(outside, "o");
    add({"one"}).inputs = {"stated"};
    const auto results = run(
        fmt::format("echo '{{\"inputs\": [\"b\", \"./a\", \"b\", \"x/../..c\", \"../{}\", \"'$2/mine'\", \"made\"], "
                    "\"outputs\": [\"x/../made\", \"'$2/report.json'\"]}}' > $2/answer.json\n",
                    outside.filename().string()));
    const auto names = [](const std::vector<FileState>& states) {
        Words all;
        for (const FileState& state : states)
            all.push_back(state.file);
        return all;
    };
    EXPECT_EQ(names(results[0].record.inputs), (Words{"..c", outside.string(), "a", "b", "stated"}));
    EXPECT_EQ(names(results[0].record.outputs), Words{"made"}); // "made" is an output and no longer an input
    EXPECT_EQ(results[0].record.inputs[2].digest, digestOf("a"));
    EXPECT_EQ(results[0].record.inputs[4].digest, "missing");
    fs::remove(outside);
}

TEST_F(BatchScript, aFailedStartIsAResultAndReportsProgress)
{
    add({"one"}).outputs = {"x"};
    add({"two"}).inputs = {"x"};
    double last = 0;
    const auto results = tryToRun([&](double fraction) {
        last = fraction;
        return true;
    });
    ASSERT_TRUE(results);
    const JobRecord &one = (*results)[0].record, &two = (*results)[1].record;
    EXPECT_EQ(one.state, JobState::failed);
    EXPECT_EQ(one.code, int(ErrorKind::unavailable));
    EXPECT_EQ(one.reason, "cannot start a process: No such file or directory");
    EXPECT_EQ(two.reason, "waits for 'one 0', which is not done");
    EXPECT_EQ(two.state, JobState::skipped);
    EXPECT_EQ(last, 1);
}

TEST_F(BatchScript, aStoppedRunIsAnErrorAndStartsNoFurtherJob)
{
    add({"three"});
    add({"four"});
    options.processes = 1;
    write(options.program, "#!/bin/sh\n");
    fs::permissions(options.program, fs::perms::owner_all);
    const auto stopped = tryToRun([](double) { return false; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::stopped);
    EXPECT_FALSE(openStore(folder / "store").find({"four"}));
}

} // namespace
} // namespace cotan
