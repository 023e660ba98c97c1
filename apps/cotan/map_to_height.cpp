// `cotan map to-height`: the height whose slopes are nearest to a normal map's.
#include "map_command.hpp"

#include <memory>

#include <fmt/format.h>

#include "map_height.hpp"
#include "map_options.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

struct MapToHeightCommandOptions {
    MapOptions map;
    std::string file, convention = "gltf", bits = "auto", size, kernel = "spectral";
    bool free = false;
};

// Heights as a picture: floats in their unit, others stretched from lowest to highest.
Image picture(const maps::Heights& heights, const Image& map, PixelType type, double unit)
{
    Image image = makeImage(map.width, map.height, type, map.name);
    const double range = heights.highest - heights.lowest;
    for (std::size_t i = 0; i < heights.texels.size(); ++i) {
        const double h = double(heights.texels[i]);
        const double part = range > 0 ? (h - heights.lowest) / range : 0.5;
        for (std::size_t c = 0; c < 4; ++c) {
            const double value = c == 3 ? 1 : type == PixelType::float32 ? h * unit : part;
            if (type == PixelType::unorm8)
                image.bytes8()[4 * i + c] = std::uint8_t(value * 255 + 0.5);
            else if (type == PixelType::unorm16)
                image.words()[4 * i + c] = std::uint16_t(value * 65535 + 0.5);
            else
                image.floats()[4 * i + c] = float(value);
        }
    }
    return image;
}

Status checkMemory(const MapToHeightCommandOptions& o, const Image& image)
{
    const std::size_t bytes = maps::heightWorkBytes(image.width, image.height,
                                                    o.free ? maps::Boundary::free : maps::Boundary::periodic);
    if (bytes > std::size_t(o.map.memory) << 20)
        return inputError(fmt::format("{}: the solver takes {} MiB for {} x {}, the limit is {} (--memory raises it)",
                                      o.file, (bytes >> 20) + 1, image.width, image.height, o.map.memory));
    return Done{};
}

Status run(const MapToHeightCommandOptions& o)
{
    if (Status given = needOutput(o.map, "to-height"); !given)
        return given;
    const auto from = parseConvention(o.convention, "--from");
    if (!from)
        return from.error();
    const auto kernel = kernelFromName(o.kernel);
    if (!kernel)
        return usageError(fmt::format("--kernel: expected spectral, forward, central, sobel or scharr; found '{}'", o.kernel));
    const auto image = openMap(o.file, o.map, *from);
    if (!image)
        return image.error();
    const auto type = parseBits(o.bits == "auto" ? "16" : o.bits, image->type, o.map.common.output);
    const auto checked = type ? type : o.bits == "auto" ? parseBits("auto", PixelType::unorm16, o.map.common.output) : type;
    if (!checked)
        return checked.error();
    if (Status fits = checkMemory(o, *image); !fits)
        return fits;
    double unit = 1, aspect = 1;
    if (!o.size.empty()) {
        const auto metres = parseMetres(o.size, image->width, image->height);
        if (!metres)
            return metres.error();
        unit = metres->first / image->width;
        aspect = metres->second / image->height / unit;
    }
    const Progress solving(o.map.common, 0, "solving for the height");
    const maps::Heights h = maps::heightFromNormals(
        *image, {.from = *from, .boundary = o.free ? maps::Boundary::free : maps::Boundary::periodic,
                 .kernel = *kernel, .aspect = aspect});
    if (Status written = writeMap(o.map.common.output, picture(h, *image, checked->type, unit), *checked); !written)
        return written;
    const double range = h.highest - h.lowest, share = h.slope > 0 ? h.residual / h.slope : 0;
    std::string again = o.size.empty() ? fmt::format("--strength {:.9g}", 100 * range / image->width)
                                       : fmt::format("--metres {} --range {:.9g}", o.size, range * unit);
    if (*kernel != maps::Kernel::spectral)
        again += " --kernel " + o.kernel;
    if (o.free)
        again += " --wrap clamp";
    if (h.invalid > 0)
        warn(o.map.common, fmt::format("{}: {} texels are no direction; taken as flat", o.file, h.invalid));
    if (!o.free && h.meanTilt > 1)
        warn(o.map.common, fmt::format("the whole map leans by {:.1f} degrees, which no repeating height can; --free follows it", h.meanTilt));
    say(o.map.common, fmt::format("{}: {} x {}, {}; from {:.6g} to {:.6g} {}", o.map.common.output.string(),
                                  image->width, image->height, bitsName(*checked), h.lowest * unit, h.highest * unit,
                                  o.size.empty() ? "texels" : "metres"));
    say(o.map.common, fmt::format("slopes {:.4f} (rms), {:.4f} of which no height explains ({:.1f} %)", h.slope,
                                  h.residual, share * 100));
    if (checked->type != PixelType::float32)
        say(o.map.common, "back: cotan map from-height " + again);
    return writeReport(o.map.common, {{"command", "map to-height"}, {"file", o.file},
                                      {"output", o.map.common.output.string()}, {"from", describe(*from)},
                                      {"lowest", h.lowest * unit}, {"highest", h.highest * unit},
                                      {"unit", o.size.empty() ? "texels" : "metres"},
                                      {"strength", 100 * range / image->width}, {"slope_rms", h.slope},
                                      {"residual_rms", h.residual}, {"residual_share", share},
                                      {"mean_tilt_degrees", h.meanTilt}, {"invalid", h.invalid}});
}

} // namespace

Command addMapToHeight(CLI::App& map)
{
    auto options = std::make_shared<MapToHeightCommandOptions>();
    CLI::App* command = map.add_subcommand("to-height", "the height whose slopes are nearest to a normal map's");
    addMapOptions(*command, options->map, "the heights; floats keep their unit, others go from black to white");
    command->add_option("FILE", options->file, "the map")->required();
    command->add_option("--from", options->convention, "how it is stored: " + conventionWords())
        ->type_name("WORDS")->capture_default_str();
    command->add_option("--metres", options->size, "metres that the picture covers: heights come in metres, otherwise in texels")->type_name("W[xH]");
    addOlderName(*command, "--size", "--metres", options->size);
    command->add_option("--kernel", options->kernel,
                        "what made the slopes: spectral (a baker, true derivatives), forward, central, sobel, scharr")->capture_default_str();
    command->add_flag("--free", options->free, "the map does not repeat: free borders");
    command->add_option("--bits", options->bits, "auto (16 where the file can hold it), 8, 16, half (.exr) or float")->capture_default_str();
    addExamples(*command, {"cotan map to-height rocks.png -o height.png",
                           "cotan map to-height rocks.png --metres 2 --bits float -o height.exr"});
    return {command, [options] {
                return withThreads(options->map.common.threads, [&] { return run(*options); });
            }};
}

} // namespace cotan::app
