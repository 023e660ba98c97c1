#include "commands.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/reports.hpp"
#include "convert_lines.hpp"
#include "cotan/convert.hpp"
#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "gltf_open.hpp"
#include "loading.hpp"
#include "parse.hpp"
#include "picture/option_words.hpp"
#include "picture_options.hpp"
#include "verify.hpp"

namespace cotan::app {

namespace {

struct ConvertCommandOptions : CommonOptions {
    std::string model;
    std::string from, to; // empty `from`: the frame that the file names, else mikktspace
    TangentOrigin tangents = TangentOrigin::stored;
    bool keepTangents = false, keepMaps = false;
    double maxDegrees = ChoiceLimits().mean; // for frames that are chosen
    std::string provoking;                   // empty: vertices stay unchanged
    int memory = kDefaultMemory;
    int bits = 0; // 0: as the old map
    std::string expansion = "biased";
    std::filesystem::path verify;
    std::string device = "auto";
};

Result<Frame> frameFor(const char* option, const std::string& text)
{
    const auto frame = parseFrame(text, option);
    if (!frame)
        return frame.error();
    if (dependsOnView(*frame))
        return usageError(
            fmt::format("{}: expected a frame that does not depend on the view; found {}, for which no map can be made",
                        option, text));
    return *frame;
}

// --provoking alone concerns vertices only.
bool verticesOnly(const ConvertCommandOptions& o) { return o.to.empty() && !o.keepMaps && !o.provoking.empty(); }

// Without --to-frame the frames are chosen by measurement, and the maps stay.
bool chooses(const ConvertCommandOptions& o) { return o.to.empty() && !verticesOnly(o); }

Status checkVerticesOnly(const ConvertCommandOptions& o)
{
    const ConvertCommandOptions unset;
    for (const auto& [option, given] : {std::pair{"--from-frame", o.from != unset.from},
                                        {"--tangents", o.tangents != unset.tangents},
                                        {"--keep-tangents", o.keepTangents},
                                        {"--bits", o.bits != unset.bits},
                                        {"--unsigned", o.expansion != unset.expansion},
                                        {"--verify", !o.verify.empty()}})
        if (given)
            return usageError(
                fmt::format("{}: applies to converted maps only; expected --to-frame FRAME with it", option));
    return Done{};
}

// The frames of the maps; empty if the maps stay unchanged.
Result<std::optional<FramePair>> checkUsage(const ConvertCommandOptions& o)
{
    if ((o.keepMaps || chooses(o)) && (o.keepTangents || o.bits != 0))
        return usageError(fmt::format("{}: {} drops only the tangents", o.keepTangents ? "--keep-tangents" : "--bits",
                                      o.keepMaps ? "--keep-maps" : "convert without --to-frame"));
    if (!chooses(o) && o.maxDegrees != ConvertCommandOptions().maxDegrees)
        return usageError(fmt::format("--max-degrees: applies to frames that are chosen; leave out {}",
                                      o.to.empty() ? "--provoking, or add --keep-maps" : "--to-frame"));
    if (verticesOnly(o))
        if (Status alone = checkVerticesOnly(o); !alone)
            return alone.error();
    const auto from = frameFor("--from-frame", o.from.empty() ? "mikktspace" : o.from);
    if (!from)
        return from.error();
    const auto to = !o.to.empty() ? frameFor("--to-frame", o.to) : chooses(o) ? Frame::orthonormal : *from;
    if (!to)
        return to.error();
    if (o.keepMaps && readsTangents(*to))
        return usageError(fmt::format(
            "--to-frame: expected a frame that reads no tangents, since --keep-maps drops them; found {}", name(*to)));
    if (o.output.empty())
        return usageError("convert needs -o FILE");
    if (Status names = checkGltfNames(o.model, o.output); !names)
        return names.error();
    std::vector<PlannedOutput> files = {{"-o", o.output}};
    if (!o.verify.empty())
        for (const PlannedOutput& picture :
             plannedIn("--verify", o.verify, imageNames(kConversionNames, kConversionViews)))
            files.push_back(picture);
    if (Status planned = beginOutputs(o, files); !planned)
        return planned.error();
    std::error_code ignored;
    if (!o.verify.empty() && std::filesystem::equivalent(o.model, o.output, ignored))
        return usageError(fmt::format("--verify: compares with {}, which -o replaces; expected another -o", o.model));
    if (verticesOnly(o))
        return std::optional<FramePair>();
    return std::optional(FramePair{*from, *to, o.tangents, TangentOrigin::generated});
}

// Converts the maps, and prints the result of each when it is done.
Result<ConvertModelReport> convert(const ConvertCommandOptions& o, const FramePair& frames, GltfDocument& document)
{
    bool first = true;
    const auto mapDone = [&](const ConvertedMap& map) {
        if (std::exchange(first, false))
            say(o, "three values are mean / 95 % / maximum, weighted by surface area");
        for (const std::string& line : linesOf(map, std::string(name(frames.to))))
            say(o, line);
    };
    auto done = withProgress(o, 1, "converting " + o.model, [&](Progress progress) {
        return convertModel(document,
                            {.frames = frames,
                             .bits = o.bits,
                             .expansion = o.expansion == "biased" ? Expansion::biased : Expansion::exact,
                             .choose = chooses(o) ? std::optional(ChoiceLimits::of(o.maxDegrees)) : std::nullopt,
                             .keepMaps = o.keepMaps || chooses(o),
                             .keepTangents = o.keepTangents,
                             .threads = o.threads,
                             .memory = std::size_t(o.memory) << 20,
                             .limits = limitsFor(o.memory),
                             .progress = std::move(progress),
                             .mapDone = mapDone});
    });
    return done ? std::move(done) : Result<ConvertModelReport>(withOptionNames(done.error()));
}

Status writeModel(const ConvertCommandOptions& o, const GltfDocument& document, Json& report)
{
    const auto written = writeGltfWithProgress(document, o);
    if (!written)
        return written.error();
    report["files"] = fileNames(*written);
    report["bytes_before"] = written->bytesBefore;
    report["bytes_after"] = written->bytesAfter;
    const double before = double(written->bytesBefore), after = double(written->bytesAfter);
    say(o, "{}: {} bytes, before {}: {:.0f} ({:.1f} %) {}", o.output.string(), written->bytesAfter,
        written->bytesBefore, std::abs(before - after), 100 * std::abs(before - after) / std::max(before, 1.0),
        after > before ? "more" : "less");
    return Done{};
}

// Converts the maps, and adds the results to the report.
Status convertMaps(const ConvertCommandOptions& o, const FramePair& frames, GltfDocument& document, Json& report,
                   std::vector<std::string>& notes)
{
    const auto done = convert(o, frames, document);
    if (!done)
        return done.error();
    for (const ConvertedMap& map : done->maps)
        report["maps"].push_back(toJson(map));
    for (const std::string& line : tangentsLines(*done, std::string(name(frames.to))))
        say(o, line);
    report["tangents"] = tangentsJson(*done);
    report["decisions"] = decisionsJson(done->decisions);
    notes = done->notes;
    return Done{};
}

// Reorders vertices for the provoking vertex, and prints how many were added.
Status provoke(const ConvertCommandOptions& o, GltfDocument& document, Json& report)
{
    const auto done =
        setGltfProvoking(document, o.provoking == "first" ? ProvokingVertex::first : ProvokingVertex::last);
    if (!done)
        return done.error();
    report["provoking"] = provokingJson(*done, o.provoking);
    say(o, provokingLine(*done, o.provoking));
    return Done{};
}

Status run(const ConvertCommandOptions& o)
{
    auto frames = checkUsage(o);
    if (!frames)
        return frames.error();
    Stopwatch watch;
    if (!o.verify.empty()) { // fails before any work
        if (const auto renderer = openRenderer(o.device, o.threads); !renderer)
            return renderer.error();
    }
    auto opened = openGltfToEdit(o.model, o);
    if (!opened)
        return opened.error();
    GltfDocument& document = opened->document;
    Json report = {{"command", "convert"}, {"model", o.model}};
    if (*frames) {
        const auto named = namedFrame(document);
        if (!named)
            return withOptionNames(named.error());
        if (*named && o.from.empty())
            (*frames)->from = **named;
        report.update({{"from", name((*frames)->from)},
                       {"to", chooses(o) ? std::string(kAutoFrame) : std::string(name((*frames)->to))},
                       {"tangents_read", wordOf(kTangentOrigins, o.tangents)},
                       {"unsigned", o.expansion}});
    }
    report["output"] = o.output.string();
    report["maps"] = Json::array();
    std::vector<std::string> notes;
    if (*frames)
        if (Status converted = convertMaps(o, **frames, document, report, notes); !converted)
            return converted;
    if (!o.provoking.empty())
        if (Status provoked = provoke(o, document, report); !provoked)
            return provoked;
    if (!o.verify.empty()) // fails before anything is written
        if (Status made = makeFolder(o.verify); !made)
            return made;
    if (Status written = writeModel(o, document, report); !written)
        return written;
    for (const std::string& note : notes)
        warn(o, note);
    report["notes"] = notes;
    report["seconds"] = {{"convert", watch.lap()}};
    if (!o.verify.empty()) {
        auto verified = verifyConversion({o.model, o.output, (*frames)->from,
                                          chooses(o) ? std::nullopt : std::optional((*frames)->to),
                                          (*frames)->fromTangents, o.verify, o.device, o.memory},
                                         o);
        if (!verified)
            return verified.error();
        report["verify"] = std::move(*verified);
        report["seconds"]["verify"] = watch.lap();
    }
    return writeReport(o, report);
}

void declare(Arguments& a, ConvertCommandOptions& o)
{
    a.option("MODEL", o.model, "glTF or GLB file").required().reads();
    a.option("--from-frame", o.from,
             "frame that the maps were made for (default: the one that the file names, else "
             "mikktspace)")
        .in("FRAME")
        .offers(frameWords())
        .main();
    a.option(
         "--to-frame", o.to,
         "frame to make the maps for; mikktspace and vertex write TANGENT, all others drop it (default: the maps stay, "
         "each primitive is read with the frame that is near enough, and tangents stay where none is)")
        .in("FRAME")
        .offers(frameWords())
        .main();
    addListOfFrames(a);
    addOlderName(a, "--from", "--from-frame", o.from);
    addOlderName(a, "--to", "--to-frame", o.to);
    addTangentsOption(
        a, o.tangents,
        "for --from-frame mikktspace or vertex: stored (as in the file, generated where missing) or generated");
    a.flag("--keep-maps", o.keepMaps,
           "keep the maps byte for byte, to be read with --to-frame, and drop only the tangents; where these reverse "
           "green of a map, its green is reversed, or they stay. Without --to-frame this is the default")
        .main();
    addMaxDegreesOption(a, o.maxDegrees);
    a.group(HelpGroup::output);
    a.flag("--keep-tangents", o.keepTangents, "keep the tangents of the file");
    a.option("--bits", o.bits,
             "bits of the new maps, 8 or 16; rewrites all maps (default: bits of the old map; a suitable map is kept)")
        .from({8, 16})
        .in("N")
        .withoutDefault();
    a.option(
         "--unsigned", o.expansion,
         "how the engine decodes the maps: biased (2c - 1, as glTF says and stock engines do) or exact (zero is 128, "
         "Cotan's default for maps that do not say)")
        .from({"biased", "exact"})
        .in("NAME");
    a.option(
         "--provoking", o.provoking,
         "give every triangle its own provoking vertex, its first (Vulkan, Direct3D, Metal, WebGPU) or its last "
         "(OpenGL, WebGL), for the frame triangle: vertex k provokes triangle k. Copies vertices; without --to-frame "
         "nothing else changes")
        .from({"first", "last"})
        .in("CORNER")
        .withoutDefault();
    addMemoryOption(a, o.memory, ", and the maximum for the triangles of one map besides the model");
    a.option("--verify", o.verify,
             "draw both models from five sides, compare normals, and write the images into this folder")
        .in("FOLDER")
        .writes()
        .main();
    addDeviceOption(a, o.device, "for --verify: ");
}

} // namespace

void addConvertCommand(Arguments& tool)
{
    addCommand<ConvertCommandOptions>(
        tool,
        {"convert",
         "Convert a glTF model's normal maps to another frame and drop its tangents, or prepare its vertices for the "
         "frame triangle.",
         "the converted model, .glb or .gltf",
         {"cotan convert model.glb --to-frame smooth -o out.glb", "cotan convert model.glb -o out.glb",
          "cotan convert model.glb --from-frame mikktspace --to-frame orthonormal -o out.glb --verify check",
          "cotan convert model.glb --provoking first -o out.glb"},
         /*needsOutput=*/true},
        declare, run);
}

} // namespace cotan::app
