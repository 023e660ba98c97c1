#include "commands.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "convert_gltf.hpp"
#include "cotan/draw/painter.hpp"
#include "cotan/image/file.hpp"
#include "cotan/lint/texel.hpp"
#include "gltf_open.hpp"
#include "memory_limit.hpp"
#include "parse.hpp"
#include "progress.hpp"
#include "spread_report.hpp"
#include "verify.hpp"

namespace cotan::app {

namespace {

constexpr double kSeen = 0.5;       // degrees on average over a map: below, nobody sees a difference
constexpr double kMostCopies = 2e6; // of the image under all triangles together

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

bool needsTangents(Frame frame) { return frame == Frame::mikktspace || frame == Frame::vertex; }

Result<Frame> frameFor(const char* option, const std::string& text)
{
    const auto frame = parseFrame(text);
    if (!frame)
        return usageError(fmt::format("{}: {}", option, frame.error().message));
    if (!viewIndependent(*frame))
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
std::string whyKept(const ConvertCommandOptions& o, const MapJob& job, const Spread& off)
{
    if (off.count == 0)
        return fmt::format("{}: stays as it is; nothing was judged, for no triangle with area, also in uv, shows it", job.name);
    return fmt::format("{}: stays as it is: read with {} it is off by {} degrees on {}, no more than rounding a new one costs", job.name,
                       o.to, toText(off), counted(job.uses.size(), "surface"));
}

void sayMap(const ConvertCommandOptions& o, const MapJob& job, const Reencoded& r, std::size_t before, std::size_t after)
{
    const double texels = double(r.image.pixelCount());
    say(o.common, fmt::format("{}: {}x{}, {:.1f} % covered by {}; read with {} as it is, off by {} degrees", job.name, r.image.width,
                              r.image.height, 100 * double(r.covered) / texels, counted(job.uses.size(), "surface"), o.to,
                              toText(r.unconverted)));
    if (r.several > 0)
        say(o.common, fmt::format("  {} texels are used in several places; in {} ({:.2f} % of the covered) these disagree by over {} degrees{}",
                                  r.several, r.disagreeing, 100 * double(r.disagreeing) / double(std::max<std::size_t>(r.covered, 1)),
                                  kDisagree, r.disagreeing > 0 ? fmt::format(": {} off at the worst place", toText(r.disagreement)) : ""));
    say(o.common, fmt::format("  converted and rounded to {} bits, off by {} degrees; {} texels of padding converted too; PNG {} bytes, before {}",
                              r.image.type == PixelType::unorm16 ? 16 : 8, toText(r.error), r.padded, after, before));
    if (r.belowHorizon > 0)
        say(o.common, fmt::format("  {} texels point below the horizon of the frame", r.belowHorizon));
}

// Of a map that stays, no texel was looked at: those figures are missing.
nlohmann::ordered_json describeKept(const MapJob& job, const Image& map, const Spread& off, std::size_t bytes)
{
    return {{"image", job.image}, {"name", job.name}, {"surfaces", job.uses.size()}, {"size", {map.width, map.height}},
            {"kept", true}, {"degrees_unconverted", toJson(off)}, {"bytes_before", bytes}, {"bytes_after", bytes}};
}

nlohmann::ordered_json describe(const MapJob& job, const Reencoded& r, std::size_t before, std::size_t after)
{
    return {{"image", job.image}, {"name", job.name}, {"surfaces", job.uses.size()}, {"size", {r.image.width, r.image.height}},
            {"kept", false}, {"bits", r.image.type == PixelType::unorm16 ? 16 : 8}, {"texels_covered", r.covered}, {"texels_padded", r.padded},
            {"texels_in_several_places", r.several}, {"texels_that_disagree", r.disagreeing},
            {"disagreement_degrees", toJson(r.disagreement)}, {"moved_degrees", toJson(r.moved)},
            {"degrees_unconverted", toJson(r.unconverted)}, {"degrees_after_rounding", toJson(r.error)}, {"below_horizon", r.belowHorizon}, {"kept_elsewhere", job.alsoElsewhere},
            {"bytes_before", before}, {"bytes_after", after}};
}

// How far the old map is off when it is read with the new frame.
Spread errorAsItIs(const Image& map, const MapJob& job, const FramePair& frames)
{
    std::vector<const MapUse*> uses;
    for (const MapUse& use : job.uses)
        uses.push_back(&use);
    return mapError(map, map, uses, frames);
}

// Converts one image and puts it back.
Status convertMap(const ConvertCommandOptions& o, const FramePair& frames, GltfDocument& document, const MapJob& job,
                  std::vector<std::string>& notes, nlohmann::ordered_json& report)
{
    const auto bytes = gltfImageBytes(document, job.image);
    if (!bytes)
        return bytes.error();
    const auto map = decodeImage(*bytes, fmt::format("{}: {}", o.model, job.name), limitsFor(o.memory));
    if (!map)
        return withMemoryHint(map.error());
    const std::size_t before = bytes->size();
    // Where the old map serves as well as a rounded new one, it stays, byte for byte.
    if (const Spread off = errorAsItIs(*map, job, frames); off.count == 0 || (o.bits == 0 && fitsAsItIs(off))) {
        say(o.common, whyKept(o, job, off));
        report["maps"].push_back(describeKept(job, *map, off, before));
        return Done{};
    }
    if (const double copies = copiesOf(job.uses); !(copies <= kMostCopies))
        return inputError(fmt::format("{}: {}: the uv repeat the map {:.3g} times in all, expected at most {:.0f}", o.model, job.name,
                                      copies, kMostCopies));
    const int bits = o.bits != 0 ? o.bits : map->type == PixelType::unorm8 ? 8 : 16;
    Progress progress(o.common, std::size_t(map->height), "converting " + job.name);
    const Reencoded r = reencode(*map, job.uses, frames, bits, o.common.threads, [&] { progress.step(); });
    auto png = encodePng(r.image);
    if (!png)
        return png.error();
    const std::size_t after = png->size();
    replaceMap(document, job, std::move(*png), notes);
    sayMap(o, job, r, before, after);
    report["maps"].push_back(describe(job, r, before, after));
    const double share = double(r.disagreeing) / double(std::max<std::size_t>(r.covered, 1));
    if (share * r.disagreement.mean > kSeen)
        notes.push_back(fmt::format("{}: on {:.0f} % of it several places share a texel and want it different, {:.1f} degrees off "
                                    "on average at the worst of them: no one map fits; give such parts texels of their own",
                                    job.name, 100 * share, r.disagreement.mean));
    else if (r.error.mean > kSeen)
        notes.push_back(fmt::format("{}: converted, it is still off by {:.1f} degrees on average: its texels are too large for how the "
                                    "surface changes under them", job.name, r.error.mean));
    return Done{};
}

Status handleTangents(const ConvertCommandOptions& o, const FramePair& frames, GltfDocument& document, std::vector<std::string>& notes,
                      nlohmann::ordered_json& report)
{
    if (needsTangents(frames.to)) {
        const auto given = giveTangents(document, frames.to);
        if (!given)
            return given.error();
        say(o.common, fmt::format("{} got TANGENT for {}", counted(*given, "primitive"), o.to));
        report["tangents"] = {{"given_primitives", *given}};
        return Done{};
    }
    if (o.keepTangents) {
        notes.push_back("TANGENT stays, and a reader that follows it will show the converted maps wrongly");
        report["tangents"] = {{"kept", true}};
        return Done{};
    }
    const auto dropped = dropTangents(document, notes);
    if (!dropped)
        return dropped.error();
    const double each = dropped->vertices > 0 ? double(dropped->bytes) / double(dropped->vertices) : 0;
    say(o.common, dropped->bytes > 0
                      ? fmt::format("TANGENT dropped from {}: {:.3g} bytes a vertex, {} vertices, {} bytes", counted(dropped->primitives, "primitive"),
                                    each, dropped->vertices, dropped->bytes)
                      : "no TANGENT to drop");
    report["tangents"] = {{"dropped_primitives", dropped->primitives}, {"bytes_per_vertex", each},
                          {"vertices", dropped->vertices}, {"bytes", dropped->bytes}};
    return Done{};
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
    std::vector<std::string> notes;
    const auto jobs = mapJobs(document, notes);
    if (!jobs)
        return jobs.error();
    nlohmann::ordered_json report = {{"command", "convert"}, {"model", o.model}, {"from", o.from}, {"to", o.to},
                                     {"tangents_read", o.tangents}, {"output", o.common.output.string()},
                                     {"maps", nlohmann::ordered_json::array()}};
    if (!o.verify.empty()) // before anything is written
        if (Status made = makeFolder(o.verify); !made)
            return made;
    if (jobs->empty())
        notes.push_back("no primitive has a normal map and uv: nothing to convert");
    else
        say(o.common, "three figures are: mean / 95 % / maximum, by area of the surface");
    for (const MapJob& job : *jobs)
        if (Status converted = convertMap(o, *frames, document, job, notes, report); !converted)
            return converted;
    if (Status handled = handleTangents(o, *frames, document, notes, report); !handled)
        return handled;
    const auto& maps = report["maps"];
    const bool changed = std::any_of(maps.begin(), maps.end(), [](const auto& m) { return !m["kept"].template get<bool>(); });
    if (changed && frames->to != Frame::mikktspace)
        notes.push_back(fmt::format("the maps are now for the frame {}; readers that make MikkTSpace tangents where TANGENT is missing, as "
                                    "glTF asks, will show them wrongly", o.to));
    if (Status written = writeModel(o, document, report); !written)
        return written;
    for (const std::string& note : notes)
        warn(o.common, note);
    report["notes"] = notes;
    report["seconds"] = {{"convert", watch.lap()}};
    if (!o.verify.empty()) {
        auto verified = verifyConversion({o.model, o.common.output, frames->from, frames->to, o.tangents == "generated", o.verify, o.device, o.memory}, o.common);
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
