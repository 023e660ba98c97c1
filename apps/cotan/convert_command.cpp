#include "commands.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "bake/reports.hpp"
#include "convert_lines.hpp"
#include "core/try.hpp"
#include "cotan/convert.hpp"
#include "cotan/inspect.hpp"
#include "cotan/render.hpp"
#include "gltf_open.hpp"
#include "loading.hpp"
#include "maps/textures/make_texture.hpp"
#include "parse.hpp"
#include "picture/option_words.hpp"
#include "picture_options.hpp"
#include "verify.hpp"

namespace cotan::app {

namespace {

struct ConvertJob {
    std::string model;
    LoadLimits limits;
    std::optional<ConvertModelOptions> maps;  // none: only vertices change
    bool fileNamesFrom = false;               // the frame that the file names, if any, replaces maps->frames.from
    std::optional<ProvokingVertex> provoking; // none: vertices stay unchanged
    std::filesystem::path output;
    std::string compress;                // blocks for the normal maps; none: they stay
    std::optional<VerifyOptions> verify; // of `maps`, whose frames it gets
};

// ---- words to a job -------------------------------------------------------------------------

struct ConvertCommandOptions : CommonOptions {
    std::string model;
    std::string from, to;                    // empty `from`: the frame that the file names, else mikktspace
    ConvertModelOptions maps;                // what the options of maps say
    double maxDegrees = ChoiceLimits().mean; // for frames that are chosen
    std::optional<ProvokingVertex> provoking;
    std::string compress = "none";
    VerifyOptions verify;
};

Result<Frame> frameFor(const char* option, const std::string& text)
{
    const auto frame = parseFrame(text, option);
    if (frame && dependsOnView(*frame))
        return usageError(
            fmt::format("{}: expected a frame that does not depend on the view; found {}, for which no map can be made",
                        option, text));
    return frame;
}

Status checkTogether(const ConvertCommandOptions& o, bool chooses, bool verticesOnly)
{
    const ConvertModelOptions &maps = o.maps, unset;
    if ((maps.keepMaps || chooses) && (maps.keepTangents || maps.bits != unset.bits))
        return usageError(fmt::format("{}: {} drops only the tangents",
                                      maps.keepTangents ? "--keep-tangents" : "--bits",
                                      maps.keepMaps ? "--keep-maps" : "convert without --to-frame"));
    if (!chooses && o.maxDegrees != ChoiceLimits().mean)
        return usageError(fmt::format("--max-degrees: applies to frames that are chosen; leave out {}",
                                      o.to.empty() ? "--provoking, or add --keep-maps" : "--to-frame"));
    for (const auto& [option, given] : {std::pair{"--from-frame", !o.from.empty()},
                                        {"--tangents", maps.frames.fromTangents != unset.frames.fromTangents},
                                        {"--keep-tangents", maps.keepTangents},
                                        {"--bits", maps.bits != unset.bits},
                                        {"--unsigned", maps.expansion != unset.expansion},
                                        {"--compress", o.compress != "none"},
                                        {"--verify", !o.verify.folder.empty()}})
        if (given && verticesOnly)
            return usageError(
                fmt::format("{}: applies to converted maps only; expected --to-frame FRAME with it", option));
    return Done{};
}

Result<ConvertJob> jobOf(const ConvertCommandOptions& o)
{
    // --provoking alone concerns vertices only. Without --to-frame the frames are chosen by measurement, and the maps
    // stay.
    const bool verticesOnly = o.to.empty() && !o.maps.keepMaps && o.provoking, chooses = o.to.empty() && !verticesOnly;
    COTAN_CHECK(checkTogether(o, chooses, verticesOnly));
    COTAN_TRY(from, frameFor("--from-frame", o.from.empty() ? "mikktspace" : o.from));
    COTAN_TRY(to, o.to.empty() ? Frame::orthonormal : frameFor("--to-frame", o.to));
    if (o.maps.keepMaps && readsTangents(*to))
        return usageError(fmt::format(
            "--to-frame: expected a frame that reads no tangents, since --keep-maps drops them; found {}", name(*to)));
    if (o.output.empty())
        return usageError("convert needs -o FILE");
    COTAN_CHECK(checkGltfNames(o.model, o.output));
    std::error_code ignored;
    const bool verifies = !o.verify.folder.empty();
    if (verifies && std::filesystem::equivalent(o.model, o.output, ignored))
        return usageError(fmt::format("--verify: compares with {}, which -o replaces; expected another -o", o.model));
    const LoadLimits limits = limitsFor(o.verify.memory, chooses ? Pixels::normalMaps : Pixels::none);
    COTAN_CHECK(checkModelCompress(o.compress));
    ConvertJob job{o.model, limits, o.maps, o.from.empty(), o.provoking, o.output, o.compress, o.verify};
    job.maps->frames.from = *from;
    job.maps->frames.to = *to;
    if (chooses)
        job.maps->choose = ChoiceLimits::of(o.maxDegrees);
    job.maps->keepMaps |= chooses;
    job.maps->threads = o.threads;
    job.maps->memory = std::size_t(o.verify.memory) << 20;
    job.maps->limits = limits;
    job.verify->before = o.model;
    job.verify->after = o.output;
    if (verticesOnly)
        job.maps.reset();
    if (!verifies)
        job.verify.reset();
    return job;
}

// ---- the work -------------------------------------------------------------------------------

struct CompressedMap {
    StoredMap stored;
    maps::TextureCost cost;
};

struct ConvertResult {
    FramePair frames;
    ConvertModelReport maps;
    std::vector<GltfProvoked> provoked;
    std::vector<CompressedMap> compressed;
    GltfWritten written;
};

std::vector<PlannedOutput> outputsOf(const ConvertJob& job)
{
    std::vector<PlannedOutput> files;
    if (job.verify)
        files = plannedIn("--verify", job.verify->folder, imageNames(kConversionNames, kConversionViews));
    files.insert(files.begin(), {"-o", job.output});
    return files;
}

// Stores the normal maps as blocks. Their notes join those of the conversion.
Status compress(GltfDocument& document, const ConvertJob& job, const CommonOptions& terminal, ConvertResult& done)
{
    const Convention convention{.expansion = job.maps->expansion};
    std::vector<maps::TextureCost> costs;
    const auto encode = [&](const Image& map, const std::string&) -> Result<std::vector<std::byte>> {
        COTAN_TRY(texture, maps::makeTexture(map, {.from = convention, .to = convention, .compress = job.compress}));
        costs.push_back(texture->cost.value_or(maps::TextureCost{}));
        return std::move(texture->bytes);
    };
    COTAN_TRY(stored, withProgress(terminal, 1, "compressing the maps", [&](Progress progress) {
                  return storeNormalMaps(document, encode, maps::extensionOf(job.compress), job.limits, progress);
              }));
    for (std::size_t i = 0; i < costs.size(); ++i) {
        StoredMap& map = stored->maps[i];
        const auto named = std::ranges::find(done.maps.maps, map.image, &ConvertedMap::image);
        if (named != done.maps.maps.end()) // before the conversion, which may have replaced it
            map.name = named->name;
        done.compressed.push_back({std::move(map), costs[i]});
    }
    done.maps.notes.insert(done.maps.notes.end(), stored->notes.begin(), stored->notes.end());
    return Done{};
}

Result<ConvertResult> convert(ConvertJob job, const CommonOptions& terminal)
{
    ConvertResult done;
    COTAN_TRY(opened, openGltfToEdit(job.model, job.limits, terminal));
    if (job.maps) {
        COTAN_TRY(named, namedFrame(opened->document));
        if (job.fileNamesFrom)
            job.maps->frames.from = named->value_or(job.maps->frames.from);
        done.frames = job.maps->frames;
        COTAN_TRY(maps, withProgress(terminal, 1, "converting " + job.model, [&](Progress progress) {
                      job.maps->progress = std::move(progress);
                      return convertModel(*opened, *job.maps);
                  }));
        done.maps = std::move(*maps);
    }
    opened->scene = {}; // its memory
    if (job.provoking) {
        COTAN_TRY(provoked, setGltfProvoking(opened->document, *job.provoking));
        done.provoked = std::move(*provoked);
    }
    if (job.compress != "none")
        COTAN_CHECK(compress(opened->document, job, terminal, done));
    if (job.verify) // fails before anything is written
        COTAN_CHECK(makeFolder(job.verify->folder));
    COTAN_TRY(written, writeGltf(opened->document, job.output));
    done.written = std::move(*written);
    return done;
}

// ---- the report -----------------------------------------------------------------------------

std::vector<std::string> linesOf(const ConvertJob& job, const ConvertResult& done)
{
    std::vector<std::string> lines;
    const auto add = [&](std::vector<std::string> more) { lines.insert(lines.end(), more.begin(), more.end()); };
    const std::string to(name(done.frames.to));
    if (!done.maps.maps.empty())
        add({"three values are mean / 95 % / maximum, weighted by surface area"});
    for (const ConvertedMap& map : done.maps.maps)
        add(mapLines(map, to));
    if (job.maps)
        add(tangentsLines(done.maps, to));
    for (const auto& [map, cost] : done.compressed)
        add({fmt::format("{}: {} bytes in blocks, before {}; mean {:.3f}, 99 % {:.2f} degrees", map.name,
                         map.bytesAfter, map.bytesBefore, cost.mean, cost.percentile99)});
    if (!done.compressed.empty())
        add({"which devices and engines read these blocks: docs/how-to/mobile.md"});
    if (job.provoking)
        add({provokingLine(done.provoked, *job.provoking)});
    const double before = double(done.written.bytesBefore), after = double(done.written.bytesAfter);
    add({fmt::format("{}: {} bytes, before {}: {:.0f} ({:.1f} %) {}", job.output.string(), done.written.bytesAfter,
                     done.written.bytesBefore, std::abs(before - after),
                     100 * std::abs(before - after) / std::max(before, 1.0), after > before ? "more" : "less")});
    return lines;
}

Json toJson(const ConvertJob& job, const ConvertResult& done)
{
    Json report = {{"command", "convert"}, {"model", job.model}};
    if (job.maps)
        report.update({{"from", name(done.frames.from)},
                       {"to", job.maps->choose ? kAutoFrame : name(done.frames.to)},
                       {"tangents_read", wordOf(kTangentOrigins, done.frames.fromTangents)},
                       {"unsigned", wordOf(kExpansions, job.maps->expansion)}});
    report["output"] = job.output.string();
    report["maps"] = Json::array();
    for (const ConvertedMap& map : done.maps.maps)
        report["maps"].push_back(toJson(map));
    if (job.maps) {
        report["tangents"] = tangentsJson(done.maps);
        report["decisions"] = decisionsJson(done.maps.decisions);
    }
    if (job.provoking)
        report["provoking"] = provokingJson(done.provoked, *job.provoking);
    report["compressed"] = Json::array();
    for (const auto& [map, cost] : done.compressed)
        report["compressed"].push_back({{"name", map.name},
                                        {"bytes_before", map.bytesBefore},
                                        {"bytes_after", map.bytesAfter},
                                        {"mean_degrees", cost.mean},
                                        {"percentile99_degrees", cost.percentile99}});
    report["files"] = fileNames(done.written);
    report["bytes_before"] = done.written.bytesBefore;
    report["bytes_after"] = done.written.bytesAfter;
    report["notes"] = done.maps.notes;
    return report;
}

// Compares the written model with the old one, and adds the result to the report.
Status verify(VerifyOptions check, const ConvertJob& job, const ConvertResult& done, const CommonOptions& terminal,
              Json& report)
{
    check.from = done.frames.from;
    check.fromTangents = done.frames.fromTangents;
    check.to = job.maps->choose ? std::nullopt : std::optional(done.frames.to);
    COTAN_TRY(verified, verifyConversion(check, terminal));
    report["verify"] = std::move(*verified);
    return Done{};
}

Status run(const ConvertCommandOptions& o)
{
    COTAN_TRY(job, jobOf(o));
    const CommonOptions& terminal = o;
    COTAN_CHECK(beginOutputs(terminal, outputsOf(*job)));
    if (job->verify) // fails before any work
        COTAN_CHECK(openRenderer(job->verify->device, terminal.threads));
    Stopwatch watch;
    const auto done = convert(*job, terminal);
    if (!done)
        return withOptionNames(done.error());
    for (const std::string& line : linesOf(*job, *done))
        say(terminal, line);
    for (const std::vector<std::string>& notes : {done->written.notes, done->maps.notes})
        for (const std::string& note : notes)
            warn(terminal, note);
    Json report = toJson(*job, *done);
    report["seconds"] = {{"convert", watch.lap()}};
    if (job->verify) {
        COTAN_CHECK(verify(*job->verify, *job, *done, terminal, report));
        report["seconds"]["verify"] = watch.lap();
    }
    return writeReport(terminal, report);
}

// ---- the options ----------------------------------------------------------------------------

void declare(Arguments& a, ConvertCommandOptions& o)
{
    a.option("MODEL", o.model, "glTF or GLB file").required().reads();
    a.option("--from-frame", o.from,
             "frame that the maps were made for (default: the one that the file names, else mikktspace)")
        .in("FRAME")
        .offers(frameWords())
        .main();
    a.option("--to-frame", o.to,
             "frame to make the maps for; those of tangents write TANGENT, all others drop it (default: the maps stay, "
             "each primitive is read with the frame that is near enough, and tangents stay where none is)")
        .in("FRAME")
        .offers(frameWords())
        .main();
    addListOfFrames(a);
    addOlderName(a, "--from", "--from-frame", o.from);
    addOlderName(a, "--to", "--to-frame", o.to);
    addTangentsOption(a, o.maps.frames.fromTangents,
                      "for a --from-frame of tangents: stored (as in the file, generated where missing) or generated");
    a.flag("--keep-maps", o.maps.keepMaps,
           "keep the maps byte for byte, to be read with --to-frame, and drop only the tangents; where these reverse "
           "green of a map, its green is reversed, or they stay. Without --to-frame this is the default")
        .main();
    addMaxDegreesOption(a, o.maxDegrees);
    a.group(HelpGroup::output);
    a.flag("--keep-tangents", o.maps.keepTangents, "keep the tangents of the file");
    a.option("--bits", o.maps.bits,
             "bits of the new maps, 8 or 16; rewrites all maps (default: bits of the old map; a suitable map is kept)")
        .from({8, 16})
        .in("N")
        .withoutDefault();
    addModelCompress(a, o.compress);
    a.choice(
        "--unsigned", o.maps.expansion, kExpansions,
        "how the engine decodes the maps: biased (2c - 1, as glTF says and stock engines do) or exact (zero is 128, "
        "Cotan's default for maps that do not say)");
    a.choice(
         "--provoking", o.provoking, kProvokings,
         "give every triangle its own provoking vertex, its first (Vulkan, Direct3D, Metal, WebGPU) or its last "
         "(OpenGL, WebGL), for the frame triangle: vertex k provokes triangle k. Copies vertices; without --to-frame "
         "nothing else changes")
        .in("CORNER")
        .withoutDefault();
    addMemoryOption(a, o.verify.memory, ", and the maximum for the triangles of one map besides the model");
    a.option("--verify", o.verify.folder,
             "draw both models from five sides, compare normals, and write the images into this folder")
        .in("FOLDER")
        .writes()
        .main();
    addDeviceOption(a, o.verify.device, "for --verify: ");
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
