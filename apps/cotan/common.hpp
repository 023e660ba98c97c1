// What every command shares: its options, its report, its way to fail.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/loops.hpp"
#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "files/output.hpp"
#include "files/report/json.hpp"
#include "terminal/arguments.hpp"
#include "terminal/progress_line.hpp"

namespace cotan::app {

struct CommonOptions {
    std::filesystem::path output;
    std::string json; // a file, "-" for standard output, empty for none
    bool quiet = false;
    int threads = 0;        // 0: all cores
    bool overwrite = false; // inputs, and one output by another
};

// Adds -o/--output, --json, --quiet, --threads and --overwrite to a command. An empty outputHelp: the command writes
// nothing but its report; -o is not listed, and refused.
void addCommonOptions(Arguments& command, CommonOptions& options, const std::string& outputHelp);

// Another name for an option of that name, which goes on working and is not listed.
void addOlderName(Arguments& command, const std::string& older, const std::string& name, std::string& value);

// Ends a command's help with commands that work, and the exit codes.
void addExamples(Arguments& command, const std::vector<std::string>& lines);

// What a command is, for addCommand.
struct CommandText {
    const char *name, *summary;
    std::string output; // what -o writes; empty: nothing
    std::vector<std::string> examples;
    bool needsOutput = false; // it does nothing without -o
};

// Adds a command whose options are CommonOptions and more: `declare` adds the others, `run` does what they ask for.
template<class Options>
void addCommand(Arguments& parent, const CommandText& text, void (*declare)(Arguments&, Options&),
                Status (*run)(const Options&))
{
    Arguments command = parent.command(text.name, text.summary);
    const auto options = std::make_shared<Options>();
    addCommonOptions(command, *options, text.output);
    if (text.needsOutput)
        command.find("--output").needed();
    declare(command, *options);
    addExamples(command, text.examples);
    command.does([options, run] { return withThreads(options->threads, [&] { return run(*options); }); });
}

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

// A file that will be written.
struct PlannedOutput {
    std::string option; // that asked for it, for messages
    std::filesystem::path file;
    bool makesFolder = false; // its folder will be made
};

// The files of these names in a folder that an option names.
std::vector<PlannedOutput> plannedIn(const std::string& option, const std::filesystem::path& folder,
                                     const std::vector<std::string>& names);

// Plans each (see planOutput) and looks whether it can come to be there (see checkWritable); empty names are left out.
// Returns a sentence about each folder in which a killed run left unfinished files. Errors: those of the two.
Result<std::vector<std::string>> planOutputs(std::vector<PlannedOutput> files);

// What every command calls before it reads anything: says what it will write, --json included; empty names are left
// out. From here on no output may be a file that is read or another output, unless --overwrite was given. Warns of
// what a killed run left in the folders. Errors: ErrorKind::usage for two outputs in one place; ErrorKind::output
// where a file cannot be written.
Status beginOutputs(const CommonOptions& options, std::vector<PlannedOutput> files);

// Prints on standard output. It does not fail: the first error is kept for flushOutput.
void print(const std::string& text);

// Whether all that was printed has arrived, or its reader has closed the pipe and wants no more. Errors:
// ErrorKind::output.
Status flushOutput();

// Writes the report where --json says, with its format and version (docs/reference/json.md); nothing if it was not
// asked for. It has the member "command".
Status writeReport(const CommonOptions& options, const Json& report);

// Prints a line, its control characters escaped, on standard output unless --quiet was given or the report goes there.
void say(const CommonOptions& options, const std::string& line);

// The same of a text of several lines, each by itself: say escapes line breaks.
void sayLines(const CommonOptions& options, const std::string& text);

// Prints "cotan: warning: LINE" on standard error unless --quiet was given.
void warn(const CommonOptions& options, const std::string& line);

// The same, formatted.
template<class First, class... Others>
void say(const CommonOptions& options, fmt::format_string<First, Others...> text, First&& first, Others&&... others)
{
    say(options, fmt::format(text, std::forward<First>(first), std::forward<Others>(others)...));
}
template<class First, class... Others>
void warn(const CommonOptions& options, fmt::format_string<First, Others...> text, First&& first, Others&&... others)
{
    warn(options, fmt::format(text, std::forward<First>(first), std::forward<Others>(others)...));
}

// Runs work(progress) under a line for so many steps; 0: nobody knows how many.
template<class Work>
auto withProgress(const CommonOptions& options, std::size_t steps, std::string what, const Work& work)
{
    ProgressLine line(options.quiet, steps, std::move(what));
    return work(line.within());
}

// The same for what a renderer draws in work(). It tells nobody afterwards: the line is gone.
template<class Work>
auto drawWithProgress(const CommonOptions& options, Renderer& renderer, std::size_t steps, std::string what,
                      const Work& work)
{
    return withProgress(options, steps, std::move(what), [&](Progress progress) {
        renderer.progress = std::move(progress);
        auto done = work();
        renderer.progress = nullptr;
        return done;
    });
}

// Warns where a map goes into a format that does not keep it.
void warnIfLossy(const CommonOptions& options, const std::filesystem::path& map);

} // namespace cotan::app
