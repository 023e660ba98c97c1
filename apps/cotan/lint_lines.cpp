#include "lint_lines.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "bake/lint/map_fit.hpp"
#include "bake/reports.hpp"

namespace cotan::app {

namespace {

std::string percentOf(double fraction) { return fmt::format("{:.1f} %", 100 * fraction); }

std::string frameWord(Frame frame) { return frame == Frame::mikktspace ? "MikkTSpace" : std::string(name(frame)); }

// A failure with its additional values.
std::string sentenceOf(const LintFailure& f) { return f.beside.empty() ? f.text : f.text + " (" + f.beside + ")"; }

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
        "  uv: degenerate {}, mirrored {}, overlapping {} (in both orientations {}), stretch above {:.1f} {}, "
        "shear above {:.0f} degrees {} of the area",
        percentOf(p.uv.degenerate), percentOf(p.uv.mirrored), percentOf(p.uv.overlapping),
        percentOf(p.uv.overlappingMirrored), kStretched, percentOf(p.uv.stretched), kSheared, percentOf(p.uv.sheared)));
    lines.push_back(fmt::format("  stretch {}, shear {} degrees", toText(p.uv.stretch), toText(p.uv.shear)));
    lines.push_back(
        fmt::format("  steps at {} interior edges, texel tilted {:.0f} degrees: cotangent {}, orthonormal {}",
                    p.steps.edges, kTestTilt, toText(p.steps.cotangent), toText(p.steps.orthonormal)));
    if (p.stored.present && p.stored.angle.count == 0)
        lines.push_back("  stored tangents: nothing to compare them with, the uv have no area");
    else if (p.stored.present)
        lines.push_back(fmt::format(
            "  stored tangents: w against the uv on {}, rotated by more than {:.0f} degrees on {} of the "
            "area; {} degrees from dP/du",
            percentOf(p.stored.reversedW), kMaxTangentAngle, percentOf(p.stored.rotated), toText(p.stored.angle)));
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
    return fmt::format("Green, judged by the maps alone: as declared in {}, the other way in {}, undecidable in {}.",
                       right, wrong, report.maps.size() - right - wrong);
}

constexpr std::size_t kWorst = 3; // primitives in the table of candidates

// "0.12 / 1.3", or "-" if it was not measured.
std::string cellOf(const FrameDecision& d, Frame frame, TangentOrigin tangents)
{
    const auto c = std::ranges::find_if(d.candidates, [&](const FrameCandidate& candidate) {
        return candidate.frame == frame && candidate.tangents == tangents && candidate.points > 0;
    });
    const bool chosen = c != d.candidates.end() && d.frame == frame && d.tangents == tangents;
    return c == d.candidates.end() ? "-"
                                   : fmt::format("{}{:.2f} / {:.1f}", chosen ? "*" : "", c->mean, c->percentile99);
}

// The candidates of the primitives that the cheapest one reads worst.
std::vector<std::string> candidateLines(const LintReport& report)
{
    std::vector<const FrameDecision*> judged;
    for (const FrameDecision& d : report.decisions)
        if (!d.candidates.empty() && d.candidates.front().mean > 0)
            judged.push_back(&d);
    if (judged.empty())
        return {};
    std::ranges::stable_sort(judged, std::greater(), [](const FrameDecision* d) { return d->candidates.front().mean; });
    judged.resize(std::min(judged.size(), kWorst));
    std::vector<std::string> lines = {
        "Degrees between normals with each frame and with the tangents, on average / exceeded on 1 % of the area (* "
        "chosen):",
        fmt::format("  {:<24}{:>14}{:>14}{:>14}{:>14}{:>16}", "", "orthonormal", "triangle", "smooth", "mikktspace",
                    "file's tangents")};
    for (const FrameDecision* d : judged) {
        const auto p = std::ranges::find(report.primitives, d->mesh, &PrimitiveLint::meshIndex);
        std::string name = p == report.primitives.end() ? std::string() : p->mesh.empty() ? p->material : p->mesh;
        if (fmt::format("{:.22}", name) != name) // which counts characters, not bytes
            name = fmt::format("{:.21}~", name);
        std::string line = fmt::format("  {:<24}", name);
        for (const Frame frame : {Frame::orthonormal, Frame::triangle, Frame::smooth, Frame::mikktspace})
            line += fmt::format("{:>14}", cellOf(*d, frame, TangentOrigin::generated));
        lines.push_back(line + fmt::format("{:>16}", cellOf(*d, Frame::mikktspace, TangentOrigin::stored)));
    }
    return lines;
}

} // namespace

std::string counted(std::size_t number, const std::string& noun)
{
    return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

std::string toText(const ValueSummary& s)
{
    return s.count > 0 ? fmt::format("{:.2f} / {:.2f} / {:.2f}", s.mean, s.percentile95, s.maximum)
                       : "nothing to measure";
}

std::vector<std::string> verdictLines(const std::string& model, const LintReport& report, const std::string& run)
{
    std::vector<std::string> lines = {titleOf(model, report)};
    for (const std::string& line : {report.defects, report.seen, report.worst, greenLine(report), report.notJudged,
                                    report.otherReaders, report.advised})
        if (!line.empty())
            lines.push_back(line);
    if (!run.empty())
        lines.push_back("  " + run);
    for (std::string& line : candidateLines(report))
        lines.push_back(std::move(line));
    return lines;
}

std::vector<std::string> detailLines(const LintReport& report)
{
    std::vector<std::string> lines;
    lines.emplace_back("Three values are mean / 95 % / maximum, weighted by area.");
    for (std::size_t i = 0; i < report.primitives.size(); ++i)
        addPrimitive(report, i, lines);
    for (const GreenEvidence& g : report.maps)
        lines.push_back(fmt::format(
            "normal map {}{}: green, if red points right, {}; agreement {:+.2f} for green up, {} of the detail agrees",
            g.image, g.name.empty() ? "" : " " + g.name, greenVerdict(g), g.verdict.agreement,
            percentOf(g.verdict.votes)));
    for (const MapFit& f : report.fits)
        lines.push_back(fmt::format("normal map {}{}: read unchanged, orthonormal {}, cotangent {}, smooth {}", f.image,
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

} // namespace cotan::app
