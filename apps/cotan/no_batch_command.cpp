// `cotan batch` where there is no xxHash to tell files apart: it takes any words and says what is missing.
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
