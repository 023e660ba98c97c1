// `cotan map diff`: two maps against each other, in degrees.
#include "map_command.hpp"

#include <memory>

#include <fmt/format.h>

#include "cotan/maps/compare.hpp"
#include "cotan/report/angles.hpp"
#include "map_options.hpp"
#include "map_stream.hpp"

namespace cotan::app {

namespace {

struct DiffOptions {
    MapOptions map;
    std::string a, b, conventionA = "gltf", conventionB;
};

Status run(const DiffOptions& o)
{
    if (Status planned = planOutputs(o.map.common, {{"-o", o.map.common.output}}); !planned)
        return planned;
    const auto conventionA = parseConvention(o.conventionA, "--from");
    if (!conventionA)
        return conventionA.error();
    const auto conventionB = parseConvention(o.conventionB.empty() ? o.conventionA : o.conventionB, "--to");
    if (!conventionB)
        return conventionB.error();
    const auto swizzleA = swizzleOfFile(o.a, o.map, *conventionA), swizzleB = swizzleOfFile(o.b, o.map, *conventionB);
    if (!swizzleA || !swizzleB)
        return swizzleA ? swizzleB.error() : swizzleA.error();
    const auto a = openMapRows(o.a, o.map), b = openMapRows(o.b, o.map);
    if (!a || !b)
        return a ? b.error() : a.error();
    RowReader* const readers[] = {a->get(), b->get()};
    const int width = readers[0]->width, height = readers[0]->height;
    if (width != readers[1]->width || height != readers[1]->height)
        return inputError(fmt::format("{}: expected {} x {} as {} has, found {} x {}", o.b, width, height, o.a,
                                      readers[1]->width, readers[1]->height));
    std::unique_ptr<RowWriter> heat;
    if (!o.map.common.output.empty()) {
        auto writer = createRows(o.map.common.output, {width, height, PixelType::unorm8, false, false}, o.map.common.threads);
        if (!writer)
            return writer.error();
        heat = *std::move(writer);
    }
    AngleHistogram angles;
    const auto work = [&](std::span<Image> strips, int) -> std::function<Status()> {
        maps::unswizzle(strips[0], *swizzleA);
        maps::unswizzle(strips[1], *swizzleB);
        auto degrees = maps::anglesBetween(strips[0], *conventionA, strips[1], *conventionB);
        Image picture = heat ? heatMap(degrees, width, strips[0].height) : Image{};
        return [&, degrees = std::move(degrees), picture = std::move(picture)]() -> Status {
            for (float d : degrees)
                angles.add(d);
            return heat ? heat->write(picture) : Status(Done{});
        };
    };
    if (Status done = streamStrips(o.map.common, readers, {}, work); !done)
        return done;
    const AngleStatistics s = angles.statistics();
    const std::size_t skipped = std::size_t(width) * std::size_t(height) - s.count;
    say(o.map.common, fmt::format("{} texels: {}", s.count, toText(s)));
    if (skipped > 0)
        say(o.map.common, fmt::format("{} texels are no direction in one of the two and were left out", skipped));
    if (heat) {
        if (Status written = heat->finish(); !written)
            return written;
        say(o.map.common, fmt::format("{}: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees and more",
                                      o.map.common.output.string()));
    }
    return writeReport(o.map.common, {{"command", "map diff"}, {"a", o.a}, {"b", o.b},
                                      {"convention_a", describe(*conventionA)},
                                      {"convention_b", describe(*conventionB)}, {"skipped", skipped},
                                      {"angles", cotan::toJson(s)}});
}

} // namespace

Command addMapDiff(CLI::App& map)
{
    auto options = std::make_shared<DiffOptions>();
    CLI::App* command = map.add_subcommand("diff", "two maps against each other, in degrees");
    addMapOptions(*command, options->map, "heat map");
    command->add_option("A", options->a, "the first map")->required();
    command->add_option("B", options->b, "the second, of the same size")->required();
    command->add_option("--from", options->conventionA, "how A is stored: " + conventionWords())
        ->type_name("WORDS")->capture_default_str();
    command->add_option("--to", options->conventionB, "how B is stored; as A if not given")->type_name("WORDS");
    addExamples(*command, {"cotan map diff rocks.png other.png",
                           "cotan map diff rocks.png other.png --from gltf --to directx -o heat.png"});
    return {command, [options] {
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace cotan::app
