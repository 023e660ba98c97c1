#include "commands.hpp"

#include <fmt/format.h>

#include "bake/convert/choose_primitives.hpp"
#include "bake/reports.hpp"
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

TangentsOptions optionsOf(const TangentsCommandOptions& o, const Progress& progress)
{
    return {.frame = o.frame == "vertex" ? Frame::vertex : Frame::mikktspace,
            .replace = o.replace,
            .threads = o.threads,
            .progress = progress};
}

Json describe(const PrimitiveTangents& p)
{
    return {{"mesh", p.mesh},
            {"primitive", p.primitive},
            {"name", p.name},
            {"triangles", p.triangles},
            {"stored", p.stored}};
}

std::string referenceName(const TangentsCommandOptions& o)
{
    return o.frame == "vertex" ? "the classic tangents" : "MikkTSpace";
}

// The frame that reads the primitive's maps without tangents, or why these stay; empty if it has no such map.
std::string chosenFor(const PrimitiveTangents& p, const std::vector<PrimitiveDecision>& decisions)
{
    const FrameDecision* const d = decisionOf(decisions, {p.mesh, p.primitive});
    return d && d->reason != ChoiceReason::noMap ? "; its normal map: " + textOf(*d) : "";
}

// Reports the tangent differences of one primitive.
void reportDifference(const TangentsCommandOptions& o, const PrimitiveTangents& p,
                      const std::vector<PrimitiveDecision>& decisions, Json& row)
{
    std::string text = p.reason.empty() ? "no TANGENT" : p.reason;
    if (!p.reason.empty()) {
        row["cannot"] = p.reason;
    } else if (p.difference) {
        row.update(toJson(*p.difference));
        text = toText(*p.difference, referenceName(o));
    }
    say(o, "{} ({} triangles): {}{}", p.name, p.triangles, text, chosenFor(p, decisions));
}

// Compares stored tangents with generated ones.
Status compare(const TangentsCommandOptions& o, const GltfDocument& document, Json& report)
{
    const auto compared = withProgress(
        o, 1, "comparing", [&](const Progress& progress) { return compareTangents(document, optionsOf(o, progress)); });
    if (!compared)
        return compared.error();
    const auto decisions = choosePrimitives(document, {}, {Frame::mikktspace, Frame::orthonormal}, {});
    if (!decisions)
        return decisions.error();
    report["decisions"] = decisionsJson(*decisions);
    for (const PrimitiveTangents& p : compared->primitives) {
        auto row = describe(p);
        reportDifference(o, p, *decisions, row);
        report["primitives"].push_back(std::move(row));
    }
    const bool any = compared->whole.corners > 0;
    std::string verdict = any ? toText(compared->whole, referenceName(o)) : "no TANGENT is stored";
    if (any && compared->without > 0)
        verdict += fmt::format("; {} without TANGENT", counted(compared->without, "primitive"));
    report["model_verdict"] = verdict;
    if (any)
        report["whole"] = toJson(compared->whole);
    say(o, "whole model: " + verdict);
    return Done{};
}

// Generates tangents and writes the model.
Status write(const TangentsCommandOptions& o, GltfDocument& document, Json& report)
{
    const auto given = withProgress(
        o, 1, "generating", [&](const Progress& progress) { return giveTangents(document, optionsOf(o, progress)); });
    if (!given)
        return given.error();
    for (const PrimitiveTangents& p : given->primitives) {
        auto row = describe(p);
        row["generated"] = p.generated;
        if (!p.reason.empty()) {
            row["cannot"] = p.reason;
            warn(o, "{}: {}, no tangents", p.name, p.reason);
        }
        report["primitives"].push_back(std::move(row));
    }
    const auto written = writeGltfWithProgress(document, o);
    if (!written)
        return written.error();
    report["generated"] = given->generated;
    report["kept"] = given->kept;
    report["skipped"] = given->skipped;
    report["vertices_added"] = given->verticesAdded;
    report["bytes_before"] = written->bytesBefore;
    report["bytes_after"] = written->bytesAfter;
    report["files"] = fileNames(*written);
    report["notes"] = written->notes;
    say(o, "{} got {} tangents, {} kept theirs, {} cannot have any; {} vertices added",
        counted(given->generated, "primitive"), o.frame, given->kept, given->skipped, given->verticesAdded);
    say(o, "{}: {} bytes, before {}", o.output.string(), written->bytesAfter, written->bytesBefore);
    return Done{};
}

// Statistics of the frame `smooth`, which is derived when a model is loaded.
Status describeSmooth(const TangentsCommandOptions& o, const GltfDocument& document, Json& report)
{
    const auto primitives = gltfPrimitives(document);
    if (!primitives)
        return primitives.error();
    for (const GltfPrimitiveGeometry& p : *primitives) {
        const GltfGeometry& g = p.geometry;
        Json row = describe({p.mesh, p.primitive, p.name, g.indices.size() / 3, !g.tangents.empty()});
        std::string line = p.reason;
        if (p.reason.empty()) {
            const SmoothStatistics smooth = smoothStatistics(p.view());
            row.update(toJson(smooth));
            line = toText(smooth);
        }
        say(o, "{}: {}", p.name, line);
        report["primitives"].push_back(std::move(row));
    }
    return Done{};
}

Status checkUsage(const TangentsCommandOptions& o)
{
    if (o.frame != "mikktspace" && o.frame != "vertex" && o.frame != "smooth")
        return usageError(fmt::format("--frame: expected mikktspace, vertex or smooth; found '{}'", o.frame));
    if (o.frame == "smooth" && !o.output.empty())
        return usageError("--frame smooth is derived when a model is loaded and never stored; leave "
                          "out -o for its statistics");
    if (o.replace && o.output.empty())
        return usageError("--replace needs -o FILE");
    if (Status names = checkGltfNames(o.model, o.output); !names)
        return names;
    return beginOutputs(o, {{"-o", o.output}});
}

Status run(const TangentsCommandOptions& o)
{
    if (Status usage = checkUsage(o); !usage)
        return usage;
    Stopwatch watch;
    auto opened = openGltfToEdit(o.model, o);
    if (!opened)
        return opened.error();
    Json report = {{"command", "tangents"},
                   {"model", o.model},
                   {"frame", o.frame},
                   {"warnings", opened->warnings},
                   {"primitives", Json::array()}};
    const double load = watch.lap();
    GltfDocument& document = opened->document;
    Status done = o.frame == "smooth" ? describeSmooth(o, document, report)
        : o.output.empty()            ? compare(o, document, report)
                                      : write(o, document, report);
    if (!done)
        return done;
    report["seconds"] = {{"load", load}, {"work", watch.lap()}};
    return writeReport(o, report);
}

void declare(Arguments& a, TangentsCommandOptions& o)
{
    a.option("MODEL", o.model, "glTF or GLB file").required().reads();
    a.option("--frame", o.frame,
             "mikktspace (every shared edge joined, as in three.js 0.187), vertex (classic averages), or smooth "
             "(statistics only)")
        .in("NAME")
        .offers({"mikktspace", "vertex", "smooth"})
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
