#include "cotan/lint.hpp"

#include <cmath>

#include <fmt/format.h>

#include "lint_parts.hpp"

namespace cotan {

namespace {

using lint::mapName;

// "normal map bumps: green points opposite to what the file says (certain)"
std::string reversedGreenText(const GreenEvidence& map)
{
    return fmt::format("normal map {}: green points opposite to what the file says ({})", mapName(map),
                       maps::name(map.verdict.confidence));
}

// modelMean: in degrees, with the frame of the limits; NaN if nothing was judged.
void checkPrimitive(const PrimitiveLint& p, const std::string& where, double modelMean, LintCheck& check)
{
    const char* const percent = "% of the area";
    const auto over = [&](const char* kind, double value, double limit, const std::string& what, const char* unit) {
        const bool fails = limit >= 0 && value > limit;
        if (fails)
            check.failures.push_back(
                {.kind = kind,
                 .where = where,
                 .value = value,
                 .limit = limit,
                 .text = fmt::format("{}: {} {:.3g} {}, limit {:.3g}", where, what, value, unit, limit),
                 .mesh = p.mesh,
                 .material = p.material,
                 .percent = unit == percent});
        return fails;
    };
    const double degrees = check.limits.degrees, area = check.limits.area;
    if (degrees >= 0 && p.unread)
        check.failures.push_back({.kind = "not_judged",
                                  .where = where,
                                  .text = fmt::format("{}: not judged, {}", where, p.notJudged),
                                  .mesh = p.mesh,
                                  .material = p.material});
    for (const Reading& r : p.readings)
        if (r.name == check.limits.frame
            && over("reading", r.error.percentile95, degrees, "95th percentile of the error with " + r.name, "degrees"))
            check.failures.back().beside =
                fmt::format("the limit applies to each primitive; the mean of this one is {:.3g}, of the model {:.3g}",
                            r.error.mean, std::isnan(modelMean) ? r.error.mean : modelMean);
    if (p.image >= 0)
        over("rounding", p.precision, degrees, "rounding", "degrees");
    over("degenerate_uv", 100 * p.uv.degenerate, area, "degenerate uv on", percent);
    over("mirrored_overlap", 100 * p.uv.overlappingMirrored, area, "uv overlapping in both orientations on", percent);
    over("reversed_w", 100 * p.stored.reversedW, area, "TANGENT.w contradicting the uv on", percent);
    over("rotated_tangents", 100 * p.stored.rotated, area, "stored tangents rotated on", percent);
}

} // namespace

std::string lint::mapName(const GreenEvidence& map)
{
    return map.name.empty() ? fmt::format("image {}", map.image) : map.name;
}

LintCheck checkLimits(const LintReport& report, const LintLimits& limits)
{
    LintCheck check{limits, {}};
    if (!limits.any())
        return check;
    const double modelMean = lint::meanOfReading(report, limits.frame);
    bool anyMap = false, anyJudged = false;
    for (std::size_t i = 0; i < report.primitives.size(); ++i) {
        const PrimitiveLint& p = report.primitives[i];
        checkPrimitive(p, nameOf(p, i), modelMean, check);
        anyMap = anyMap || p.image >= 0;
        anyJudged = anyJudged || (p.image >= 0 && p.notJudged.empty());
    }
    for (const GreenEvidence& map : report.maps) {
        if (!map.asDeclared())
            check.failures.push_back(
                {.kind = "reversed_green", .where = mapName(map), .text = reversedGreenText(map), .map = mapName(map)});
        for (const maps::Fault& fault : map.faults)
            if (maps::changesLight(fault.kind))
                check.failures.push_back({.kind = "broken_map",
                                          .where = mapName(map),
                                          .text = fmt::format("normal map {}: {}", mapName(map), fault.text),
                                          .map = mapName(map)});
    }
    if (limits.degrees >= 0 && anyMap && !anyJudged && check.passed())
        check.failures.push_back({.kind = "not_judged", .where = "", .text = "no normal map could be judged"});
    return check;
}

const std::vector<std::string>& readingNames()
{
    static const std::vector<std::string> names = {"cotangent", "orthonormal", "smooth", "exact", "triangle", "stored"};
    return names;
}

std::vector<std::string> lintWarnings(const LintReport& report)
{
    std::vector<std::string> lines;
    for (const GreenEvidence& map : report.maps) {
        if (!map.asDeclared())
            lines.push_back(reversedGreenText(map));
        if (!map.note.empty())
            lines.push_back(fmt::format("normal map {}: {}", mapName(map), map.note));
    }
    lines.insert(lines.end(), report.hints.begin(), report.hints.end());
    return lines;
}

std::string nameOf(const PrimitiveLint& p, std::size_t index)
{
    const std::string mesh = p.mesh.empty() ? fmt::format("primitive {}", index) : p.mesh;
    const std::string name = p.material.empty() ? mesh : fmt::format("{}, material {}", mesh, p.material);
    return p.placings == 1 ? name : fmt::format("{}, node scaling {} of {}", name, p.placing + 1, p.placings);
}

} // namespace cotan
