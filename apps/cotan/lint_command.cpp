#include "commands.hpp"

#include <cmath>

#include <fmt/format.h>

#include "cotan/asset/load.hpp"
#include "cotan/lint/lint.hpp"
#include "normal_map_option.hpp"
#include "parse.hpp"
#include "spread_report.hpp"

namespace cotan::app {

namespace {

struct Options {
    CommonOptions common;
    std::string model;
    NormalMapOption normalMap;
    double distance = 0;
    bool strict = false;
    double limitDegrees = -1;
    double limitArea = -1;
    std::string frame = "cotangent";
};

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

std::string nameOf(const PrimitiveLint& p, std::size_t index)
{
    const std::string mesh = p.mesh.empty() ? fmt::format("primitive {}", index) : p.mesh;
    const std::string name = p.material.empty() ? mesh : fmt::format("{}, material {}", mesh, p.material);
    return p.placings == 1 ? name : fmt::format("{}, stretched by its nodes in {} ways, number {}", name, p.placings, p.placing + 1);
}

void sayPrimitive(const Options& o, const LintReport& report, std::size_t index)
{
    const PrimitiveLint& p = report.primitives[index];
    const CommonOptions& c = o.common;
    say(c, fmt::format("{}: {} triangles, {}", nameOf(p, index), p.triangles,
                       p.image >= 0 ? fmt::format("normal map {}", p.image) : "no normal map"));
    if (p.triangles == 0 || !p.hasUv) {
        say(c, p.triangles == 0 ? "  nothing to measure: no triangles" : "  nothing to measure: no uv");
        return;
    }
    say(c, fmt::format("  uv: degenerate {}, mirrored {}, overlapping {} (in both orientations {}), stretched over {:.1f} {}, "
                       "sheared over {:.0f} degrees {} of the area",
                       percent(p.uv.degenerate), percent(p.uv.mirrored), percent(p.uv.overlapping),
                       percent(p.uv.overlappingMirrored), kStretched, percent(p.uv.stretched), kSheared,
                       percent(p.uv.sheared)));
    say(c, fmt::format("  stretch {}, shear {} degrees", toText(p.uv.stretch), toText(p.uv.shear)));
    say(c, fmt::format("  steps at {} interior edges, texel tilted {:.0f} degrees: cotangent {}, orthonormal {}", p.steps.edges,
                       kTestTilt, toText(p.steps.cotangent), toText(p.steps.orthonormal)));
    if (p.stored.present)
        say(c, fmt::format("  stored tangents: w against the uv on {}, turned over {:.0f} degrees on {} of the area; "
                           "{} degrees from dP/du",
                           percent(p.stored.reversedW), kTurned, percent(p.stored.turned), toText(p.stored.angle)));
    for (const Reading& r : p.readings)
        say(c, fmt::format("  made for MikkTSpace, read with {}: {}", r.name, toText(r.error)));
    say(c, fmt::format("  rounding at distance {:.3g}: {:.2g} degrees; half a degree at {:.2g}", report.distance, p.precision,
                       p.closest));
}

std::string greenVerdict(const GreenEvidence& g)
{
    if (!g.decided)
        return "cannot be told from the map";
    const double degree = std::abs(g.correlation);
    const char* sureness = degree > 0.5 && g.agreement > 0.95 ? "sure" : degree > 0.2 && g.agreement > 0.85 ? "likely" : "weak";
    return fmt::format("{} ({})", g.asDeclared ? "as declared" : "the other way than declared", sureness);
}

void sayMap(const Options& o, const GreenEvidence& g)
{
    say(o.common, fmt::format("normal map {}{}: green, taking red as right, {}; integrability {:+.2f} of 1, {} of the detail agrees",
                              g.image, g.name.empty() ? "" : " " + g.name, greenVerdict(g), g.correlation,
                              percent(g.agreement)));
}

nlohmann::ordered_json describe(const PrimitiveLint& p)
{
    nlohmann::ordered_json j = {{"mesh", p.mesh}, {"material", p.material}, {"placing", p.placing}, {"placings", p.placings},
                                {"normal_map", p.image}, {"tangents_for", p.tangentsFor},
                                {"triangles", p.triangles}, {"has_uv", p.hasUv}};
    j["uv"] = {{"area", p.uv.area}, {"degenerate", p.uv.degenerate}, {"mirrored", p.uv.mirrored},
               {"overlapping", p.uv.overlapping}, {"overlapping_mirrored", p.uv.overlappingMirrored},
               {"stretched", p.uv.stretched}, {"sheared", p.uv.sheared}, {"stretch", toJson(p.uv.stretch)},
               {"shear_degrees", toJson(p.uv.shear)}, {"gradient", p.uv.gradient}, {"largest_uv", p.uv.largestUv}};
    j["edge_steps"] = {{"edges", p.steps.edges}, {"cotangent", toJson(p.steps.cotangent)},
                       {"orthonormal", toJson(p.steps.orthonormal)}};
    if (p.stored.present)
        j["stored_tangents"] = {{"reversed_w", p.stored.reversedW}, {"turned", p.stored.turned},
                                {"degrees_from_dpdu", toJson(p.stored.angle)}};
    for (const Reading& r : p.readings)
        j["read_with"][r.name] = toJson(r.error);
    j["rounding_degrees"] = p.precision;
    j["half_a_degree_at"] = p.closest;
    return j;
}

nlohmann::ordered_json describe(const GreenEvidence& g)
{
    return {{"image", g.image}, {"name", g.name}, {"decided", g.decided}, {"as_declared", g.asDeclared},
            {"correlation", g.correlation}, {"agreement", g.agreement}, {"verdict", greenVerdict(g)}};
}

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

std::string commandFor(const Options& o, const LintReport& report)
{
    if (report.advice == Advice::nothing)
        return {};
    const std::string to = report.advice == Advice::readOrthonormal ? "orthonormal"
        : report.advice == Advice::convertToSmooth                  ? "smooth"
                                                                    : "cotangent";
    const std::filesystem::path model = o.model;
    const std::string extension = model.extension().string();
    if (extension != ".gltf" && extension != ".glb") // convert writes glTF only
        return fmt::format("cotan render {} --frame orthonormal -o {}.png", quoted(o.model), quoted(model.stem().string()));
    return fmt::format("cotan convert {} --from mikktspace --to {}{} -o {} --verify {}", quoted(o.model), to,
                       report.distrustStored ? " --tangents generated" : "",
                       quoted(model.stem().string() + "-" + to + ".glb"), quoted(model.stem().string() + "-verify"));
}

// What is over the limits, one sentence each.
std::vector<std::string> exceeded(const Options& o, const LintReport& report)
{
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < report.primitives.size(); ++i) {
        const PrimitiveLint& p = report.primitives[i];
        auto check = [&](double value, double limit, const std::string& what, const char* unit) {
            if (limit >= 0 && value > limit)
                lines.push_back(fmt::format("{}: {} {:.3g} {}, limit {:.3g}", nameOf(p, i), what, value, unit, limit));
        };
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
    return lines;
}

Status checkUsage(const Options& o)
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

Status run(const Options& o)
{
    if (Status usage = checkUsage(o); !usage)
        return usage;
    if (Status planned = planOutputs(o.common, {}); !planned)
        return planned;
    Stopwatch watch;
    auto scene = loadScene(o.model);
    if (!scene)
        return scene.error();
    if (Status applied = applyNormalMap(o.normalMap, *scene); !applied)
        return applied;
    for (const std::string& line : scene->warnings)
        warn(o.common, line);
    const double loadSeconds = watch.lap();
    const LintReport report = lintScene(*scene, {o.distance});

    nlohmann::ordered_json j = {{"command", "lint"}, {"model", o.model}, {"warnings", scene->warnings},
                                {"distance", report.distance}};
    say(o.common, "three figures are: mean / 95 % / maximum, by area");
    j["primitives"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < report.primitives.size(); ++i) {
        sayPrimitive(o, report, i);
        j["primitives"].push_back(describe(report.primitives[i]));
    }
    j["maps"] = nlohmann::ordered_json::array();
    for (const GreenEvidence& g : report.maps) {
        sayMap(o, g);
        j["maps"].push_back(describe(g));
    }
    const std::string command = commandFor(o, report);
    say(o.common, report.recommendation);
    if (!command.empty())
        say(o.common, "  " + command);
    const std::vector<std::string> over = exceeded(o, report);
    for (const std::string& line : over)
        say(o.common, "over the limit: " + line);
    j["recommendation"] = report.recommendation;
    j["run"] = command;
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
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("lint", "what to expect of a model's normal maps without stored tangents, in degrees");
    addCommonOptions(*command, options->common, "");
    command->get_option("--threads")->group(""); // accepted by all commands, listed where it is used
    command->add_option("MODEL", options->model, "glTF, GLB, OBJ, PLY, STL, COLLADA, FBX or 3DS file")->required();
    addNormalMapOption(*command, options->normalMap);
    command->add_option("--distance", options->distance,
                        "from the eye to the surface in world units, 45 degrees and 1080 lines high; 0: where the model fills the picture")
        ->type_name("D")->capture_default_str();
    command->add_flag("--strict", options->strict, "exit code 5 if something is over a limit");
    command->add_option("--limit", options->limitDegrees,
                        "degrees: 95 % of the expected error of reading with --frame, and rounding")->type_name("DEGREES");
    command->add_option("--limit-area", options->limitArea,
                        "% of a primitive's area: degenerate uv, uv overlapping mirrored, stored tangents against the uv")
        ->type_name("PERCENT");
    command->add_option("--frame", options->frame, "for --limit: cotangent, orthonormal, smooth, exact or stored")
        ->check(CLI::IsMember({"cotangent", "orthonormal", "smooth", "exact", "stored"}))->type_name("NAME")
        ->capture_default_str();
    return {command, [options] { return run(*options); }};
}

} // namespace cotan::app
