// Readers in a child process: their failures, and what they leave behind. sandbox_child.cpp is the child.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/one_line.hpp"
#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "files/file_registry.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/process.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;

// Makes the child misbehave as named, for the lifetime of the object.
class Act {
public:
    explicit Act(const char* what) { ::setenv("SANDBOX_CHILD_DOES", what, 1); }
    ~Act() { ::unsetenv("SANDBOX_CHILD_DOES"); }
};

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Sandboxed : public testing::Test {
protected:
    TemporaryFolder folder;
    std::filesystem::path model = folder / "m.obj";
    LoadLimits limits;

    void SetUp() override
    {
        std::ofstream(model) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n";
        limits.sandbox = {.program = SANDBOX_CHILD};
        ::setenv("ASAN_OPTIONS", "handle_segv=0:handle_abort=0", 1); // the child must crash as without sanitizers
        ::setenv("TSAN_OPTIONS", "handle_segv=0:handle_abort=0", 1);
    }

    // Error message of loading while the child misbehaves, without the file name; empty on success.
    std::string problem(const char* act) const
    {
        const Act acting(act);
        const auto scene = loadScene(model, limits);
        if (scene)
            return "";
        EXPECT_EQ(scene.error().kind, ErrorKind::input);
        EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
        const std::string file = model.string() + ": ";
        EXPECT_TRUE(scene.error().message.starts_with(file)) << scene.error().message;
        return scene.error().message.substr(std::min(file.size(), scene.error().message.size()));
    }
};

TEST_F(Sandboxed, misbehavingReadersGiveOneLineErrors)
{
    const std::string the = "the reader of OBJ files ";
    EXPECT_EQ(problem("crash"), the + "crashed (signal 11, Segmentation fault)");
    EXPECT_EQ(problem("abort"), the + "crashed (signal 6, Aborted): expected  [31mcourage");
    EXPECT_EQ(problem("leave"), the + "ended without a result");
    EXPECT_EQ(problem("unread"), the + "ended without a result");
    EXPECT_EQ(problem("half"), the + "ended without a result");
    EXPECT_EQ(problem("count"), the + "ended without a result");
    EXPECT_EQ(problem("garbage"), the + "returned invalid data");
    EXPECT_EQ(problem("index"), "mesh 0: triangle 1: expected an index below 25, found 25");
    EXPECT_EQ(problem("flood"), "");
}

TEST_F(Sandboxed, watchersGetTheFilesThatTheChildReadsAndNoEmptyName)
{
    std::ofstream(folder / "m.mtl") << "newmtl red\n";
    std::ofstream(model, std::ios::app) << "mtllib m.mtl\nusemtl red\n";
    std::vector<std::filesystem::path> read;
    watchInputs([&](const std::filesystem::path& file) { read.push_back(file); });
    const bool loaded = bool(loadScene(model, limits));
    watchInputs({});
    ASSERT_TRUE(loaded);
    EXPECT_NE(std::ranges::find(read, folder / "m.mtl"), read.end());
    EXPECT_EQ(std::ranges::find(read, std::filesystem::path()), read.end());
}

TEST_F(Sandboxed, timeAndMemoryLimitsAreEnforced)
{
    const auto start = std::chrono::steady_clock::now();
    limits.sandbox.seconds = 0.05; // of CPU time, limited in whole seconds; wall time is limited to 15 times that
    EXPECT_EQ(problem("hang"), "the reader of OBJ files took too long; the limit is 0 seconds");
    EXPECT_NE(problem("deaf").find("took too long"), std::string::npos);
    EXPECT_NE(problem("expect").find("took too long"), std::string::npos); // however much work it announces
    limits.sandbox.seconds = 1;
    EXPECT_EQ(problem("spin"), "the reader of OBJ files took too long; the limit is 1 seconds");
    EXPECT_LT(secondsSince(start), 40);
    if (kSanitized)
        return; // memory is not limited then
    limits.sandbox = {.program = SANDBOX_CHILD, .megabytes = 64};
    EXPECT_EQ(problem("eat"), "the reader of OBJ files takes too much memory; the limit is 64 MiB");
    rusage used{};
    ::getrusage(RUSAGE_CHILDREN, &used);
    EXPECT_LT(used.ru_maxrss, 200 << 10) << "KB; the limit, and what the program itself is";
}

TEST_F(Sandboxed, errorMessagesAreOnePrintableLine)
{
    const Act acting("lines");
    const std::string whole = loadScene(model, limits).error().message;
    EXPECT_TRUE(whole.starts_with("two lines [2Jxxx")) << whole.substr(0, 40);
    EXPECT_LT(whole.size(), 5000u);
}

