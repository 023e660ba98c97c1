#include "commands.hpp"

#include <fmt/format.h>

#include "cotan/report/tangent_difference.hpp"
#include "cotan/tangents.hpp"
#include "gltf_open.hpp"
#include "gltf_placed.hpp"
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

// What happens with one primitive.
struct Entry {
    std::size_t mesh = 0, primitive = 0;
    std::string name;
    GltfGeometry geometry;
    std::string cannot; // why there are no tangents to be had; empty if there are

    MeshView view() const
    {
        return {geometry.positions, geometry.normals, geometry.texcoords, geometry.indices};
    }
};

std::string whyNot(const GltfGeometry& geometry)
{
    if (geometry.indices.empty())
        return "no triangles";
    if (geometry.normals.empty())
        return "no NORMAL";
    if (geometry.texcoords.empty())
        return fmt::format("no TEXCOORD_{}", geometry.texcoordSet);
    return {};
}

Result<std::vector<Entry>> readEntries(const GltfDocument& document)
{
    std::vector<Entry> entries;
    if (!document.root.contains("meshes"))
        return entries;
    const auto& meshes = document.root["meshes"];
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (std::size_t p = 0; p < meshes[m]["primitives"].size(); ++p) {
            auto geometry = gltfGeometry(document, m, p);
            if (!geometry)
                return geometry.error();
            Entry entry{m, p, meshes[m].value("name", fmt::format("mesh {}", m)),
                        std::move(*geometry), {}};
            if (meshes[m]["primitives"].size() > 1)
                entry.name += fmt::format("/{}", p);
            entry.cannot = whyNot(entry.geometry);
            makeUnit(entry.geometry.normals);
            entries.push_back(std::move(entry));
        }
    return entries;
}

std::vector<glm::vec4> generate(const TangentsCommandOptions& o, const Entry& entry)
{
    return o.frame == "vertex" ? vertexTangents(entry.view()) : mikktspaceTangents(entry.view(), o.common.threads);
}

nlohmann::ordered_json describe(const Entry& entry)
{
    return {{"mesh", entry.mesh},
            {"primitive", entry.primitive},
            {"name", entry.name},
            {"triangles", entry.geometry.indices.size() / 3},
            {"stored", !entry.geometry.tangents.empty()}};
}

std::string referenceName(const TangentsCommandOptions& o)
{
    return o.frame == "vertex" ? "the classic tangents" : "MikkTSpace";
}

// Compares what is stored.
void compare(const TangentsCommandOptions& o, const std::vector<Entry>& entries, nlohmann::ordered_json& report)
{
    TangentDifference all;
    std::size_t without = 0;
    Progress progress(o.common, entries.size(), "comparing");
    for (const Entry& entry : entries) {
        auto row = describe(entry);
        const std::string label = fmt::format("{} ({} triangles)", entry.name,
                                              entry.geometry.indices.size() / 3);
        if (!entry.cannot.empty()) {
            row["cannot"] = entry.cannot;
            say(o.common, fmt::format("{}: {}", label, entry.cannot));
        } else if (entry.geometry.tangents.empty()) {
            ++without;
            say(o.common, fmt::format("{}: no TANGENT", label));
        } else {
            const TangentDifference d =
                tangentDifference(entry.view(), entry.geometry.tangents, generate(o, entry));
            row.update(toJson(d));
            say(o.common, fmt::format("{}: {}", label, toText(d, referenceName(o))));
            append(all, d);
        }
        report["primitives"].push_back(std::move(row));
        progress.step();
    }
    std::string verdict = "no TANGENT is stored";
    if (all.corners > 0)
        verdict = toText(all, referenceName(o));
    if (all.corners > 0 && without > 0)
        verdict += fmt::format("; {} without TANGENT", counted(without, "primitive"));
    report["model_verdict"] = verdict;
    if (all.corners > 0)
        report["whole"] = toJson(all);
    say(o.common, "whole model: " + verdict);
}

// Generates and writes.
Status write(const TangentsCommandOptions& o, GltfDocument& document, const std::vector<Entry>& entries,
             nlohmann::ordered_json& report)
{
    std::vector<GltfCornerTangents> tangents;
    std::size_t kept = 0, skipped = 0;
    {
        Progress progress(o.common, entries.size(), "generating");
        for (const Entry& entry : entries) {
            auto row = describe(entry);
            const bool keep = !entry.geometry.tangents.empty() && !o.replace;
            row["generated"] = entry.cannot.empty() && !keep;
            if (!entry.cannot.empty()) {
                ++skipped;
                row["cannot"] = entry.cannot;
                warn(o.common, fmt::format("{}: {}, no tangents", entry.name, entry.cannot));
            } else if (keep) {
                ++kept;
            } else {
                tangents.push_back({entry.mesh, entry.primitive, generate(o, entry)});
            }
            report["primitives"].push_back(std::move(row));
            progress.step();
        }
    }
    const auto added = setGltfTangents(document, tangents);
    if (!added)
        return added.error();
    const auto written = writeGltf(document, o.common.output);
    if (!written)
        return written.error();
    for (const std::string& note : written->notes)
        warn(o.common, note);
    std::vector<std::string> files;
    for (const auto& file : written->files)
        files.push_back(file.string());
    report["generated"] = tangents.size();
    report["kept"] = kept;
    report["skipped"] = skipped;
    report["vertices_added"] = *added;
    report["bytes_before"] = written->bytesBefore;
    report["bytes_after"] = written->bytesAfter;
    report["files"] = files;
    report["notes"] = written->notes;
    say(o.common, fmt::format("{} got {} tangents, {} kept theirs, {} can have none; "
                              "{} vertices added", counted(tangents.size(), "primitive"), o.frame, kept, skipped, *added));
    say(o.common, fmt::format("{}: {} bytes, before {}", o.common.output.string(),
                              written->bytesAfter, written->bytesBefore));
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
    const auto entries = readEntries(opened->document);
    if (!entries)
        return entries.error();
    nlohmann::ordered_json report = {{"command", "tangents"},
                                     {"model", o.model},
                                     {"frame", o.frame},
                                     {"warnings", opened->warnings},
                                     {"primitives", nlohmann::ordered_json::array()}};
    const double load = watch.lap();
    if (o.frame == "smooth") {
        for (const Entry& entry : *entries) {
            auto row = describe(entry);
            const std::string line = entry.cannot.empty()
                ? reportSmooth(entry.view(), row)
                : entry.cannot;
            say(o.common, fmt::format("{}: {}", entry.name, line));
            report["primitives"].push_back(std::move(row));
        }
    } else if (o.common.output.empty()) {
        compare(o, *entries, report);
    } else if (Status written = write(o, opened->document, *entries, report); !written) {
        return written;
    }
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
