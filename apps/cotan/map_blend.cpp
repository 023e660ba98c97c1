// `cotan map blend`: a base and a detail as one map.
#include "map_command.hpp"

#include <atomic>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cotan/maps/blend.hpp"
#include "map_options.hpp"
#include "map_stream.hpp"

namespace cotan::app {

namespace {

struct MapBlendCommandOptions {
    MapOptions map;
    std::string base, detail, from = "gltf", detailFrom, to, mode = "reoriented", mask, tiles = "1", bits = "auto";
    double strength = 1;
    bool dither = false;
};

std::optional<maps::BlendMode> modeFromName(const std::string& name)
{
    using enum maps::BlendMode;
    for (const auto& [word, mode] : {std::pair("reoriented", reoriented), {"whiteout", whiteout}, {"udn", udn},
                                     {"slopes", slopes}, {"linear", linear}})
        if (name == word)
            return mode;
    return std::nullopt;
}

// "N" or "NxM", each 1..4096.
Result<std::pair<int, int>> parseTiles(const std::string& text)
{
    char* end = nullptr;
    const long x = std::strtol(text.c_str(), &end, 10);
    const long y = *end == 'x' ? std::strtol(end + 1, &end, 10) : x;
    if (text.empty() || *end != '\0' || x < 1 || y < 1 || x > 4096 || y > 4096)
        return usageError(fmt::format("--tiles: expected N or NxM, each 1 to 4096; found '{}'", text));
    return std::pair(int(x), int(y));
}

Status run(const MapBlendCommandOptions& o)
{
    if (Status given = needOutput(o.map, "blend"); !given)
        return given;
    maps::BlendSettings s;
    for (const auto& [words, option, target] : {std::tuple(o.from, "--from", &s.base),
                                                {o.detailFrom.empty() ? o.from : o.detailFrom, "--detail-from", &s.detail},
                                                {o.to.empty() ? o.from : o.to, "--to", &s.to}}) {
        const auto convention = parseConvention(words, option);
        if (!convention)
            return convention.error();
        *target = *convention;
    }
    const auto mode = modeFromName(o.mode);
    if (!mode)
        return usageError(fmt::format("--mode: expected reoriented, whiteout, udn, slopes or linear; found '{}'", o.mode));
    const auto tiles = parseTiles(o.tiles);
    if (!tiles)
        return tiles.error();
    const auto swizzle = swizzleOfFile(o.base, o.map, s.base);
    if (!swizzle)
        return swizzle.error();
    const auto base = openMapRows(o.base, o.map);
    if (!base)
        return base.error();
    RowReader& in = **base;
    const auto detail = openMap(o.detail, o.map, s.detail);
    if (!detail)
        return detail.error();
    const auto mask = o.mask.empty() ? Result<Image>(Image{}) : openMap(o.mask, o.map);
    if (!mask)
        return mask.error();
    const auto bits = parseBits(o.bits, in.type, o.map.common.output);
    if (!bits)
        return bits.error();
    warnIfLossy(o.map.common, o.map.common.output);
    if (Status fits = checkSigned(s.to, *bits, o.map.common.output); !fits)
        return fits;
    s.mode = *mode;
    s.strength = float(o.strength);
    s.tilesX = tiles->first, s.tilesY = tiles->second;
    s.mask = o.mask.empty() ? nullptr : &*mask;
    s.type = bits->type;
    s.dither = o.dither;
    s.pictureHeight = in.height;
    const auto writer = createRows(o.map.common.output, {in.width, in.height, bits->type, false, bits->half}, o.map.common.threads);
    if (!writer)
        return writer.error();
    std::atomic<std::size_t> invalid = 0;
    const auto work = [&](std::span<Image> strips, int firstRow) -> std::function<Status()> {
        maps::unswizzle(strips[0], *swizzle);
        maps::BlendSettings here = s;
        here.firstRow = firstRow;
        std::size_t found = 0;
        Image out = maps::blend(strips[0], *detail, here, found);
        invalid += found;
        return [&writer, out = std::move(out)] { return (*writer)->write(out); };
    };
    RowReader* const readers[] = {&in};
    if (Status done = streamStrips(o.map.common, readers, {}, work); !done)
        return done;
    if (Status finished = (*writer)->finish(); !finished)
        return finished;
    if (invalid > 0)
        warn(o.map.common, fmt::format("{} texels are no direction in one of the maps; the other counts alone there", invalid.load()));
    say(o.map.common, fmt::format("{}: {} x {}, {}: {}, {}", o.map.common.output.string(), in.width, in.height,
                                  bitsName(*bits), o.mode, describe(s.to)));
    return writeReport(o.map.common, {{"command", "map blend"}, {"base", o.base}, {"detail", o.detail},
                                      {"output", o.map.common.output.string()}, {"mode", o.mode},
                                      {"strength", o.strength}, {"tiles", {s.tilesX, s.tilesY}},
                                      {"to", describe(s.to)}, {"bits", bitsName(*bits)}, {"invalid", invalid.load()}});
}

} // namespace

Command addMapBlend(CLI::App& map)
{
    auto options = std::make_shared<MapBlendCommandOptions>();
    CLI::App* command = map.add_subcommand("blend", "a base and a detail map as one");
    addMapOptions(*command, options->map, "the blend, of the base's size");
    command->add_option("BASE", options->base, "the base map")->required();
    command->add_option("DETAIL", options->detail, "the detail map")->required();
    command->add_option("--mode", options->mode, "reoriented, whiteout, udn, slopes or linear")->capture_default_str();
    command->add_option("--strength", options->strength, "factor on the detail's slopes")->capture_default_str();
    command->add_option("--tiles", options->tiles, "how often the detail repeats over the base")->type_name("N[xM]")->capture_default_str();
    command->add_option("--mask", options->mask, "picture whose red, 0 to 1, multiplies the strength")->type_name("FILE");
    command->add_option("--from", options->from, "how the base is stored: " + conventionWords())->type_name("WORDS")->capture_default_str();
    command->add_option("--detail-from", options->detailFrom, "how the detail is stored; as the base if not given")->type_name("WORDS");
    command->add_option("--to", options->to, "how to store the blend; as the base if not given")->type_name("WORDS");
    command->add_option("--bits", options->bits, "auto (as the base), 8, 16, half (.exr) or float")->capture_default_str();
    command->add_flag("--dither", options->dither, "noise of half a step before rounding, the same on every run");
    addExamples(*command, {"cotan map blend rocks.png grain.png -o out.png",
                           "cotan map blend rocks.png grain.png --tiles 4 --strength 0.5 --mode udn -o out.png"});
    return {command, [options] {
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace cotan::app
