#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene.hpp"

namespace cotan {

namespace {

// Returns x shifted by a multiple of `period` into [-period/2, period/2].
double centred(double x, double period) { return x - period * std::round(x / period); }

// Domes (1 - r^2)^2, steepest slope 0.92, on a square grid.
HeightSample domes(double u, double v)
{
    constexpr double kGrid = 0.25, kRadius = 0.1, kAmplitude = 0.6 * kRadius;
    const double x = centred(u - kGrid / 2, kGrid) / kRadius;
    const double y = centred(v - kGrid / 2, kGrid) / kRadius;
    const double inside = std::max(1 - x * x - y * y, 0.0);
    const double slope = -4 * kAmplitude / kRadius * inside;
    return {kAmplitude * inside * inside, slope * x, slope * y};
}

struct Ramp {
    double value, slope;
};

// 0 in the mortar joint, 1 on the brick, with a C1 transition; x is measured from the middle of the brick.
Ramp brickProfile(double x, double brickLength)
{
    constexpr double kJoint = 0.006, kEdge = 0.014; // half the joint's width; the width of the rounded edge
    const double t = (brickLength / 2 - std::abs(x) - kJoint) / kEdge;
    const double s = std::clamp(t, 0.0, 1.0);
    const double outwards = x < 0 ? -1 : 1;
    return {s * s * (3 - 2 * s), -outwards * 6 * s * (1 - s) / kEdge};
}

// Eight courses of four bricks in running bond: every other course is shifted by half a brick.
HeightSample bricks(double u, double v)
{
    constexpr double kLength = 0.25, kHeight = 0.125, kAmplitude = 0.009;
    const double course = std::floor(v / kHeight);
    const bool odd = course - 2 * std::floor(course / 2) == 1;
    const Ramp x = brickProfile(centred(u - (odd ? 0 : kLength / 2), kLength), kLength);
    const Ramp y = brickProfile(v - (course + 0.5) * kHeight, kHeight);
    return {kAmplitude * x.value * y.value, kAmplitude * x.slope * y.value, kAmplitude * x.value * y.slope};
}

// A sum of sines, each periodic over the unit square.
HeightSample waves(double u, double v)
{
    const struct {
        double perU, perV, phase, amplitude;
    } sines[] = {
        {2, 1, 0.0, 0.018},
        {-1, 3, 1.3, 0.014},
        {4, 2, 2.1, 0.007},
        {3, -5, 0.7, 0.005},
    };
    HeightSample sample;
    for (const auto& s : sines) {
        const double ku = 2 * std::numbers::pi * s.perU, kv = 2 * std::numbers::pi * s.perV;
        const double angle = ku * u + kv * v + s.phase;
        sample.h += s.amplitude * std::sin(angle);
        sample.hu += s.amplitude * ku * std::cos(angle);
        sample.hv += s.amplitude * kv * std::cos(angle);
    }
    return sample;
}

std::uint8_t exactByte(double x) { return static_cast<std::uint8_t>(std::lround(127 * x + 128)); }

const char* reliefName(Relief kind)
{
    return kind == Relief::domes ? "domes" : kind == Relief::bricks ? "bricks" : "waves";
}

} // namespace

HeightSample relief(Relief kind, double u, double v)
{
    switch (kind) {
    case Relief::domes: return domes(u, v);
    case Relief::bricks: return bricks(u, v);
    case Relief::waves: return waves(u, v);
    }
    return {};
}

Image makeReliefMap(Relief kind, int side)
{
    side = std::max(side, 1);
    Image image = makeImage(side, side, PixelType::unorm8, reliefName(kind));
    std::uint8_t* texel = image.bytes8();
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column, texel += 4) {
            const HeightSample s = relief(kind, (column + 0.5) / side, (row + 0.5) / side);
            const glm::dvec3 m = glm::normalize(glm::dvec3(-s.hu, -s.hv, 1));
            texel[0] = exactByte(m.x);
            texel[1] = exactByte(-m.y); // glTF's green points against +v
            texel[2] = exactByte(m.z);
            texel[3] = 255;
        }
    return image;
}

} // namespace cotan
