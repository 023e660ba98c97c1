#include "bake/lint_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bake/lint/map_fit.hpp"
#include "bake/report_words.hpp"

namespace cotan {

namespace {

std::string percentOf(double share) { return fmt::format("{:.1f} %", 100 * share); }

std::string greenVerdict(const GreenEvidence& g)
{
    if (!g.decided())
        return "cannot be told from the map (" + (g.verdict.reason.empty() ? "it was not read" : g.verdict.reason)
            + ")";
    return fmt::format("{} ({})", g.asDeclared() ? "as declared" : "the other way than declared",
                       name(g.verdict.confidence));
}

std::string frameWord(Frame frame) { return frame == Frame::mikktspace ? "MikkTSpace" : std::string(name(frame)); }

void addPrimitive(const LintReport& report, std::size_t index, std::vector<std::string>& lines)
{
    const PrimitiveLint& p = report.primitives[index];
    lines.push_back(fmt::format("{}: {} triangles, {}", nameOf(p, index), p.triangles,
                                p.image >= 0 ? fmt::format("normal map {}", p.image) : "no normal map"));
    if (p.triangles == 0 || !p.hasUv || !(p.uv.area > 0)) {
        lines.push_back(fmt::format("  nothing to measure: no {}",
                                    p.triangles == 0 ? "triangles"
                                        : !p.hasUv   ? "uv"
                                                     : "area"));
        return;
    }
    lines.push_back(fmt::format(
        "  uv: degenerate {}, mirrored {}, overlapping {} (in both orientations {}), stretched over {:.1f} {}, "
        "sheared over {:.0f} degrees {} of the area",
        percentOf(p.uv.degenerate), percentOf(p.uv.mirrored), percentOf(p.uv.overlapping),
        percentOf(p.uv.overlappingMirrored), kStretched, percentOf(p.uv.stretched), kSheared, percentOf(p.uv.sheared)));
    lines.push_back(fmt::format("  stretch {}, shear {} degrees", toText(p.uv.stretch), toText(p.uv.shear)));
    lines.push_back(
        fmt::format("  steps at {} interior edges, texel tilted {:.0f} degrees: cotangent {}, orthonormal {}",
                    p.steps.edges, kTestTilt, toText(p.steps.cotangent), toText(p.steps.orthonormal)));
    if (p.stored.present && p.stored.angle.count == 0)
        lines.push_back("  stored tangents: nothing to compare them with, the uv have no area");
    else if (p.stored.present)
        lines.push_back(
            fmt::format("  stored tangents: w against the uv on {}, turned over {:.0f} degrees on {} of the area; "
                        "{} degrees from dP/du",
                        percentOf(p.stored.reversedW), kTurned, percentOf(p.stored.turned), toText(p.stored.angle)));
    if (!p.notJudged.empty())
        lines.push_back("  normal map not judged: " + p.notJudged);
    else
        for (const Reading& r : p.readings)
            lines.push_back(
                fmt::format("  made for {}, read with {}: {}", frameWord(p.madeFor), r.name, toText(r.error)));
    if (p.uv.gradient > 0)
        lines.push_back(fmt::format("  rounding at distance {:.3g}: {:.2g} degrees; half a degree at {:.2g}",
                                    report.distance, p.precision, p.closest));
}

std::string titleOf(const std::string& model, const LintReport& report)
{
    std::size_t mapped = 0, stored = 0;
    for (const PrimitiveLint& p : report.primitives) {
        mapped += p.image >= 0;
        stored += p.stored.present;
    }
    return fmt::format("{}: {}, {} with a normal map, {} with stored tangents", model,
                       counted(report.primitives.size(), "primitive"), mapped, stored);
}

std::string greenLine(const LintReport& report)
{
    std::size_t right = 0, wrong = 0;
    for (const GreenEvidence& g : report.maps) {
        right += g.decided() && g.asDeclared();
        wrong += !g.asDeclared();
    }
    if (report.maps.empty())
        return {};
    return fmt::format("Green, judged by the maps alone: as declared in {}, the other way in {}, cannot be told in {}.",
                       right, wrong, report.maps.size() - right - wrong);
}

// With what is beside the value.
std::string sentenceOf(const LintFailure& f) { return f.beside.empty() ? f.text : f.text + " (" + f.beside + ")"; }

Json toJson(const PrimitiveLint& p)
{
    Json j = {{"mesh", p.mesh},
              {"material", p.material},
              {"placing", p.placing},
              {"placings", p.placings},
              {"normal_map", p.image},
              {"not_judged", p.notJudged},
              {"tangents_for", p.tangentsFor},
              {"made_for", name(p.madeFor)},
              {"triangles", p.triangles},
              {"has_uv", p.hasUv}};
    j["uv"] = {{"area", p.uv.area},
               {"degenerate", p.uv.degenerate},
               {"mirrored", p.uv.mirrored},
               {"overlapping", p.uv.overlapping},
               {"overlapping_mirrored", p.uv.overlappingMirrored},
               {"stretched", p.uv.stretched},
               {"sheared", p.uv.sheared},
               {"stretch", toJson(p.uv.stretch)},
               {"shear_degrees", toJson(p.uv.shear)},
               {"gradient", p.uv.gradient},
               {"largest_uv", p.uv.largestUv}};
    j["edge_steps"] = {{"edges", p.steps.edges},
                       {"cotangent", toJson(p.steps.cotangent)},
                       {"orthonormal", toJson(p.steps.orthonormal)}};
    if (p.stored.present)
        j["stored_tangents"] = {{"reversed_w", p.stored.reversedW},
                                {"turned", p.stored.turned},
                                {"degrees_from_dpdu", toJson(p.stored.angle)}};
    for (const Reading& r : p.readings)
        j["read_with"][r.name] = toJson(r.error);
    j["rounding_degrees"] = p.precision;
    j["half_a_degree_at"] = p.closest;
    return j;
}

Json toJson(const GreenEvidence& g)
{
    return {{"image", g.image},
            {"name", g.name},
            {"decided", g.decided()},
            {"as_declared", g.asDeclared()},
            {"green", name(g.verdict.green)},
            {"confidence", name(g.verdict.confidence)},
            {"reason", g.verdict.reason},
            {"agreement", g.verdict.agreement},
            {"votes", g.verdict.votes},
            {"verdict", greenVerdict(g)}};
}

Json toJson(const MapFit& f)
{
    return {{"image", f.image},
            {"name", f.name},
            {"orthonormal", toJson(f.orthonormal)},
            {"cotangent", toJson(f.cotangent)},
            {"smooth", toJson(f.smooth)}};
}

} // namespace

std::vector<std::string> verdictLines(const std::string& model, const LintReport& report, const std::string& run)
{
    std::vector<std::string> lines = {titleOf(model, report)};
    for (const std::string& line :
         {report.defects, report.seen, greenLine(report), report.notJudged, report.otherReaders, report.advised})
        if (!line.empty())
            lines.push_back(line);
    if (!run.empty())
        lines.push_back("  " + run);
    return lines;
}

std::vector<std::string> detailLines(const LintReport& report)
{
    std::vector<std::string> lines;
    if (!report.worst.empty())
        lines.push_back(report.worst);
    lines.emplace_back("Three figures are mean / 95 % / maximum, weighted by area.");
    for (std::size_t i = 0; i < report.primitives.size(); ++i)
        addPrimitive(report, i, lines);
    for (const GreenEvidence& g : report.maps)
        lines.push_back(fmt::format(
            "normal map {}{}: green, taking red as right, {}; agreement {:+.2f} for green up, {} of the detail agrees",
            g.image, g.name.empty() ? "" : " " + g.name, greenVerdict(g), g.verdict.agreement,
            percentOf(g.verdict.votes)));
    for (const MapFit& f : report.fits)
        lines.push_back(fmt::format("normal map {}{}: read as it is, orthonormal {}, cotangent {}, smooth {}", f.image,
                                    f.name.empty() ? "" : " " + f.name, toText(f.orthonormal), toText(f.cotangent),
                                    toText(f.smooth)));
    return lines;
}

Json overLimits(const LintCheck& check)
{
    const auto text = [](const std::string& name) { return name.empty() ? Json(nullptr) : Json(name); };
    const auto number = [](bool known, double value) { return known ? Json(value) : Json(nullptr); };
    Json all = Json::array();
    for (const LintFailure& f : check.failures) {
        const bool measured = f.limit >= 0;
        all.push_back({{"kind", f.kind},
                       {"mesh", text(f.mesh)},
                       {"material", text(f.material)},
                       {"map", text(f.map)},
                       {"degrees", number(measured && !f.percent, f.value)},
                       {"percent", number(measured && f.percent, f.value)},
                       {"limit", number(measured, f.limit)},
                       {"text", f.text}});
    }
    return all;
}

std::vector<std::string> checkLines(const LintCheck& check, std::size_t most)
{
    if (check.passed())
        return {"check: passed"};
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < std::min(most, check.failures.size()); ++i)
        lines.push_back("check: failed: " + sentenceOf(check.failures[i]));
    if (lines.size() < check.failures.size())
        lines.back() += fmt::format(" and {} more", check.failures.size() - lines.size());
    return lines;
}

