// `cotan batch` in builds without xxHash, which detects changed files: accepts any words and reports what is missing.
#include "commands.hpp"
#include "core/not_built.hpp"

namespace cotan::app {

void addBatchCommand(Arguments& tool)
{
    Arguments command = tool.command("batch", "Run many commands. Not in this build: needs xxHash.");
    command.takesAnything();
    command.does([]() -> Status { return notBuiltWith("xxHash", "libxxhash-dev"); });
}

} // namespace cotan::app
