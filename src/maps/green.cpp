#include "cotan/maps/green.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <oneapi/tbb/parallel_for.h>

namespace cotan::maps {

namespace {

// Texels tilted by more than about 80 degrees say little (slopes explode); beside them a cell is skipped.
constexpr float kLowestZ = 0.17f;
constexpr double kLikely = 0.12, kCertain = 0.5;  // |agreement|
constexpr double kLikelyDeviations = 5;
constexpr double kMostBlocksASide = 16;

// Products of the cross derivatives over the cells of a block.
struct Products {
    double ay2 = 0, bx2 = 0, ayBx = 0; // red and green in their places
    double by2 = 0, ax2 = 0, byAx = 0; // exchanged
    double cells = 0;  // looked at
    double active = 0; // with a relief that is not constant: where rounding noise can be

    void add(const Products& o)
    {
        ay2 += o.ay2, bx2 += o.bx2, ayBx += o.ayBx;
        by2 += o.by2, ax2 += o.ax2, byAx += o.byAx;
        cells += o.cells, active += o.active;
    }
    double agreement() const { return ay2 + bx2 > 0 ? 2 * ayBx / (ay2 + bx2) : 0; }
    double exchanged() const { return by2 + ax2 > 0 ? 2 * byAx / (by2 + ax2) : 0; }
};

struct Slope {
    float a = 0, b = 0, weight = 0; // dh/dx, dh/dy upwards; weight 0: skip
};

Slope slopeOf(const glm::vec3& n)
{
    const float length = glm::length(n);
    if (!(length > 0) || n.z < kLowestZ * length)
        return {};
    const float z = n.z / length;
    return {-n.x / n.z, -n.y / n.z, z * z};
}

void addRow(const Slope* upper, const Slope* lower, std::size_t first, std::size_t last, Products& sums)
{
    for (std::size_t x = first; x < last; ++x) {
        const Slope &p = upper[x], &q = upper[x + 1], &r = lower[x], &s = lower[x + 1];
        const float weight = p.weight * q.weight * r.weight * s.weight;
        if (weight == 0)
            continue;
        const double ax = 0.5 * (q.a + s.a - p.a - r.a) * weight, ay = 0.5 * (p.a + q.a - r.a - s.a) * weight;
        const double bx = 0.5 * (q.b + s.b - p.b - r.b) * weight, by = 0.5 * (p.b + q.b - r.b - s.b) * weight;
        sums.ay2 += ay * ay, sums.bx2 += bx * bx, sums.ayBx += ay * bx;
        sums.by2 += by * by, sums.ax2 += ax * ax, sums.byAx += by * ax;
        sums.cells += 1;
        sums.active += ax != 0 || ay != 0 || bx != 0 || by != 0;
    }
}

// The slopes of all rows of a strip.
std::vector<Slope> slopesOf(const Image& strip, const Convention& convention)
{
    std::vector<Slope> slopes(strip.pixelCount());
    forRowBands(strip.height, [&](int first, int last) {
        std::vector<glm::vec3> normals(std::size_t(strip.width));
        for (int y = first; y < last; ++y) {
            decodeRow(strip, y, convention, normals);
            std::ranges::transform(normals, slopes.begin() + std::ptrdiff_t(y) * strip.width, slopeOf);
        }
    });
    return slopes;
}

// Spread of a figure of the sum when single blocks are left out (the jackknife).
template<class Figure> double uncertainty(const std::vector<Products>& blocks, const Products& all, Figure figure)
{
    double sum = 0, sum2 = 0, n = 0;
    for (const Products& b : blocks)
        if (b.cells > 0) {
            Products rest = all;
            rest.ay2 -= b.ay2, rest.bx2 -= b.bx2, rest.ayBx -= b.ayBx;
            rest.by2 -= b.by2, rest.ax2 -= b.ax2, rest.byAx -= b.byAx;
            const double f = figure(rest);
            sum += f, sum2 += f * f, n += 1;
        }
    if (n < 2)
        return 1;
    return std::sqrt(std::max(0.0, (n - 1) / n * (sum2 - sum * sum / n)));
}

double votesFor(const std::vector<Products>& blocks, double sign, bool exchanged)
{
    double with = 0, all = 0;
    for (const Products& b : blocks) {
        const double c = exchanged ? b.byAx : b.ayBx;
        all += std::abs(c);
        with += c * sign > 0 ? std::abs(c) : 0;
    }
    return all > 0 ? with / all : 0;
}

// Rounding moves a slope by a twelfth of a squared step; four of them, halved, are in a derivative.
double noiseOf(PixelType type)
{
    const double step = type == PixelType::unorm8 ? 1.0 / 127 : type == PixelType::unorm16 ? 1.0 / 32767 : 1e-6;
    return step * step / 12;
}

std::string unreadable(int width, int height, const NormalStatistics& s)
{
    if (width < 3 || height < 3)
        return "the picture is too small to have a relief";
    switch (s.content) {
    case Content::flat: return "every texel has the same value: there is no relief to judge by";
    case Content::grey: return "the picture is grey: a height map has no green direction";
    case Content::objectSpace:
        return "the map is in object space: its directions follow a mesh, and no relief can be read from it alone";
    case Content::other: return "the lengths are not those of a normal map";
    default: return {};
    }
}

Convention reading(const NormalStatistics& s)
{
    Convention c;
    c.expansion = s.centre == Centre::biased ? Expansion::biased : Expansion::exact;
    if (s.content == Content::twoChannel)
        c.channels = Channels::orthographic;
    if (s.content == Content::slopes)
        c.channels = Channels::slope;
    if (s.signedStored)
        c.expansion = Expansion::signedValues;
    return c;
}

} // namespace

struct GreenSurvey::State {
    int width = 0, height = 0;
    PixelType type = PixelType::unorm8;
    NormalStatistics statistics;
    std::string unreadable;
    int side = 0, across = 0; // of the square blocks, in texels; how many in a row of them
    std::vector<Products> blocks;
};

GreenSurvey::GreenSurvey(int width, int height, PixelType type, const NormalStatistics& statistics)
    : state_(std::make_unique<State>())
{
    State& s = *state_;
    s.width = width, s.height = height, s.type = type, s.statistics = statistics;
    s.unreadable = unreadable(width, height, statistics);
    if (!s.unreadable.empty())
        return;
    s.side = std::max(8, int(std::ceil(std::max(width, height) / kMostBlocksASide)));
    s.across = (width - 2) / s.side + 1;
    s.blocks.resize(std::size_t(s.across) * std::size_t((height - 2) / s.side + 1));
}

GreenSurvey::~GreenSurvey() = default;

void GreenSurvey::add(const Image& strip, int firstRow)
{
    State& s = *state_;
    if (s.blocks.empty())
        return;
    Image moved;
    if (s.statistics.swizzle != Swizzle::rg) {
        moved = strip;
        unswizzle(moved, s.statistics.swizzle);
    }
    const std::vector<Slope> slopes = slopesOf(moved.width > 0 ? moved : strip, reading(s.statistics));
    // Columns of blocks side by side; in each the rows follow one another, however they are cut into strips.
    oneapi::tbb::parallel_for(std::size_t(0), std::size_t(s.across), [&](std::size_t i) {
        const std::size_t first = i * std::size_t(s.side), last = std::min(first + std::size_t(s.side), std::size_t(s.width - 1));
        for (int y = 0; y + 1 < strip.height; ++y) {
            const Slope* upper = slopes.data() + std::size_t(y) * std::size_t(s.width);
            addRow(upper, upper + s.width, first, last,
                   s.blocks[std::size_t((firstRow + y) / s.side) * std::size_t(s.across) + i]);
        }
    });
}

GreenVerdict GreenSurvey::verdict() const
{
    GreenVerdict v;
    v.reason = state_->unreadable;
    if (!v.reason.empty())
        return v;
    const std::vector<Products>& blocks = state_->blocks;
    Products all;
    for (const Products& b : blocks)
        all.add(b);
    v.used = all.cells / (double(state_->width - 1) * double(state_->height - 1));
    v.agreement = all.agreement();
    v.exchanged = all.exchanged();
    const double noise = noiseOf(state_->type) * std::max(all.active, 1.0);
    if (all.ay2 + all.bx2 + all.by2 + all.ax2 < 6 * noise) {
        v.reason = "the relief is so weak that it drowns in rounding";
        return v;
    }
    // Exchanged channels are believed only when they explain clearly more.
    const bool exchanged = std::abs(v.exchanged) > 0.7 && std::abs(v.exchanged) > std::abs(v.agreement) + 0.25;
    const double best = exchanged ? v.exchanged : v.agreement;
    const double spread = uncertainty(blocks, all, [&](const Products& p) { return exchanged ? p.exchanged() : p.agreement(); });
    v.deviations = std::min(std::abs(best) / std::max(spread, 1e-6), 1e3);
    v.residualRatio = (1 + std::abs(best)) / std::max(1 - std::abs(best), 1e-4);
    const double sign = best < 0 ? -1 : 1;
    v.votes = votesFor(blocks, sign, exchanged);
    const double cross = exchanged ? all.by2 + all.ax2 : all.ay2 + all.bx2;
    if (cross < 4 * noise || cross < 0.002 * (all.ay2 + all.bx2 + all.by2 + all.ax2)) {
        v.reason = "the relief runs along the rows and columns only: either way of green explains it";
        return v;
    }
    if (std::abs(best) < kLikely || v.deviations < kLikelyDeviations) {
        v.reason = "red and green do not agree on a relief, whichever way green points";
        return v;
    }
    v.green = sign > 0 ? Green::up : Green::down;
    v.confidence = std::abs(best) >= kCertain && v.votes >= 0.8 ? Confidence::certain : Confidence::likely;
    const double other = exchanged ? v.agreement : v.exchanged;
    v.swapped = std::abs(best) > std::abs(other) + 0.15 ? (exchanged ? Swapped::yes : Swapped::no)
                                                        : Swapped::undecidable;
    v.reason = "the slopes in red and green belong to one relief when green points this way";
    return v;
}

GreenVerdict greenOf(const Image& image, const NormalStatistics& statistics)
{
    GreenSurvey survey(image.width, image.height, image.type, statistics);
    survey.add(image, 0);
    return survey.verdict();
}

} // namespace cotan::maps
