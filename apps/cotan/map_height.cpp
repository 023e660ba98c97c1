// `cotan map from-height` and `to-height`: converts a height image to a normal map, and back.
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/parse_number.hpp"
#include "core/try.hpp"
#include "map_files/height.hpp"
#include "map_options.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

// Options of both commands.
struct HeightOptions : MapOptions {
    std::string file, convention = "gltf,exact", metres, kernel;
};

struct MapFromHeightCommandOptions : HeightOptions {
    MapFromHeightCommandOptions() { kernel = "central"; }
    std::string wrap = "repeat";
    double range = 0, strength = 1;
    bool dither = false;
};

struct MapToHeightCommandOptions : HeightOptions {
    MapToHeightCommandOptions() { kernel = "spectral"; }
    bool free = false;
};

// Parses "W" or "WxH" in metres; empty for an empty text.
Result<std::optional<Metres>> parseMetres(const std::string& text)
{
    if (text.empty())
        return std::optional<Metres>();
    const std::string_view words = text, width = words.substr(0, words.find('x'));
    const bool both = width.size() < words.size();
    Metres metres{0, 0};
    const bool read =
        parseNumber(width, metres.width) && (!both || parseNumber(words.substr(width.size() + 1), metres.height));
    const double height = both ? metres.height : metres.width;
    if (!read || !(metres.width > 0) || !(height > 0) || !std::isfinite(metres.width * height))
        return usageError(fmt::format("--metres: expected metres as W or WxH, each over 0; found '{}'", text));
    return std::optional(metres);
}

const Words<maps::Kernel> kDifferences = {{"forward", maps::Kernel::forward},
                                          {"central", maps::Kernel::central},
                                          {"sobel", maps::Kernel::sobel},
                                          {"scharr", maps::Kernel::scharr}};

Status runFrom(const MapFromHeightCommandOptions& o)
{
    COTAN_CHECK(needOutput(o, "from-height"));
    COTAN_TRY(written, parseWrittenConvention(o.convention, "--to"));
    const Convention& to = written->convention;
    COTAN_TRY(kernel, valueOf("--kernel", o.kernel, kDifferences));
    using enum maps::Wrap;
    COTAN_TRY(wrap, valueOf<maps::Wrap>("--wrap", o.wrap, {{"repeat", repeat}, {"clamp", clamp}, {"mirror", mirror}}));
    if (o.metres.empty() != (o.range == 0))
        return usageError("from-height: expected --metres and --range together, both in metres; found one of them");
    COTAN_TRY(metres, parseMetres(o.metres));
    const auto done = onFilesToMap(o, o.file, [&](const FileOptions& files) {
        return normalsFromHeightFile(o.file, o.output,
                                     {.to = to,
                                      .kernel = *kernel,
                                      .wrap = *wrap,
                                      .metres = *metres,
                                      .range = o.range,
                                      .strength = o.strength,
                                      .bits = o.bits,
                                      .dither = o.dither},
                                     files);
    });
    if (!done)
        return done.error();
    std::vector<std::string> warnings;
    if (done->invalid > 0)
        warnings.push_back(
            fmt::format("{}: {} texels have no finite height next to them; written as flat", o.file, done->invalid));
    if (done->heights == PixelType::unorm8)
        warnings.push_back(fmt::format("{}: 8-bit heights make steps; one step is a slope of {:.3g} here", o.file,
                                       done->slopeX / 255 / 2));
    for (const std::string& warning : warnings)
        warn(o, warning);
    say(o, "{}: {} x {}, {}: {}", o.output.string(), done->width, done->height, bitsName(done->bits), describe(to));
    return writeReport(o,
                       {{"command", "map from-height"},
                        {"file", o.file},
                        {"output", o.output.string()},
                        {"to", describe(to)},
                        {"slope_per_unit_and_texel", {done->slopeX, done->slopeY}},
                        {"bits", bitsName(done->bits)},
                        {"invalid", done->invalid},
                        {"warnings", warnings}});
}

// The options that convert the heights back to the map.
std::string inverseOptions(const MapToHeightCommandOptions& o, const ToHeightFile& done)
{
    const double range = done.heights.highest - done.heights.lowest;
    std::string options = o.metres.empty() ? fmt::format("--strength {:.9g}", 100 * range / done.width)
                                           : fmt::format("--metres {} --range {:.9g}", o.metres, range * done.unit);
    if (o.kernel != "spectral")
        options += " --kernel " + o.kernel;
    if (o.free)
        options += " --wrap clamp";
    return options;
}

