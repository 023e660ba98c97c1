// `cotan map from-height`: a normal map from a height picture.
#include "map_command.hpp"

#include <atomic>
#include <memory>

#include <fmt/format.h>

#include "map_height.hpp"
#include "map_options.hpp"
#include "map_stream.hpp"

namespace cotan::app {

namespace {

struct MapFromHeightCommandOptions {
    MapOptions map;
    std::string file, convention = "gltf", bits = "auto", size, kernel = "central", wrap = "repeat";
    double range = 0, strength = 1;
    bool dither = false;
};

std::optional<maps::Wrap> wrapFromName(const std::string& name)
{
    using enum maps::Wrap;
    for (const auto& [word, wrap] : {std::pair("repeat", repeat), {"clamp", clamp}, {"mirror", mirror}})
        if (name == word)
            return wrap;
    return std::nullopt;
}

// Slope per unit of stored height and texel, across and along.
Result<std::pair<double, double>> scaleOf(const MapFromHeightCommandOptions& o, int width, int height)
{
    if (o.size.empty() != (o.range == 0))
        return usageError("from-height: expected --metres and --range together, both in metres; found one of them");
    if (o.size.empty()) {
        const double texels = o.strength / 100 * width;
        return std::pair(texels, texels);
    }
    const auto metres = parseMetres(o.size, width, height);
    if (!metres)
        return metres.error();
    return std::pair(o.range * width / metres->first, o.range * height / metres->second);
}

Status run(const MapFromHeightCommandOptions& o)
{
    if (Status given = needOutput(o.map, "from-height"); !given)
        return given;
    const auto to = parseConvention(o.convention, "--to");
    if (!to)
        return to.error();
    const auto kernel = kernelFromName(o.kernel);
    if (!kernel || *kernel == maps::Kernel::spectral)
        return usageError(fmt::format("--kernel: expected forward, central, sobel or scharr; found '{}'", o.kernel));
    const auto wrap = wrapFromName(o.wrap);
    if (!wrap)
        return usageError(fmt::format("--wrap: expected repeat, clamp or mirror; found '{}'", o.wrap));
    const auto reader = openMapRows(o.file, o.map);
    if (!reader)
        return reader.error();
    RowReader& in = **reader;
    const auto scale = scaleOf(o, in.width, in.height);
    if (!scale)
        return scale.error();
    const auto bits = parseBits(o.bits, in.type, o.map.common.output);
    if (!bits)
        return bits.error();
    warnIfLossy(o.map.common, o.map.common.output);
    if (Status fits = checkSigned(*to, *bits, o.map.common.output); !fits)
        return fits;
    const auto writer = createRows(o.map.common.output, {in.width, in.height, bits->type, false, bits->half}, o.map.common.threads);
    if (!writer)
        return writer.error();
    // What repeats needs its last row first.
    const auto lastRow = *wrap == maps::Wrap::repeat ? lastRowOf(o.file, o.map) : Result<Image>(Image{});
    if (!lastRow)
        return lastRow.error();
    const maps::FromHeightSettings settings{.kernel = *kernel, .wrap = *wrap, .scaleX = scale->first,
                                            .scaleY = scale->second, .to = *to, .type = bits->type,
                                            .dither = o.dither, .bordered = true};
    std::atomic<std::size_t> invalid = 0;
    const auto work = [&](std::span<Image> strips, int firstRow) -> std::function<Status()> {
        maps::FromHeightSettings here = settings;
        here.firstRow = firstRow;
        std::size_t found = 0;
        Image out = maps::normalsFromHeight(strips[0], here, found);
        invalid += found;
        return [&writer, out = std::move(out)] { return (*writer)->write(out); };
    };
    RowReader* const readers[] = {&in};
    const Status done = streamStrips(o.map.common, readers, {Border::both, *wrap, &*lastRow}, work);
    if (!done)
        return done;
    if (Status finished = (*writer)->finish(); !finished)
        return finished;
    if (invalid > 0)
        warn(o.map.common, fmt::format("{}: {} texels have no finite height beside them; written as flat", o.file, invalid.load()));
    if (in.type == PixelType::unorm8)
        warn(o.map.common, fmt::format("{}: 8-bit heights make steps; one step is a slope of {:.3g} here", o.file,
                                       scale->first / 255 / 2));
    say(o.map.common, fmt::format("{}: {} x {}, {}: {}", o.map.common.output.string(), in.width, in.height,
                                  bitsName(*bits), describe(*to)));
    return writeReport(o.map.common, {{"command", "map from-height"}, {"file", o.file},
                                      {"output", o.map.common.output.string()}, {"to", describe(*to)},
                                      {"slope_per_unit_and_texel", {scale->first, scale->second}},
                                      {"bits", bitsName(*bits)}, {"invalid", invalid.load()}});
}

} // namespace

Command addMapFromHeight(CLI::App& map)
{
    auto options = std::make_shared<MapFromHeightCommandOptions>();
    CLI::App* command = map.add_subcommand("from-height", "a normal map from a height picture");
    addMapOptions(*command, options->map, "the normal map");
    command->add_option("FILE", options->file, "heights: grey, or the red channel")->required();
    command->add_option("--to", options->convention, "how to store it: " + conventionWords())
        ->type_name("WORDS")->capture_default_str();
    command->add_option("--metres", options->size, "metres that the picture covers; with --range")->type_name("W[xH]");
    addOlderName(*command, "--size", "--metres", options->size);
    command->add_option("--range", options->range, "metres from black to white (floats: metres per unit); negative: white is low")->type_name("METRES");
    command->add_option("--strength", options->strength,
                        "without metres: white is this many hundredths of the picture's width above black")->capture_default_str();
    command->add_option("--kernel", options->kernel, "forward, central, sobel or scharr")->capture_default_str();
    command->add_option("--wrap", options->wrap, "at the borders: repeat, clamp or mirror")->capture_default_str();
    command->add_option("--bits", options->bits, "auto (as the heights), 8, 16, half (.exr) or float")->capture_default_str();
    command->add_flag("--dither", options->dither, "noise of half a step before rounding, the same on every run");
    addExamples(*command, {"cotan map from-height height.png --metres 2 --range 0.05 -o normal.png",
                           "cotan map from-height height.png --strength 2 --wrap clamp -o normal.png"});
    return {command, [options] {
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace cotan::app
