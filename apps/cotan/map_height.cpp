// `cotan map from-height` and `to-height`: converts a height image to a normal map, and back.
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/named_values.hpp"
#include "core/try.hpp"
#include "map_files/height.hpp"
#include "map_options.hpp"

namespace cotan::app {

namespace {

constexpr Named<maps::Kernel> kKernels[] = {{"spectral", maps::Kernel::spectral},
                                            {"forward", maps::Kernel::forward},
                                            {"central", maps::Kernel::central},
                                            {"sobel", maps::Kernel::sobel},
                                            {"scharr", maps::Kernel::scharr}};
constexpr Named<maps::Kernel> kDifferences[] = {kKernels[1], kKernels[2], kKernels[3], kKernels[4]};
constexpr Named<maps::Wrap> kWraps[] = {
    {"repeat", maps::Wrap::repeat}, {"clamp", maps::Wrap::clamp}, {"mirror", maps::Wrap::mirror}};

struct MapFromHeightCommandOptions : MapOptions {
    FromHeightFileOptions height;
};

struct MapToHeightCommandOptions : MapOptions {
    ToHeightFileOptions height;
    bool free = false;
};

// Parses "W" or "WxH" in metres.
Status parseMetres(const std::string& text, std::optional<Metres>& parsed)
{
    // Not strtod, which would parse "0x1" as one number.
    Metres metres{0, 0};
    const char* const last = text.data() + text.size();
    const char* end = std::from_chars(text.data(), last, metres.width).ptr;
    const bool both = end != last && *end == 'x';
    if (both)
        end = std::from_chars(end + 1, last, metres.height).ptr;
    const double height = both ? metres.height : metres.width;
    if (end != last || !(metres.width > 0) || !(height > 0) || !std::isfinite(metres.width * height))
        return usageError(fmt::format("--metres: expected metres as W or WxH, each over 0; found '{}'", text));
    parsed = metres;
    return Done{};
}

Status runFrom(const MapFromHeightCommandOptions& o)
{
    COTAN_CHECK(needOutput(o, "from-height"));
    const FromHeightFileOptions& options = o.height;
    if (!options.metres != (options.range == 0))
        return usageError("from-height: expected --metres and --range together, both in metres; found one of them");
    const auto done = onFilesToMap(
        o, o.file, [&](const FileOptions& files) { return normalsFromHeightFile(o.file, o.output, options, files); });
    if (!done)
        return done.error();
    if (done->invalid > 0)
        warn(o, "{}: {} texels have no finite height next to them; written as flat", o.file, done->invalid);
    if (done->heights == PixelType::unorm8)
        warn(o, "{}: 8-bit heights make steps; one step is a slope of {:.3g} here", o.file, done->slopeX / 255 / 2);
    say(o, "{}: {} x {}, {}: {}", o.output.string(), done->width, done->height, bitsName(done->bits),
        describe(options.to));
    return writeReport(o,
                       {{"command", "map from-height"},
                        {"file", o.file},
                        {"output", o.output.string()},
                        {"to", describe(options.to)},
                        {"slope_per_unit_and_texel", {done->slopeX, done->slopeY}},
                        {"bits", bitsName(done->bits)},
                        {"invalid", done->invalid}});
}

std::string textOf(const Metres& metres)
{
    return metres.height > 0 ? fmt::format("{}x{}", metres.width, metres.height) : fmt::format("{}", metres.width);
}

// The options that convert the heights back to the map.
std::string inverseOptions(const MapToHeightCommandOptions& o, const ToHeightFile& done)
{
    const double range = done.heights.highest - done.heights.lowest;
    std::string options = !o.height.metres
        ? fmt::format("--strength {:.9g}", 100 * range / done.width)
        : fmt::format("--metres {} --range {:.9g}", textOf(*o.height.metres), range * done.unit);
    if (o.height.kernel != maps::Kernel::spectral)
        options += " --kernel " + wordOf(kKernels, o.height.kernel);
    if (o.free)
        options += " --wrap clamp";
    return options;
}

Status runTo(const MapToHeightCommandOptions& o)
{
    COTAN_CHECK(needOutput(o, "to-height"));
    ToHeightFileOptions options = o.height;
    options.boundary = o.free ? maps::Boundary::free : maps::Boundary::periodic;
    const auto done = onFiles(o, "solving for the height", [&](const FileOptions& files) {
        return heightFromNormalsFile(o.file, o.output, options, files);
    });
    if (!done)
        return done.error();
    const maps::Heights& h = done->heights;
    const double lowest = h.lowest * done->unit, highest = h.highest * done->unit;
    const double fraction = h.slope > 0 ? h.residual / h.slope : 0;
    const char* const unit = !options.metres ? "texels" : "metres";
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
                        {"residual_share", fraction},
                        {"mean_tilt_degrees", h.meanTilt},
                        {"invalid", h.invalid},
                        {"warnings", warnings}});
}

void addMetres(Arguments& a, std::optional<Metres>& metres, const std::string& help)
{
    a.option(
         "--metres", "", [&metres](const std::string& text) { return parseMetres(text, metres); }, help)
        .in("W[xH]")
        .main()
        .olderName("--size");
}

void declareFrom(Arguments& a, MapFromHeightCommandOptions& o)
{
    addFile(a, o, "FILE", "heights: grey, or the red channel");
    addConvention(a, "--to", o.height.to, "gltf", "how to store the map: " + conventionWords()).main();
    addMetres(a, o.height.metres, "size of the image in metres; with --range");
    a.option("--range", o.height.range, "metres from black to white (floats: metres per unit); below 0: white is low")
        .in("METRES")
        .withoutDefault()
        .main();
    a.option("--strength", o.height.strength,
             "without --metres: height from black to white, in hundredths of the image's width")
        .in("X")
        .main();
    a.choice("--kernel", o.height.kernel, kDifferences, "how slopes are measured: forward, central, sobel or scharr");
    a.choice("--wrap", o.height.wrap, kWraps, "at the borders: repeat, clamp or mirror");
    addBits(a, o.height.bits, " (as the heights)");
    addDither(a, o.height.dither);
}

void declareTo(Arguments& a, MapToHeightCommandOptions& o)
{
    addFile(a, o, "FILE", "the map");
    addConvention(a, "--from", o.height.from, "gltf", "how the map is stored: " + conventionWords()).main();
    addMetres(a, o.height.metres, "size of the image in metres; heights are then in metres, without this in texels");
    a.choice("--kernel", o.height.kernel, kKernels,
             "what made the slopes: spectral (a baker, true derivatives), forward, central, sobel, scharr");
    a.flag("--free", o.free, "the map does not repeat at its borders");
    addBits(a, o.height.bits, " (16 where the file can hold it)");
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
