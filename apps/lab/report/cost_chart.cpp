#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cost/choices.hpp"
#include "cost_markdown.hpp"
#include "report/cost_tables.hpp"

namespace cotan {

using namespace cost;

namespace {

// Lengths are in SVG user units.
constexpr double kWidth = 860, kHeight = 496, kLeft = 64, kRight = 620, kTop = 76, kBottom = 400;
constexpr double kMin = 0.5, kMax = 1024; // pixels per triangle
constexpr double kLabelHeight = 17, kStripTop = 446, kStripHeight = 22;
constexpr int kSteps = 220; // per curve

struct Curve {
    std::string_view name;
    TrianglePrice price;
};

// The other curves are compared with the first.
struct Chart {
    std::vector<Curve> curves;
    double low, high; // range of the ratios shown

    double x(double pixels) const { return kLeft + (kRight - kLeft) * std::log(pixels / kMin) / std::log(kMax / kMin); }
    double y(double ratio) const { return kBottom - (kBottom - kTop) * std::log(ratio / low) / std::log(high / low); }
    double ratio(std::size_t curve, double pixels) const
    {
        return curves[curve].price.of(pixels) / curves[0].price.of(pixels);
    }
    static double pixelsAt(int step) { return kMin * std::pow(kMax / kMin, double(step) / kSteps); }
};

std::optional<Chart> chartOf(const DeviceCode& d)
{
    Chart chart{{}, 1, 1};
    for (const Choice& choice : choices()) {
        const auto price = trianglePrice(d, choice);
        if (!price)
            return std::nullopt;
        chart.curves.push_back({choice.name, *price});
    }
    for (std::size_t i = 0; i < chart.curves.size(); ++i)
        for (int step = 0; step <= kSteps; ++step) {
            const double r = chart.ratio(i, Chart::pixelsAt(step));
            chart.low = std::min(chart.low, std::floor(r * 10) / 10);
            chart.high = std::max(chart.high, std::ceil(r * 10) / 10);
        }
    return chart;
}

std::string text(double x, double y, std::string_view kind, std::string_view words)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, kind, words);
}

std::string axes(const Chart& c)
{
    std::string svg;
    for (double pixels = kMin; pixels <= kMax; pixels *= 2) {
        const double x = c.x(pixels);
        svg += fmt::format("<path class=\"grid\" d=\"M{:.1f} {}V{}\"/>\n", x, kTop, kBottom);
        svg += text(x, kBottom + 18, "tick middle", fmt::format("{:g}", pixels));
    }
    // Equal steps of the ratio are closer together at the top of the logarithmic axis.
    double last = kBottom + kLabelHeight;
    for (int tenth = int(std::lround(c.low * 10)); tenth <= int(std::lround(c.high * 10)); ++tenth) {
        const double y = c.y(tenth / 10.0);
        if (tenth != 10 && (last - y < kLabelHeight || std::abs(y - c.y(1)) < kLabelHeight))
            continue;
        last = y;
        svg += fmt::format("<path class=\"grid\" d=\"M{} {:.1f}H{}\"/>\n", kLeft, y, kRight);
        svg += text(kLeft - 8, y + 4, "tick end", fmt::format("{:.1f}", tenth / 10.0));
    }
    return svg + text((kLeft + kRight) / 2, kBottom + 37, "middle", "pixels that a triangle covers");
}

std::string curves(const Chart& c)
{
    std::string svg;
    for (std::size_t i = c.curves.size(); i-- > 0;) {
        svg += fmt::format("<path class=\"curve c{}\" d=\"", i);
        for (int step = 0; step <= kSteps; ++step)
            svg += fmt::format("{}{:.1f} {:.1f}", step ? "L" : "M", c.x(Chart::pixelsAt(step)),
                               c.y(c.ratio(i, Chart::pixelsAt(step))));
        svg += "\"/>\n";
    }
    return svg;
}

// Labels at the right ends of the curves, moved apart where they would overlap, with leader lines.
std::string names(const Chart& c)
{
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < c.curves.size(); ++i)
        order.push_back(i);
    const auto end = [&](std::size_t i) { return c.y(c.ratio(i, kMax)); };
    std::ranges::sort(order, {}, end);
    std::vector<double> labelY;
    for (const std::size_t i : order)
        labelY.push_back(std::max(end(i), labelY.empty() ? 0.0 : labelY.back() + kLabelHeight));
    double maxY = kBottom + kLabelHeight; // the lowest label may be a little below the axis
    for (std::size_t k = labelY.size(); k-- > 0; maxY -= kLabelHeight)
        labelY[k] = std::min(labelY[k], maxY);
    std::string svg;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::size_t i = order[k];
        svg += fmt::format("<path class=\"leader c{}\" d=\"M{} {:.1f}L{} {:.1f}\"/>\n", i, kRight + 2, end(i),
                           kRight + 20, labelY[k]);
        svg += text(kRight + 24, labelY[k] + 4, fmt::format("name n{}", i), c.curves[i].name);
    }
    return svg;
}

