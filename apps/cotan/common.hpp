// What every command shares: its options, its report, its way to fail.
#pragma once

#include <chrono>
#include <functional>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cotan/result.hpp"

namespace cotan::app {

struct CommonOptions {
    std::filesystem::path output;
    std::string json;  // a file, "-" for standard output, empty for none
    bool quiet = false;
    int threads = 0;   // 0: all cores
};

// Adds -o/--output, --json, --quiet and --threads to a command.
void addCommonOptions(CLI::App& command, CommonOptions& options, const std::string& outputHelp);

// A command of the table in main.cpp: adds itself to the application; `run` is called after parsing
// when its name was given.
struct Command {
    CLI::App* app = nullptr;
    std::function<Status()> run;
};

// Seconds since it was made or last asked.
class Stopwatch {
public:
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double s = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return s;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Writes the report where --json says; nothing if it was not asked for.
Status writeReport(const CommonOptions& options, const nlohmann::ordered_json& report);

// Prints a line on standard output unless --quiet was given or the report goes there.
void say(const CommonOptions& options, const std::string& line);

// Prints "cotan: warning: LINE" on standard error unless --quiet was given.
void warn(const CommonOptions& options, const std::string& line);

// "1 primitive", "2 primitives".
std::string counted(std::size_t number, const std::string& noun);

// Makes a folder and those above it. Errors: ErrorKind::output.
Status makeFolder(const std::filesystem::path& folder);

} // namespace cotan::app
