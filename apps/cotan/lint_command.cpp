#include "commands.hpp"

#include <fmt/format.h>

#include "bake/reports.hpp"
#include "cotan/inspect.hpp"
#include "cotan/lint.hpp"
#include "cotan/render.hpp"
#include "gltf_open.hpp"
#include "lint_lines.hpp"
#include "loading.hpp"
#include "picture.hpp"
#include "terminal/command_words.hpp"

namespace cotan::app {

namespace {

struct LintCommandOptions : CommonOptions {
    std::string model;
    Up up = Up::y;
    int memory = kDefaultMemory;
    bool details = false;
    OwnMaps maps;
    double distance = 0;
    bool strict = false;
    double maxDegrees = ChoiceLimits().mean; // for frames that are chosen
    LintLimits limits;
};

// The command that follows the advice; empty if it would change nothing.
std::string commandFor(const LintCommandOptions& o, const LintReport& report)
{
    if (report.advice == Advice::nothing || !o.maps.normal.empty()) // convert reads the model's own maps
        return {};
    const std::string stem = std::filesystem::path(o.model).stem().string();
    if (!namedAsGltf(o.model)) // convert writes glTF only
        return fmt::format("cotan render {} --frame orthonormal -o {}", quoted(o.model), quoted(stem + ".png"));
    if (report.dropping == 0)
        return {};
    return fmt::format("cotan convert {}{} -o {} --verify {}", quoted(o.model),
                       report.distrustStored ? " --tangents generated" : "", quoted(stem + "-free.glb"),
                       quoted(stem + "-verify"));
}

Status checkUsage(const LintCommandOptions& o)
{
    if (!(o.distance >= 0 && o.distance <= 1e9))
        return usageError(fmt::format("--distance: expected a number from 0 to 1e9; found {}", o.distance));
    const auto outside = [](double limit, double max) { return !(limit == -1 || (limit >= 0 && limit <= max)); };
    if (outside(o.limits.degrees, 180))
        return usageError(fmt::format("--limit: expected degrees from 0 to 180; found {}", o.limits.degrees));
    if (outside(o.limits.area, 100))
        return usageError(fmt::format("--limit-area: expected percent from 0 to 100; found {}", o.limits.area));
    if (o.strict && o.limits.degrees < 0 && o.limits.area < 0)
        return usageError("--strict: expected --limit DEGREES or --limit-area PERCENT; found neither");
    return Done{};
}

Status run(const LintCommandOptions& o)
{
    if (Status usage = checkUsage(o); !usage)
        return usage;
    if (Status planned = beginOutputs(o, {}); !planned)
        return planned;
    Stopwatch watch;
    LoadLimits limits = limitsFor(o.memory, Pixels::whereReadable);
    limits.up = o.up;
    auto scene = loadWithProgress(o, limits, o.model);
    if (!scene)
        return scene.error();
    if (Status applied = applyOwnMaps(o.maps, o.memory, *scene); !applied)
        return applied;
    for (const std::string& line : scene->warnings)
        warn(o, line);
    const double loadSeconds = watch.lap();
    const auto linted = withProgress(o, 1, "measuring " + o.model, [&](const Progress& progress) {
        return lintScene(
            *scene,
            {.distance = o.distance, .memory = std::size_t(o.memory) << 20, .limits = ChoiceLimits::of(o.maxDegrees)},
            progress);
    });
    if (!linted)
        return withOptionNames(linted.error());
    const LintReport& report = *linted;
    for (const GreenEvidence& map : report.maps)
        if (!map.note.empty())
            warn(o, "normal map {}: {}", map.name.empty() ? fmt::format("image {}", map.image) : map.name, map.note);
    const std::string command = commandFor(o, report);
    const LintCheck check = checkLimits(report, o.limits);
    const std::vector<std::string> verdict = verdictLines(o.model, report, command);
    for (const std::string& line : verdict)
        say(o, line);
    std::vector<std::string> details = detailLines(report);
    const std::vector<ProblemArea> areas =
        report.primitives.empty() ? std::vector<ProblemArea>() : problemAreas(*scene);
    for (const ProblemArea& area : areas)
        details.push_back(fmt::format("look: {}: --camera {}", area.text, formatCamera(area.camera)));
    if (o.limits.any())
        for (const std::string& line : checkLines(check, o.details ? check.failures.size() : 1))
            say(o, line);
    if (o.details)
        for (const std::string& line : details)
            say(o, line);
    else
        say(o,
            "--details adds {} lines: the statistics of each primitive and map, and cameras that look at the problem "
            "areas",
            details.size());

    Json j = {{"command", "lint"},
              {"model", o.model},
              {"warnings", warningsOf(report, scene->warnings)},
              {"distance", report.distance},
              {"verdict", verdict},
              {"recommendation", report.recommendation},
              {"run", command},
              {"run_would",
               {{"primitives_dropping", report.dropping},
                {"primitives_keeping", report.keeping},
                {"drops_tangents", report.dropping > 0}}}};
    j.update(listsOf(report));
    j["hot_spots"] = Json::array();
    for (const ProblemArea& area : areas)
        j["hot_spots"].push_back({{"text", area.text},
                                  {"mesh", scene->meshes[area.mesh].name},
                                  {"share", area.share},
                                  {"camera", formatCamera(area.camera)}});
    j["check"] = toJson(check);
    j["over_limit"] = overLimits(check);
    j["seconds"] = {{"load", loadSeconds}, {"lint", watch.lap()}};
    if (Status written = writeReport(o, j); !written)
        return written;
    if (!check.passed())
        return Error{ErrorKind::limit, summaryOf(check)};
    return Done{};
}

void declare(Arguments& a, LintCommandOptions& o)
{
    a.find("--threads").unlisted(); // accepted by all commands, but listed only where used
    a.option("MODEL", o.model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file").required().reads();
    addUpOption(a, o.up);
    addMemoryOption(a, o.memory, ", and the maximum for all triangles besides the model");
    a.flag("--details", o.details,
           "also print the statistics of each primitive and map, and cameras that look at the problem areas")
        .main();
    addOwnNormalMap(a, o.maps);
    a.group(HelpGroup::frame);
    addMaxDegreesOption(a, o.maxDegrees);
    a.group(HelpGroup::diagnostics);
    a.option("--distance", o.distance,
             "distance from the eye in world units, for an image with a 45 degree view and 1080 rows; 0: where the "
             "model fills it")
        .in("D");
    a.option(
         "--limit", o.limits.degrees,
         "check each primitive: exit code 5 if the error with --frame exceeds this many degrees on more than 5 % of "
         "a primitive's area, a map's green points the other way, or a normal map could not be judged")
        .in("DEGREES")
        .withoutDefault()
        .main();
    a.option("--limit-area", o.limits.area,
             "check each primitive: exit code 5 if degenerate uv, mirrored uv that overlap, or stored tangents against "
             "the uv exceed this % of a primitive's area, or a map's green points the other way")
        .in("PERCENT")
        .withoutDefault();
    a.flag("--strict", o.strict, "require --limit or --limit-area: without either it is a usage error");
    a.option("--frame", o.limits.frame,
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
                                    {"cotan lint model.glb", "cotan lint model.glb --limit 2",
                                     "cotan lint model.glb --distance 3 --json report.json"}},
                                   declare, run);
}

} // namespace cotan::app
