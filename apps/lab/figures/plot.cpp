#include "plot.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "cotan/portable.hpp"
#include "truth.hpp"
#include "truth/quad.hpp"

namespace cotan::figures {

glm::dvec3 plotLight() { return glm::normalize(glm::dvec3(-0.6, 0.55, 0.58)); }

glm::dvec3 onSphere(glm::dvec2 at) { return {at, std::sqrt(std::max(1 - glm::dot(at, at), 0.0))}; }

glm::dvec3 plotShade(glm::dvec3 n, glm::dvec3 v, glm::dvec3 color)
{
    const double lit = std::max(glm::dot(n, plotLight()), 0.0);
    return color * (0.12 + 0.08 * n.y + lit) + 0.12 * lit * f64::cotan_ggx(n, v, plotLight(), 0.45);
}

Image plot(int side, const std::function<glm::dvec3(glm::dvec2 at)>& color)
{
    constexpr int kSamples = 2; // along a side of a pixel
    Image image = makeImage(side, side, PixelType::unorm8, "plot");
    parallelFor(0, side, [&](int y) {
        std::uint8_t* out = image.bytes8() + 4 * std::ptrdiff_t(y) * side;
        for (int x = 0; x < side; ++x, out += 4) {
            glm::dvec3 sum(0);
            for (int i = 0; i < kSamples * kSamples; ++i) {
                const glm::dvec2 p(x + (i % kSamples + 0.5) / kSamples, y + (i / kSamples + 0.5) / kSamples);
                sum += f64::cotan_tone_map(color({2 * p.x / side - 1, 1 - 2 * p.y / side}));
            }
            for (int c = 0; c < 3; ++c)
                out[c] = std::uint8_t(std::lround(f64::cotan_linear_to_srgb(sum[c] / (kSamples * kSamples)) * 255));
            out[3] = 255;
        }
    });
    return image;
}

std::vector<float> plotValues(const std::function<std::optional<double>(glm::dvec2 at)>& value)
{
    constexpr int kPoints = 150; // along a side
    std::vector<float> values;
    for (int i = 0; i < kPoints * kPoints; ++i)
        if (const auto v = value((glm::dvec2(i % kPoints, i / kPoints) + 0.5) * (2.0 / kPoints) - 1.0))
            values.push_back(float(*v));
    return values;
}

void plotDirections(Figure& figure, int side, const PlottedDirection& plotted)
{
    const auto draw = [&](By by) { return plot(side, [&](glm::dvec2 at) { return plotted.color(by, at); }); };
    figure.panels = {{"a-cotan", plotted.cotan, "", draw(By::cotan)},
                     {"b-usual", plotted.usual, "", draw(By::usual)},
                     {"c-truth", "truth", "", draw(By::truth)}};
    for (const By by : {By::cotan, By::usual}) {
        const auto degrees = plotValues([&](glm::dvec2 at) -> std::optional<double> {
            const auto direction = plotted.direction(by, at);
            return direction ? std::optional(degreesBetween(*direction, *plotted.direction(By::truth, at)))
                             : std::nullopt;
        });
        figure.measures.push_back({by == By::cotan ? "cotan" : "usual", angleStatistics(degrees)});
        addError(figure, figure.measures.size() - 1, figure.measures.back().name);
    }
    figure.sliders = {{1, 0}};
}

} // namespace cotan::figures
