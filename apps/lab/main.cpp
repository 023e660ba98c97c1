// cotan-lab implements `cotan accuracy`, `figures` and `cost`. The tool starts it with its own arguments, so it calls
// itself cotan in messages.
#include "common.hpp"
#include "lab.hpp"
#include "program.hpp"

namespace {

int runCommandLine(std::vector<std::string> words)
{
    using namespace cotan::app;
    if (const std::optional<int> code = runCostChild(words))
        return *code;
    cotan::app::Arguments tool("cotan", "Normal mapping without precomputed tangents: accuracy, figures, costs.",
                               "cotan " COTAN_VERSION);
    addCostCommand(tool, runCost);
    addAccuracyCommand(tool, runAccuracy);
    addFiguresCommand(tool, runFigures);
    return finish(tool.run(std::move(words), print));
}

} // namespace

int main(int argc, char** argv) { return cotan::app::runProgram(argc, argv, runCommandLine); }
