#include "tangents_report.hpp"

#include <array>

#include "inspect/angles.hpp"
#include <fmt/format.h>

namespace cotan::app {

namespace {

std::string percent(double fraction) { return fmt::format("{:.1f} %", fraction * 100); }

const char* name(TangentVerdict verdict)
{
    constexpr std::array names{"nothing to compare", "equal", "w inverted", "half reversed", "off"};
    return names[std::size_t(verdict)];
}

// Smaller values are rounding errors.
std::string degreesText(double degrees) { return degrees < 0.001 ? "under 0.001" : fmt::format("{:.3g}", degrees); }

std::string directions(const AngleStatistics& s)
{
    if (s.maximum <= kEqualTangents)
        return fmt::format("equal (max {} degrees)", degreesText(s.maximum));
    return fmt::format("mean {:.3g}, median {:.3g}, 95 % {:.3g}, 99 % {:.3g}, max {:.3g} degrees", s.mean, s.median,
                       s.percentile95, s.percentile99, s.maximum);
}

} // namespace

std::string toText(const TangentDifference& d, const std::string& reference)
{
    const AngleStatistics s = angleStatistics(d.degrees);
    std::string line;
    switch (verdictOf(d)) {
    case TangentVerdict::nothing: line = "nothing to compare"; break;
    case TangentVerdict::equal:
        line = fmt::format("equal to {} (max {} degrees)", reference, degreesText(s.maximum));
        break;
    case TangentVerdict::inverted:
        line = fmt::format("w inverted against {} on {} of the corners; directions {}", reference,
                           percent(invertedFraction(d)), directions(s));
        break;
    case TangentVerdict::turned:
        line = fmt::format("half reversed against {}: {} point the other way; w differs on {} of the corners; "
                           "directions {}",
                           reference, percent(reversedFraction(d)), percent(invertedFraction(d)), directions(s));
        break;
    case TangentVerdict::off:
        line = s.maximum <= kEqualTangents ? fmt::format("directions equal to {}", reference)
                                           : fmt::format("differs from {} by {}", reference, directions(s));
        line += d.handedness == 0 ? "; w equal"
                                  : fmt::format("; w differs on {} of {} corners", d.handedness, d.degrees.size());
        break;
    }
    if (d.degenerate > 0)
        line += fmt::format("; {} of {} corners are degenerate and not compared", d.degenerate, d.corners);
    return line;
}

Json toJson(const TangentDifference& d)
{
    Json directions = toJson(angleStatistics(d.degrees));
    directions.erase("pixels"); // these are corners, not pixels
    return {{"verdict", name(verdictOf(d))},   {"corners", d.corners},
            {"degenerate", d.degenerate},      {"w_different", invertedFraction(d)},
            {"reversed", reversedFraction(d)}, {"directions", directions}};
}

} // namespace cotan::app
