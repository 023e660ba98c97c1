#include "inspect/angles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "cotan/vector.hpp"

namespace cotan {

namespace {

glm::dvec3 directionAt(const Image& image, std::size_t pixel)
{
    const float* p = image.floats() + pixel * 4;
    return p[3] > 0 ? glm::dvec3(p[0], p[1], p[2]) : glm::dvec3(0);
}

struct Stop {
    float degrees;
    glm::vec3 color; // sRGB
};

constexpr std::array<Stop, 6> kHeat = {{{0, {0, 0, 0}},
                                        {0.5f, {20, 60, 200}},
                                        {2, {30, 180, 80}},
                                        {5, {250, 220, 40}},
                                        {15, {220, 30, 20}},
                                        {45, {255, 255, 255}}}};

glm::vec3 heatColor(float degrees)
{
    for (std::size_t i = 1; i < kHeat.size(); ++i)
        if (degrees < kHeat[i].degrees) {
            const Stop &a = kHeat[i - 1], &b = kHeat[i];
            return a.color + (b.color - a.color) * ((degrees - a.degrees) / (b.degrees - a.degrees));
        }
    return kHeat.back().color;
}

void setPixel(Image& image, std::size_t pixel, glm::vec3 color255)
{
    std::uint8_t* p = image.bytes8() + pixel * 4;
    for (int c = 0; c < 3; ++c)
        p[c] = std::uint8_t(std::clamp(color255[c], 0.0f, 255.0f) + 0.5f);
    p[3] = 255;
}

// An image with the colour of each covered pixel computed from its value in `source`.
template<class Color> Image colored(const Image& source, Color color)
{
    Image image = makeImage(source.width, source.height, PixelType::unorm8, source.name);
    for (std::size_t i = 0; i < source.pixelCount(); ++i) {
        const float* p = source.floats() + i * 4;
        if (p[3] > 0)
            setPixel(image, i, color(glm::vec3(p[0], p[1], p[2])));
    }
    return image;
}

Image depthAsColor(const Image& depth)
{
    float nearest = 1e30f, farthest = 0;
    for (std::size_t i = 0; i < depth.pixelCount(); ++i) {
        const float* p = depth.floats() + i * 4;
        if (p[3] > 0) {
            nearest = std::min(nearest, p[0]);
            farthest = std::max(farthest, p[0]);
        }
    }
    const float span = std::max(farthest - nearest, 1e-20f);
    return colored(depth, [&](glm::vec3 d) { return glm::vec3(255 - 215 * (d.x - nearest) / span); });
}

} // namespace

std::vector<float> anglesBetween(const Image& a, const Image& b)
{
    std::vector<float> degrees(a.pixelCount(), -1.0f);
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        const glm::dvec3 u = directionAt(a, i), v = directionAt(b, i);
        if (u != glm::dvec3(0) && v != glm::dvec3(0))
            degrees[i] = float(angleBetween(u, v) * 180 / std::numbers::pi);
    }
    return degrees;
}

void keepInterior(std::vector<float>& degrees, int width, int height)
{
    const std::vector<float> before = degrees;
    auto missing = [&](int x, int y) {
        return x < 0 || y < 0 || x >= width || y >= height
            || before[std::size_t(y) * std::size_t(width) + std::size_t(x)] < 0;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    if (missing(x + dx, y + dy))
                        degrees[std::size_t(y) * std::size_t(width) + std::size_t(x)] = -1;
}

std::vector<float> interiorAngles(const Image& a, const Image& b)
{
    std::vector<float> degrees = anglesBetween(a, b);
    keepInterior(degrees, a.width, a.height);
    return degrees;
}

double shareOpposed(const std::vector<float>& degrees)
{
    const auto compared = std::ranges::count_if(degrees, [](float d) { return d >= 0; });
    const auto opposed = std::ranges::count_if(degrees, [](float d) { return d > 90; });
    return compared > 0 ? double(opposed) / double(compared) : kEmptyStatistics;
}

Image heatMap(const std::vector<float>& degrees, int width, int height)
{
    Image image = makeImage(width, height, PixelType::unorm8, "heat map");
    for (std::size_t i = 0; i < degrees.size(); ++i)
        setPixel(image, i, degrees[i] < 0 ? glm::vec3(96) : heatColor(degrees[i]));
    return image;
}

Image asColor(Output output, const Image& image)
{
    if (output == Output::depth)
        return depthAsColor(image);
    if (output == Output::uv)
        return colored(image, [](glm::vec3 c) { return (c - glm::floor(c)) * 255.0f; });
    return colored(image, [](glm::vec3 d) { return (d * 0.5f + 0.5f) * 255.0f; });
}

void AngleCounter::add(float degrees)
{
    if (!(degrees >= 0) || !std::isfinite(degrees))
        return;
    values_.add(double(degrees));
    over1_ += degrees > 1;
    over5_ += degrees > 5;
}

AngleStatistics AngleCounter::statistics()
{
    if (values_.count() == 0)
        return {};
    const double n = double(values_.count());
    return {.count = values_.count(),
            .mean = values_.mean(),
            .median = values_.percentile(0.5),
            .percentile95 = values_.percentile(0.95),
            .percentile99 = values_.percentile(0.99),
            .maximum = values_.maximum(),
            .over1 = double(over1_) / n,
            .over5 = double(over5_) / n};
}

AngleStatistics angleStatistics(const std::vector<float>& degrees)
{
    AngleCounter counter;
    for (float d : degrees)
        counter.add(d);
    return counter.statistics();
}

std::string toText(const AngleStatistics& s)
{
    if (s.count == 0)
        return "nothing was compared";
    return fmt::format("mean {:.3f}, median {:.3f}, 95 % {:.3f}, 99 % {:.3f}, max {:.2f} degrees; "
                       "over 1: {:.1f} %, over 5: {:.1f} %",
                       s.mean, s.median, s.percentile95, s.percentile99, s.maximum, s.over1 * 100, s.over5 * 100);
}

Json toJson(const AngleStatistics& s)
{
    return {{"pixels", s.count},
            {"mean_degrees", s.mean},
            {"median_degrees", s.median},
            {"percentile95_degrees", s.percentile95},
            {"percentile99_degrees", s.percentile99},
            {"max_degrees", s.maximum},
            {"fraction_over_1_degree", s.over1},
            {"fraction_over_5_degrees", s.over5}};
}

} // namespace cotan
