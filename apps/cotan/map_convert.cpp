// `cotan map convert`: converts a map to another convention.
#include "core/try.hpp"
#include "image/format_table.hpp"
#include "map_files/convert.hpp"
#include "map_options.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

struct MapConvertCommandOptions : MapOptions {
    std::string file, from = kFound, to;
    double strength = 1;
    bool normalise = false, dither = false, mips = false;
    std::string mesh, frame = "smooth", compress = "none", swizzle = "auto", device;
    double maxDegrees = 0;
    TangentOrigin tangents = TangentOrigin::stored;
    Up up = Up::y;
    int material = -1;
};

// The budget of --max-degrees and --for, which go together.
Result<std::optional<FormatBudget>> budgetOf(const MapConvertCommandOptions& o)
{
    using enum Device;
    const bool chooses = !o.device.empty();
    COTAN_TRY(device,
              valueOf<Device>("--for", chooses ? o.device : "mobile",
                              {{"desktop", desktop}, {"mobile", mobile}, {"web", web}}));
    if ((o.maxDegrees > 0) != chooses)
        return usageError(chooses ? "--for needs --max-degrees: how much a format may cost"
                                  : "--max-degrees needs --for: whose formats to choose from");
    return chooses ? std::optional(FormatBudget{ChoiceLimits::of(o.maxDegrees), *device}) : std::nullopt;
}

// The formats that were tried, as a table.
void sayTried(const MapConvertCommandOptions& o, const ConvertedFile& done)
{
    if (done.tried.empty())
        return;
    say(o, "{:<10}  bits a texel  mean degrees  99 %", "format");
    for (const TriedFormat& tried : done.tried)
        say(o, "{:<10}  {:12.2f}  {:12.3f}  {:.2f}{}", tried.compress, tried.bitsPerTexel, tried.meanDegrees,
            tried.percentile99, tried.compress == done.compress ? "  chosen" : "");
    if (done.compress == "none" && done.tried.size() > 1 && done.to.channels == Channels::xyz)
        say(o, "all blocks of three channels lose more; those of two may lose less: --to WORDS,xy");
}

Status run(const MapConvertCommandOptions& o)
{
    COTAN_TRY(written, parseWrittenConvention(o.to, "--to"));
    COTAN_CHECK(needOutput(o, "convert"));
    COTAN_TRY(budget, budgetOf(o));
    COTAN_TRY(source, sourceOf(o, o.from, "--from", o.file, *written));
    ConvertFileOptions options{.from = source->from,
                               .to = source->to,
                               .bits = source->eightBits && o.bits == "auto" ? "8" : o.bits,
                               .compress = o.compress,
                               .swizzle = o.swizzle,
                               .strength = float(o.strength),
                               .mips = o.mips,
                               .normalise = o.normalise || source->normalise,
                               .dither = o.dither,
                               .mesh = {}};
    options.budget = *budget;
    const Convention& to = options.to;
    if (!o.mesh.empty()) {
        COTAN_TRY(frame, parseFrame(o.frame, "--frame"));
        options.mesh = {o.mesh, *frame, o.tangents, o.material, o.up};
    }
    const auto done =
        onFilesToMap(o, o.mesh.empty() ? o.file : "converting with the mesh",
                     [&](const FileOptions& files) { return convertFile(o.file, o.output, options, files); });
    if (!done)
        return done.error();
    if (!o.mesh.empty())
        say(o, "{}: the mesh uses {:.1f} % of the map; the rest is padding", o.mesh,
            100 * double(done->covered) / (double(done->width) * double(done->height)));
    if (done->counts.invalid > 0)
        warn(o, "{}: {} texels have no direction; written as flat", o.file, done->counts.invalid);
    if (done->counts.clamped > 0)
        warn(o, "{}: {} texels are steeper than {} can hold; clamped", o.file, done->counts.clamped, describe(to));
    const std::vector<std::string> warnings = warned(o, done->notes);
    sayTried(o, *done);
    const std::string bits = done->compress != "none" ? done->compress : bitsName(done->bits);
    if (done->cost)
        say(o, "{}: mean {:.3f}, 99 % {:.2f} degrees", done->compress, done->cost->mean, done->cost->percentile99);
    say(o, "{}: {} x {}, {}: {}", o.output.string(), done->width, done->height, bits, describe(done->to));
    Json tried = Json::array();
    for (const TriedFormat& format : done->tried)
        tried.push_back(toJson(format));
    return writeReport(o,
                       {{"command", "map convert"},
                        {"file", o.file},
                        {"output", o.output.string()},
                        {"from", describe(done->from)},
                        {"to", describe(done->to)},
                        {"width", done->width},
                        {"height", done->height},
                        {"bits", bits},
                        {"tried", tried},
                        {"mean_degrees", done->cost ? Json(done->cost->mean) : Json()},
                        {"percentile99_degrees", done->cost ? Json(done->cost->percentile99) : Json()},
                        {"invalid", done->counts.invalid},
                        {"clamped", done->counts.clamped},
                        {"warnings", warnings}});
}

