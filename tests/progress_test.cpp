// The progress line of long commands, on a terminal and elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>

#include <fmt/format.h>
#include <pty.h>

#include "common.hpp"
#include "cotan/image.hpp"
#include "cotan/render.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "terminal/progress_line.hpp"

namespace cotan {
namespace {

using namespace app;
using namespace test;
using Words = std::vector<std::string>;

// Runs `work` in a child process whose standard error is a terminal of `columns` columns; returns what it writes there.
template<class Work> std::string onTerminal(unsigned short columns, Work work)
{
    int terminal = -1;
    const winsize size{24, columns, 0, 0};
    const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        ::dup2(::open("/dev/null", O_WRONLY), 1);
        work();
        ::_exit(0);
    }
    std::string text;
    char bytes[4096];
    for (ssize_t n; (n = ::read(terminal, bytes, sizeof bytes)) > 0;)
        text.append(bytes, std::size_t(n));
    ::close(terminal);
    ::waitpid(child, nullptr, 0);
    return text;
}

// The successive states of the line; the last is the empty one after it is wiped.
std::vector<std::string> states(const std::string& text)
{
    const std::string wipe = "\r\033[K";
    std::vector<std::string> all;
    for (std::size_t at = 0; (at = text.find(wipe, at)) != std::string::npos;) {
        at += wipe.size();
        all.push_back(text.substr(at, text.find(wipe, at) - at));
    }
    return all;
}

std::size_t columnsOf(const std::string& line)
{
    return std::size_t(
        std::ranges::count_if(line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

double percentOf(const std::string& line)
{
    const std::size_t end = line.find(" %");
    return end == std::string::npos ? -1 : std::stod(line.substr(line.rfind(": ", end) + 2));
}

// States of the line while two threads do `steps` steps each of `milliseconds`.
std::vector<std::string> statesOfWork(unsigned short columns, const std::string& name, int milliseconds, int steps)
{
    return states(onTerminal(columns, [&] {
        ProgressLine progress(false, std::size_t(2 * steps), name);
        const auto half = [&] {
            for (int i = 0; i < steps; ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
                progress.step();
            }
        };
        std::thread other(half);
        half();
        other.join();
    }));
}

TEST(ProgressLine, isRedrawnAtMostTenTimesASecondAndNeverDecreases)
{
    const auto lines = statesOfWork(80, "work", 5, 600); // 3 s at least
    ASSERT_GT(lines.size(), 5u);
    EXPECT_LT(lines.size(), 10u * 30); // a loaded machine takes longer, but not ten times
    double before = -1;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        EXPECT_GE(percentOf(lines[i]), before) << lines[i];
        before = percentOf(lines[i]);
    }
    EXPECT_EQ(lines.back(), "") << "the line is wiped";
    EXPECT_LT(lines.size(), 1200u / 2) << "drawn at every step";
}

// The work is even, so the time left is the one stated before less the time since; other load on the machine may halve
// or double it.
TEST(ProgressLine, showsTheRemainingTimeOnceItIsReliable)
{
    const auto lines = statesOfWork(80, "work", 10, 600); // 6 s at least
    bool timeShown = false;
    for (const std::string& line : lines) {
        const std::size_t at = line.find("about ");
        timeShown = timeShown || at != std::string::npos;
        if (percentOf(line) >= 0 && percentOf(line) < 3) {
            EXPECT_EQ(at, std::string::npos) << line;
        }
        if (at != std::string::npos) {
            EXPECT_LE(std::stod(line.substr(at + 6)), 20) << line;
        }
    }
    EXPECT_TRUE(timeShown);
}

TEST(ProgressLine, fitsTheTerminalForAnyName)
{
    const std::string name = "a\nb\033[31m" + std::string(60, 'x') + "\xc3\xa4\xc3\xb6\xc3\xbc" + std::string(200, 'y');
    for (const unsigned short columns : std::initializer_list<unsigned short>{80, 200, 40, 12})
        for (const std::string& line : statesOfWork(columns, name, 1, 150)) {
            EXPECT_LT(columnsOf(line), std::min<std::size_t>(columns, 80)) << line;
            for (const char c : line)
                EXPECT_GE(static_cast<unsigned char>(c), 32) << line;
        }
}

// States of the line for steps that are farther apart than two redraws, without the time left.
std::vector<std::string> drawnBy(unsigned short columns, std::size_t total, const std::string& name,
                                 const std::function<void(ProgressLine&, const std::function<void()>&)>& work)
{
    auto lines = states(onTerminal(columns, [&] {
        ProgressLine progress(false, total, name);
        work(progress, [] { std::this_thread::sleep_for(std::chrono::milliseconds(120)); });
    }));
    for (std::string& line : lines) // a busy machine may have stated a time
        line = line.substr(0, line.find(", about "));
    return lines;
}

TEST(ProgressLine, countsStepsAndNeverShows100)
{
    const auto lines = drawnBy(80, 3, "work", [](ProgressLine& progress, const auto& later) {
        for (int i = 0; i < 4; ++i) { // one more than the total
            later();
            progress.step();
        }
    });
    EXPECT_EQ(lines, (Words{"work: 0 %", "work: 33 %", "work: 66 %", "work: 99 %", "work: 99 %", ""}));
    // 0 begins the next step; fractions that are out of range or fall are ignored.
    const auto parts = drawnBy(80, 2, "p", [](ProgressLine& progress, const auto& later) {
        const Progress within = progress.within();
        for (const double fraction : {0.5, 0.25, 1.5, 0.0}) {
            later();
            EXPECT_TRUE(within(fraction));
        }
    });
    EXPECT_EQ(parts, (Words{"p: 0 %", "p: 25 %", "p: 25 %", "p: 50 %", "p: 50 %", ""}));
    const auto begun = drawnBy(80, 2, "p", [](ProgressLine& progress, const auto& later) {
        const Progress within = progress.within();
        for (const double fraction : {0.0, 0.5}) { // of the first step
            later();
            within(fraction);
        }
    });
    EXPECT_EQ(begun, (Words{"p: 0 %", "p: 0 %", "p: 25 %", ""}));
    const auto unknown = drawnBy(80, 0, "of who knows how many", [](ProgressLine& progress, const auto& later) {
        later();
        progress.step();
    });
    EXPECT_EQ(unknown, (Words{"of who knows how many ...", "of who knows how many ...", ""}));
}

// One column of the terminal stays free, and at most 79 are used; longer lines end in three dots.
TEST(ProgressLine, cutsLongNamesByWholeLettersAndKeepsThePercentage)
{
    const auto first = [](unsigned short columns, const std::string& name) {
        return drawnBy(columns, 3, name, [](ProgressLine&, const auto&) {}).at(0);
    };
    EXPECT_EQ(first(20, std::string(14, 'x')), std::string(14, 'x') + ": 0 %");
    EXPECT_EQ(first(20, std::string(15, 'x')), std::string(11, 'x') + "...: 0 %");
    EXPECT_EQ(first(80, std::string(74, 'x')), std::string(74, 'x') + ": 0 %");
    EXPECT_EQ(first(300, std::string(75, 'x')), std::string(71, 'x') + "...: 0 %");
    std::string umlauts;
    for (int i = 0; i < 15; ++i)
        umlauts += "\xc3\xa4";
    EXPECT_EQ(first(20, umlauts.substr(0, 28)), umlauts.substr(0, 28) + ": 0 %");
    EXPECT_EQ(first(20, umlauts), umlauts.substr(0, 22) + "...: 0 %");
    EXPECT_EQ(first(20, "a\nb\x7f~"), "a\\nb\\x7f~: 0 %");
    EXPECT_EQ(first(6, "work"), "wo..."); // no space for a percentage
}

TEST(ProgressLine, isSilentWithoutATerminal)
{
    ::testing::internal::CaptureStderr();
    {
        ProgressLine progress(false, 3, "work");
        progress.step();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(onTerminal(80, [&] { ProgressLine progress(true, 3, "work"); }), "");
}

// `compare --edges` once rendered two more images that reported progress to a destroyed line.
TEST(ProgressLine, isDetachedFromTheRendererWhenDestroyed)
{
    const auto renderer = openRenderer("reference", 1);
    ASSERT_TRUE(renderer) << renderer.error().message;
    app::CommonOptions quiet;
    quiet.quiet = true;
    const bool reported =
        app::drawWithProgress(quiet, **renderer, 1, "drawing", [&] { return bool((*renderer)->progress); });
    EXPECT_TRUE(reported);
    EXPECT_FALSE((*renderer)->progress);
}

TEST(ProgressLine, isShownByEveryLongCommandOnlyOnATerminal)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    ASSERT_TRUE(writeImage(folder / "n.png", makeReliefMap(Relief::domes, 64)));
    std::vector<Words> commands = {
        {"render", "quad.gltf", "-o", "a.png", "--size", "32x32", "--device", "reference"},
        {"compare", "quad.gltf", "-o", "d", "--size", "32x32", "--device", "reference"},
        {"bake", "--high", "quad.gltf", "--low", "quad.gltf", "--size", "16x16", "-o", "b.png"},
        {"convert", "quad.gltf", "--to", "orthonormal", "-o", "c.glb"},
        {"lint", "quad.gltf"},
        {"tangents", "quad.gltf"},
        {"accuracy", "--tables", "flat", "--frames", "cotangent"},
        {"figures", "--only", "mirrored", "--size", "64x48", "--device", "reference", "-o", "f"},
        {"map", "info", "n.png"},
        {"map", "detect", "n.png"},
        {"map", "convert", "n.png", "--from", "directx", "--to", "opengl", "-o", "e.png"},
        {"map", "from-height", "n.png", "-o", "g.png"},
        {"map", "to-height", "n.png", "-o", "h.png"},
        {"map", "blend", "n.png", "n.png", "-o", "i.png"},
        {"map", "diff", "n.png", "n.png"},
        {"map", "mips", "n.png", "-o", "j.dds"}};
#ifdef COTAN_WITH_VULKAN
    commands.push_back({"cost", "--frames", "cotangent", "--no-timing", "--family", "NAVI21"});
#endif
    for (const Words& words : commands) {
        const auto lines = states(onTerminal(80, [&] {
            std::vector<char*> arguments{const_cast<char*>("cotan")};
            for (const std::string& word : words)
                arguments.push_back(const_cast<char*>(word.c_str()));
            arguments.push_back(nullptr);
            if (::chdir(folder.path().c_str()) == 0)
                ::execv(COTAN_TOOL, arguments.data());
        }));
        const std::string all = ::testing::PrintToString(words);
        ASSERT_GE(lines.size(), 2u) << all;
        for (const std::string& line : lines)
            EXPECT_LT(columnsOf(line.substr(0, std::min(line.find("cotan: warning"), line.find("cotan: error")))), 80u)
                << all << line;
        EXPECT_EQ(runTool(words, folder.path()).err.find('\033'), std::string::npos) << all;
    }
}

} // namespace
} // namespace cotan
