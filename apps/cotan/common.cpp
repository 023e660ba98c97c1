#include "common.hpp"

#include <cerrno>
#include <cstdio>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "cotan/files/extension.hpp"
#include "cotan/files/account.hpp"
#include "cotan/files/output.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 usage, 2 bad input, 3 not available here, 4 cannot write, 5 over a limit.";

int printErrno = 0; // of the first print that failed

// What a killed run has left where this one writes.
void warnOfParts(const CommonOptions& options, const std::filesystem::path& folder)
{
    const auto parts = leftParts(folder);
    if (parts.empty())
        return;
    warn(options, fmt::format("{}: {} of a run that was killed, {}{}; delete what is not needed",
                              folder.string(), counted(parts.size(), "unfinished file"), parts.front().filename().string(),
                              parts.size() > 1 ? " and others" : ""));
}

} // namespace

void addCommonOptions(CLI::App& command, CommonOptions& options, const std::string& outputHelp)
{
    CLI::Option* output = command.add_option("-o,--output", options.output, outputHelp)->type_name("PATH");
    if (outputHelp.empty())
        output->group("")->each([&command](const std::string&) {
            throw CLI::ArgumentMismatch(command.get_name() + " writes no files but --json FILE; leave out -o");
        });
    command.add_option("--json", options.json, "machine-readable report; - is standard output")
        ->type_name("FILE");
    command.add_flag("--quiet", options.quiet, "no notes and warnings");
    command.add_option("--threads", options.threads, "threads to use; 0 means all cores")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command.add_flag("--overwrite", options.overwrite, "replace files that are read, too");
}

void addOlderName(CLI::App& command, const std::string& older, const std::string& name, std::string& value)
{
    // Not by `excludes`: the help would list it at the newer option, without a name.
    const CLI::Option* newer = command.get_option(name);
    command.add_option(older, value)->group("")->each([newer, older, name](const std::string&) {
        if (newer->count() > 0)
            throw CLI::ArgumentMismatch(older + " is another word for " + name + ": expected one of them, found both");
    });
}

void addExamples(CLI::App& command, const std::vector<std::string>& lines)
{
    std::string text = "Examples:\n";
    for (const std::string& line : lines)
        text += "  " + line + "\n";
    command.footer(text + "\n" + kExitCodes);
}

std::vector<PlannedOutput> plannedIn(const std::string& option, const std::filesystem::path& folder,
                                     const std::vector<std::string>& names)
{
    std::vector<PlannedOutput> files;
    for (const std::string& name : names)
        files.push_back({option, folder / name, /*makesFolder*/ true});
    return files;
}

Status planOutputs(const CommonOptions& options, const std::vector<PlannedOutput>& files)
{
    guardInputs(options.overwrite);
    std::vector<PlannedOutput> all = files;
    if (options.json != "-")
        all.push_back({"--json", options.json});
    std::erase_if(all, [](const PlannedOutput& output) { return output.file.empty(); });
    for (const PlannedOutput& output : all)
        if (Status planned = planOutput(output.option, output.file); !planned)
            return planned;
    std::set<std::filesystem::path> folders, made;
    for (const PlannedOutput& output : all) {
        const std::filesystem::path folder = (output.file.has_parent_path() ? output.file.parent_path() : ".").lexically_normal();
        folders.insert(folder);
        if (output.makesFolder)
            made.insert(folder);
        if (Status writable = checkWritable(output.file, made.contains(folder)); !writable)
            return writable;
    }
    for (const std::filesystem::path& folder : folders)
        warnOfParts(options, folder);
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
    if (printErrno != 0)
        return outputError("standard output: cannot write: " + reasonOf(printErrno));
    return Done{};
}

Status writeReport(const CommonOptions& options, const nlohmann::ordered_json& report)
{
    if (options.json.empty())
        return Done{};
    // Names in files need not be UTF-8; replace what is not rather than fail.
    const std::string text =
        report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    if (options.json == "-") {
        print(text);
        return flushOutput();
    }
    return writeFileWhole(options.json, text);
}

void say(const CommonOptions& options, const std::string& line)
{
    if (!options.quiet && options.json != "-")
    {
        wipeProgress();
        print(line + "\n");
    }
}

void warn(const CommonOptions& options, const std::string& line)
{
    if (!options.quiet)
    {
        wipeProgress();
        std::fputs(fmt::format("cotan: warning: {}\n", line).c_str(), stderr);
    }
}

void warnIfLossy(const CommonOptions& options, const std::filesystem::path& map)
{
    const std::string extension = lowerExtension(map);
    if (extension == ".jpg" || extension == ".jpeg")
        warn(options, "JPEG loses degrees on normal maps; PNG or TIFF keep them");
}

std::string counted(std::size_t number, const std::string& noun)
{
    return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

Status makeFolder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder))
        return outputError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                       error ? error.message() : "a file is in the way"));
    return Done{};
}

} // namespace cotan::app
