// OutputFile, through which all files are written, and the record of files read and written.
#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <span>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common.hpp"
#include "cotan/image.hpp"
#include "files/file_registry.hpp"
#include "files/output.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;

// The record belongs to the process; every test starts a new one.
class InputGuard : public ::testing::Test {
protected:
    void SetUp() override
    {
        guardInputs(/*overwrite*/ false);
        fs::create_directories(folder / "real/deep");
        fs::create_directory_symlink("real", folder / "link");
        std::ofstream(folder / "real/in.png") << "input";
        fs::create_hard_link(folder / "real/in.png", folder / "hard.png");
        fs::create_symlink("real/in.png", folder / "soft.png");
    }
    void TearDown() override { guardInputs(/*overwrite*/ true); }

    TemporaryFolder folder;
    // Names of the same file.
    const std::vector<std::string> spellings = {"real/in.png", "real/./in.png",       "real/deep/../in.png",
                                                "link/in.png", "link/deep/../in.png", "hard.png",
                                                "soft.png"};
};

TEST(Outputs, throughASymbolicLinkReplaceItsTarget)
{
    TemporaryFolder folder;
    fs::create_directory(folder / "real");
    std::ofstream(folder / "real/old.txt") << "old";
    fs::create_symlink("real/old.txt", folder / "link");
    fs::create_symlink("link", folder / "link of link");
    fs::create_symlink("real/new.txt", folder / "to nothing");
    ASSERT_TRUE(writeFileWhole(folder / "link of link", "new"));
    ASSERT_TRUE(writeFileWhole(folder / "to nothing", "made"));
    EXPECT_TRUE(fs::is_symlink(folder / "link of link"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_TRUE(fs::is_symlink(folder / "to nothing"));
    EXPECT_EQ(fs::file_size(folder / "real/old.txt"), 3u);
    std::string text;
    std::ifstream(folder / "real/old.txt") >> text;
    EXPECT_EQ(text, "new");
    std::ifstream(folder / "real/new.txt") >> text;
    EXPECT_EQ(text, "made");
}

// The system accepts no full path of a file in such a folder; names in it are compared as they are spelled.
TEST_F(InputGuard, filesAreDistinguishedInFoldersDeeperThanTheLongestPath)
{
    const int start = open(".", O_RDONLY | O_DIRECTORY);
    ASSERT_GE(start, 0);
    const std::string step(200, 'd');
    const fs::path top = fs::temp_directory_path() / ("cotan-deep-" + std::to_string(getpid()));
    fs::create_directory(top);
    ASSERT_EQ(chdir(top.c_str()), 0);
    for (int i = 0; i < 25; ++i) {
        ASSERT_EQ(mkdir(step.c_str(), 0700), 0);
        ASSERT_EQ(chdir(step.c_str()), 0);
    }
    std::ofstream("a.png") << "input";
    EXPECT_TRUE(noteInput("a.png"));
    EXPECT_TRUE(planOutput("-o", "b.png"));
    EXPECT_FALSE(planOutput("--json", "./b.png"));
    EXPECT_FALSE(planOutput("--mask", "a.png"));
    unlink("a.png");
    for (int i = 0; i < 25; ++i) {
        ASSERT_EQ(chdir(".."), 0);
        ASSERT_EQ(rmdir(step.c_str()), 0);
    }
    ASSERT_EQ(fchdir(start), 0);
    close(start);
    fs::remove(top);
}

TEST_F(InputGuard, anOutputIsRefusedByEveryNameOfAnInput)
{
    for (const std::string& input : spellings)
        for (const std::string& output : spellings) {
            guardInputs(false);
            ASSERT_TRUE(noteInput(folder / input));
            const Status planned = planOutput("-o", folder / output);
            ASSERT_FALSE(planned) << input << " " << output;
            EXPECT_EQ(planned.error().kind, ErrorKind::usage);
            EXPECT_NE(planned.error().message.find("-o " + (folder / output).string()), std::string::npos);
            EXPECT_NE(planned.error().message.find((folder / input).string() + ", which is an"), std::string::npos);
        }
}

TEST_F(InputGuard, readingIsRefusedByEveryNameOfAPlannedOutput)
{
    for (const std::string& input : spellings)
        for (const std::string& output : spellings) {
            guardInputs(false);
            ASSERT_TRUE(planOutput("-o", folder / output));
            EXPECT_FALSE(noteInput(folder / input)) << input << " " << output;
            EXPECT_TRUE(firstRefusal().has_value());
            EXPECT_FALSE(beginOutput(folder / output)) << "written although a reader went on without it";
        }
}

TEST_F(InputGuard, twoOutputsWithOneNewPathAreRefused)
{
    for (const auto& [a, b] : {std::pair("new.png", "./new.png"),
                               {"real/new.png", "link/deep/../new.png"},
                               {"no/such/new.png", "no/other/../such/./new.png"},
                               {"hard.png", "soft.png"}}) {
        guardInputs(false);
        ASSERT_TRUE(planOutput("-o", folder / a));
        const Status second = planOutput("--json", folder / b);
        ASSERT_FALSE(second) << a << " " << b;
        EXPECT_NE(second.error().message.find("-o "), std::string::npos);
        EXPECT_NE(second.error().message.find("--json "), std::string::npos);
    }
}

TEST_F(InputGuard, unplannedOutputsAreCheckedToo)
{
    ASSERT_TRUE(noteInput(folder / "real/in.png"));
    EXPECT_FALSE(writeFileWhole(folder / "hard.png", "new"));
    EXPECT_EQ(readWhole(folder / "real/in.png"), "input");
    ASSERT_TRUE(writeFileWhole(folder / "a", "first"));
    EXPECT_FALSE(writeFileWhole(folder / "link/../a", "second"));
    EXPECT_EQ(readWhole(folder / "a"), "first");
}

TEST_F(InputGuard, differentFilesPipesAndFinishedOutputsAreAllowed)
{
    ASSERT_TRUE(noteInput(folder / "real/in.png"));
    EXPECT_TRUE(planOutput("-o", folder / "in.png"));
    EXPECT_TRUE(writeFileWhole(folder / "in.png", "out"));
    EXPECT_TRUE(noteInput(folder / "in.png"));
    EXPECT_TRUE(planOutput("-o", "/dev/null"));
    EXPECT_TRUE(planOutput("--json", "/dev/null"));
}

TEST_F(InputGuard, aFileThatIsReadWhileItIsWrittenStaysAsItWas)
{
    auto output = OutputFile::begin(folder / "hard.png");
    ASSERT_TRUE(output && writeBytes(*output, {}));
    EXPECT_FALSE(noteInput(folder / "real/in.png")); // the reader may continue without it
    EXPECT_FALSE(output->commit());
    EXPECT_EQ(readWhole(folder / "hard.png"), "input");
}

TEST_F(InputGuard, onlyASessionWritesAnOutputAgainAndNoneThatItHasReadMeanwhile)
{
    for (const bool again : {false, true}) {
        guardInputs(/*overwrite*/ false, again);
        ASSERT_TRUE(noteInput(folder / "real/in.png"));
        ASSERT_TRUE(writeFileWhole(folder / "a", "first"));
        EXPECT_EQ(bool(writeFileWhole(folder / "a", "second")), again);
        EXPECT_EQ(bool(writeFileWhole(folder / "link/../a", "third")), again);
        EXPECT_EQ(readWhole(folder / "a"), again ? "third" : "first");
        ASSERT_TRUE(noteInput(folder / "a"));
        EXPECT_FALSE(writeFileWhole(folder / "a", "fourth"));
        EXPECT_FALSE(writeFileWhole(folder / "hard.png", "fifth"));
        EXPECT_EQ(readWhole(folder / "a"), again ? "third" : "first");
    }
}

// An editor replaces a file by a new one: every name of the new one is an input's once it is read again.
TEST_F(InputGuard, aFileThatWasReplacedAndReadAgainIsProtectedByItsNewLinks)
{
    ASSERT_TRUE(noteInput(folder / "real/in.png"));
    std::ofstream(folder / "saved") << "new";
    fs::rename(folder / "saved", folder / "real/in.png");
    ASSERT_TRUE(noteInput(folder / "real/in.png"));
    fs::create_hard_link(folder / "real/in.png", folder / "newer.png");
    EXPECT_FALSE(planOutput("-o", folder / "newer.png"));
    EXPECT_TRUE(planOutput("-o", folder / "hard.png")) << "it has the old content, which nobody reads any more";
}

TEST_F(InputGuard, anOutputOfAnotherProcessIsCheckedAndNotRegistered)
{
    ASSERT_TRUE(noteInput(folder / "real/in.png"));
    ASSERT_TRUE(planOutput("-o", folder / "page"));
    for (const std::string& name : spellings)
        EXPECT_FALSE(checkOutput("line 1:", folder / name)) << name;
    EXPECT_FALSE(checkOutput("line 1:", folder / "page"));
    EXPECT_TRUE(checkOutput("line 1:", folder / "free"));
    EXPECT_TRUE(planOutput("--json", folder / "free"));
}

TEST_F(InputGuard, withOverwriteEverythingIsAllowed)
{
    guardInputs(/*overwrite*/ true);
    ASSERT_TRUE(noteInput(folder / "real/in.png"));
    ASSERT_TRUE(planOutput("-o", folder / "hard.png"));
    ASSERT_TRUE(writeFileWhole(folder / "hard.png", "new"));
    EXPECT_EQ(readWhole(folder / "hard.png"), "new");
    EXPECT_EQ(readWhole(folder / "real/in.png"), "input") << "written into the file that both names had";
}

std::size_t entries(const fs::path& folder) { return std::size_t(std::distance(fs::directory_iterator(folder), {})); }

TEST(OutputFiles, uncommittedOutputsKeepTheOldFile)
{
    TemporaryFolder folder;
    std::ofstream(folder / "a.png") << "old";
    {
        auto output = OutputFile::begin(folder / "a.png");
        ASSERT_TRUE(output);
        EXPECT_EQ(output->path().extension(), ".png");
        ASSERT_TRUE(writeBytes(*output, {}));
        EXPECT_EQ(entries(folder.path()), 2u);
    }
    EXPECT_EQ(entries(folder.path()), 1u);
    EXPECT_EQ(readWhole(folder / "a.png"), "old");
}

TEST(OutputFiles, aNameAsLongAsAFolderTakesCanBeWritten)
{
    TemporaryFolder folder;
    const std::string name = std::string(251, 'x') + ".txt";
    EXPECT_TRUE(writeFileWhole(folder / name, "text"));
    EXPECT_EQ(readWhole(folder / name), "text");
}

TEST(OutputFiles, aFullDeviceIsReportedAsFull)
{
    const Status written = writeFileWhole("/dev/full", "text");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().message, "/dev/full: cannot write: no space left on the device");
}

TEST(OutputFiles, onlyPartialFilesOfEndedProcessesAreFound)
{
    TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        const auto half = OutputFile::begin(folder / "a.png");
        ::_exit(half && writeBytes(*half, {}) ? 0 : 1); // without removing the part
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child); // its process number is free now
    ASSERT_EQ(status, 0);
    const fs::path left = fs::directory_iterator(folder.path())->path();
    EXPECT_TRUE(left.filename().string().starts_with(".cotan-" + std::to_string(child) + "-")) << left;
    auto ours = OutputFile::begin(folder / "b.png");
    ASSERT_TRUE(ours && writeBytes(*ours, {}));
    std::string elsewhere = left.filename().string(); // the same process number on another machine
    const std::size_t machine = elsewhere.find(".part") - 1;
    elsewhere[machine] = elsewhere[machine] == '0' ? '1' : '0';
    std::ofstream(folder / elsewhere) << "theirs";
    std::ofstream(folder / ".cotan-x-0.part") << "mine";
    std::ofstream(folder / "a.part.png") << "mine";
    EXPECT_EQ(leftParts(folder.path()), std::vector<fs::path>{left});
    removeParts(folder.path(), 0); // process 0 has no parts
    EXPECT_TRUE(fs::exists(left));
    EXPECT_TRUE(fs::exists(folder / "a.part.png"));
    removeParts(folder.path(), child);
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(folder / elsewhere));
    EXPECT_TRUE(fs::exists(ours->path()));
}

