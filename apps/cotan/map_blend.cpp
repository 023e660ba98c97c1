// `cotan map blend`: blends a base map and a detail map.
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "core/try.hpp"
#include "map_files/blend.hpp"
#include "map_options.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

struct MapBlendCommandOptions : MapOptions {
    std::string base, detail, from = "gltf,exact", detailFrom, to, mode = "reoriented", mask, tiles = "1";
    double strength = 1;
    bool dither = false;
};

// Parses "N" or "NxM", each 1 to 4096.
Result<std::pair<int, int>> parseTiles(const std::string& text)
{
    char* end = nullptr;
    const long x = std::strtol(text.c_str(), &end, 10);
    const long y = *end == 'x' ? std::strtol(end + 1, &end, 10) : x;
    if (text.empty() || *end != '\0' || x < 1 || y < 1 || x > 4096 || y > 4096)
        return usageError(fmt::format("--tiles: expected N or NxM, each 1 to 4096; found '{}'", text));
    return std::pair(int(x), int(y));
}

Result<BlendFileOptions> parseOptions(const MapBlendCommandOptions& o)
{
    using enum maps::BlendMode;
    BlendFileOptions options;
    if (!o.to.empty()) {
        COTAN_TRY(written, parseWrittenConvention(o.to, "--to"));
        options.to = written->convention;
    }
    COTAN_TRY(mode,
              valueOf<maps::BlendMode>("--mode", o.mode,
                                       {{"reoriented", reoriented},
                                        {"whiteout", whiteout},
                                        {"udn", udn},
                                        {"slopes", slopes},
                                        {"linear", linear}}));
    COTAN_TRY(tiles, parseTiles(o.tiles));
    for (const auto& [words, option, file, target] :
         {std::tuple(o.from, "--from", o.base, &options.base),
          {o.detailFrom.empty() ? o.from : o.detailFrom, "--detail-from", o.detail, &options.detail}}) {
        COTAN_TRY(source, sourceOf(o, words, option, file));
        *target = source->from;
    }
    options.mode = *mode;
    options.strength = float(o.strength);
    options.tilesX = tiles->first, options.tilesY = tiles->second;
    options.mask = o.mask;
    options.bits = o.bits;
    options.dither = o.dither;
    return options;
}

Status run(const MapBlendCommandOptions& o)
{
    COTAN_CHECK(needOutput(o, "blend"));
    COTAN_TRY(options, parseOptions(o));
    const auto done = onFilesToMap(
        o, o.base, [&](const FileOptions& files) { return blendFiles(o.base, o.detail, o.output, *options, files); });
    if (!done)
        return done.error();
    if (done->invalid > 0)
        warn(o, "{} texels have no direction in one of the maps; the other map is used there", done->invalid);
    const std::vector<std::string> warnings = warned(o, done->notes);
    say(o, "{}: {} x {}, {}: {}, {}", o.output.string(), done->width, done->height, bitsName(done->bits), o.mode,
        describe(done->to));
    return writeReport(o,
                       {{"command", "map blend"},
                        {"base", o.base},
                        {"detail", o.detail},
                        {"output", o.output.string()},
                        {"mode", o.mode},
                        {"strength", o.strength},
                        {"tiles", {options->tilesX, options->tilesY}},
                        {"to", describe(done->to)},
                        {"bits", bitsName(done->bits)},
                        {"invalid", done->invalid},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapBlendCommandOptions& o)
{
    addMemoryOption(a, o.memory);
    a.group(HelpGroup::input);
    a.option("BASE", o.base, "the base map").required().reads();
    a.option("DETAIL", o.detail, "the detail map").required().reads();
    a.option("--mode", o.mode, "how to combine the maps: reoriented, whiteout, udn, slopes or linear")
        .in("NAME")
        .offers({"reoriented", "whiteout", "udn", "slopes", "linear"})
        .main();
    a.option("--strength", o.strength, "factor on the detail's slopes").in("X").main();
    a.option("--tiles", o.tiles, "how often the detail repeats over the base").in("N[xM]").main();
    a.option("--mask", o.mask, "image whose red, 0 to 1, multiplies the strength").in("FILE").reads();
    addSource(a, "--from", o.from, "how the base is stored");
    a.option("--detail-from", o.detailFrom, "how the detail is stored; the same words as for the base if not given")
        .in("WORDS")
        .offers(sourceWords());
    a.option("--to", o.to, "how to store the blend; as the base if not given")
        .in("WORDS")
        .offers(conventionWordList())
        .under(HelpGroup::output);
    addBits(a, o, " (as the base)");
    addDither(a, o.dither);
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
