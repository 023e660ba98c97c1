// Lint's advice on hand-made reports, in which every judged map fits `orthonormal` unless decisions are given.
#pragma once

#include <utility>
#include <vector>

#include "lint_parts.hpp"

namespace cotan {

inline LintReport adviceOn(std::vector<PrimitiveLint> primitives, std::vector<MapFit> fits,
                           std::vector<GreenEvidence> maps, std::vector<FrameDecision> decisions = {})
{
    LintReport report;
    report.primitives = std::move(primitives);
    report.fits = std::move(fits);
    report.maps = std::move(maps);
    report.decisions = std::move(decisions);
    for (std::size_t i = 0; i < report.primitives.size(); ++i) {
        report.primitives[i].meshIndex = i;
        if (report.decisions.size() <= i)
            report.decisions.push_back({.mesh = i,
                                        .reason = report.primitives[i].image < 0     ? ChoiceReason::noMap
                                            : report.primitives[i].notJudged.empty() ? ChoiceReason::fits
                                                                                     : ChoiceReason::notJudged});
    }
    lint::recommend(report);
    return report;
}

} // namespace cotan
