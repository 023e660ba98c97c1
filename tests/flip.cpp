#include "flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace cotan::test {
namespace {

using glm::dmat3;
using glm::dvec3;

constexpr double kPixelsPerDegree = 0.7 * 3840 / 0.7 * std::numbers::pi / 180;

// Linear sRGB colours to CIE XYZ, by columns, and the XYZ of white.
const dmat3 kToXyz(0.4124564, 0.2126729, 0.0193339, 0.3575761, 0.7151522, 0.1191920, 0.1804375, 0.0721750, 0.9503041);
const dvec3 kWhite = kToXyz * dvec3(1);

double linearOf(double x) { return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4); }

// Luminance and two colour differences, and the inverse.
dvec3 opponentOf(dvec3 linear)
{
    const dvec3 c = kToXyz * linear / kWhite;
    return {116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z)};
}

dvec3 linearOfOpponent(dvec3 c)
{
    const double y = (c.x + 16) / 116;
    return glm::inverse(kToXyz) * (dvec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

// CIE L*a*b* with reduced chroma in dark colours (Hunt's adjustment).
dvec3 labOf(dvec3 linear)
{
    const dvec3 c = kToXyz * linear / kWhite;
    const auto curve = [](double t) {
        constexpr double d = 6.0 / 29;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
    };
    const double l = 116 * curve(c.y) - 16;
    return {l, 0.01 * l * 500 * (curve(c.x) - curve(c.y)), 0.01 * l * 200 * (curve(c.y) - curve(c.z))};
}

double distanceOf(dvec3 a, dvec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// A separable kernel's row or column.
using Row = std::vector<double>;

struct Plane {
    int width, height;
    std::vector<double> values;

    double at(int x, int y) const
    {
        return values[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width)
                      + std::size_t(std::clamp(x, 0, width - 1))];
    }
    Plane filtered(const Row& across, const Row& down) const
    {
        const auto pass = [](const Plane& from, const Row& row, int dx, int dy) {
            Plane to{from.width, from.height, std::vector<double>(from.values.size())};
            const int radius = int(row.size()) / 2;
            for (int y = 0; y < from.height; ++y)
                for (int x = 0; x < from.width; ++x)
                    for (int k = -radius; k <= radius; ++k)
                        to.values[std::size_t(y) * std::size_t(from.width) + std::size_t(x)] +=
                            row[std::size_t(k + radius)] * from.at(x + k * dx, y + k * dy);
            return to;
        };
        return pass(pass(*this, across, 1, 0), down, 0, 1);
    }
};

struct Normal {
    double weight, width; // a and b: weight * sqrt(pi / width) * exp(-pi^2 x^2 / width), x in degrees
};

// An opponent channel after the eye's contrast sensitivity: filtered with a sum of two Gaussians.
Plane filteredByEye(const Plane& plane, Normal first, Normal second, double widest)
{
    const int radius =
        int(std::ceil(3 * std::sqrt(widest / (2 * std::numbers::pi * std::numbers::pi)) * kPixelsPerDegree));
    std::array<Row, 2> rows;
    std::array<double, 2> total{};
    for (int i = 0; i < 2; ++i) {
        const Normal g = i == 0 ? first : second;
        double sum = 0;
        for (int k = -radius; k <= radius; ++k) {
            const double x = k / kPixelsPerDegree;
            rows[std::size_t(i)].push_back(std::exp(-std::numbers::pi * std::numbers::pi * x * x / g.width));
            sum += rows[std::size_t(i)].back();
        }
        for (double& w : rows[std::size_t(i)])
            w /= sum;
        total[std::size_t(i)] = g.weight * std::sqrt(std::numbers::pi / g.width) * sum * sum;
    }
    Plane a = plane.filtered(rows[0], rows[0]);
    if (second.weight == 0)
        return a;
    const Plane b = plane.filtered(rows[1], rows[1]);
    for (std::size_t i = 0; i < a.values.size(); ++i)
        a.values[i] = (a.values[i] * total[0] + b.values[i] * total[1]) / (total[0] + total[1]);
    return a;
}

// Edges and points of the luminance: responses to first and second derivatives.
struct Features {
    Plane edgeX, edgeY, pointX, pointY;
    glm::dvec2 at(std::size_t i) const
    {
        return {std::hypot(edgeX.values[i], edgeY.values[i]), std::hypot(pointX.values[i], pointY.values[i])};
    }
};

Features featuresOf(const Plane& luminance)
{
    const double deviation = 0.5 * 0.082 * kPixelsPerDegree;
    const int radius = int(std::ceil(3 * deviation));
    Row gauss, first, second;
    for (int k = -radius; k <= radius; ++k) {
        const double g = std::exp(-k * k / (2 * deviation * deviation));
        gauss.push_back(g);
        first.push_back(-k * g);
        second.push_back((k * k / (deviation * deviation) - 1) * g);
    }
    double sum = 0;
    for (const double g : gauss)
        sum += g;
    for (double& g : gauss)
        g /= sum;
    for (Row* const row : {&first, &second}) { // positive and negative weights sum to 1 and -1
        double above = 0, below = 0;
        for (const double w : *row)
            (w > 0 ? above : below) += std::abs(w);
        for (double& w : *row)
            w /= w > 0 ? above : below;
    }
    return {luminance.filtered(first, gauss), luminance.filtered(gauss, first), luminance.filtered(second, gauss),
            luminance.filtered(gauss, second)};
}

struct Eye {
    std::vector<dvec3> lab;
    Features features;
};

Eye eyeOf(const Image& image)
{
    std::array<Plane, 3> planes;
    planes.fill({image.width, image.height, {}});
    Plane luminance{image.width, image.height, {}};
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        dvec3 linear;
        for (int c = 0; c < 3; ++c)
            linear[c] = linearOf(double(image.data[i * image.bytesPerPixel() + std::size_t(c)]) / 255);
        const dvec3 opponent = opponentOf(linear);
        for (int c = 0; c < 3; ++c)
            planes[std::size_t(c)].values.push_back(opponent[c]);
        luminance.values.push_back((opponent.x + 16) / 116);
    }
    constexpr double widest = 0.04;
    planes[0] = filteredByEye(planes[0], {1, 0.0047}, {0, 1e-5}, widest);
    planes[1] = filteredByEye(planes[1], {1, 0.0053}, {0, 1e-5}, widest);
    planes[2] = filteredByEye(planes[2], {34.1, 0.04}, {13.5, 0.025}, widest);
    Eye eye{{}, featuresOf(luminance)};
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        eye.lab.push_back(labOf(glm::clamp(
            linearOfOpponent({planes[0].values[i], planes[1].values[i], planes[2].values[i]}), dvec3(0), dvec3(1))));
    return eye;
}

} // namespace

double flipError(const Image& reference, const Image& candidate, const std::vector<bool>& counted)
{
    const Eye a = eyeOf(reference), b = eyeOf(candidate);
    const double maxDistance = std::pow(distanceOf(labOf({0, 1, 0}), labOf({0, 0, 1})), 0.7), knee = 0.4 * maxDistance;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < reference.pixelCount(); ++i) {
        if (!counted[i])
            continue;
        const double apart = std::pow(distanceOf(a.lab[i], b.lab[i]), 0.7);
        const double colour = apart < knee ? apart * 0.95 / knee : 0.95 + (apart - knee) / (maxDistance - knee) * 0.05;
        const glm::dvec2 change = glm::abs(a.features.at(i) - b.features.at(i));
        const double feature = std::sqrt(std::max(change.x, change.y) / std::numbers::sqrt2);
        sum += std::pow(colour, 1 - std::min(feature, 1.0));
        ++count;
    }
    return count == 0 ? std::nan("") : sum / double(count);
}

} // namespace cotan::test
