#include "common.hpp"

#include <cerrno>
#include <cstdio>
#include <set>
#include <sstream>

#include "core/try.hpp"
#include "files/bytes.hpp"
#include "image/format_table.hpp"
#include "terminal/file_words.hpp"
#include "terminal/printable.hpp"

namespace cotan::app {

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 usage, 2 bad input, 3 not available here, 4 cannot write, 5 over a limit.";

int printErrno = 0; // errno of the first print that failed

} // namespace

void addCommonOptions(Arguments& command, CommonOptions& options, const std::string& outputHelp)
{
    command.group(HelpGroup::output);
    Argument output = command.option("-o,--output", options.output, outputHelp).in("PATH").writes().main();
    if (outputHelp.empty())
        output.unlisted().refused(
            [name = command.name()] { return name + " writes no files but --json FILE; leave out -o"; });
    command.option("--json", options.json, "write a machine-readable report; - is standard output").in("FILE").writes();
    command.flag("--overwrite", options.overwrite, "let outputs replace input files");
    command.group(HelpGroup::general);
    command.flag("--quiet", options.quiet, "print no notes or warnings");
    command.option("--threads", options.threads, "threads to use; 0 means all cores").within(0, 1024).in("N");
}

void addOlderName(Arguments& command, const std::string& older, const std::string& name, std::string& value)
{
    // CLI11's `excludes` would list the old option in the help of the new one, without a name.
    command.option(older, value, "").unlisted().refused([newer = command.find(name), older, name] {
        return newer.count() > 0 ? older + " is another name for " + name + ": expected one of them, found both" : "";
    });
}

void addExamples(Arguments& command, const std::vector<std::string>& lines) { command.examples(lines, kExitCodes); }

std::vector<PlannedOutput> plannedIn(const std::string& option, const std::filesystem::path& folder,
                                     const std::vector<std::string>& names)
{
    std::vector<PlannedOutput> files;
    for (const std::string& name : names)
        files.push_back({option, folder / name, /*makesFolder*/ true});
    return files;
}

Result<std::vector<std::string>> planOutputs(std::vector<PlannedOutput> files)
{
    std::erase_if(files, [](const PlannedOutput& output) { return output.file.empty(); });
    for (const PlannedOutput& output : files)
        COTAN_CHECK(planOutput(output.option, output.file));
    std::set<std::filesystem::path> folders, made;
    for (const PlannedOutput& output : files) {
        const std::filesystem::path folder = folderOf(output.file).lexically_normal();
        folders.insert(folder);
        if (output.makesFolder)
            made.insert(folder);
        COTAN_CHECK(checkWritable(output.file, made.contains(folder)));
    }
    std::vector<std::string> left;
    for (const std::filesystem::path& folder : folders)
        if (const auto parts = leftParts(folder); !parts.empty())
            left.push_back(
                fmt::format("{}: {} unfinished file{} of a run that was killed, {}{}; delete what is not needed",
                            folder.string(), parts.size(), parts.size() > 1 ? "s" : "",
                            parts.front().filename().string(), parts.size() > 1 ? " and others" : ""));
    return left;
}

Status beginOutputs(const CommonOptions& options, std::vector<PlannedOutput> files, bool again)
{
    guardInputs(options.overwrite, again);
    if (options.json != "-")
        files.push_back({"--json", options.json});
    COTAN_TRY(left, planOutputs(std::move(files)));
    for (const std::string& line : *left)
        warn(options, line);
    return Done{};
}

void print(const std::string& text)
{
    if (printErrno == 0 && std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
        printErrno = errno;
}

Status flushOutput()
{
    if (printErrno == 0 && std::fflush(stdout) != 0)
        printErrno = errno;
    if (printErrno == EPIPE) // the reader, such as `head`, has read enough
        return Done{};
    if (printErrno != 0)
        return outputError("standard output: cannot write: " + reasonOf(printErrno));
    return Done{};
}

Status writeReport(const CommonOptions& options, const Json& report)
{
    if (options.json.empty())
        return Done{};
    const std::string text = asTyped(toText(versioned(report)), /*json*/ true);
    if (options.json == "-") {
        print(text);
        return flushOutput();
    }
    return writeFileWhole(options.json, text);
}

void say(const CommonOptions& options, const std::string& line)
{
    if (options.quiet || options.json == "-")
        return;
    wipeProgress();
    print(printable(asTyped(line)) + "\n");
}

void sayLines(const CommonOptions& options, const std::string& text)
{
    std::istringstream lines(text + "\n");
    for (std::string line; std::getline(lines, line);)
        say(options, line);
}

void warn(const CommonOptions& options, const std::string& line)
{
    if (options.quiet)
        return;
    wipeProgress();
    std::fputs(fmt::format("cotan: warning: {}\n", printable(asTyped(line))).c_str(), stderr);
}

void warnIfLossy(const CommonOptions& options, const std::filesystem::path& map)
{
    if (imageFormatHas(map, &ImageFormat::lossy))
        warn(options, "{} adds errors of degrees to normal maps; PNG and TIFF are lossless", imageFormatOf(map)->name);
}

} // namespace cotan::app
