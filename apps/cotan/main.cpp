// The command line: a table of commands, and exit codes.
#include <cstdio>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "cotan/asset/sandbox.hpp"

namespace {

constexpr const char* kFooter =
    "Exit codes: 0 done, 1 usage, 2 bad input, 3 not available here, 4 cannot write, 5 over a limit.";

int fail(const cotan::Error& error)
{
    fmt::print(stderr, "cotan: error: {}\n", error.message);
    return int(error.kind);
}

int runCommandLine(int argc, char** argv)
{
    using namespace cotan::app;
    CLI::App app("Normal mapping without precomputed tangents.", "cotan");
    app.set_version_flag("--version", std::string("cotan ") + COTAN_VERSION);
    app.require_subcommand(1);
    app.footer(kFooter);
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
#ifdef COTAN_WITH_VULKAN
        addCostCommand,
#endif
    };
    for (auto add : kCommands) {
        commands.push_back(add(app));
        commands.back().app->footer(kFooter);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0)
            return app.exit(e); // help or version
        std::string message = e.what();
        for (char& c : message)
            c = c == '\n' ? ' ' : c;
        fmt::print(stderr, "cotan: error: {} (see --help)\n", message);
        return int(cotan::ErrorKind::usage);
    }
    for (const Command& command : commands)
        if (command.app->parsed()) {
            const cotan::Status status = command.run();
            return status ? 0 : fail(status.error());
        }
    return int(cotan::ErrorKind::usage);
}

} // namespace

int main(int argc, char** argv)
{
    if (cotan::isReaderProcess(argc, argv))
        return cotan::runReaderProcess();
    cotan::sandboxByDefault({.program = "/proc/self/exe"});
    try {
        return runCommandLine(argc, argv);
    } catch (const std::bad_alloc&) {
        return fail({cotan::ErrorKind::unavailable, "not enough memory"});
    } catch (const std::exception& e) {
        return fail({cotan::ErrorKind::unavailable, std::string("unexpected: ") + e.what()});
    }
}
