// `cotan map convert`: the same directions, stored another way.
#include "map_command.hpp"

#include <atomic>
#include <memory>

#include <fmt/format.h>

#include "cotan/maps/recode.hpp"
#include "map_object.hpp"
#include "map_options.hpp"
#include "map_stream.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

struct MapConvertCommandOptions {
    MapOptions map;
    std::string file, from, to, bits = "auto";
    double strength = 1;
    bool normalise = false, dither = false;
    MeshOptions mesh;
};

Status checkSpaces(const MapConvertCommandOptions& o, const Convention& from, const Convention& to)
{
    const bool turns = from.kind != to.kind;
    if (turns == o.mesh.file.empty())
        return usageError(turns ? "--mesh: between tangent and object space the mesh is needed; found none"
                                : "--mesh: is for maps between tangent and object space; found both in one");
    if (turns && o.strength != 1)
        return usageError("--strength: expected 1 between tangent and object space; convert within tangent space for it");
    return Done{};
}

// Reads, turns and writes a whole picture.
Result<maps::RecodeCounts> byMesh(const MapConvertCommandOptions& o, const maps::RecodeSettings& settings, const Bits& bits)
{
    const auto map = openMap(o.file, o.map, settings.from);
    if (!map)
        return map.error();
    maps::RecodeCounts counts;
    std::size_t shown = 0;
    const Progress turning(o.map.common, 0, "turning texels by the mesh");
    const auto out = throughMesh(*map, settings, o.mesh, counts, shown);
    if (!out)
        return out.error();
    if (shown == 0)
        return inputError(fmt::format("{}: no texel of the map is shown by the mesh (uv outside 0 to 1?)", o.mesh.file));
    if (Status written = writeMap(o.map.common.output, *out, bits); !written)
        return written.error();
    say(o.map.common, fmt::format("{}: the mesh shows {:.1f} % of the map; the rest is padding", o.mesh.file,
                                  100 * double(shown) / double(map->pixelCount())));
    return counts;
}

// Strip by strip.
Result<maps::RecodeCounts> byRows(const MapConvertCommandOptions& o, RowReader& in, const maps::RecodeSettings& settings,
                                  maps::Swizzle swizzle, const Bits& bits)
{
    const bool alpha = in.alpha && settings.from.channels == Channels::xyz && settings.to.channels == Channels::xyz;
    const auto writer = createRows(o.map.common.output, {in.width, in.height, bits.type, alpha, bits.half}, o.map.common.threads);
    if (!writer)
        return writer.error();
    std::atomic<std::size_t> invalid = 0, clamped = 0;
    const auto work = [&](std::span<Image> strips, int firstRow) -> std::function<Status()> {
        maps::unswizzle(strips[0], swizzle);
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
        return done.error();
    if (Status finished = (*writer)->finish(); !finished)
        return finished.error();
    return maps::RecodeCounts{invalid, clamped};
}

Status run(const MapConvertCommandOptions& o)
{
    const auto from = parseConvention(o.from, "--from");
    const auto to = parseConvention(o.to, "--to");
    if (!from)
        return from.error();
    if (!to)
        return to.error();
    if (Status fits = checkSpaces(o, *from, *to); !fits)
        return fits;
    const bool turns = from->kind != to->kind;
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
    warnIfLossy(o.map.common, o.map.common.output);
    if (Status fits = checkSigned(*to, *bits, o.map.common.output); !fits)
        return fits;
    const maps::RecodeSettings settings{.from = *from, .to = *to, .type = bits->type, .strength = float(o.strength),
                                        .normalise = o.normalise, .dither = o.dither};
    const auto converted = turns ? byMesh(o, settings, *bits) : byRows(o, in, settings, *swizzle, *bits);
    if (!converted)
        return converted.error();
    const maps::RecodeCounts counts = *converted;
    if (counts.invalid > 0)
        warn(o.map.common, fmt::format("{}: {} texels are no direction; written as flat", o.file, counts.invalid));
    if (counts.clamped > 0)
        warn(o.map.common, fmt::format("{}: {} texels are steeper than {} can hold; clamped", o.file, counts.clamped,
                                       describe(*to)));
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
    auto options = std::make_shared<MapConvertCommandOptions>();
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
    command->add_option("--mesh", options->mesh.file, "the mesh of the map, to or from object space")->type_name("FILE");
    command->add_option("--frame", options->mesh.frame, "with --mesh: the frame that reads the tangent-space map")
        ->capture_default_str();
    command->add_option("--material", options->mesh.material, "with --mesh: only what has this material; -1: all")
        ->check(CLI::Range(-1, 1 << 20))->capture_default_str();
    command->add_option("--tangents", options->mesh.tangents, "with --mesh: stored, or generated")
        ->check(CLI::IsMember({"stored", "generated"}))->capture_default_str();
    addExamples(*command, {"cotan map convert rocks.png --from directx --to gltf -o out.png",
                           "cotan map convert rocks.png --from gltf --to unity,orthographic --bits 16 -o out.tif"});
    return {command, [options] {
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace cotan::app