TEST(OutputFiles, aNameWithoutAProcessIsNoPartialFile)
{
    TemporaryFolder folder;
    auto ours = OutputFile::begin(folder / "a.png");
    ASSERT_TRUE(ours);
    // A negative process number would mean a process group, and there is no such group.
    const std::string number = std::to_string(::getpid());
    std::string name = ours->path().filename().string();
    name.replace(name.find(number), number.size(), "-999999");
    std::ofstream(folder / name) << "mine";
    EXPECT_TRUE(leftParts(folder.path()).empty());
}

TEST(OutputFiles, filesOpenUnderProcAreWrittenThrough)
{
    TemporaryFolder folder;
    std::ofstream(folder / "a.txt") << "old";
    const int file = ::open((folder / "a.txt").c_str(), O_RDWR | O_APPEND);
    ASSERT_GE(file, 0);
    EXPECT_TRUE(writeFileWhole("/proc/self/fd/" + std::to_string(file), "new"));
    char text[4] = "";
    EXPECT_EQ(::pread(file, text, 3, 0), 3); // the open file, not another one of its name
    EXPECT_EQ(std::string(text), "new");
    ::close(file);
    EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(OutputFiles, writingContinuesAfterASignal)
{
    TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    struct sigaction quiet {};
    quiet.sa_handler = [](int) {};
    struct sigaction before {};
    ::sigaction(SIGUSR1, &quiet, &before); // without SA_RESTART: write() ends with EINTR
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    const std::string sent(300000, 'x');
    Status written = Done{};
    const auto output = OutputFile::begin(pipe);
    ASSERT_TRUE(output);
    std::thread writer([&] { written = writeBytes(*output, {std::as_bytes(std::span(sent.data(), sent.size()))}); });
    for (int i = 0; i < 50; ++i) { // the pipe is soon full
        ::usleep(2000);
        ::pthread_kill(writer.native_handle(), SIGUSR1);
    }
    std::size_t received = 0;
    std::vector<char> buffer(65536);
    for (int idle = 0; received < sent.size() && idle < 500;) {
        const ssize_t count = ::read(reader, buffer.data(), buffer.size());
        received += count > 0 ? std::size_t(count) : 0;
        if (count <= 0) {
            ::usleep(2000);
            ++idle;
        }
    }
    ::close(reader); // ends a writer that still waits
    writer.join();
    ::sigaction(SIGUSR1, &before, nullptr);
    EXPECT_TRUE(written) << written.error().message;
    EXPECT_EQ(received, sent.size());
}

TEST(OutputFiles, aFullQuotaIsReportedAsNoSpace)
{
    EXPECT_EQ(reasonOf(EDQUOT), "no space left on the device");
    EXPECT_EQ(reasonOf(ENOSPC), "no space left on the device");
    EXPECT_EQ(reasonOf(EACCES), "permission denied");
}

TEST(OutputFiles, libraryErrorsAboutPartialFilesNameTheFinalFile)
{
    TemporaryFolder folder;
    auto output = OutputFile::begin(folder / "a.png");
    ASSERT_TRUE(output);
    const std::string part = output->path().string(), name = output->path().filename().string();
    EXPECT_EQ(output->failed(outputError(part + ": bad; " + name)).message,
              (folder / "a.png").string() + ": bad; a.png");
    EXPECT_EQ(output->failed(inputError(part)).message, part) << "of an input nothing is changed";
    auto here = OutputFile::begin("a.png"); // in the working folder, where parts are named ./...
    ASSERT_TRUE(here);
    EXPECT_EQ(here->failed(outputError(here->path().string() + ": bad")).message, "a.png: bad");
}

TEST(OutputPlan, foldersAreMadeOnlyIfAllowedAndErrorsNameOptions)
{
    TemporaryFolder folder;
    using app::plannedIn, app::planOutputs;
    const fs::path deep = folder / "new";
    EXPECT_TRUE(planOutputs(plannedIn("-o", deep, {"a.png", "b.png"})));
    const auto missing = planOutputs({{"--json", deep / "c.json"}});
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("new does not exist"), std::string::npos) << missing.error().message;
    guardInputs(/*overwrite*/ false);
    const auto twice = planOutputs({{"--csv", folder / "d"}, {"--json", folder / "d"}});
    guardInputs(/*overwrite*/ true);
    ASSERT_FALSE(twice);
    EXPECT_NE(twice.error().message.find("--json"), std::string::npos) << twice.error().message;
    EXPECT_NE(twice.error().message.find("--csv"), std::string::npos) << twice.error().message;
}

