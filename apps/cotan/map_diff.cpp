// `cotan map diff`: compares two maps, in degrees.
#include <fmt/format.h>

#include "core/try.hpp"
#include "map_files/inspect.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

struct MapDiffCommandOptions : MapOptions {
    std::string a, b, mask, from = "gltf,exact", to;
};

Status run(const MapDiffCommandOptions& o)
{
    COTAN_CHECK(beginOutputs(o, {{"-o", o.output}}));
    COTAN_TRY(from, sourceOf(o, o.from, "--from", o.a));
    COTAN_TRY(to, o.to.empty() ? sourceOf(o, o.from, "--from", o.b) : sourceOf(o, o.to, "--to", o.b));
    const auto compared = onFiles(o, o.a, [&](const FileOptions& files) {
        return compareFiles(o.a, from->from, o.b, to->from, o.output, files, o.mask);
    });
    if (!compared)
        return compared.error();
    const std::vector<std::string> warnings = warned(o, compared->notes);
    say(o, "{} texels: {}", compared->angles.count, toText(compared->angles));
    if (compared->skipped > 0)
        say(o, "{} texels have no direction in one of the maps and were left out", compared->skipped);
    if (compared->masked > 0)
        say(o, "{} texels are black in {} and were left out", compared->masked, o.mask);
    if (!o.output.empty())
        say(o, "{}: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees and more", o.output.string());
    return writeReport(o,
                       {{"command", "map diff"},
                        {"a", o.a},
                        {"b", o.b},
                        {"convention_a", describe(compared->a)},
                        {"convention_b", describe(compared->b)},
                        {"skipped", compared->skipped},
                        {"masked", compared->masked},
                        {"angles", toJson(compared->angles)},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapDiffCommandOptions& o)
{
    addMemoryOption(a, o.memory);
    a.group(HelpGroup::input);
    a.option("A", o.a, "the first map").required().reads();
    a.option("B", o.b, "the second, of the same size").required().reads();
    addSource(a, "--from", o.from, "how A is stored");
    a.option("--to", o.to, "how B is stored; the same words as for A if not given").in("WORDS").offers(sourceWords());
    a.option("--mask", o.mask, "image of the same size, whose black texels are left out, such as that of bake --mask")
        .in("FILE")
        .reads();
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
