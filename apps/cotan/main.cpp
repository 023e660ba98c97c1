// The command line and its exit codes.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#ifdef COTAN_WITH_BATCH
#include "cotan/batch/child.hpp"
#endif
#include "cotan/files/account.hpp"
#include "cotan/files/interrupt.hpp"
#include "cotan/files/output.hpp"
#include "cotan/files/sandbox.hpp"
#include "cotan/model/reader.hpp"
#include "cotan/terminal/help_files.hpp"
#include "cotan/terminal/printable.hpp"
#include "view_command.hpp"

namespace {

// Not fmt::print, which throws where standard error cannot be written.
int fail(const cotan::Error& error)
{
    std::fputs(fmt::format("cotan: error: {}\n", cotan::printable(error.message)).c_str(), stderr);
    return int(error.kind);
}

// The manual's pages and the completion of shells, into a folder as share/ has them. For the build: see CMakeLists.txt.
cotan::Status writeHelpFiles(const cotan::Arguments& tool, const std::filesystem::path& folder)
{
    for (const cotan::HelpFile& file : cotan::helpFiles(tool.describe(), COTAN_VERSION)) {
        std::error_code failed; // the file then cannot be written, either
        std::filesystem::create_directories((folder / file.path).parent_path(), failed);
        if (cotan::Status written = cotan::writeFileWhole(folder / file.path, file.text); !written)
            return written;
    }
    return cotan::Done{};
}

// The exit code of a command, once what it printed has arrived.
int finish(const cotan::Status& status)
{
    if (const auto refused = cotan::refusal(); refused && !status)
        return fail(*refused); // a reader may have put it in other words
    if (!status)
        return fail(status.error());
    const cotan::Status printed = cotan::app::flushOutput();
    return printed ? 0 : fail(printed.error());
}

// Arguments itself takes "help render" for "render --help"; this is what the help and completion have of it.
void addHelpCommand(cotan::Arguments& tool)
{
    std::vector<std::string> names;
    for (const cotan::CommandHelp& command : tool.describe().commands)
        names.push_back(command.name);
    cotan::Arguments command = tool.command("help", "Show the options of a command.");
    const auto words = std::make_shared<std::vector<std::string>>();
    command.option("COMMAND", *words, "command, such as render, or map convert").offers(names);
    cotan::app::addExamples(command, {"cotan help render", "cotan help map convert"});
    command.does([words] { return cotan::Status(cotan::Done{}); });
}

// By what somebody wants to do; the order here is that of the help.
void addCommands(cotan::Arguments& tool)
{
    using namespace cotan::app;
    tool.heading("Look at models");
    addViewCommand(tool);
    addRenderCommand(tool);
    addCompareCommand(tool);
    tool.heading("Check and repair");
    addLintCommand(tool);
    addMapCommand(tool);
    tool.heading("Make maps and models");
    addBakeCommand(tool);
    addConvertCommand(tool);
    addTangentsCommand(tool);
    tool.heading("Put it into an engine");
    addShaderCommand(tool);
    addCostCommand(tool);
    tool.heading("Many files, and proofs");
    addBatchCommand(tool);
    addAccuracyCommand(tool);
    addFiguresCommand(tool);
    tool.heading("Help");
    addHelpCommand(tool);
}

int runCommandLine(std::vector<std::string> words)
{
    using namespace cotan::app;
    cotan::Arguments tool("cotan", "Normal mapping without precomputed tangents.", "cotan " COTAN_VERSION);
    addExamples(tool, {"cotan render model.glb -o picture.png", "cotan help render"});
    addCommands(tool);
    if (words.size() == 2 && words[0] == "--help-files")
        return finish(writeHelpFiles(tool, words[1]));
    return finish(tool.run(std::move(words), print));
}

} // namespace

int main(int argc, char** argv)
{
    if (cotan::isReaderProcess(argc, argv))
        return cotan::runReaderProcess();
    cotan::sandboxByDefault({.program = "/proc/self/exe"});
    cotan::removePartsOnInterrupt();
    try {
#ifdef COTAN_WITH_BATCH
        if (cotan::isJobProcess(argc, argv))
            return cotan::runJobProcess(argc, argv, runCommandLine);
#endif
        return runCommandLine({argv + std::min(argc, 1), argv + argc});
    } catch (const std::bad_alloc&) {
        return fail({cotan::ErrorKind::unavailable, "not enough memory"});
    } catch (const std::system_error& e) { // of threads, too
        return fail({cotan::ErrorKind::unavailable,
                     e.code() == std::errc::resource_unavailable_try_again
                         ? "no more threads or processes are allowed here (ulimit -u)"
                         : std::string("unexpected: ") + e.what()});
    } catch (const std::exception& e) {
        return fail({cotan::ErrorKind::unavailable, std::string("unexpected: ") + e.what()});
    }
}
