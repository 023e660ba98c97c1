#include "commands.hpp"

#include <optional>

#include <fmt/format.h>

#include "bake/reports.hpp"
#include "core/try.hpp"
#include "cotan/inspect.hpp"
#include "cotan/lint.hpp"
#include "cotan/render.hpp"
#include "gltf_open.hpp"
#include "lint_lines.hpp"
#include "loading.hpp"
#include "map_files/choose.hpp"
#include "terminal/shell_words.hpp"

namespace cotan::app {

namespace {

struct LintJob {
    std::string model;
    OwnMaps maps;
    int memory = kDefaultMemory; // MiB
    LoadLimits load;
    LintOptions lint;
    LintLimits limits;
    bool details = false; // also in the lines
};

struct LintCommandOptions : CommonOptions {
    LintJob job; // but for `load` and `lint.memory`
    Up up = Up::y;
    bool strict = false;
    double maxDegrees = ChoiceLimits().mean; // for frames that are chosen
};

Result<LintJob> jobOf(const LintCommandOptions& o)
{
    LintJob job = o.job;
    const LintLimits& limits = job.limits;
    if (!(job.lint.distance >= 0 && job.lint.distance <= 1e9))
        return usageError(fmt::format("--distance: expected a number from 0 to 1e9; found {}", job.lint.distance));
    const auto outside = [](double limit, double max) { return !(limit == -1 || (limit >= 0 && limit <= max)); };
    if (outside(limits.degrees, 180))
        return usageError(fmt::format("--limit: expected degrees from 0 to 180; found {}", limits.degrees));
    if (outside(limits.area, 100))
        return usageError(fmt::format("--limit-area: expected percent from 0 to 100; found {}", limits.area));
    if (o.strict && limits.degrees < 0 && limits.area < 0)
        return usageError("--strict: expected --limit DEGREES or --limit-area PERCENT; found neither");
    job.load = limitsFor(job.memory, Pixels::whereReadable);
    job.load.up = o.up;
    job.load.keepsJpeg = job.details;
    job.lint.memory = std::size_t(job.memory) << 20;
    job.lint.limits = ChoiceLimits::of(o.maxDegrees);
    return job;
}

// ---- the work -------------------------------------------------------------------------------

struct LintResult {
    Scene scene; // with the given maps
    LintReport report;
    LintCheck check;
    std::vector<ProblemArea> areas;
    std::string command;                          // that follows the advice; empty if it would change nothing
    std::vector<std::vector<TriedFormat>> blocks; // with details: what formats would cost each of report.maps
    std::vector<std::optional<CostBefore>> lost;  // with details: what its file has cost each of them
    double loadSeconds = 0, seconds = 0;          // seconds: of the measurements
};

std::string commandFor(const LintJob& job, const LintReport& report)
{
    if (report.advice == Advice::nothing || !job.maps.normal.empty()) // convert reads the model's own maps
        return {};
    const std::string stem = std::filesystem::path(job.model).stem().string();
    if (!namedAsGltf(job.model)) // convert writes glTF only
        return fmt::format("cotan render {} --frame orthonormal -o {}", quoted(job.model), quoted(stem + ".png"));
    if (report.dropping == 0)
        return {};
    return fmt::format("cotan convert {}{} -o {} --verify {}", quoted(job.model),
                       report.distrustStored ? " --tangents generated" : "", quoted(stem + "-free.glb"),
                       quoted(stem + "-verify"));
}

// The image of a map. Null without pixels.
const Image* imageOf(const GreenEvidence& map, const Scene& scene)
{
    const Image* const image = map.image >= 0 ? &scene.images[std::size_t(map.image)] : nullptr;
    return image && !image->data.empty() ? image : nullptr;
}

Result<LintResult> lint(const LintJob& job, const CommonOptions& terminal)
{
    Stopwatch watch;
    COTAN_TRY(scene, loadWithProgress(terminal, job.load, job.model));
    COTAN_CHECK(applyOwnMaps(job.maps, job.load, *scene));
    LintResult done;
    done.scene = *std::move(scene);
    done.loadSeconds = watch.lap();
    COTAN_TRY(report, withProgress(terminal, 1, "measuring " + job.model, [&](const Progress& progress) {
                  return lintScene(done.scene, job.lint, progress);
              }));
    done.report = std::move(*report);
    done.check = checkLimits(done.report, job.limits);
    done.command = commandFor(job, done.report);
    if (!done.report.primitives.empty())
        done.areas = problemAreas(done.scene);
    // Maps without pixels cost nothing: their list is empty.
    for (const GreenEvidence& map : done.report.maps) {
        const Image* const image = job.details ? imageOf(map, done.scene) : nullptr;
        constexpr Convention kRead{.expansion = Expansion::biased};
        done.blocks.push_back(image ? costsOf(*image, kRead) : std::vector<TriedFormat>());
        done.lost.push_back(image ? costBefore(*image, kRead) : std::nullopt);
    }
    done.seconds = watch.lap();
    return done;
}

// ---- the report -----------------------------------------------------------------------------

std::string nameOf(const GreenEvidence& map)
{
    return map.name.empty() ? fmt::format("image {}", map.image) : map.name;
}

std::vector<std::string> linesOf(const LintJob& job, const LintResult& done)
{
    std::vector<std::string> lines = verdictLines(job.model, done.report, done.command);
    std::vector<std::string> details = detailLines(done.report);
    for (const ProblemArea& area : done.areas)
        details.push_back(fmt::format("look: {}: --camera {}", area.text, formatCamera(area.camera)));
    for (std::size_t i = 0; i < done.blocks.size(); ++i) {
        if (job.details && done.blocks[i].empty())
            continue;
        std::string line =
            fmt::format("as blocks, {} would be off by these degrees, mean and 99 %:", nameOf(done.report.maps[i]));
        for (const TriedFormat& format : done.blocks[i])
            line += fmt::format(" {} {:.2f}, {:.1f};", format.compress, format.meanDegrees, format.percentile99);
        line.back() = '.';
        details.push_back(std::move(line));
    }
    for (std::size_t i = 0; i < done.lost.size(); ++i)
        if (done.lost[i])
            details.push_back(fmt::format("{}: its file ({}) has already cost about {:.2f} degrees on average, "
                                          "estimated from what it holds",
                                          nameOf(done.report.maps[i]), done.lost[i]->format,
                                          done.lost[i]->meanDegrees));
    const std::vector<std::string> checks = job.limits.any()
        ? checkLines(done.check, job.details ? done.check.failures.size() : 1)
        : std::vector<std::string>();
    lines.insert(lines.end(), checks.begin(), checks.end());
    if (job.details)
        lines.insert(lines.end(), details.begin(), details.end());
    else
        lines.push_back(fmt::format("--details adds {} lines: the statistics of each primitive and map, and cameras "
                                    "that look at the problem areas",
                                    details.size()));
    return lines;
}

Json toJson(const LintJob& job, const LintResult& done)
{
    const LintReport& report = done.report;
    Json j = {{"command", "lint"},
              {"model", job.model},
              {"warnings", warningsOf(report, done.scene.warnings)},
              {"distance", report.distance},
              {"verdict", verdictLines(job.model, report, done.command)},
              {"recommendation", report.recommendation},
              {"run", done.command},
              {"run_would",
               {{"primitives_dropping", report.dropping},
                {"primitives_keeping", report.keeping},
                {"drops_tangents", report.dropping > 0}}}};
    j.update(listsOf(report));
    Json areas = Json::array();
    for (const ProblemArea& area : done.areas)
        areas.push_back({{"text", area.text},
                         {"mesh", done.scene.meshes[area.mesh].name},
                         {"fraction", area.share},
                         {"camera", formatCamera(area.camera)}});
    j["problem_areas"] = areas;
    Json blocks = Json::array();
    for (std::size_t i = 0; i < done.blocks.size(); ++i)
        for (const TriedFormat& format : done.blocks[i])
            blocks.emplace_back(Json{{"map", done.report.maps[i].name}}).update(toJson(format));
    j["as_blocks"] = blocks;
    Json lost = Json::array();
    for (std::size_t i = 0; i < done.lost.size(); ++i)
        if (done.lost[i])
            lost.push_back({{"map", done.report.maps[i].name},
                            {"compress", done.lost[i]->format},
                            {"mean_degrees", done.lost[i]->meanDegrees}});
    j["lost_before"] = lost;
    j["check"] = toJson(done.check);
    j["over_limit"] = overLimits(done.check);
    j["seconds"] = {{"load", done.loadSeconds}, {"lint", done.seconds}};
    return j;
}

Status run(const LintCommandOptions& o)
{
    COTAN_TRY(job, jobOf(o));
    const CommonOptions& terminal = o;
    COTAN_CHECK(beginOutputs(terminal, {}));
    const auto done = lint(*job, terminal);
    if (!done)
        return withOptionNames(done.error());
    for (const std::string& line : done->scene.warnings)
        warn(terminal, line);
    for (const GreenEvidence& map : done->report.maps)
        if (!map.note.empty())
            warn(terminal, "normal map {}: {}", nameOf(map), map.note);
    for (const std::string& line : linesOf(*job, *done))
        say(terminal, line);
    COTAN_CHECK(writeReport(terminal, toJson(*job, *done)));
    if (!done->check.passed())
        return Error{ErrorKind::limit, summaryOf(done->check)};
    return Done{};
}

// ---- the options ----------------------------------------------------------------------------

void declare(Arguments& a, LintCommandOptions& o)
{
    a.find("--threads").unlisted(); // accepted by all commands, but listed only where used
    a.option("MODEL", o.job.model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file").required().reads();
    addUpOption(a, o.up);
    addMemoryOption(a, o.job.memory, ", and the maximum for all triangles besides the model");
    a.flag("--details", o.job.details,
           "also print the statistics of each primitive and map, and cameras that look at the problem areas")
        .main();
    addOwnNormalMap(a, o.job.maps);
    a.group(HelpGroup::frame);
    addMaxDegreesOption(a, o.maxDegrees);
    a.group(HelpGroup::diagnostics);
    a.option("--distance", o.job.lint.distance,
             "distance from the eye in world units, for an image with a 45 degree view and 1080 rows; 0: where the "
             "model fills it")
        .in("D");
    a.option(
         "--limit", o.job.limits.degrees,
         "check each primitive: exit code 5 if the error with --frame exceeds this many degrees on more than 5 % of "
         "a primitive's area, a map's green points the other way, or a normal map could not be judged")
        .in("DEGREES")
        .withoutDefault()
        .main();
    a.option("--limit-area", o.job.limits.area,
             "check each primitive: exit code 5 if degenerate uv, mirrored uv that overlap, or stored tangents against "
             "the uv exceed this % of a primitive's area, or a map's green points the other way")
        .in("PERCENT")
        .withoutDefault();
    a.flag("--strict", o.strict, "require --limit or --limit-area: without either it is a usage error");
    a.option("--frame", o.job.limits.frame,
             "frame that --limit judges: cotangent, orthonormal, smooth, exact, triangle or stored")
        .from(readingNames())
        .in("NAME")
        .main();
}

} // namespace

void addLintCommand(Arguments& tool)
{
    addCommand<LintCommandOptions>(tool,
                                   {"lint",
                                    "Check a model: the error of its normal maps without stored tangents, in degrees.",
                                    "",
                                    {"cotan lint model.glb", "cotan lint model.glb --limit 3",
                                     "cotan lint model.glb --distance 3 --json report.json"}},
                                   declare, run);
}

} // namespace cotan::app
