// `cotan map convert`: the same directions, stored another way.
#include "map_command.hpp"

#include <atomic>
#include <memory>

#include <fmt/format.h>

#include "cotan/maps/recode.hpp"
#include "map_options.hpp"
#include "map_stream.hpp"

namespace cotan::app {

namespace {

struct Options {
    MapOptions map;
    std::string file, from, to, bits = "auto";
    double strength = 1;
    bool normalise = false, dither = false;
};

Status run(const Options& o)
{
    const auto from = parseConvention(o.from, "--from");
    const auto to = parseConvention(o.to, "--to");
    if (!from)
        return from.error();
    if (!to)
        return to.error();
    if (Status given = needOutput(o.map, "convert"); !given)
        return given;
    if (o.strength == 0)
        return usageError("--strength: expected a factor other than 0; found 0");
    const auto swizzle = swizzleOfFile(o.file, o.map, *from);
    if (!swizzle)
        return swizzle.error();
    const auto reader = openMapRows(o.file, o.map);
    if (!reader)
        return reader.error();
    RowReader& in = **reader;
    const auto bits = parseBits(o.bits, in.type, o.map.common.output);
    if (!bits)
        return bits.error();
    if (Status fits = checkSigned(*to, *bits, o.map.common.output); !fits)
        return fits;
    const bool alpha = in.alpha && from->channels == Channels::xyz && to->channels == Channels::xyz;
    const auto writer = createRows(o.map.common.output, {in.width, in.height, bits->type, alpha, bits->half}, o.map.common.threads);
    if (!writer)
        return writer.error();
    const maps::RecodeSettings settings{.from = *from, .to = *to, .type = bits->type, .strength = float(o.strength),
                                        .normalise = o.normalise, .dither = o.dither};
    std::atomic<std::size_t> invalid = 0, clamped = 0;
    const auto work = [&](std::span<Image> strips, int firstRow) -> std::function<Status()> {
        maps::unswizzle(strips[0], *swizzle);
        maps::RecodeSettings here = settings;
        here.firstRow = firstRow;
        maps::RecodeCounts found;
        Image out = maps::recode(strips[0], here, found);
        invalid += found.invalid;
        clamped += found.clamped;
        return [&writer, out = std::move(out)] { return (*writer)->write(out); };
    };
    RowReader* const readers[] = {&in};
    const Status done = streamStrips(o.map.common, readers, {}, work);
    if (!done)
        return done;
    if (Status finished = (*writer)->finish(); !finished)
        return finished;
    const maps::RecodeCounts counts{invalid, clamped};
    const std::string extension = o.map.common.output.extension().string();
    if (counts.invalid > 0)
        warn(o.map.common, fmt::format("{}: {} texels are no direction; written as flat", o.file, counts.invalid));
    if (counts.clamped > 0)
        warn(o.map.common, fmt::format("{}: {} texels are steeper than {} can hold; clamped", o.file, counts.clamped,
                                       describe(*to)));
    if (extension == ".jpg" || extension == ".jpeg")
        warn(o.map.common, "JPEG loses degrees on normal maps; PNG or TIFF keep them");
    say(o.map.common, fmt::format("{}: {} x {}, {}: {}", o.map.common.output.string(), in.width, in.height,
                                  bitsName(*bits), describe(*to)));
    return writeReport(o.map.common, {{"command", "map convert"}, {"file", o.file},
                                      {"output", o.map.common.output.string()}, {"from", describe(*from)},
                                      {"to", describe(*to)}, {"width", in.width}, {"height", in.height},
                                      {"bits", bitsName(*bits)}, {"invalid", counts.invalid},
                                      {"clamped", counts.clamped}});
}

} // namespace

Command addMapConvert(CLI::App& map)
{
    auto options = std::make_shared<Options>();
    CLI::App* command = map.add_subcommand("convert", "the same directions, stored another way");
    addMapOptions(*command, options->map, "the new map: .png .exr .tif .tga .jpg .hdr");
    command->add_option("FILE", options->file, "the map")->required();
    command->add_option("--from", options->from, "how it is stored: " + conventionWords())
        ->type_name("WORDS")->required();
    command->add_option("--to", options->to, "how to store it; the same words")->type_name("WORDS")->required();
    command->add_option("--bits", options->bits, "auto, 8, 16, half (.exr) or float")->capture_default_str();
    command->add_option("--strength", options->strength, "factor on the slopes; negative turns bumps into dents")
        ->capture_default_str();
    command->add_flag("--normalise", options->normalise,
                      "make every vector unit; otherwise three channels keep their lengths");
    command->add_flag("--dither", options->dither, "noise of half a step before rounding, the same on every run");
    return {command, [options] {
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace cotan::app
