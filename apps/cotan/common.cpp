#include "common.hpp"

#include <cstdio>
#include <system_error>

#include <fmt/format.h>

#include "file_output.hpp"

namespace cotan::app {

void addCommonOptions(CLI::App& command, CommonOptions& options, const std::string& outputHelp)
{
    command.add_option("-o,--output", options.output, outputHelp)->type_name("PATH");
    command.add_option("--json", options.json, "machine-readable report; - is standard output")
        ->type_name("FILE");
    command.add_flag("--quiet", options.quiet, "no notes and warnings");
    command.add_option("--threads", options.threads, "threads to use; 0 means all cores")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

Status writeReport(const CommonOptions& options, const nlohmann::ordered_json& report)
{
    if (options.json.empty())
        return Done{};
    // Names in files need not be UTF-8; replace what is not rather than fail.
    const std::string text =
        report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    if (options.json == "-") {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
            return outputError("standard output: cannot write the report");
        return Done{};
    }
    return writeFileWhole(options.json, text);
}

void say(const CommonOptions& options, const std::string& line)
{
    if (!options.quiet && options.json != "-")
        fmt::print("{}\n", line);
}

void warn(const CommonOptions& options, const std::string& line)
{
    if (!options.quiet)
        fmt::print(stderr, "cotan: warning: {}\n", line);
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
