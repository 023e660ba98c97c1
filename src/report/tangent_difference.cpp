#include "cotan/report/tangent_difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace cotan {

namespace {

// Another implementation's rounding moves a tangent by some thousandths of a degree.
constexpr float kEqualDegrees = 0.05f;

bool isDegenerate(const MeshView& mesh, std::size_t corner)
{
    const auto i = mesh.indices.subspan(corner / 3 * 3, 3);
    const glm::dvec2 origin(mesh.texcoords[i[0]]);
    const glm::dvec2 a = glm::dvec2(mesh.texcoords[i[1]]) - origin;
    const glm::dvec2 b = glm::dvec2(mesh.texcoords[i[2]]) - origin;
    const glm::vec3 p = mesh.positions[i[0]], q = mesh.positions[i[1]], r = mesh.positions[i[2]];
    return a.x * b.y == a.y * b.x || p == q || q == r || p == r;
}

// By the cross product as well: the cosine alone knows no angles below 0.02 degrees in float.
float degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    constexpr double kDegrees = 57.29577951308232;
    return float(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegrees);
}

double share(std::size_t part, std::size_t whole)
{
    return whole == 0 ? 0 : double(part) / double(whole);
}

double turnedShare(const TangentDifference& d)
{
    const auto turned = std::count_if(d.degrees.begin(), d.degrees.end(),
                                      [](float degrees) { return degrees > 90; });
    return share(std::size_t(turned), d.degrees.size());
}

double invertedShare(const TangentDifference& d) { return share(d.handedness, d.degrees.size()); }

std::string percent(double part) { return fmt::format("{:.1f} %", part * 100); }

const char* name(TangentVerdict verdict)
{
    constexpr std::array names{"nothing to compare", "equal", "w inverted", "half turned", "off"};
    return names[std::size_t(verdict)];
}

// Smaller ones are rounding.
std::string degreesText(double degrees)
{
    return degrees < 0.001 ? "under 0.001" : fmt::format("{:.3g}", degrees);
}

std::string directions(const AngleStatistics& s)
{
    if (s.maximum <= kEqualDegrees)
        return fmt::format("equal (max {} degrees)", degreesText(s.maximum));
    return fmt::format("mean {:.3g}, median {:.3g}, 95 % {:.3g}, 99 % {:.3g}, max {:.3g} degrees",
                       s.mean, s.median, s.percentile95, s.percentile99, s.maximum);
}

} // namespace

TangentDifference tangentDifference(const MeshView& mesh, std::span<const glm::vec4> stored,
                                    std::span<const glm::vec4> generated)
{
    TangentDifference d;
    d.corners = generated.size();
    for (std::size_t c = 0; c < generated.size(); ++c) {
        const glm::vec4 a = stored[mesh.indices[c]], b = generated[c];
        const glm::dvec3 from(a), to(b);
        if (isDegenerate(mesh, c) || !(glm::length(from) > 0) || !(glm::length(to) > 0)) {
            ++d.degenerate;
            continue;
        }
        d.degrees.push_back(degreesBetween(from, to));
        d.handedness += (a.w < 0) != (b.w < 0);
    }
    return d;
}

void append(TangentDifference& to, const TangentDifference& more)
{
    to.degrees.insert(to.degrees.end(), more.degrees.begin(), more.degrees.end());
    to.corners += more.corners;
    to.degenerate += more.degenerate;
    to.handedness += more.handedness;
}

TangentVerdict verdictOf(const TangentDifference& d)
{
    if (d.degrees.empty())
        return TangentVerdict::nothing;
    if (d.handedness == 0
        && *std::max_element(d.degrees.begin(), d.degrees.end()) <= kEqualDegrees)
        return TangentVerdict::equal;
    if (invertedShare(d) >= 0.9)
        return TangentVerdict::inverted;
    const double turned = turnedShare(d);
    return turned >= 0.4 && turned <= 0.6 ? TangentVerdict::turned : TangentVerdict::off;
}

std::string toText(const TangentDifference& d, const std::string& reference)
{
    const AngleStatistics s = statisticsOf(d.degrees);
    std::string line;
    switch (verdictOf(d)) {
    case TangentVerdict::nothing: line = "nothing to compare"; break;
    case TangentVerdict::equal:
        line = fmt::format("equal to {} (max {} degrees)", reference, degreesText(s.maximum));
        break;
    case TangentVerdict::inverted:
        line = fmt::format("w inverted against {} on {} of the corners; directions {}", reference,
                           percent(invertedShare(d)), directions(s));
        break;
    case TangentVerdict::turned:
        line = fmt::format("half of them turned against {}: {} point the other way; w different "
                           "on {} of the corners; directions {}",
                           reference, percent(turnedShare(d)), percent(invertedShare(d)),
                           directions(s));
        break;
    case TangentVerdict::off:
        line = s.maximum <= kEqualDegrees
            ? fmt::format("directions equal to {}", reference)
            : fmt::format("off {} by {}", reference, directions(s));
        line += d.handedness == 0
            ? "; w equal"
            : fmt::format("; w different on {} of {} corners", d.handedness, d.degrees.size());
        break;
    }
    if (d.degenerate > 0)
        line += fmt::format("; {} of {} corners are degenerate and not compared", d.degenerate,
                            d.corners);
    return line;
}

nlohmann::ordered_json toJson(const TangentDifference& d)
{
    nlohmann::ordered_json directions = toJson(statisticsOf(d.degrees));
    directions.erase("pixels"); // corners here
    return {{"verdict", name(verdictOf(d))},
            {"corners", d.corners},
            {"degenerate", d.degenerate},
            {"w_different", invertedShare(d)},
            {"turned", turnedShare(d)},
            {"directions", directions}};
}

} // namespace cotan
