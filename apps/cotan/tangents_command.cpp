#include "commands.hpp"

#include <fmt/format.h>

#include "cotan/gltf/tangents.hpp"
#include "cotan/report/tangent_difference.hpp"
#include "gltf_open.hpp"
#include "progress.hpp"
#include "smooth_report.hpp"

namespace cotan::app {

namespace {

struct TangentsCommandOptions {
    CommonOptions common;
    std::string model;
    std::string frame = "mikktspace";
    bool replace = false;
};

TangentsOptions optionsOf(const TangentsCommandOptions& o, Progress& progress)
{
    return {.frame = o.frame == "vertex" ? Frame::vertex : Frame::mikktspace, .replace = o.replace, .threads = o.common.threads,
            .progress = progress.within()};
}

nlohmann::ordered_json describe(const PrimitiveTangents& p)
{
    return {{"mesh", p.mesh}, {"primitive", p.primitive}, {"name", p.name}, {"triangles", p.triangles}, {"stored", p.stored}};
}

std::string referenceName(const TangentsCommandOptions& o)
{
    return o.frame == "vertex" ? "the classic tangents" : "MikkTSpace";
}

// Says of one primitive how far its tangents are off.
void reportDifference(const TangentsCommandOptions& o, const PrimitiveTangents& p, nlohmann::ordered_json& row)
{
    std::string said = p.cannot.empty() ? "no TANGENT" : p.cannot;
    if (!p.cannot.empty()) {
        row["cannot"] = p.cannot;
    } else if (p.difference) {
        row.update(toJson(*p.difference));
        said = toText(*p.difference, referenceName(o));
    }
    say(o.common, fmt::format("{} ({} triangles): {}", p.name, p.triangles, said));
}

// Compares what is stored.
Status compare(const TangentsCommandOptions& o, const GltfDocument& document, nlohmann::ordered_json& report)
{
    Progress progress(o.common, 1, "comparing");
    const auto compared = compareTangents(document, optionsOf(o, progress));
    if (!compared)
        return compared.error();
    for (const PrimitiveTangents& p : compared->primitives) {
        auto row = describe(p);
        reportDifference(o, p, row);
        report["primitives"].push_back(std::move(row));
    }
    const bool any = compared->whole.corners > 0;
    std::string verdict = any ? toText(compared->whole, referenceName(o)) : "no TANGENT is stored";
    if (any && compared->without > 0)
        verdict += fmt::format("; {} without TANGENT", counted(compared->without, "primitive"));
    report["model_verdict"] = verdict;
    if (any)
        report["whole"] = toJson(compared->whole);
    say(o.common, "whole model: " + verdict);
    return Done{};
}

// Generates and writes.
Status write(const TangentsCommandOptions& o, GltfDocument& document, nlohmann::ordered_json& report)
{
    Result<TangentsGiven> given = TangentsGiven{};
    {
        Progress progress(o.common, 1, "generating");
        given = giveTangents(document, optionsOf(o, progress));
    }
    if (!given)
        return given.error();
    for (const PrimitiveTangents& p : given->primitives) {
        auto row = describe(p);
        row["generated"] = p.generated;
        if (!p.cannot.empty()) {
            row["cannot"] = p.cannot;
            warn(o.common, fmt::format("{}: {}, no tangents", p.name, p.cannot));
        }
        report["primitives"].push_back(std::move(row));
    }
    const auto written = writeGltf(document, o.common.output);
    if (!written)
        return written.error();
    for (const std::string& note : written->notes)
        warn(o.common, note);
    std::vector<std::string> files;
    for (const auto& file : written->files)
        files.push_back(file.string());
    report["generated"] = given->generated;
    report["kept"] = given->kept;
    report["skipped"] = given->skipped;
    report["vertices_added"] = given->verticesAdded;
    report["bytes_before"] = written->bytesBefore;
    report["bytes_after"] = written->bytesAfter;
    report["files"] = files;
    report["notes"] = written->notes;
    say(o.common, fmt::format("{} got {} tangents, {} kept theirs, {} can have none; {} vertices added",
                              counted(given->generated, "primitive"), o.frame, given->kept, given->skipped, given->verticesAdded));
    say(o.common, fmt::format("{}: {} bytes, before {}", o.common.output.string(),
                              written->bytesAfter, written->bytesBefore));
    return Done{};
}

// Statistics of the frame that is derived when a model is loaded.
Status describeSmooth(const TangentsCommandOptions& o, const GltfDocument& document, nlohmann::ordered_json& report)
{
    const auto primitives = gltfPrimitives(document);
    if (!primitives)
        return primitives.error();
    for (const GltfPrimitiveGeometry& p : *primitives) {
        const GltfGeometry& g = p.geometry;
        auto row = describe({p.mesh, p.primitive, p.name, g.indices.size() / 3, !g.tangents.empty()});
        const std::string line = p.cannot.empty() ? reportSmooth(smoothStatistics(p.view()), row) : p.cannot;
        say(o.common, fmt::format("{}: {}", p.name, line));
        report["primitives"].push_back(std::move(row));
    }
    return Done{};
}

Status checkUsage(const TangentsCommandOptions& o)
{
    if (o.frame != "mikktspace" && o.frame != "vertex" && o.frame != "smooth")
        return usageError(fmt::format(
            "--frame: expected mikktspace, vertex or smooth; found '{}'", o.frame));
    if (o.frame == "smooth" && !o.common.output.empty())
        return usageError("--frame smooth is derived when a model is loaded and never stored; leave "
                          "out -o for its statistics");
    if (o.replace && o.common.output.empty())
        return usageError("--replace: expected -o FILE to write to; found none");
    if (Status names = checkGltfNames(o.model, o.common.output); !names)
        return names;
    return planOutputs(o.common, {{"-o", o.common.output}});
}

Status run(const TangentsCommandOptions& o)
{
    if (Status usage = checkUsage(o); !usage)
        return usage;
    Stopwatch watch;
    auto opened = openGltfToEdit(o.model, o.common);
    if (!opened)
        return opened.error();
    nlohmann::ordered_json report = {{"command", "tangents"},
                                     {"model", o.model},
                                     {"frame", o.frame},
                                     {"warnings", opened->warnings},
                                     {"primitives", nlohmann::ordered_json::array()}};
    const double load = watch.lap();
    GltfDocument& document = opened->document;
    Status done = o.frame == "smooth"       ? describeSmooth(o, document, report)
                  : o.common.output.empty() ? compare(o, document, report)
                                            : write(o, document, report);
    if (!done)
        return done;
    report["seconds"] = {{"load", load}, {"work", watch.lap()}};
    return writeReport(o.common, report);
}

} // namespace

Command addTangentsCommand(CLI::App& app)
{
    auto options = std::make_shared<TangentsCommandOptions>();
    CLI::App* command = app.add_subcommand(
        "tangents", "write tangents into a glTF model; without -o say of those in it whether they equal "
                    "MikkTSpace, w is inverted, half of them are turned, or how far off they are");
    addCommonOptions(*command, options->common, "the model with tangents, .glb or .gltf");
    command->add_option("MODEL", options->model, "glTF or GLB file")->required();
    command->add_option("--frame", options->frame,
                        "mikktspace, vertex (classic averages), or smooth (statistics only)")
        ->capture_default_str();
    command->add_flag("--replace", options->replace,
                      "generate also where the file has TANGENT; else only where it is missing");
    addExamples(*command, {"cotan tangents model.glb",
                           "cotan tangents model.glb --replace -o with-tangents.glb"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
