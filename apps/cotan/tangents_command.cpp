#include "commands.hpp"

#include <fmt/format.h>

#include "bake/convert/choose_primitives.hpp"
#include "bake/reports.hpp"
#include "core/try.hpp"
#include "cotan/gltf.hpp"
#include "gltf_open.hpp"
#include "lint_lines.hpp"
#include "smooth_report.hpp"
#include "tangents_report.hpp"

namespace cotan::app {

namespace {

struct TangentsCommandOptions : CommonOptions {
    std::string model;
    std::string frame = "mikktspace";
    bool replace = false;
};

// ---- words to a job -------------------------------------------------------------------------

struct TangentsJob {
    std::string model;
    TangentsOptions tangents;     // frame: also smooth, for its statistics
    std::filesystem::path output; // empty: nothing is written
};

Result<TangentsJob> jobOf(const TangentsCommandOptions& o)
{
    const auto frame = frameFromName(o.frame);
    if (!frame || !readsVertices(*frame))
        return usageError(
            fmt::format("--frame: expected mikktspace, area-weighted, vertex or smooth; found '{}'", o.frame));
    if (frame == Frame::smooth && !o.output.empty())
        return usageError("--frame smooth is derived when a model is loaded and never stored; leave "
                          "out -o for its statistics");
    if (o.replace && o.output.empty())
        return usageError("--replace needs -o FILE");
    COTAN_CHECK(checkGltfNames(o.model, o.output));
    return TangentsJob{o.model, {.frame = *frame, .replace = o.replace, .threads = o.threads}, o.output};
}

// ---- the work and its report ----------------------------------------------------------------

// The lines and the JSON of what was done.
struct TangentsReport {
    std::vector<std::string> lines, warnings;
    Json json = Json::object();
};

Json describe(const PrimitiveTangents& p)
{
    return {{"mesh", p.mesh},
            {"primitive", p.primitive},
            {"name", p.name},
            {"triangles", p.triangles},
            {"stored", p.stored}};
}

// The frame that reads the primitive's maps without tangents, or why these stay; empty if it has no such map.
std::string chosenFor(const PrimitiveTangents& p, const std::vector<PrimitiveDecision>& decisions)
{
    const FrameDecision* const d = decisionOf(decisions, {p.mesh, p.primitive});
    return d && d->reason != ChoiceReason::noMap ? "; its normal map: " + textOf(*d) : "";
}

// Compares stored tangents with generated ones.
Result<TangentsReport> compare(OpenGltf& model, const TangentsOptions& options)
{
    const std::string reference = options.frame == Frame::vertex ? "the classic tangents"
        : options.frame == Frame::areaWeighted                   ? "meshoptimizer's"
                                                                 : "MikkTSpace";
    COTAN_TRY(compared, compareTangents(model.document, options));
    COTAN_TRY(
        decisions,
        choosePrimitives(model.document, {}, {Frame::mikktspace, Frame::orthonormal}, {}, std::move(model.scene)));
    TangentsReport report;
    report.json["decisions"] = decisionsJson(*decisions);
    for (const PrimitiveTangents& p : compared->primitives) {
        Json row = describe(p);
        std::string text = p.reason.empty() ? "no TANGENT" : p.reason;
        if (!p.reason.empty()) {
            row["cannot"] = p.reason;
        } else if (p.difference) {
            row.update(toJson(*p.difference));
            text = toText(*p.difference, reference);
            row["area_weighted"] = p.areaWeighted;
            if (p.areaWeighted)
                text += "; equal to area-weighted, meshoptimizer's tangents";
        }
        report.lines.push_back(
            fmt::format("{} ({} triangles): {}{}", p.name, p.triangles, text, chosenFor(p, *decisions)));
        report.json["primitives"].push_back(std::move(row));
    }
    const bool any = compared->whole.corners > 0;
    std::string verdict = any ? toText(compared->whole, reference) : "no TANGENT is stored";
    if (any && compared->without > 0)
        verdict += fmt::format("; {} without TANGENT", counted(compared->without, "primitive"));
    report.json["model_verdict"] = verdict;
    if (any)
        report.json["whole"] = toJson(compared->whole);
    report.lines.push_back("whole model: " + verdict);
    return report;
}

// Generates tangents and writes the model.
Result<TangentsReport> write(GltfDocument& document, const TangentsOptions& options, const std::filesystem::path& file)
{
    COTAN_TRY(given, giveTangents(document, options));
    COTAN_TRY(written, writeGltf(document, file));
    TangentsReport report;
    for (const PrimitiveTangents& p : given->primitives) {
        Json row = describe(p);
        row["generated"] = p.generated;
        if (!p.reason.empty()) {
            row["cannot"] = p.reason;
            report.warnings.push_back(fmt::format("{}: {}, no tangents", p.name, p.reason));
        }
        report.json["primitives"].push_back(std::move(row));
    }
    report.warnings.insert(report.warnings.end(), written->notes.begin(), written->notes.end());
    report.json.update({{"generated", given->generated},
                        {"kept", given->kept},
                        {"skipped", given->skipped},
                        {"vertices_added", given->verticesAdded},
                        {"bytes_before", written->bytesBefore},
                        {"bytes_after", written->bytesAfter},
                        {"files", fileNames(*written)},
                        {"notes", written->notes}});
    report.lines = {fmt::format("{} got {} tangents, {} kept theirs, {} cannot have any; {} vertices added",
                                counted(given->generated, "primitive"), name(options.frame), given->kept,
                                given->skipped, given->verticesAdded),
                    fmt::format("{}: {} bytes, before {}", file.string(), written->bytesAfter, written->bytesBefore)};
    return report;
}

// Statistics of the frame `smooth`, which is derived when a model is loaded.
Result<TangentsReport> describeSmooth(const GltfDocument& document)
{
    COTAN_TRY(primitives, gltfPrimitives(document));
    TangentsReport report;
    for (const GltfPrimitiveGeometry& p : *primitives) {
        const GltfGeometry& g = p.geometry;
        Json row = describe({p.mesh, p.primitive, p.name, g.indices.size() / 3, !g.tangents.empty()});
        std::string line = p.reason;
        if (p.reason.empty()) {
            const SmoothStatistics smooth = smoothStatistics(p.view());
            row.update(toJson(smooth));
            line = toText(smooth);
        }
        report.lines.push_back(fmt::format("{}: {}", p.name, line));
        report.json["primitives"].push_back(std::move(row));
    }
    return report;
}

Status run(const TangentsCommandOptions& o)
{
    COTAN_TRY(job, jobOf(o));
    const CommonOptions& terminal = o;
    COTAN_CHECK(beginOutputs(terminal, {{"-o", job->output}}));
    Stopwatch watch;
    LoadLimits limits;
    const bool compares = job->output.empty() && job->tangents.frame != Frame::smooth;
    limits.pixels = compares ? Pixels::normalMaps : Pixels::none;
    COTAN_TRY(opened, openGltfToEdit(job->model, limits, terminal));
    Json json = {{"command", "tangents"},
                 {"model", job->model},
                 {"frame", name(job->tangents.frame)},
                 {"warnings", opened->scene.warnings},
                 {"primitives", Json::array()}};
    const double load = watch.lap();
    const auto done =
        withProgress(terminal, 1, job->output.empty() ? "comparing" : "generating", [&](Progress progress) {
            TangentsOptions options = job->tangents;
            options.progress = std::move(progress);
            return compares           ? compare(*opened, options)
                : job->output.empty() ? describeSmooth(opened->document)
                                      : write(opened->document, options, job->output);
        });
    if (!done)
        return done.error();
    for (const std::string& line : done->warnings)
        warn(terminal, line);
    for (const std::string& line : done->lines)
        say(terminal, line);
    json.update(done->json);
    json["seconds"] = {{"load", load}, {"work", watch.lap()}};
    return writeReport(terminal, json);
}

// ---- the options ----------------------------------------------------------------------------

void declare(Arguments& a, TangentsCommandOptions& o)
{
    a.option("MODEL", o.model, "glTF or GLB file").required().reads();
    a.option("--frame", o.frame,
             "mikktspace (every shared edge joined, as in three.js 0.187), area-weighted (meshoptimizer's default), "
             "vertex (classic averages), or smooth (statistics only)")
        .in("NAME")
        .offers({"mikktspace", "area-weighted", "vertex", "smooth"})
        .main();
    a.flag("--replace", o.replace,
           "generate tangents also where the file has them; without this only where they are missing")
        .main();
}

} // namespace

void addTangentsCommand(Arguments& tool)
{
    addCommand<TangentsCommandOptions>(
        tool,
        {"tangents",
         "Write tangents into a glTF model; without -o, compare those in the file with MikkTSpace.",
         "the model with tangents, .glb or .gltf",
         {"cotan tangents model.glb", "cotan tangents model.glb --replace -o with-tangents.glb"}},
        declare, run);
}

} // namespace cotan::app
