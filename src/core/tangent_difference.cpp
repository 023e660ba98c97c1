#include "cotan/tangents.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"

namespace cotan {

namespace {

bool isDegenerate(const MeshView& mesh, std::size_t corner)
{
    const auto i = mesh.indices.subspan(corner / 3 * 3, 3);
    const glm::dvec2 origin(mesh.texcoords[i[0]]);
    const glm::dvec2 a = glm::dvec2(mesh.texcoords[i[1]]) - origin;
    const glm::dvec2 b = glm::dvec2(mesh.texcoords[i[2]]) - origin;
    const glm::vec3 p = mesh.positions[i[0]], q = mesh.positions[i[1]], r = mesh.positions[i[2]];
    return a.x * b.y == a.y * b.x || p == q || q == r || p == r;
}

float degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    constexpr double kDegrees = 57.29577951308232;
    return float(angleBetween(a, b) * kDegrees);
}

double share(std::size_t part, std::size_t whole) { return whole == 0 ? 0 : double(part) / double(whole); }

} // namespace

double turnedShare(const TangentDifference& d)
{
    const auto turned = std::count_if(d.degrees.begin(), d.degrees.end(), [](float degrees) { return degrees > 90; });
    return share(std::size_t(turned), d.degrees.size());
}

double invertedShare(const TangentDifference& d) { return share(d.handedness, d.degrees.size()); }

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
    if (d.handedness == 0 && *std::max_element(d.degrees.begin(), d.degrees.end()) <= kEqualTangents)
        return TangentVerdict::equal;
    if (invertedShare(d) >= 0.9)
        return TangentVerdict::inverted;
    const double turned = turnedShare(d);
    return turned >= 0.4 && turned <= 0.6 ? TangentVerdict::turned : TangentVerdict::off;
}

} // namespace cotan
