// Lint's advice on hand-made reports.
#pragma once

#include <utility>
#include <vector>

#include "lint_parts.hpp"

namespace cotan {

inline LintReport adviceOn(std::vector<PrimitiveLint> primitives, std::vector<MapFit> fits,
                           std::vector<GreenEvidence> maps)
{
    LintReport report;
    report.primitives = std::move(primitives);
    report.fits = std::move(fits);
    report.maps = std::move(maps);
    lint::recommend(report);
    return report;
}

} // namespace cotan
