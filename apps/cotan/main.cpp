// The command line and its exit codes.
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "files/output.hpp"
#include "help/help_files.hpp"
#include "lab_options.hpp"
#include "program.hpp"
#include "view_command.hpp"

#ifndef COTAN_LEFT_OUT // a sentence on what this build lacks, for a build that lacks anything
#define COTAN_LEFT_OUT ""
#endif

namespace {

using cotan::app::finish;

// Writes manual pages and shell completions to a folder laid out like share/, for the build (CMakeLists.txt).
cotan::Status writeHelpFiles(const cotan::app::Arguments& tool, const std::filesystem::path& folder)
{
    for (const cotan::app::HelpFile& file : cotan::app::helpFiles(tool.describe(), COTAN_VERSION, COTAN_REPOSITORY)) {
        std::error_code failed; // if set, writing the file fails as well
        std::filesystem::create_directories((folder / file.path).parent_path(), failed);
        if (cotan::Status written = cotan::writeFileWhole(folder / file.path, file.text); !written)
            return written;
    }
    return cotan::Done{};
}

// Arguments itself parses "help render" as "render --help"; this entry is for the help and completion only.
void addHelpCommand(cotan::app::Arguments& tool)
{
    std::vector<std::string> names;
    for (const cotan::app::CommandHelp& command : tool.describe().commands)
        names.push_back(command.name);
    cotan::app::Arguments command = tool.command("help", "Show the options of a command.");
    const auto words = std::make_shared<std::vector<std::string>>();
    command.option("COMMAND", *words, "command, such as render, or map convert").offers(names);
    cotan::app::addExamples(command, {"cotan help render", "cotan help map convert"});
    command.does([words] { return cotan::Status(cotan::Done{}); });
}

// Accuracy, figures and costs belong to another program, so that users who only bake need not install it.
template<class Options> cotan::Status runInLab(const Options&) { return cotan::app::startLab(); }

// Grouped by task; the order is that of the help.
void addCommands(cotan::app::Arguments& tool)
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
    tool.heading("Use in an engine");
    addShaderCommand(tool);
    addCostCommand(tool, runInLab<CostCommandOptions>);
    tool.heading("Batches and measurements");
    addBatchCommand(tool);
    addAccuracyCommand(tool, runInLab<AccuracyCommandOptions>);
    addFiguresCommand(tool, runInLab<FiguresCommandOptions>);
    tool.heading("Help");
    addHelpCommand(tool);
}

// A file that was opened with the program, or dropped on it, and nothing else: the window shows it.
void showOpened(std::vector<std::string>& words)
{
    std::error_code failed;
    const std::filesystem::path file = words.size() == 1 ? words[0] : "";
    if (file.has_extension() && std::filesystem::is_regular_file(file, failed))
        words.insert(words.begin(), "view");
}

int runCommandLine(std::vector<std::string> words)
{
    using namespace cotan::app;
    cotan::app::Arguments tool("cotan", "Normal mapping without precomputed tangents." COTAN_LEFT_OUT,
                               "cotan " COTAN_VERSION COTAN_LEFT_OUT);
    addExamples(tool, {"cotan render model.glb -o picture.png", "cotan help render"});
    addCommands(tool);
    if (words.size() == 2 && words[0] == "--help-files")
        return finish(writeHelpFiles(tool, words[1]));
    showOpened(words);
    return finish(tool.run(std::move(words), print));
}

} // namespace

int main(int argc, char** argv) { return cotan::app::runProgram(argc, argv, runCommandLine); }
