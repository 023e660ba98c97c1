// `cotan map diff`: compares two maps, in degrees.
#include <optional>

#include <fmt/format.h>

#include "core/try.hpp"
#include "map_files/inspect.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

struct MapDiffCommandOptions : MapOptions {
    std::string second;
    StatedConvention from;
    std::optional<StatedConvention> to; // none: as `from`
};

Status run(const MapDiffCommandOptions& o)
{
    COTAN_CHECK(beginOutputs(o, {{"-o", o.output}}));
    const auto compared = onFiles(o, o.file, [&](const FileOptions& files) {
        return compareFiles(o.file, o.from, o.second, o.to.value_or(o.from), o.output, files);
    });
    if (!compared)
        return compared.error();
    const std::vector<std::string> warnings = warned(o, compared->notes);
    say(o, "{} texels: {}", compared->angles.count, toText(compared->angles));
    if (compared->skipped > 0)
        say(o, "{} texels have no direction in one of the maps and were left out", compared->skipped);
    if (!o.output.empty())
        say(o, "{}: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees and more", o.output.string());
    return writeReport(o,
                       {{"command", "map diff"},
                        {"a", o.file},
                        {"b", o.second},
                        {"convention_a", describe(compared->a)},
                        {"convention_b", describe(compared->b)},
                        {"skipped", compared->skipped},
                        {"angles", toJson(compared->angles)},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapDiffCommandOptions& o)
{
    addFile(a, o, "A", "the first map");
    a.option("B", o.second, "the second, of the same size").required().reads();
    addConvention(a, "--from", o.from, "gltf", "how A is stored: " + conventionWords());
    addConvention(a, "--to", o.to, "", "how B is stored; as A if not given");
}

} // namespace

void addMapDiff(Arguments& map)
{
    addCommand<MapDiffCommandOptions>(map,
                                      {"diff",
                                       "Measure the angle between two maps, in degrees.",
                                       "heat map of the angles",
                                       {"cotan map diff rocks.png other.png",
                                        "cotan map diff rocks.png other.png --from gltf --to directx -o heat.png"}},
                                      declare, run);
}

} // namespace cotan::app