TEST_F(Sandboxed, theReaderCanOnlyRead)
{
    if (kSanitized)
        GTEST_SKIP() << "with sanitizers no call is forbidden";
    const Act acting("powers");
    EXPECT_EQ(loadScene(model, limits).error().message, "can:.");
    EXPECT_TRUE(std::filesystem::exists(model));
}

TEST_F(Sandboxed, unneededSystemCallsAreRefused)
{
    if (kSanitized)
        GTEST_SKIP() << "with sanitizers no call is forbidden";
    const Act acting("calls");
    EXPECT_EQ(loadScene(model, limits).error().message, "not refused:.");
}

TEST_F(Sandboxed, theReaderInheritsNoDescriptors)
{
    const std::ifstream ours(model);
    const int leaky = ::dup(0); // without O_CLOEXEC, as other libraries open files: child processes inherit it
    const Act acting("descriptors");
    EXPECT_EQ(loadScene(model, limits).error().message, "open: 0 1 2.");
    ::close(leaky);
}

TEST_F(Sandboxed, aMissingReaderProgramIsNotAnInputError)
{
    limits.sandbox.program = folder / "none";
    const auto scene = loadScene(model, limits);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().kind, ErrorKind::unavailable);
    EXPECT_NE(scene.error().message.find("none: No such file"), std::string::npos) << scene.error().message;
}

TEST_F(Sandboxed, twoHundredLoadsLeaveNoZombieAndNoDescriptor)
{
    const auto descriptors = [] {
        const std::filesystem::directory_iterator all("/proc/self/fd");
        return std::distance(begin(all), end(all));
    };
    const auto before = descriptors();
    for (int i = 0; i < 200; ++i) {
        if (i % 4 == 0)
            EXPECT_NE(problem(i % 8 == 0 ? "crash" : "half"), "");
        else
            ASSERT_TRUE(loadScene(model, limits)) << i;
    }
    EXPECT_EQ(descriptors(), before);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST_F(Sandboxed, loadingWorksIfSigchldIsIgnored)
{
    ::signal(SIGCHLD, SIG_IGN);
    EXPECT_TRUE(loadScene(model, limits));
    EXPECT_EQ(problem("crash"), "the reader of OBJ files ended without a result"); // the exit status is not available
    ::signal(SIGCHLD, SIG_DFL);
}

// A compromised reader may claim anything about an image. Inconsistent claims are refused.
TEST_F(Sandboxed, inconsistentImageHeadersAreRefused)
{
    const auto file = folder / "a.tga";
    ASSERT_TRUE(writeImage(file, makeImage(3, 2, PixelType::unorm8)));
    limits.imageSide = 9;
    limits.imageBytes = 100;
    const std::string name = file.string() + ": ";
    const auto outcome = [&](const char* claim) {
        ::setenv("SANDBOX_CHILD_PICTURE", claim, 1);
        const Act acting("picture");
        const auto image = readImage(file, limits);
        ::unsetenv("SANDBOX_CHILD_PICTURE");
        return image ? "accepted" : image.error().message;
    };
    EXPECT_EQ(outcome("3 2 1 24"), "accepted");
    EXPECT_EQ(outcome("3 2 4 24"), "accepted");
    EXPECT_EQ(outcome("3 2 0 24"), name + "expected 1 to 4 channels, found 0");
    EXPECT_EQ(outcome("3 2 5 24"), name + "expected 1 to 4 channels, found 5");
    EXPECT_EQ(outcome("3 2 4 23"), name + "expected the bytes of 3 x 2 pixels, found 23");
    EXPECT_EQ(outcome("3 2 4 25"), name + "expected the bytes of 3 x 2 pixels, found 25");
    EXPECT_EQ(outcome("9 1 4 36"), "accepted");
    EXPECT_EQ(outcome("10 1 4 40"), name + "the image size is 10 x 1, the limit is 9 per side");
    EXPECT_EQ(outcome("1 10 4 40"), name + "the image size is 1 x 10, the limit is 9 per side");
    EXPECT_EQ(outcome("0 2 4 0"), name + "the image size is 0 x 2");
    EXPECT_EQ(outcome("5 5 4 100"), "accepted");
    EXPECT_EQ(outcome("2 13 4 104"), name + "the image size is 2 x 13, the limit is 9 per side");
    EXPECT_EQ(outcome("9 3 4 108"), name + "9 x 3 pixels take 108 bytes, the limit is 100");
}

TEST_F(Sandboxed, inconsistentRowHeadersAreRefused)
{
    const auto file = folder / "a.tif";
    ASSERT_TRUE(writeImage(file, makeImage(3, 2, PixelType::unorm8)));
    limits.imageSide = 9;
    const auto outcome = [&](const char* claim, int rows) {
        ::setenv("SANDBOX_CHILD_PICTURE", claim, 1);
        const Act acting("rows");
        auto reader = openRows(file, limits);
        ::unsetenv("SANDBOX_CHILD_PICTURE");
        if (!reader)
            return reader.error().message;
        Image strip = makeImage((*reader)->width, rows, (*reader)->type);
        const Status read = (*reader)->read(strip);
        return read ? std::to_string((*reader)->height) + " rows of " + std::to_string(int(strip.data.back()))
                    : read.error().message;
    };
    EXPECT_EQ(outcome("3 2 1 24", 2), "2 rows of 7");
    EXPECT_EQ(outcome("3 2 4 12", 1), "2 rows of 7");
    EXPECT_EQ(outcome("9 9 4 36", 1), "9 rows of 7");
    for (const char* const claim : {"3 2 0 24", "3 2 5 24", "0 2 4 24", "3 0 4 24", "-3 2 4 24", "10 2 4 80",
                                    "3 10 4 24", "3 2 4 23", "3 2 4 25"})
        EXPECT_NE(outcome(claim, 2).find("returned invalid data"), std::string::npos)
            << claim << ": " << outcome(claim, 2);
}

TEST_F(Sandboxed, anImageThatTheChildDoesNotReadIsAnError)
{
    const Act acting("unread");
    std::vector<std::byte> bytes(4 << 20, std::byte(0));
    bytes[0] = std::byte('B'), bytes[1] = std::byte('M');
    const auto image = decodeImage(bytes, "big.bmp", limits);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().message, "big.bmp: the reader of BMP images ended without a result");
}

