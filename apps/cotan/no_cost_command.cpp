// `cotan cost` where there is no Vulkan to ask: it takes any words and says what is missing.
#include "commands.hpp"
#include "cotan/not_built.hpp"

namespace cotan::app {

Command addCostCommand(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("cost", "what each frame costs; not in this build: needs Vulkan");
    command->allow_extras();
    return {command, []() -> Status { return notBuiltWith("Vulkan", "libvulkan-dev and glslang-tools"); }};
}

} // namespace cotan::app
