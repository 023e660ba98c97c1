#include "commands.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "cotan/convert/convert_model.hpp"
#include "cotan/draw/painter.hpp"
#include "gltf_open.hpp"
#include "memory_limit.hpp"
#include "parse.hpp"
#include "progress.hpp"
#include "spread_report.hpp"
#include "verify.hpp"

namespace cotan::app {

namespace {

struct ConvertCommandOptions {
    CommonOptions common;
    std::string model;
    std::string from = "mikktspace", to;
    std::string tangents = "stored";
    bool keepTangents = false;
    int memory = kDefaultMemory;
    int bits = 0; // 0: as the old map
    std::filesystem::path verify;
    std::string device = "auto";
};

Result<Frame> frameFor(const char* option, const std::string& text)
{
    const auto frame = parseFrame(text);
    if (!frame)
        return usageError(fmt::format("{}: {}", option, frame.error().message));
    if (dependsOnView(*frame))
        return usageError(fmt::format("{}: expected a frame that is the same from every side; {} is not, so no map can be made for it",
                                      option, text));
    return *frame;
}

Result<FramePair> checkUsage(const ConvertCommandOptions& o)
{
    if (o.to.empty())
        return usageError("convert: expected --to-frame FRAME; found none");
    const auto from = frameFor("--from-frame", o.from);
    if (!from)
        return from.error();
    const auto to = frameFor("--to-frame", o.to);
    if (!to)
        return to.error();
    if (o.common.output.empty())
        return usageError("convert: expected -o FILE; found none");
    if (Status names = checkGltfNames(o.model, o.common.output); !names)
        return names.error();
    std::vector<PlannedOutput> files = {{"-o", o.common.output}};
    if (!o.verify.empty())
        for (const PlannedOutput& picture : plannedIn("--verify", o.verify, verifyPictures()))
            files.push_back(picture);
    if (Status planned = planOutputs(o.common, files); !planned)
        return planned.error();
    std::error_code ignored;
    if (!o.verify.empty() && std::filesystem::equivalent(o.model, o.common.output, ignored))
        return usageError(fmt::format("--verify: compares with {}, which -o replaces; expected another -o", o.model));
    return FramePair{*from, *to, o.tangents == "generated" ? TangentOrigin::generated : TangentOrigin::stored,
                     TangentOrigin::generated};
}

// What is to be said of a map that stays.
std::string whyKept(const ConvertCommandOptions& o, const ConvertedMap& map)
{
    const Spread& off = map.figures.unconverted;
    if (off.count == 0)
        return fmt::format("{}: stays as it is; nothing was judged, for no triangle with area, also in uv, shows it", map.name);
    return fmt::format("{}: stays as it is: read with {} it is off by {} degrees on {}, no more than rounding a new one costs", map.name,
                       o.to, toText(off), counted(map.surfaces, "surface"));
}

void sayMap(const ConvertCommandOptions& o, const ConvertedMap& map)
{
    if (map.kept)
        return say(o.common, whyKept(o, map));
    const ReencodeFigures& r = map.figures;
    const double texels = double(map.width) * double(map.height);
    say(o.common, fmt::format("{}: {}x{}, {:.1f} % covered by {}; read with {} as it is, off by {} degrees", map.name, map.width, map.height,
                              100 * double(r.covered) / texels, counted(map.surfaces, "surface"), o.to, toText(r.unconverted)));
    if (r.several > 0)
        say(o.common, fmt::format("  {} texels are used in several places; in {} ({:.2f} % of the covered) these disagree by over {} degrees{}",
                                  r.several, r.disagreeing, 100 * double(r.disagreeing) / double(std::max<std::size_t>(r.covered, 1)),
                                  kDisagree, r.disagreeing > 0 ? fmt::format(": {} off at the worst place", toText(r.disagreement)) : ""));
    say(o.common, fmt::format("  converted and rounded to {} bits, off by {} degrees; {} texels of padding converted too; PNG {} bytes, before {}",
                              map.bits, toText(r.error), r.padded, map.bytesAfter, map.bytesBefore));
    if (r.belowHorizon > 0)
        say(o.common, fmt::format("  {} texels point below the horizon of the frame", r.belowHorizon));
}

// Of a map that stays, no texel was looked at: those figures are missing.
nlohmann::ordered_json describe(const ConvertedMap& map)
{
    const ReencodeFigures& r = map.figures;
    if (map.kept)
        return {{"image", map.image}, {"name", map.name}, {"surfaces", map.surfaces}, {"size", {map.width, map.height}}, {"kept", true},
                {"degrees_unconverted", toJson(r.unconverted)}, {"bytes_before", map.bytesBefore}, {"bytes_after", map.bytesAfter}};
    return {{"image", map.image}, {"name", map.name}, {"surfaces", map.surfaces}, {"size", {map.width, map.height}},
            {"kept", false}, {"bits", map.bits}, {"texels_covered", r.covered}, {"texels_padded", r.padded},
            {"texels_in_several_places", r.several}, {"texels_that_disagree", r.disagreeing},
            {"disagreement_degrees", toJson(r.disagreement)}, {"moved_degrees", toJson(r.moved)},
            {"degrees_unconverted", toJson(r.unconverted)}, {"degrees_after_rounding", toJson(r.error)}, {"below_horizon", r.belowHorizon},
            {"kept_elsewhere", map.alsoElsewhere}, {"bytes_before", map.bytesBefore}, {"bytes_after", map.bytesAfter}};
}

// Says what became of the tangents, and returns it for the report.
nlohmann::ordered_json reportTangents(const ConvertCommandOptions& o, const ConvertModelReport& done)
{
    if (done.tangents == TangentsAfter::kept)
        return {{"kept", true}};
    if (done.tangents == TangentsAfter::given) {
        say(o.common, fmt::format("{} got TANGENT for {}", counted(done.primitivesGiven, "primitive"), o.to));
        return {{"given_primitives", done.primitivesGiven}};
    }
    const TangentBytes& d = done.dropped;
    const double each = d.vertices > 0 ? double(d.bytes) / double(d.vertices) : 0;
    say(o.common, d.bytes > 0 ? fmt::format("TANGENT dropped from {}: {:.3g} bytes a vertex, {} vertices, {} bytes",
                                            counted(d.primitives, "primitive"), each, d.vertices, d.bytes)
                              : "no TANGENT to drop");
    return {{"dropped_primitives", d.primitives}, {"bytes_per_vertex", each}, {"vertices", d.vertices}, {"bytes", d.bytes}};
}

// Converts, and says what became of each map when it is done.
Result<ConvertModelReport> convert(const ConvertCommandOptions& o, const FramePair& frames, GltfDocument& document)
{
    Progress progress(o.common, 1, "converting " + o.model);
    bool first = true;
    auto done = convertModel(document, {.frames = frames, .bits = o.bits, .keepTangents = o.keepTangents, .threads = o.common.threads,
                                        .limits = limitsFor(o.memory), .progress = progress.within(),
                                        .mapDone = [&](const ConvertedMap& map) {
                                            if (std::exchange(first, false))
                                                say(o.common, "three figures are: mean / 95 % / maximum, by area of the surface");
                                            sayMap(o, map);
                                        }});
    return done ? std::move(done) : Result<ConvertModelReport>(withMemoryHint(done.error()));
}

Status writeModel(const ConvertCommandOptions& o, const GltfDocument& document, nlohmann::ordered_json& report)
{
    const auto written = writeGltf(document, o.common.output);
    if (!written)
        return written.error();
    for (const std::string& note : written->notes)
        warn(o.common, note);
    for (const auto& file : written->files)
        report["files"].push_back(file.string());
    report["bytes_before"] = written->bytesBefore;
    report["bytes_after"] = written->bytesAfter;
    const double before = double(written->bytesBefore), after = double(written->bytesAfter);
    say(o.common, fmt::format("{}: {} bytes, before {}: {:.0f} ({:.1f} %) {}", o.common.output.string(), written->bytesAfter,
                              written->bytesBefore, std::abs(before - after), 100 * std::abs(before - after) / std::max(before, 1.0),
                              after > before ? "more" : "less"));
    return Done{};
}

Status run(const ConvertCommandOptions& o)
{
    const auto frames = checkUsage(o);
    if (!frames)
        return frames.error();
    Stopwatch watch;
    if (!o.verify.empty()) { // before anything is done
        if (const auto painter = openPainter(o.device, o.common.threads); !painter)
            return painter.error();
    }
    auto opened = openGltfToEdit(o.model, o.common);
    if (!opened)
        return opened.error();
    GltfDocument& document = opened->document;
    const auto done = convert(o, *frames, document);
    if (!done)
        return done.error();
    nlohmann::ordered_json report = {{"command", "convert"}, {"model", o.model}, {"from", o.from}, {"to", o.to},
                                     {"tangents_read", o.tangents}, {"output", o.common.output.string()},
                                     {"maps", nlohmann::ordered_json::array()}};
    for (const ConvertedMap& map : done->maps)
        report["maps"].push_back(describe(map));
    report["tangents"] = reportTangents(o, *done);
    if (!o.verify.empty()) // before anything is written
        if (Status made = makeFolder(o.verify); !made)
            return made;
    if (Status written = writeModel(o, document, report); !written)
        return written;
    for (const std::string& note : done->notes)
        warn(o.common, note);
    report["notes"] = done->notes;
    report["seconds"] = {{"convert", watch.lap()}};
    if (!o.verify.empty()) {
        auto verified = verifyConversion({o.model, o.common.output, frames->from, frames->to, frames->fromTangents, o.verify, o.device, o.memory}, o.common);
        if (!verified)
            return verified.error();
        report["verify"] = std::move(*verified);
        report["seconds"]["verify"] = watch.lap();
    }
    return writeReport(o.common, report);
}

} // namespace

Command addConvertCommand(CLI::App& app)
{
    auto options = std::make_shared<ConvertCommandOptions>();
    CLI::App* command = app.add_subcommand("convert", "make a glTF model's normal maps for another frame, and drop the tangents");
    addCommonOptions(*command, options->common, "the converted model, .glb or .gltf");
    command->add_option("MODEL", options->model, "glTF or GLB file")->required();
    command->add_option("--from-frame", options->from, "frame that the maps were made for")->type_name("FRAME")->capture_default_str();
    command->add_option("--to-frame", options->to, "frame that they shall be for; mikktspace and vertex write TANGENT, all others drop it")
        ->type_name("FRAME");
    addOlderName(*command, "--from", "--from-frame", options->from);
    addOlderName(*command, "--to", "--to-frame", options->to);
    command->add_option("--tangents", options->tangents, "for --from-frame mikktspace or vertex: stored (as in the file, generated where missing) or generated")
        ->check(CLI::IsMember({"stored", "generated"}))->type_name("NAME")->capture_default_str();
    command->add_flag("--keep-tangents", options->keepTangents, "leave TANGENT where it is");
    command->add_option("--bits", options->bits, "of the new maps: 8 or 16, and all are written anew (default: as the old ones, which stay where they fit)")
        ->check(CLI::IsMember({8, 16}))->type_name("N");
    addMemoryOption(*command, options->memory);
    command->add_option("--verify", options->verify, "folder: draw both models from five sides, compare normals, write the pictures")
        ->type_name("FOLDER");
    command->add_option("--device", options->device, "for --verify: auto, reference, or a part of a Vulkan device's name")
        ->type_name("DEVICE")->capture_default_str();
    addExamples(*command, {"cotan convert model.glb --to-frame smooth -o out.glb",
                           "cotan convert model.glb --from-frame mikktspace --to-frame orthonormal -o out.glb --verify check"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
