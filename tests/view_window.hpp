// Plays sessions of `cotan view` on a display in memory.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cotan/image.hpp"
#include "run_tool.hpp"

namespace cotan::test {

// Prevents dialogs of the desktop on which the tests run.
inline constexpr const char* kNoBus = "unix:path=/nowhere";
inline const bool kBusIsHidden = ::setenv("DBUS_SESSION_BUS_ADDRESS", kNoBus, 1) == 0;

// Xvfb on a free display; options: additional arguments.
class Display {
public:
    explicit Display(std::vector<std::string> options = {})
    {
        options.insert(options.begin(), {"Xvfb", "-nolisten", "tcp", "-screen", "0", "1600x1000x24"});
        int ends[2];
        if (::pipe(ends) != 0)
            return;
        child_ = ::fork();
        if (child_ == 0) {
            ::close(ends[0]);
            ::dup2(::open("/dev/null", O_WRONLY), 2);
            options.insert(options.end(), {"-displayfd", std::to_string(ends[1])});
            std::vector<char*> words;
            for (std::string& option : options)
                words.push_back(option.data());
            words.push_back(nullptr);
            ::execvp(words[0], words.data());
            ::_exit(127);
        }
        ::close(ends[1]);
        for (char c; ::read(ends[0], &c, 1) == 1 && c != '\n';)
            name_ += c;
        ::close(ends[0]);
        if (!name_.empty())
            name_ = ":" + name_;
    }
    ~Display()
    {
        if (child_ > 0) {
            ::kill(child_, SIGTERM);
            ::waitpid(child_, nullptr, 0);
        }
    }
    const std::string& name() const { return name_; } // empty if there is no Xvfb

private:
    pid_t child_ = -1;
    std::string name_;
};

// The display that all tests share, except those that need special options.
inline const std::string& display()
{
    static const Display one;
    return one.name();
}

// Plays a session, with Vulkan's validation layer if it is installed; words: arguments before --play.
inline ToolRun play(const TemporaryFolder& folder, const std::string& session, std::vector<std::string> words = {},
                    const std::string& on = display())
{
    std::ofstream(folder / "session.txt") << session;
    words.insert(words.begin(), "view");
    words.insert(words.end(), {"--play", "session.txt"});
    ::setenv("DISPLAY", on.c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    if (std::filesystem::exists("/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json"))
        ::setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 1);
    ToolRun run = runTool(words, folder.path(), 120);
    ::unsetenv("VK_INSTANCE_LAYERS");
    EXPECT_EQ((run.out + run.err).find("VUID"), std::string::npos) << run.out << run.err;
    return run;
}

// Runs the command for `file` that a session printed. Returns the command; empty if it failed or was not printed.
inline std::string runPrinted(const TemporaryFolder& folder, const std::string& output, const std::string& file)
{
    for (std::size_t start = 0; (start = output.find("cotan render ", start)) != std::string::npos; ++start) {
        const std::string command = output.substr(start + 6, output.find('\n', start) - start - 6);
        if (command.find("-o " + file) == std::string::npos)
            continue;
        const std::string shell = "cd " + folder.path().string() + " && " COTAN_TOOL " " + command + " > /dev/null";
        return std::system(shell.c_str()) == 0 ? command : std::string();
    }
    return {};
}

#define COTAN_NEEDS_DISPLAY()                                                                                          \
    if (display().empty())                                                                                             \
    GTEST_SKIP() << "no Xvfb to open a window on"

inline Image readImageFile(const std::filesystem::path& file)
{
    auto image = readImage(file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? *image : Image();
}

// Number of pixels whose red, green or blue differ. A window has no alpha.
inline std::size_t differentPixels(const Image& a, const Image& b)
{
    if (a.width != b.width || a.height != b.height)
        return std::max(a.pixelCount(), b.pixelCount());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i)
        different += !std::equal(a.bytes8() + 4 * i, a.bytes8() + 4 * i + 3, b.bytes8() + 4 * i);
    return different;
}

inline std::string lineOf(const std::string& report, const std::string& name)
{
    const std::size_t start = ("\n" + report).find("\n" + name + ": ");
    if (start == std::string::npos)
        return "no such line";
    const std::size_t from = start + name.size() + 2;
    return report.substr(from, report.find('\n', from) - from);
}

} // namespace cotan::test