Status runTo(const MapToHeightCommandOptions& o)
{
    COTAN_CHECK(needOutput(o, "to-height"));
    Words<maps::Kernel> kernels = {{"spectral", maps::Kernel::spectral}};
    kernels.insert(kernels.end(), kDifferences.begin(), kDifferences.end());
    COTAN_TRY(kernel, valueOf("--kernel", o.kernel, kernels));
    COTAN_TRY(metres, parseMetres(o.metres));
    COTAN_TRY(from, sourceOf(o, o.convention, "--from", o.file));
    const auto done = onFiles(o, "solving for the height", [&](const FileOptions& files) {
        return heightFromNormalsFile(o.file, o.output,
                                     {.from = from->from,
                                      .kernel = *kernel,
                                      .boundary = o.free ? maps::Boundary::free : maps::Boundary::periodic,
                                      .metres = *metres,
                                      .bits = o.bits},
                                     files);
    });
    if (!done)
        return done.error();
    const maps::Heights& h = done->heights;
    const double lowest = h.lowest * done->unit, highest = h.highest * done->unit;
    const double fraction = h.slope > 0 ? h.residual / h.slope : 0;
    const char* const unit = o.metres.empty() ? "texels" : "metres";
    const std::vector<std::string> warnings = warned(o, done->notes);
    if (h.invalid > 0)
        warn(o, "{}: {} texels have no direction; treated as flat", o.file, h.invalid);
    if (!o.free && h.meanTilt > 1)
        warn(o, "the mean normal tilts by {:.1f} degrees, which no repeating heights give; --free does", h.meanTilt);
    say(o, "{}: {} x {}, {}; from {:.6g} to {:.6g} {}", o.output.string(), done->width, done->height,
        bitsName(done->bits), lowest, highest, unit);
    say(o, "slopes {:.4f} (rms), {:.4f} not explained by any height ({:.1f} %)", h.slope, h.residual, fraction * 100);
    if (done->bits.type != PixelType::float32)
        say(o, "to convert back: cotan map from-height " + inverseOptions(o, *done));
    return writeReport(o,
                       {{"command", "map to-height"},
                        {"file", o.file},
                        {"output", o.output.string()},
                        {"from", describe(done->from)},
                        {"lowest", lowest},
                        {"highest", highest},
                        {"unit", unit},
                        {"strength", 100 * (h.highest - h.lowest) / done->width},
                        {"slope_rms", h.slope},
                        {"residual_rms", h.residual},
                        {"residual_fraction", fraction},
                        {"mean_tilt_degrees", h.meanTilt},
                        {"invalid", h.invalid},
                        {"warnings", warnings}});
}

void declareFrom(Arguments& a, MapFromHeightCommandOptions& o)
{
    addMemoryOption(a, o.memory);
    a.group(HelpGroup::input);
    a.option("FILE", o.file, "heights: grey, or the red channel").required().reads();
    a.option("--to", o.convention, "how to store the map: " + conventionWords())
        .in("WORDS")
        .offers(conventionWordList())
        .main();
    a.option("--metres", o.metres, "size of the image in metres; with --range").in("W[xH]").main();
    addOlderName(a, "--size", "--metres", o.metres);
    a.option("--range", o.range, "metres from black to white (floats: metres per unit); below 0: white is low")
        .in("METRES")
        .withoutDefault()
        .main();
    a.option("--strength", o.strength,
             "without --metres: height from black to white, in hundredths of the image's width")
        .in("X")
        .main();
    a.option("--kernel", o.kernel, "how slopes are measured: forward, central, sobel or scharr")
        .in("NAME")
        .offers({"forward", "central", "sobel", "scharr"});
    a.option("--wrap", o.wrap, "at the borders: repeat, clamp or mirror")
        .in("NAME")
        .offers({"repeat", "clamp", "mirror"});
    addBits(a, o, " (as the heights)");
    addDither(a, o.dither);
}

void declareTo(Arguments& a, MapToHeightCommandOptions& o)
{
    addMemoryOption(a, o.memory);
    a.group(HelpGroup::input);
    a.option("FILE", o.file, "the map").required().reads();
    addSource(a, "--from", o.convention, "how the map is stored").main();
    a.option("--metres", o.metres, "size of the image in metres; heights are then in metres, without this in texels")
        .in("W[xH]")
        .main();
    addOlderName(a, "--size", "--metres", o.metres);
    a.option("--kernel", o.kernel,
             "what made the slopes: spectral (a baker, true derivatives), forward, central, sobel, scharr")
        .in("NAME")
        .offers({"spectral", "forward", "central", "sobel", "scharr"});
    a.flag("--free", o.free, "the map does not repeat at its borders");
    addBits(a, o, " (16 where the file can hold it)");
}

} // namespace

void addMapFromHeight(Arguments& map)
{
    addCommand<MapFromHeightCommandOptions>(
        map,
        {"from-height",
         "Make a normal map from a height map.",
         "the normal map",
         {"cotan map from-height height.png --metres 2 --range 0.05 -o normal.png",
          "cotan map from-height height.png --strength 2 --wrap clamp -o normal.png"},
         /*needsOutput=*/true},
        declareFrom, runFrom);
}

void addMapToHeight(Arguments& map)
{
    addCommand<MapToHeightCommandOptions>(map,
                                          {"to-height",
                                           "Make a height map from a normal map: the one whose slopes are closest.",
                                           "the heights; floats keep their unit, others go from black to white",
                                           {"cotan map to-height rocks.png -o height.png",
                                            "cotan map to-height rocks.png --metres 2 --bits float -o height.exr"},
                                           /*needsOutput=*/true},
                                          declareTo, runTo);
}

} // namespace cotan::app
