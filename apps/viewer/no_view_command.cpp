// `cotan view` where a window cannot be opened: accepts any words.
#include "core/not_built.hpp"
#include "view_command.hpp"

namespace cotan::app {

void addViewCommand(Arguments& tool)
{
    Arguments command = tool.command("view", "Show a model in a window. Not in this build.");
    command.takesAnything();
    command.does([]() -> Status { return notBuiltWith("the window", ""); });
}

} // namespace cotan::app