void declare(Arguments& a, MapConvertCommandOptions& o)
{
    addMemoryOption(a, o.memory);
    a.group(HelpGroup::input);
    a.option("FILE", o.file, "the map").required().reads();
    addSource(a, "--from", o.from, "how the map is stored").main();
    a.option("--to", o.to, "how to store the result; the same words")
        .in("WORDS")
        .offers(conventionWordList())
        .required()
        .main();
    addBits(a, o, "");
    a.option("--strength", o.strength, "factor on the slopes; negative turns bumps into dents").in("X").main();
    a.flag("--normalise", o.normalise,
           "normalise every vector; without this, vectors of three channels keep their lengths")
        .under(HelpGroup::output);
    addCompress(a, o.compress, o.swizzle);
    a.flag("--mips", o.mips,
           "for " + imageEndings(&ImageFormat::texture, ", ", " and ")
               + ": write all levels, filtered as vectors (map mips stores the roughness that they need as well)")
        .under(HelpGroup::output);
    a.option("--max-degrees", o.maxDegrees,
             "for " + imageEndings(&ImageFormat::texture, ", ", " and ")
                 + ", in place of --compress: take the smallest format that costs no more than this angle on "
                   "average, and ten times as much on 99 % of the texels; prints what was tried")
        .within(0.0, 180.0)
        .in("D")
        .under(HelpGroup::output);
    a.option("--for", o.device,
             "with --max-degrees: desktop (bc5 or bc7), mobile (astc of all sizes, eac-rg11) or web (uastc)")
        .in("NAME")
        .offers({"desktop", "mobile", "web"})
        .under(HelpGroup::output);
    addDither(a, o.dither);
    a.option("--mesh", o.mesh, "mesh that uses the map; required to or from object space").in("FILE").reads();
    a.option("--frame", o.frame, "with --mesh: the frame that reads the tangent-space map")
        .in("NAME")
        .offers(frameWords())
        .under(HelpGroup::frame);
    addListOfFrames(a);
    a.group(HelpGroup::input);
    addUpOption(a, o.up, "--mesh");
    a.option("--material", o.material, "with --mesh: only triangles of this material; -1: all")
        .within(-1, 1 << 20)
        .in("N");
    addTangentsOption(a, o.tangents,
                      "with --mesh, for frames of tangents (mikktspace, area-weighted, vertex): stored or generated");
}

} // namespace

void addMapConvert(Arguments& map)
{
    addCommand<MapConvertCommandOptions>(
        map,
        {"convert",
         "Convert a normal map between conventions, or repair it: green, channels, sRGB, space, bits.",
         "the new map: " + imageEndings([](const ImageFormat& f) { return f.writes || f.texture; }),
         {"cotan map convert rocks.png --to opengl -o out.png",
          "cotan map convert rocks.png --from directx --to opengl -o out.png",
          "cotan map convert rocks.png --from gltf --to unity,orthographic --bits 16 -o out.tif"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
