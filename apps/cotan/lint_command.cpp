#include "commands.hpp"

#include <cmath>

#include <fmt/format.h>

#include "gltf_open.hpp"
#include "lint_report.hpp"
#include "memory_limit.hpp"
#include "normal_map_option.hpp"
#include "progress.hpp"

namespace cotan::app {

namespace {

struct LintCommandOptions {
    CommonOptions common;
    std::string model;
    int memory = kDefaultMemory;
    bool details = false;
    NormalMapOption normalMap;
    double distance = 0;
    bool strict = false;
    double limitDegrees = -1;
    double limitArea = -1;
    std::string frame = "cotangent";
};

// A path as a word of a shell's command line.
std::string quoted(const std::string& path)
{
    const bool plain = path.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./")
        == std::string::npos;
    std::string text = "'";
    for (char c : path)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return plain && !path.empty() ? path : text + "'";
}

// What does what is advised; empty where that would do nothing.
std::string commandFor(const LintCommandOptions& o, const LintReport& report)
{
    if (report.advice == Advice::nothing || !o.normalMap.file.empty()) // convert reads the model's own maps
        return {};
    const std::string to(name(frameOf(report.advice)));
    const std::string stem = std::filesystem::path(o.model).stem().string();
    if (!namedAsGltf(o.model)) // convert writes glTF only
        return fmt::format("cotan render {} --frame orthonormal -o {}", quoted(o.model), quoted(stem + ".png"));
    if (report.mapsConverted == 0 && !report.dropsTangents)
        return {};
    return fmt::format("cotan convert {} --from-frame mikktspace --to-frame {}{} -o {} --verify {}", quoted(o.model), to,
                       report.distrustStored ? " --tangents generated" : "", quoted(stem + "-" + to + ".glb"), quoted(stem + "-verify"));
}

// What is over the limits, one sentence each. A limit in degrees does not hold for maps whose pixels were not read, nor
// where no map at all was judged.
std::vector<std::string> exceeded(const LintCommandOptions& o, const LintReport& report)
{
    std::vector<std::string> lines;
    bool anyMap = false, anyJudged = false;
    for (std::size_t i = 0; i < report.primitives.size(); ++i) {
        const PrimitiveLint& p = report.primitives[i];
        auto check = [&](double value, double limit, const std::string& what, const char* unit) {
            if (limit >= 0 && value > limit)
                lines.push_back(fmt::format("{}: {} {:.3g} {}, limit {:.3g}", nameOf(p, i), what, value, unit, limit));
        };
        anyMap = anyMap || p.image >= 0;
        anyJudged = anyJudged || (p.image >= 0 && p.notJudged.empty());
        if (o.limitDegrees >= 0 && p.unread)
            lines.push_back(fmt::format("{}: not judged, {}; limit {:.3g}", nameOf(p, i), p.notJudged, o.limitDegrees));
        for (const Reading& r : p.readings)
            if (r.name == o.frame)
                check(r.error.percentile95, o.limitDegrees, "95 % of the error of reading with " + r.name, "degrees");
        if (p.image >= 0)
            check(p.precision, o.limitDegrees, "rounding", "degrees");
        check(100 * p.uv.degenerate, o.limitArea, "degenerate uv on", "% of the area");
        check(100 * p.uv.overlappingMirrored, o.limitArea, "uv overlapping in both orientations on", "% of the area");
        check(100 * p.stored.reversedW, o.limitArea, "TANGENT.w against the uv on", "% of the area");
        check(100 * p.stored.turned, o.limitArea, "stored tangents turned on", "% of the area");
    }
    if (o.limitDegrees >= 0 && anyMap && !anyJudged && lines.empty())
        lines.push_back(fmt::format("no normal map could be judged, limit {:.3g}", o.limitDegrees));
    return lines;
}

Status checkUsage(const LintCommandOptions& o)
{
    if (!(o.distance >= 0 && o.distance <= 1e9))
        return usageError(fmt::format("--distance: expected a number from 0 to 1e9; found {}", o.distance));
    const auto outside = [](double limit, double most) { return !(limit == -1 || (limit >= 0 && limit <= most)); };
    if (outside(o.limitDegrees, 180))
        return usageError(fmt::format("--limit: expected degrees from 0 to 180; found {}", o.limitDegrees));
    if (outside(o.limitArea, 100))
        return usageError(fmt::format("--limit-area: expected percent from 0 to 100; found {}", o.limitArea));
    if (o.strict && o.limitDegrees < 0 && o.limitArea < 0)
        return usageError("--strict: expected --limit DEGREES or --limit-area PERCENT; found neither");
    return Done{};
}

Status run(const LintCommandOptions& o)
{
    if (Status usage = checkUsage(o); !usage)
        return usage;
    if (Status planned = planOutputs(o.common, {}); !planned)
        return planned;
    Stopwatch watch;
    auto scene = [&] {
        const Progress loading(o.common, 0, "loading " + o.model);
        return loadSceneWithin(o.memory, o.model, Pixels::whereReadable);
    }();
    if (!scene)
        return scene.error();
    if (Status applied = applyNormalMap(o.normalMap, o.memory, *scene); !applied)
        return applied;
    for (const std::string& line : scene->warnings)
        warn(o.common, line);
    const double loadSeconds = watch.lap();
    auto progress = std::make_unique<Progress>(o.common, 1, "measuring " + o.model);
    const LintReport report = lintScene(*scene, {o.distance, progress->within()});
    progress.reset();
    const std::string command = commandFor(o, report);
    const std::vector<std::string> over = exceeded(o, report), verdict = verdictLines(o.model, report, command);
    for (const std::string& line : verdict)
        say(o.common, line);
    const std::vector<std::string> details = detailLines(report);
    if (!over.empty())
        say(o.common, fmt::format("over the limit: {}{}", over.front(), over.size() > 1 && !o.details ? fmt::format(" and {} more", over.size() - 1) : ""));
    for (std::size_t i = 1; o.details && i < over.size(); ++i)
        say(o.common, "over the limit: " + over[i]);
    if (o.details)
        for (const std::string& line : details)
            say(o.common, line);
    else
        say(o.common, fmt::format("--details adds {} lines: each primitive and map, in figures", details.size()));

    nlohmann::ordered_json j = {{"command", "lint"}, {"model", o.model}, {"warnings", scene->warnings},
                                {"distance", report.distance}, {"verdict", verdict}, {"recommendation", report.recommendation},
                                {"run", command},
                                {"run_would", {{"maps_converted", report.mapsConverted}, {"maps_kept", report.mapsKept},
                                               {"drops_tangents", report.dropsTangents}}}};
    for (const char* list : {"primitives", "maps", "fits"})
        j[list] = nlohmann::ordered_json::array();
    for (const PrimitiveLint& p : report.primitives)
        j["primitives"].push_back(toJson(p));
    for (const GreenEvidence& g : report.maps)
        j["maps"].push_back(toJson(g));
    for (const MapFit& f : report.fits)
        j["fits"].push_back(toJson(f));
    j["over_limit"] = over;
    j["seconds"] = {{"load", loadSeconds}, {"lint", watch.lap()}};
    if (Status written = writeReport(o.common, j); !written)
        return written;
    if (o.strict && !over.empty())
        return Error{ErrorKind::limit, over.size() == 1 ? over.front() : fmt::format("{} and {} more", over.front(), over.size() - 1)};
    return Done{};
}

} // namespace

Command addLintCommand(CLI::App& app)
{
    auto options = std::make_shared<LintCommandOptions>();
    CLI::App* command = app.add_subcommand("lint", "what to expect of a model's normal maps without stored tangents, in degrees");
    addCommonOptions(*command, options->common, "");
    command->get_option("--threads")->group(""); // accepted by all commands, listed where it is used
    command->add_option("MODEL", options->model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file")->required();
    addMemoryOption(*command, options->memory);
    command->add_flag("--details", options->details, "also the figures of each primitive and map");
    addNormalMapOption(*command, options->normalMap);
    command->add_option("--distance", options->distance,
                        "from the eye to the surface in world units, 45 degrees and 1080 lines high; 0: where the model fills the picture")
        ->type_name("D")->capture_default_str();
    command->add_flag("--strict", options->strict, "exit code 5 if something is over a limit, or a normal map could not be judged");
    command->add_option("--limit", options->limitDegrees,
                        "degrees: 95 % of the expected error of reading with --frame, and rounding")->type_name("DEGREES");
    command->add_option("--limit-area", options->limitArea,
                        "% of a primitive's area: degenerate uv, uv overlapping mirrored, stored tangents against the uv")
        ->type_name("PERCENT");
    command->add_option("--frame", options->frame, "for --limit: cotangent, orthonormal, smooth, exact or stored")
        ->check(CLI::IsMember({"cotangent", "orthonormal", "smooth", "exact", "stored"}))->type_name("NAME")
        ->capture_default_str();
    addExamples(*command, {"cotan lint model.glb",
                           "cotan lint model.glb --distance 3 --json report.json"});
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
