// cotan.h: lint of models in memory, and their images.
#include <algorithm>
#include <set>

#include "bake/convert/map_jobs.hpp"
#include "bake/reports.hpp"
#include "cotan/gltf.hpp"
#include "cotan/lint.hpp"
#include "gltf/json/lookup.hpp"
#include "meshes.hpp"
#include "model_files.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

std::string adviceOf(const LintReport& report)
{
    return report.advice == Advice::nothing ? "" : std::string(name(frameOf(report)));
}

double worst(const LintReport& report, ValueSummary MapFit::*frame)
{
    double degrees = -1;
    for (const MapFit& fit : report.fits)
        if ((fit.*frame).count > 0)
            degrees = std::max(degrees, (fit.*frame).mean);
    return degrees;
}

Json lintJson(const LintReport& report, const Scene& scene, const LintLimits& limits)
{
    Json json = {{"recommendation", report.recommendation},
                 {"advice", adviceOf(report)},
                 {"distance", report.distance},
                 {"primitives_dropping", report.dropping},
                 {"primitives_keeping", report.keeping},
                 {"drops_tangents", report.dropping > 0},
                 {"distrust_stored", report.distrustStored}};
    json.update(listsOf(report));
    json["check"] = toJson(checkLimits(report, limits));
    json["warnings"] = warningsOf(report, scene.warnings);
    return json;
}

void fill(const LintReport& report, cotan_lint_result& r)
{
    r.primitives = report.primitives.size();
    r.maps = report.maps.size();
    copyText(adviceOf(report), r.advice, sizeof r.advice);
    r.maps_to_convert = 0;
    r.distrust_stored = report.distrustStored;
    r.green_against =
        std::size_t(std::ranges::count_if(report.maps, [](const GreenEvidence& g) { return !g.asDeclared(); }));
    r.orthonormal_degrees = worst(report, &MapFit::orthonormal);
    r.cotangent_degrees = worst(report, &MapFit::cotangent);
    r.smooth_degrees = worst(report, &MapFit::smooth);
    copyText(report.recommendation, r.recommendation, sizeof r.recommendation);
}

cotan_lint_options lintOptionsOf(const cotan_lint_options* options, const cotan_lint_result* result)
{
    const cotan_lint_options o = optionsOf(options, "options");
    require(o.distance >= 0, "options.distance: expected 0 or more");
    require(o.limit >= 0 && o.limit <= 180, "options.limit: expected degrees from 0 to 180");
    const auto& frames = readingNames();
    require(!o.frame || std::ranges::find(frames, o.frame) != frames.end(),
            "options.frame: expected cotangent, orthonormal, smooth, exact, triangle or stored");
    require(o.limit_area >= 0 && o.limit_area <= 100, "options.limit_area: expected percent from 0 to 100");
    choiceLimitsOf(o.max_degrees);
    if (result)
        checked(result, "result");
    return o;
}

void lintInto(const Scene& scene, const cotan_lint_options& o, cotan_lint_result* result, cotan_bytes** json)
{
    const LintReport report = valueOf(lintScene(
        scene, {.distance = o.distance, .limits = choiceLimitsOf(o.max_degrees)}, progressOf(o.progress, o.user)));
    LintLimits limits;
    if (o.limit > 0)
        limits.degrees = o.limit;
    if (o.limit_area > 0)
        limits.area = o.limit_area;
    if (o.frame)
        limits.frame = o.frame;
    giveText("cotan-lint-result", lintJson(report, scene, limits), json);
    if (result)
        fill(report, *result);
}

} // namespace

cotan_status cotan_lint_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                             const cotan_lint_options* options, cotan_lint_result* result, cotan_bytes** json,
                             char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_lint_options o = lintOptionsOf(options, result);
        const ModelFiles source(model, model_size, files);
        lintInto(valueOf(loadGltf(source.name(), source.limits())), o, result, json);
    });
}

cotan_status cotan_lint_model(const cotan_model* model, const cotan_lint_options* options, cotan_lint_result* result,
                              cotan_bytes** json, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const Scene& scene = sceneOf(model, "model");
        lintInto(scene, lintOptionsOf(options, result), result, json);
    });
}

cotan_status cotan_gltf_images(const void* model, size_t model_size, const cotan_model_files* files, int maps_only,
                               cotan_take_file take, void* user, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(take, "take: expected a function, found null");
        const ModelFiles source(model, model_size, files);
        const LoadLimits limits = source.limits();
        const GltfDocument document = valueOf(openGltfDocument(source.name(), limits));
        std::set<std::size_t> wanted;
        if (maps_only != 0) {
            std::vector<std::string> notes;
            for (const MapJob& job : valueOf(mapJobs(document, notes, limits)))
                wanted.insert(job.image);
        } else {
            for (std::size_t i = 0; i < countOf(rootOf(document), "images"); ++i)
                wanted.insert(i);
        }
        for (const std::size_t image : wanted) {
            const Bytes bytes = valueOf(gltfImageBytes(document, image, limits));
            const std::string name = rootOf(document)["images"][image].value("name", "");
            if (take(user, name.c_str(), bytes.data(), bytes.size()) != 0)
                throw stoppedError();
        }
    });
}
