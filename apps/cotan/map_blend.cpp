// `cotan map blend`: blends a base map and a detail map.
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "core/try.hpp"
#include "map_files/blend.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

constexpr Named<maps::BlendMode> kModes[] = {{"reoriented", maps::BlendMode::reoriented},
                                             {"whiteout", maps::BlendMode::whiteout},
                                             {"udn", maps::BlendMode::udn},
                                             {"slopes", maps::BlendMode::slopes},
                                             {"linear", maps::BlendMode::linear}};

struct MapBlendCommandOptions : MapOptions {
    std::string detail;
    double strength = 1;
    BlendFileOptions blend;                     // but for `detail` and `strength`
    std::optional<StatedConvention> detailFrom; // none: as the base
};

// Parses "N" or "NxM", each 1 to 4096.
Status parseTiles(const std::string& text, BlendFileOptions& options)
{
    char* end = nullptr;
    const long x = std::strtol(text.c_str(), &end, 10);
    const long y = *end == 'x' ? std::strtol(end + 1, &end, 10) : x;
    if (text.empty() || *end != '\0' || x < 1 || y < 1 || x > 4096 || y > 4096)
        return usageError(fmt::format("--tiles: expected N or NxM, each 1 to 4096; found '{}'", text));
    options.tilesX = int(x), options.tilesY = int(y);
    return Done{};
}

Status run(const MapBlendCommandOptions& o)
{
    COTAN_CHECK(needOutput(o, "blend"));
    BlendFileOptions options = o.blend;
    options.detail = o.detailFrom.value_or(options.base);
    options.strength = float(o.strength);
    const std::string mode = wordOf(kModes, options.mode);
    const auto done = onFilesToMap(
        o, o.file, [&](const FileOptions& files) { return blendFiles(o.file, o.detail, o.output, options, files); });
    if (!done)
        return done.error();
    if (done->invalid > 0)
        warn(o, "{} texels have no direction in one of the maps; the other map is used there", done->invalid);
    const std::vector<std::string> warnings = warned(o, done->notes);
    say(o, "{}: {} x {}, {}: {}, {}", o.output.string(), done->width, done->height, bitsName(done->bits), mode,
        describe(done->to));
    return writeReport(o,
                       {{"command", "map blend"},
                        {"base", o.file},
                        {"detail", o.detail},
                        {"output", o.output.string()},
                        {"mode", mode},
                        {"strength", o.strength},
                        {"tiles", {options.tilesX, options.tilesY}},
                        {"to", describe(done->to)},
                        {"bits", bitsName(done->bits)},
                        {"invalid", done->invalid},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapBlendCommandOptions& o)
{
    addFile(a, o, "BASE", "the base map");
    a.option("DETAIL", o.detail, "the detail map").required().reads();
    a.choice("--mode", o.blend.mode, kModes, "how to combine the maps: reoriented, whiteout, udn, slopes or linear")
        .main();
    a.option("--strength", o.strength, "factor on the detail's slopes").in("X").main();
    a.option(
         "--tiles", "1", [&o](const std::string& text) { return parseTiles(text, o.blend); },
         "how often the detail repeats over the base")
        .in("N[xM]")
        .main();
    a.option("--mask", o.blend.mask, "image whose red, 0 to 1, multiplies the strength").in("FILE").reads();
    addConvention(a, "--from", o.blend.base, "gltf", "how the base is stored: " + conventionWords());
    addConvention(a, "--detail-from", o.detailFrom, "", "how the detail is stored; as the base if not given");
    addConvention(a, "--to", o.blend.to, "", "how to store the blend; as the base if not given")
        .under(HelpGroup::output);
    addBits(a, o.blend.bits, " (as the base)");
    addDither(a, o.blend.dither);
}

} // namespace

void addMapBlend(Arguments& map)
{
    addCommand<MapBlendCommandOptions>(
        map,
        {"blend",
         "Combine a base map and a detail map.",
         "the blend, of the base's size",
         {"cotan map blend rocks.png grain.png -o out.png",
          "cotan map blend rocks.png grain.png --tiles 4 --strength 0.5 --mode udn -o out.png"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
