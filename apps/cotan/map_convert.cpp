// `cotan map convert`: the same directions, stored another way.
#include "map_command.hpp"

#include <memory>

#include <fmt/format.h>

#include "cotan/asset/image_file.hpp"
#include "cotan/maps/recode.hpp"
#include "map_options.hpp"

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
    const auto image = openMap(o.file, o.map, *from);
    if (!image)
        return image.error();
    const auto type = parseBits(o.bits, image->type, o.map.common.output);
    if (!type)
        return type.error();
    const std::string extension = o.map.common.output.extension().string();
    if (to->expansion == Expansion::signedValues && (*type != PixelType::float32 || extension == ".hdr"))
        return usageError(fmt::format("--to: signed values need a .exr or .tif of floats; found {}, {}",
                                      extension, bitsName(*type)));
    maps::RecodeSettings settings{.from = *from, .to = *to, .type = *type, .strength = float(o.strength),
                                  .normalise = o.normalise, .dither = o.dither};
    maps::RecodeCounts counts;
    const Image out = maps::recode(*image, settings, counts);
    if (Status written = writeImage(o.map.common.output, out); !written)
        return written;
    if (counts.invalid > 0)
        warn(o.map.common, fmt::format("{}: {} texels are no direction; written as flat", o.file, counts.invalid));
    if (counts.clamped > 0)
        warn(o.map.common, fmt::format("{}: {} texels are steeper than {} can hold; clamped", o.file, counts.clamped,
                                       describe(*to)));
    if (extension == ".jpg" || extension == ".jpeg")
        warn(o.map.common, "JPEG loses degrees on normal maps; PNG or TIFF keep them");
    say(o.map.common, fmt::format("{}: {} x {}, {}: {}", o.map.common.output.string(), out.width, out.height,
                                  bitsName(*type), describe(*to)));
    return writeReport(o.map.common, {{"command", "map convert"}, {"file", o.file},
                                      {"output", o.map.common.output.string()}, {"from", describe(*from)},
                                      {"to", describe(*to)}, {"width", out.width}, {"height", out.height},
                                      {"bits", bitsName(*type)}, {"invalid", counts.invalid},
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
    command->add_option("--bits", options->bits, "auto, 8, 16 or float")->capture_default_str();
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
