// Shared by all commands: options, reports and messages.
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
#include "files/file_registry.hpp"
#include "files/json.hpp"
#include "files/output.hpp"
#include "terminal/arguments.hpp"
#include "terminal/progress_line.hpp"

namespace cotan::app {

struct CommonOptions {
    std::filesystem::path output;
    std::string json; // a file, "-" for standard output, empty for none
    bool quiet = false;
    int threads = 0;        // 0: all cores
    bool overwrite = false; // allows replacing inputs, and one output by another
};

// Adds -o/--output, --json, --quiet, --threads and --overwrite to a command. An empty outputHelp means that the command
// writes only its report; -o is then unlisted and refused.
void addCommonOptions(Arguments& command, CommonOptions& options, const std::string& outputHelp);

// Adds an older name of the option `name`, which still works but is not listed.
void addOlderName(Arguments& command, const std::string& older, const std::string& name, std::string& value);

// Ends a command's help with example commands and the exit codes.
void addExamples(Arguments& command, const std::vector<std::string>& lines);

// Describes a command for addCommand.
struct CommandText {
    const char *name, *summary;
    std::string output; // what -o writes; empty: nothing
    std::vector<std::string> examples;
    bool needsOutput = false; // -o is required
};

// Adds a command with options derived from CommonOptions: `declare` adds the others, `run` runs the command.
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
    command.does([options, run] {
        guardInputs(options->overwrite); // also if the command forgets beginOutputs
        return withThreads(options->threads, [&] { return run(*options); });
    });
}

// Measures the seconds since its construction or the last call.
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
    std::string option; // that names the file, for messages
    std::filesystem::path file;
    bool makesFolder = false; // a missing folder will be created
};

// Files with these names in a folder that an option names.
std::vector<PlannedOutput> plannedIn(const std::string& option, const std::filesystem::path& folder,
                                     const std::vector<std::string>& names);

// Calls planOutput and checkWritable for each file; empty names are skipped. Returns a sentence about each folder with
// unfinished files of a killed run. Errors: those of the two functions.
Result<std::vector<std::string>> planOutputs(std::vector<PlannedOutput> files);

// Every command calls this before it reads anything. Registers the output files, including --json; empty names are
// skipped. From here on no output may be an input file or another output, unless --overwrite was given. again: as for
// guardInputs. Warns of unfinished files of a killed run. Errors: ErrorKind::usage for two outputs with the same path;
// ErrorKind::output if a file cannot be written.
Status beginOutputs(const CommonOptions& options, std::vector<PlannedOutput> files, bool again = false);

// Prints on standard output. Does not fail: the first error is kept for flushOutput.
void print(const std::string& text);

// Flushes standard output. A reader that has closed the pipe is no error. Errors: ErrorKind::output if anything printed
// was lost.
Status flushOutput();

// Writes the report to --json, with its format and version (docs/reference/json.md); does nothing without --json. The
// report has the member "command".
Status writeReport(const CommonOptions& options, const Json& report);

// Prints a line on standard output, with control characters escaped, unless --quiet was given or the report goes there.
void say(const CommonOptions& options, const std::string& line);

// Prints a text of several lines by say, which would escape the line breaks.
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

// Runs work(progress) while showing a progress line with `steps` steps; 0: their number is unknown.
template<class Work>
auto withProgress(const CommonOptions& options, std::size_t steps, std::string what, const Work& work)
{
    ProgressLine line(options.quiet, steps, std::move(what));
    return work(line.within());
}

// The same, with the progress of `renderer` during work(). The renderer is detached from the line afterwards.
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

// Warns if the format of a normal map is lossy.
void warnIfLossy(const CommonOptions& options, const std::filesystem::path& map);

} // namespace cotan::app