bool isGone(pid_t process)
{
    for (int i = 0; i < 500 && ::kill(process, 0) == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return ::kill(process, 0) != 0;
}

TEST_F(Sandboxed, theReaderEndsWhenItsParentIsKilledOrInterrupted)
{
    const Act acting("hang-confined");
    const auto note = folder / "pid";
    ::setenv("SANDBOX_CHILD_PID", note.c_str(), 1);
    for (const int signal : {SIGKILL, SIGINT}) {
        std::filesystem::remove(note);
        const pid_t parent = ::fork();
        if (parent == 0) {
            (void)loadScene(model, limits);
            ::_exit(0);
        }
        pid_t reader = 0;
        for (int i = 0; i < 1000 && reader == 0; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            std::ifstream(note) >> reader;
        }
        ASSERT_GT(reader, 0);
        EXPECT_EQ(::kill(reader, 0), 0);
        ::kill(parent, signal);
        ::waitpid(parent, nullptr, 0);
        EXPECT_TRUE(isGone(reader)) << signal;
    }
    ::unsetenv("SANDBOX_CHILD_PID");
}

// The text is cut to the given number of bytes; "..." marks a cut.
TEST(SandboxText, isTruncatedAndControlCharactersBecomeSpaces)
{
    EXPECT_EQ(oneLine("abcd", 4), "abcd");
    EXPECT_EQ(oneLine("abcde", 4), "abcd...");
    EXPECT_EQ(oneLine("", 0), "");
    EXPECT_EQ(oneLine("a\nb\r\nc\r"), "a b  c");
    EXPECT_EQ(oneLine("\n\t\x1f !~\x7f\xc3\xa4", 99), "    !~ \xc3\xa4");
    EXPECT_EQ(oneLine(std::string("a\0b", 3), 3), "a b");
}

// The caller's limits apply to the child's answer too, here a plane of 25 vertices and 32 triangles.
TEST_F(Sandboxed, scenesOverTheCallersLimitsAreRefused)
{
    const Act acting("plane");
    const std::string name = model.string() + ": ";
    const auto outcome = [&] {
        const auto scene = loadScene(model, limits);
        return scene ? "accepted" : scene.error().message;
    };
    EXPECT_EQ(outcome(), "accepted");
    limits.vertices = 25, limits.triangles = 32;
    EXPECT_EQ(outcome(), "accepted");
    limits.vertices = 24;
    EXPECT_EQ(outcome(), name + "over the limit of 24 vertices");
    limits.vertices = 25, limits.triangles = 31;
    EXPECT_EQ(outcome(), name + "over the limit of 31 triangles");
    ::setenv("SANDBOX_CHILD_INSTANCES", "25", 1);
    limits.triangles = 32;
    EXPECT_EQ(outcome(), "accepted");
    ::setenv("SANDBOX_CHILD_INSTANCES", "26", 1);
    EXPECT_EQ(outcome(), name + "over the limit of 25 instances");
    ::unsetenv("SANDBOX_CHILD_INSTANCES");
}

// The error quotes the first line of the reader's stderr, 160 bytes at most; the parent keeps 4096 bytes of stderr.
TEST_F(Sandboxed, theFirstLineOfStderrIsQuoted)
{
    const std::string the = "the reader of OBJ files ended without a result";
    const auto outcome = [&](const std::string& said) {
        ::setenv("SANDBOX_CHILD_SAYS", said.c_str(), 1);
        const std::string message = problem("say");
        ::unsetenv("SANDBOX_CHILD_SAYS");
        return message;
    };
    EXPECT_EQ(outcome(""), the);
    EXPECT_EQ(outcome("\nmore"), the);
    EXPECT_EQ(outcome("one\ntwo"), the + ": one");
    EXPECT_EQ(outcome(std::string(160, 'a')), the + ": " + std::string(160, 'a'));
    EXPECT_EQ(outcome(std::string(161, 'a')), the + ": " + std::string(160, 'a') + "...");
}

TEST_F(Sandboxed, errorsNameTheFileFormat)
{
    const Act acting("leave");
    const auto outcome = [&](const char* name) {
        const std::string file = (folder / name).string();
        std::ofstream(file) << "x";
        const auto scene = loadScene(file, limits);
        EXPECT_FALSE(scene);
        return scene ? "" : scene.error().message.substr(std::min(file.size(), scene.error().message.size()));
    };
    EXPECT_EQ(outcome("a.PLY"), ": the reader of PLY files ended without a result");
    EXPECT_EQ(outcome("b.3ds"), ": the reader of 3DS files ended without a result");
    const auto picture = [&](const char* name) {
        std::vector<std::byte> bytes(100, std::byte(0));
        bytes[0] = std::byte('B'), bytes[1] = std::byte('M');
        const auto image = decodeImage(bytes, name, limits);
        return image ? "" : image.error().message;
    };
    EXPECT_EQ(picture("a.b"), "a.b: the reader of B images ended without a result");
    EXPECT_EQ(picture("a."), "a.: the reader of images ended without a result");
    EXPECT_EQ(picture("a"), "a: the reader of images ended without a result");
    EXPECT_EQ(picture("a.long"), "a.long: the reader of LONG images ended without a result");
    EXPECT_EQ(picture("a.longer"), "a.longer: the reader of images ended without a result");
}

// A shell script prints its arguments, folder, environment variables and input.
TEST(Spawned, programsGetArgumentsFolderEnvironmentAndInput)
{
    const TemporaryFolder folder;
    const auto run = [&](SpawnRequest request, const std::string& script) -> std::string {
        const auto out = folder / "out";
        const Descriptor output(::open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0600));
        request.program = "/bin/sh";
        request.arguments.insert(request.arguments.begin(), {"-c", script, "name"});
        request.output = output.get();
        pid_t process = -1;
        if (const int problem = spawn(request, process))
            return std::strerror(problem);
        int status = 0;
        ::waitpid(process, &status, 0);
        return readWhole(out) + (WIFEXITED(status) ? std::to_string(WEXITSTATUS(status)) : "killed");
    };
    ::setenv("COTAN_TEST_A", "ours", 1);
    ::setenv("COTAN_TEST_AB", "ours too", 1);
    EXPECT_EQ(run({.program{}, .arguments = {"first", "second"}}, "echo $0 $2 $1; exit 3"), "name second first\n3");
    EXPECT_EQ(run({}, "echo $COTAN_TEST_A; echo $COTAN_TEST_AB >&2; pwd"),
              "ours\nours too\n" + std::filesystem::current_path().string() + "\n0");
    EXPECT_EQ(run({.program{},
                   .arguments{},
                   .folder = folder.path(),
                   .environment = {{"COTAN_TEST_A", "another"}, {"COTAN_TEST_C", "a = b"}}},
                  "echo $COTAN_TEST_A $COTAN_TEST_AB $COTAN_TEST_C; env | grep -c ^COTAN_TEST_A=; pwd"),
              "another ours too a = b\n1\n" + std::filesystem::canonical(folder.path()).string() + "\n0");
    EXPECT_EQ(run({}, "cat; echo end"), "end\n0"); // the input is empty
    std::ofstream(folder / "in") << "given\n";
    const Descriptor input(::open((folder / "in").c_str(), O_RDONLY | O_CLOEXEC));
    EXPECT_EQ(run({.program{}, .arguments{}, .input = input.get()}, "cat; echo end"), "given\nend\n0");
    ::signal(SIGUSR1, SIG_IGN); // ignored signals are inherited by programs
    EXPECT_EQ(run({}, "kill -USR1 $$; echo alive"), "killed");
    ::signal(SIGUSR1, SIG_DFL);
    ::unsetenv("COTAN_TEST_A");
    ::unsetenv("COTAN_TEST_AB");
    pid_t none = -1;
    EXPECT_EQ(spawn({.program = folder / "none", .arguments = {}, .output = 1}, none), ENOENT);
}

TEST(SandboxCommand, isRefusedWithoutAParent)
{
    const TemporaryFolder folder;
    const ToolRun run = runTool({"read-for-parent"}, folder.path());
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(lines(run.err), 1) << run.err;
}

} // namespace
} // namespace cotan