std::string summaryOf(const LintCheck& check)
{
    if (check.passed())
        return {};
    const std::string first = sentenceOf(check.failures.front());
    return check.failures.size() == 1 ? first : fmt::format("{} and {} more", first, check.failures.size() - 1);
}

Json toJson(const LintCheck& check)
{
    if (!check.limits.any())
        return nullptr;
    const auto limit = [](double value) { return value >= 0 ? Json(value) : Json(nullptr); };
    Json j = {{"passed", check.passed()},
              {"limit", limit(check.limits.degrees)},
              {"limit_area", limit(check.limits.area)},
              {"frame", check.limits.frame},
              {"failures", Json::array()}};
    for (const LintFailure& f : check.failures) {
        const bool measured = f.limit >= 0;
        j["failures"].push_back({{"kind", f.kind},
                                 {"where", f.where},
                                 {"value", measured ? Json(f.value) : Json(nullptr)},
                                 {"limit", limit(f.limit)},
                                 {"text", f.text}});
    }
    return j;
}

std::vector<std::string> warningsOf(const LintReport& report, std::vector<std::string> ofFile)
{
    for (std::string& line : lintWarnings(report))
        ofFile.push_back(std::move(line));
    return ofFile;
}

Json listsOf(const LintReport& report)
{
    Json lists = {{"primitives", Json::array()}, {"maps", Json::array()}, {"fits", Json::array()}};
    for (const PrimitiveLint& p : report.primitives)
        lists["primitives"].push_back(toJson(p));
    for (const GreenEvidence& g : report.maps)
        lists["maps"].push_back(toJson(g));
    for (const MapFit& f : report.fits)
        lists["fits"].push_back(toJson(f));
    return lists;
}

} // namespace cotan
