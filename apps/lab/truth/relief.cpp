#include "truth/relief.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace cotan {

ReliefSample Waves::at(double u, double v) const
{
    constexpr double kDiagonal = 0.7; // relative wave number of the diagonal waves, whose amplitude is halved
    const double k = 2 * std::numbers::pi * perUnit, d = kDiagonal * k;
    const double amplitude = slope / (1.25 * k);
    const double sinU = std::sin(k * u + 1), cosU = std::cos(k * u + 1);
    const double sinV = std::sin(k * v), cosV = std::cos(k * v);
    const double sinD = std::sin(d * (u + v)), cosD = std::cos(d * (u + v));
    return {amplitude * (sinU * cosV + 0.5 * sinD), amplitude * (k * cosU * cosV + 0.5 * d * cosD),
            amplitude * (-k * sinU * sinV + 0.5 * d * cosD)};
}

glm::dvec3 texelOf(const ReliefSample& s, double scale)
{
    return glm::normalize(glm::dvec3(-s.hu * scale, -s.hv * scale, 1));
}

} // namespace cotan