// A ring where a choice becomes cheaper or dearer than the first, labelled with the pixels per triangle.
std::string crossings(const Chart& c)
{
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t i = 1; i < c.curves.size(); ++i) {
        const PixelRange r = cheaperRange(c.curves[i].price, c.curves[0].price);
        const double pixels = std::isinf(r.below) ? r.above : r.below;
        if (pixels > kMin && pixels < kMax)
            found.emplace_back(pixels, i);
    }
    std::ranges::sort(found);
    std::string svg;
    double freeX = kLeft; // from this x on, a label fits above the line
    for (const auto& [pixels, i] : found) {
        const double x = c.x(pixels), y = c.y(1);
        const bool above = x >= freeX;
        svg += fmt::format("<circle class=\"ring c{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\"/>\n", i, x, y);
        svg += text(x + 7, above ? y - 7 : y + kLabelHeight, fmt::format("name n{}", i), pixelsText(pixels));
        freeX = above ? x + 44 : freeX;
    }
    return svg;
}

// A strip along the axis that shows the cheapest choice.
std::string cheapest(const Chart& c)
{
    std::string svg = text(kLeft, kStripTop + kStripHeight + 16, "tick", "cheapest");
    const auto best = [&](int step) {
        std::size_t found = 0;
        for (std::size_t i = 1; i < c.curves.size(); ++i)
            if (c.curves[i].price.of(Chart::pixelsAt(step)) < c.curves[found].price.of(Chart::pixelsAt(step)))
                found = i;
        return found;
    };
    for (int from = 0; from < kSteps;) {
        int to = from;
        while (to < kSteps && best(to) == best(from))
            ++to;
        const double x0 = c.x(Chart::pixelsAt(from)), x1 = c.x(Chart::pixelsAt(to));
        svg += fmt::format("<rect class=\"strip s{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>\n",
                           best(from), x0, kStripTop, x1 - x0, kStripHeight);
        if (x1 - x0 > 7.5 * double(c.curves[best(from)].name.size())) // if the name fits
            svg += text((x0 + x1) / 2, kStripTop + 15, "on middle", c.curves[best(from)].name);
        if (to < kSteps && x1 > kLeft + 80) // do not overlap the word "cheapest"
            svg += text(x1, kStripTop + kStripHeight + 16, "tick middle", pixelsText(Chart::pixelsAt(to)));
        from = to;
    }
    return svg;
}

constexpr std::string_view kChartStyle = R"(<style>
text { font: 13px system-ui, sans-serif; fill: #1f2328 }
.tick { font-size: 12px; fill: #59636e }
.title { font-size: 16px; font-weight: 600 }
.name { font-weight: 600 }
.on { fill: #fff; font-weight: 600 }
.middle { text-anchor: middle }
.end { text-anchor: end }
.back { fill: #fff }
.grid { stroke: #d1d9e0; fill: none }
.curve { fill: none; stroke-width: 2.5; stroke-linejoin: round }
.leader { fill: none }
.ring { fill: #fff; stroke-width: 2 }
.c0 { stroke: #59636e } .n0 { fill: #59636e } .s0 { fill: #59636e }
.c1 { stroke: #0969da } .n1 { fill: #0969da } .s1 { fill: #0969da }
.c2 { stroke: #1a7f37 } .n2 { fill: #1a7f37 } .s2 { fill: #1a7f37 }
.c3 { stroke: #8250df } .n3 { fill: #8250df } .s3 { fill: #8250df }
.c4 { stroke: #bc4c00 } .n4 { fill: #bc4c00 } .s4 { fill: #bc4c00 }
.c5 { stroke: #bf3989 } .n5 { fill: #bf3989 } .s5 { fill: #bf3989 }
@media (prefers-color-scheme: dark) {
text { fill: #f0f6fc }
.tick { fill: #9198a1 }
.on { fill: #0d1117 }
.back, .ring { fill: #0d1117 }
.grid { stroke: #3d444d }
.c0 { stroke: #9198a1 } .n0 { fill: #9198a1 } .s0 { fill: #9198a1 }
.c1 { stroke: #58a6ff } .n1 { fill: #58a6ff } .s1 { fill: #58a6ff }
.c2 { stroke: #3fb950 } .n2 { fill: #3fb950 } .s2 { fill: #3fb950 }
.c3 { stroke: #bc8cff } .n3 { fill: #bc8cff } .s3 { fill: #bc8cff }
.c4 { stroke: #f0883e } .n4 { fill: #f0883e } .s4 { fill: #f0883e }
.c5 { stroke: #f778ba } .n5 { fill: #f778ba } .s5 { fill: #f778ba }
}
</style>
)";

} // namespace

std::optional<std::string> costChart(const CostReport& report)
{
    std::optional<Chart> chart;
    std::string of;
    for (const DeviceCode* d : devicesWith(report, &StageCode::inverseThroughput))
        if (!chart || d->family == "NAVI21")
            if (auto found = chartOf(*d)) {
                chart = std::move(found);
                of = title(*d);
            }
    if (!chart)
        return std::nullopt;
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                       "role=\"img\">\n<title>What a triangle costs, against stored tangents</title>\n",
                       kWidth, kHeight)
        + std::string(kChartStyle) + fmt::format("<rect class=\"back\" width=\"{}\" height=\"{}\"/>\n", kWidth, kHeight)
        + text(kLeft - 40, 28, "title", "What a triangle costs, as a ratio to stored tangents")
        + text(kLeft - 40, 50, "tick",
               fmt::format("{}, by inverse throughput of whole stages. Below 1 is cheaper. Pixels are shaded in quads; "
                           "vertices as in a closed mesh.",
                           of))
        + axes(*chart) + curves(*chart) + names(*chart) + crossings(*chart) + cheapest(*chart) + "</svg>\n";
}

} // namespace cotan