// Writes in a child process that dies by `signal` half-way; returns the status of the process.
int statusAfter(int signal, const fs::path& folder, bool hold, bool ignored)
{
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(signal, ignored ? SIG_IGN : SIG_DFL); // overrides what the shell passed on (nohup)
        removePartsOnInterrupt();
        auto a = OutputFile::begin(folder / "a.png"), b = OutputFile::begin(folder / "b.png");
        if (!a || !b || !writeBytes(*a, {}) || !writeBytes(*b, {}))
            ::_exit(70);
        if (hold) {
            const InterruptsHeld held;
            ::raise(signal);
            if (!std::ofstream(folder / "reached"))
                ::_exit(71);
        } else {
            ::raise(signal);
        }
        ::_exit(72); // parts stay
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

TEST(OutputFiles, signalsRemovePartialFilesAndEndTheProcessAsUsual)
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        TemporaryFolder folder;
        const int status = statusAfter(signal, folder.path(), false, false);
        ASSERT_TRUE(WIFSIGNALED(status)) << signal;
        EXPECT_EQ(WTERMSIG(status), signal);
        EXPECT_TRUE(fs::is_empty(folder.path())) << signal;
    }
}

TEST(OutputFiles, blockedSignalsArriveLaterAndIgnoredOnesStayIgnored)
{
    TemporaryFolder folder;
    const int held = statusAfter(SIGTERM, folder.path(), true, false);
    EXPECT_TRUE(WIFSIGNALED(held));
    EXPECT_TRUE(fs::exists(folder / "reached"));
    EXPECT_EQ(entries(folder.path()), 1u);
    const int ignored = statusAfter(SIGHUP, folder.path(), false, true);
    EXPECT_TRUE(WIFEXITED(ignored) && WEXITSTATUS(ignored) == 72);
}

} // namespace
} // namespace cotan
