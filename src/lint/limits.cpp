#include "cotan/lint/limits.hpp"

#include <fmt/format.h>

namespace cotan {

std::vector<std::string> overLimits(const LintReport& report, const LintLimits& limits)
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
        if (limits.degrees >= 0 && p.unread)
            lines.push_back(fmt::format("{}: not judged, {}; limit {:.3g}", nameOf(p, i), p.notJudged, limits.degrees));
        for (const Reading& r : p.readings)
            if (r.name == limits.frame)
                check(r.error.percentile95, limits.degrees, "95 % of the error of reading with " + r.name, "degrees");
        if (p.image >= 0)
            check(p.precision, limits.degrees, "rounding", "degrees");
        check(100 * p.uv.degenerate, limits.area, "degenerate uv on", "% of the area");
        check(100 * p.uv.overlappingMirrored, limits.area, "uv overlapping in both orientations on", "% of the area");
        check(100 * p.stored.reversedW, limits.area, "TANGENT.w against the uv on", "% of the area");
        check(100 * p.stored.turned, limits.area, "stored tangents turned on", "% of the area");
    }
    if (limits.degrees >= 0 && anyMap && !anyJudged && lines.empty())
        lines.push_back(fmt::format("no normal map could be judged, limit {:.3g}", limits.degrees));
    return lines;
}

std::string nameOf(const PrimitiveLint& p, std::size_t index)
{
    const std::string mesh = p.mesh.empty() ? fmt::format("primitive {}", index) : p.mesh;
    const std::string name = p.material.empty() ? mesh : fmt::format("{}, material {}", mesh, p.material);
    return p.placings == 1
        ? name
        : fmt::format("{}, stretched by its nodes in {} ways, number {}", name, p.placings, p.placing + 1);
}

} // namespace cotan
