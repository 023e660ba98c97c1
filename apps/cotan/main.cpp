// The command line: a table of commands, and exit codes.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <span>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "command_words.hpp"
#include "commands.hpp"
#include "cotan/files/sandbox.hpp"
#include "cotan/model/reader.hpp"
#include "cotan/files/account.hpp"
#include "cotan/files/interrupt.hpp"

namespace {

// Not fmt::print, which throws where standard error cannot be written.
int fail(const cotan::Error& error)
{
    std::fputs(fmt::format("cotan: error: {}\n", error.message).c_str(), stderr);
    return int(error.kind);
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

int runCommandLine(int argc, char** argv)
{
    using namespace cotan::app;
    CLI::App app("Normal mapping without precomputed tangents.", "cotan");
    app.set_version_flag("--version", std::string("cotan ") + COTAN_VERSION);
    app.require_subcommand(1);
    addExamples(app, {"cotan render model.glb -o picture.png", "cotan render --help"});
    std::vector<Command> commands;
    constexpr Command (*kCommands[])(CLI::App&) = {
        addRenderCommand,
        addCompareCommand,
        addFiguresCommand,
        addMapCommand,
        addAccuracyCommand,
        addBakeCommand,
        addTangentsCommand,
        addLintCommand,
        addConvertCommand,
        addShaderCommand,
        addCostCommand,
    };
    for (auto add : kCommands)
        commands.push_back(add(app));
    if (cotan::Status known = checkCommandWords(app, std::span(argv, std::size_t(argc)).subspan(std::min(argc, 1))); !known)
        return fail(known.error());
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) { // help or version
            std::ostringstream text;
            app.exit(e, text, text);
            print(text.str());
            return finish(cotan::Done{});
        }
        std::string message = e.what();
        for (char& c : message)
            c = c == '\n' ? ' ' : c;
        return fail(cotan::usageError(message + " (see --help)"));
    }
    for (const Command& command : commands)
        if (command.app->parsed())
            return finish(command.run());
    return int(cotan::ErrorKind::usage);
}

} // namespace

int main(int argc, char** argv)
{
    if (cotan::isReaderProcess(argc, argv))
        return cotan::runReaderProcess();
    cotan::sandboxByDefault({.program = "/proc/self/exe"});
    cotan::removePartsOnInterrupt();
    try {
        return runCommandLine(argc, argv);
    } catch (const std::bad_alloc&) {
        return fail({cotan::ErrorKind::unavailable, "not enough memory"});
    } catch (const std::exception& e) {
        return fail({cotan::ErrorKind::unavailable, std::string("unexpected: ") + e.what()});
    }
}
