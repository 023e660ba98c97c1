#include "map_command.hpp"

#include <memory>
#include <vector>

#include "commands.hpp"
#include "cotan/parallel/loops.hpp"

namespace cotan::app {

Status withThreads(int threads, const std::function<Status()>& work)
{
    Status status = Done{};
    cotan::withThreads(threads, [&] { status = work(); });
    return status;
}

Command addMapCommand(CLI::App& app)
{
    CLI::App* map = app.add_subcommand("map", "normal-map files: what they are, and from one form to another");
    map->require_subcommand(1);
    addExamples(*map, {"cotan map detect rocks.png", "cotan map convert rocks.png --from directx --to gltf -o out.png"});
    auto commands = std::make_shared<std::vector<Command>>();
    for (auto add : {addMapInfo, addMapDetect, addMapConvert, addMapDiff, addMapFromHeight, addMapToHeight,
                     addMapBlend, addMapMips})
        commands->push_back(add(*map));
    return {map, [commands]() -> Status {
                for (const Command& command : *commands)
                    if (command.app->parsed())
                        return command.run();
                return usageError("map: expected a subcommand; found none");
            }};
}

} // namespace cotan::app
