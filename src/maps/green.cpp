#include "cotan/maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "maps/patches.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {

namespace {

// Slopes explode at grazing normals: cells with a texel tilted by more than about 80 degrees are skipped.
constexpr float kLowestZ = 0.17f;
constexpr double kLikely = 0.12, kCertain = 0.5; // limits on |agreement|
constexpr double kLikelyDeviations = 5;
constexpr int kMinTexels = 100;           // of an image; in smaller ones noise agrees by chance
constexpr double kMinPatches = 4;         // patches; fewer give no standard error
constexpr int kRun = 8;                   // equal adjacent texels that count as fill between charts
constexpr double kMinFillFraction = 0.02; // minimum fraction of all texels in runs of the most common colour

// Sums of products of cross derivatives over the cells of a patch.
struct Products {
    double ay2 = 0, bx2 = 0, ayBx = 0; // red and green in their places
    double by2 = 0, ax2 = 0, byAx = 0; // exchanged
    double cells = 0;                  // cells with four usable texels
    double active = 0;                 // cells whose relief is not constant and can show rounding noise
    double cross = 0, along = 0;       // unweighted sums of ay^2 + bx^2 and of ax^2 + by^2, for noise

    void add(const Products& o, double sign = 1)
    {
        ay2 += sign * o.ay2, bx2 += sign * o.bx2, ayBx += sign * o.ayBx;
        by2 += sign * o.by2, ax2 += sign * o.ax2, byAx += sign * o.byAx;
        cells += sign * o.cells, active += sign * o.active;
        cross += sign * o.cross, along += sign * o.along;
    }
    double agreement() const { return ay2 + bx2 > 0 ? 2 * ayBx / (ay2 + bx2) : 0; }
    double exchanged() const { return by2 + ax2 > 0 ? 2 * byAx / (by2 + ax2) : 0; }
};

struct Slope {
    float a = 0, b = 0, weight = 0; // dh/dx, dh/dy with y up; weight 0: skip
};

struct Derivatives {
    float ax = 0, ay = 0, bx = 0, by = 0;
    float energy() const { return ax * ax + ay * ay + bx * bx + by * by; }
};

Slope slopeOf(const glm::vec3& n, bool xyz)
{
    const float length = glm::length(n);
    const bool direction = xyz ? usableLength(length) : length > 0 && n.x * n.x + n.y * n.y < 1.1f * length * length;
    if (!direction || n.z < kLowestZ * length)
        return {};
    const float z = n.z / length;
    return {-n.x / n.z, -n.y / n.z, z * z};
}

// The stored bytes of one texel.
using Colour = std::string_view;

Colour at(const Image& image, std::size_t i)
{
    return {reinterpret_cast<const char*>(image.data.data()) + i * image.bytesPerPixel(), image.bytesPerPixel()};
}

// The colour that fills the space between charts: the one with the most texels in runs; empty if there is none.
std::string fillColour(const std::vector<Patch>& patches)
{
    std::map<Colour, std::size_t> inRuns;
    std::size_t all = 0;
    for (const Patch& patch : patches) {
        const std::size_t width = std::size_t(patch.texels.width), count = patch.texels.pixelCount();
        all += count;
        for (std::size_t start = 0, i = 0; i < count; start = i) {
            for (i = start + 1; i < count && i % width != 0 && at(patch.texels, i) == at(patch.texels, start);)
                ++i;
            if (i - start >= kRun)
                inRuns[at(patch.texels, start)] += i - start;
        }
    }
    const auto most = std::ranges::max_element(inRuns, {}, [](const auto& c) { return std::pair(c.second, c.first); });
    return most != inRuns.end() && double(most->second) > kMinFillFraction * double(all) ? std::string(most->first)
                                                                                         : std::string();
}

std::vector<Slope> slopesOf(const Patch& patch, const Convention& convention, const NormalStatistics& statistics,
                            const std::string& between)
{
    Image unswizzled = patch.texels;
    unswizzle(unswizzled, statistics.swizzle);
    const std::size_t width = std::size_t(unswizzled.width);
    std::vector<glm::vec3> normals(width);
    std::vector<glm::vec4> texels(width);
    std::vector<Slope> slopes(unswizzled.pixelCount());
    for (int y = 0; y < unswizzled.height; ++y) {
        loadRow(patch.texels, y, texels);
        decodeRow(unswizzled, y, convention, normals);
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = std::size_t(y) * width + x;
            if (!outsideCharts(texels[x], statistics.alphaMasks) && at(patch.texels, i) != between)
                slopes[i] = slopeOf(normals[x], convention.channels == Channels::xyz);
        }
    }
    return slopes;
}

// Variance of a slope by rounding: a twelfth of the squared step. It equals that of half a sum of four slopes.
double roundingVariance(PixelType type)
{
    const double step = type == PixelType::unorm8 ? 1.0 / 127 : type == PixelType::unorm16 ? 1.0 / 32767 : 1e-6;
    return step * step / 12;
}

// Slopes jump where charts meet and at folds of the frame that the map was baked for, and fit no relief there. Each
// cell's contribution is bounded by 1: its energy over the sum of itself and the patch's median.
Products productsOf(const std::vector<Slope>& slopes, std::size_t width, double noise)
{
    std::vector<Derivatives> cells;
    Products sums;
    for (std::size_t i = 0; i + width + 1 < slopes.size(); ++i) {
        if (i % width == width - 1)
            continue;
        const Slope &p = slopes[i], &q = slopes[i + 1], &r = slopes[i + width], &s = slopes[i + width + 1];
        const float weight = 0.5f * p.weight * q.weight * r.weight * s.weight;
        if (weight == 0)
            continue;
        sums.cells += 1;
        const Derivatives d{(q.a + s.a - p.a - r.a) * weight, (p.a + q.a - r.a - s.a) * weight,
                            (q.b + s.b - p.b - r.b) * weight, (p.b + q.b - r.b - s.b) * weight};
        if (d.energy() > 0)
            cells.push_back(d);
    }
    if (cells.empty())
        return sums;
    sums.active = double(cells.size());
    std::vector<float> energies(cells.size());
    std::ranges::transform(cells, energies.begin(), &Derivatives::energy);
    const auto middle = energies.begin() + std::ptrdiff_t(energies.size() / 2);
    std::ranges::nth_element(energies, middle);
    const double regularisation = double(*middle) + 16 * noise;
    for (const Derivatives& d : cells) {
        const double ax = double(d.ax), ay = double(d.ay), bx = double(d.bx), by = double(d.by);
        const double weight = 1 / (double(d.energy()) + regularisation);
        sums.ay2 += weight * ay * ay, sums.bx2 += weight * bx * bx, sums.ayBx += weight * ay * bx;
        sums.by2 += weight * by * by, sums.ax2 += weight * ax * ax, sums.byAx += weight * by * ax;
        sums.cross += ay * ay + bx * bx, sums.along += ax * ax + by * by;
    }
    return sums;
}

// Standard error of a figure of the sum, by the jackknife: each patch is left out in turn.
template<class Figure> double uncertainty(const std::vector<Products>& patches, const Products& all, Figure figure)
{
    double sum = 0, sum2 = 0, n = 0;
    for (const Products& p : patches)
        if (p.cells > 0) {
            Products rest = all;
            rest.add(p, -1);
            const double f = figure(rest);
            sum += f, sum2 += f * f, n += 1;
        }
    if (n < kMinPatches)
        return 1;
    return std::sqrt(std::max(0.0, (n - 1) / n * (sum2 - sum * sum / n)));
}

double votesFor(const std::vector<Products>& patches, double sign, bool exchanged)
{
    double with = 0, all = 0;
    for (const Products& p : patches) {
        const double c = exchanged ? p.byAx : p.ayBx;
        all += std::abs(c);
        with += c * sign > 0 ? std::abs(c) : 0;
    }
    return all > 0 ? with / all : 0;
}

std::string whyUndecidable(int width, int height, const NormalStatistics& s)
{
    if (width < 3 || height < 3 || width * std::int64_t(height) < kMinTexels)
        return "the image is too small to show a relief";
    switch (s.content) {
    case Content::flat: return "every texel has the same value: there is no relief to analyse";
    case Content::grey: return "the image is grey: a height map has no green direction";
    case Content::objectSpace:
        if (s.redIsZ)
            return "red and blue are exchanged: the relief cannot be analysed until they are exchanged back";
        return "the map is in object space: its directions follow a mesh, and the map alone shows no relief";
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

NormalStatistics statisticsOf(const std::vector<Patch>& patches, AlphaUse alpha)
{
    MapSurvey survey(alpha);
    for (const Patch& patch : patches)
        survey.addFirstPass(patch.texels);
    for (const Patch& patch : patches)
        survey.addSecondPass(patch.texels);
    return survey.finish();
}

std::vector<Products> productsOf(const std::vector<Patch>& patches, const NormalStatistics& statistics, double noise)
{
    const Convention convention = reading(statistics);
    const std::string between = fillColour(patches);
    std::vector<Products> products(patches.size());
    parallelFor(std::size_t(0), patches.size(), [&](std::size_t i) {
        products[i] = productsOf(slopesOf(patches[i], convention, statistics, between),
                                 std::size_t(patches[i].texels.width), noise);
    });
    return products;
}

void decide(GreenVerdict& v, const std::vector<Products>& patches, double noise)
{
    Products all;
    for (const Products& p : patches)
        all.add(p);
    v.agreement = all.agreement();
    v.exchanged = all.exchanged();
    noise *= std::max(all.active, 1.0);
    if (all.cross + all.along < 6 * noise) {
        v.reason = "the relief is weaker than the rounding noise";
        return;
    }
    // Exchanged channels must explain clearly more.
    const bool exchanged = std::abs(v.exchanged) > 0.7 && std::abs(v.exchanged) > std::abs(v.agreement) + 0.25;
    const double best = exchanged ? v.exchanged : v.agreement;
    const double standardError =
        uncertainty(patches, all, [&](const Products& p) { return exchanged ? p.exchanged() : p.agreement(); });
    v.deviations = std::min(std::abs(best) / std::max(standardError, 1e-6), 1e3);
    v.residualRatio = (1 + std::abs(best)) / std::max(1 - std::abs(best), 1e-4);
    const double sign = best < 0 ? -1 : 1;
    v.votes = votesFor(patches, sign, exchanged);
    const double cross = exchanged ? all.along : all.cross;
    if (cross < 4 * noise || cross < 0.002 * (all.cross + all.along)) {
        v.reason = "the relief runs along the rows and columns only: both directions of green explain it";
        return;
    }
    if (std::abs(best) < kLikely || v.deviations < kLikelyDeviations) {
        v.reason = "red and green do not agree on a relief, whichever way green points";
        return;
    }
    v.green = sign > 0 ? Green::up : Green::down;
    v.confidence = std::abs(best) >= kCertain && v.votes >= 0.8 ? Confidence::certain : Confidence::likely;
    const double other = exchanged ? v.agreement : v.exchanged;
    v.swapped =
        std::abs(best) > std::abs(other) + 0.15 ? (exchanged ? Swapped::yes : Swapped::no) : Swapped::undecidable;
    v.reason = "the slopes in red and green belong to one relief when green points this way";
}

} // namespace

const char* name(Green g) { return g == Green::up ? "up" : g == Green::down ? "down" : "undecidable"; }
const char* name(Swapped s) { return s == Swapped::no ? "no" : s == Swapped::yes ? "yes" : "undecidable"; }
const char* name(Confidence c)
{
    return c == Confidence::certain ? "certain" : c == Confidence::likely ? "likely" : "none";
}

GreenVerdict greenOf(const PatchSampler& sampler, AlphaUse alpha)
{
    const std::vector<Patch>& patches = sampler.patches();
    GreenVerdict v;
    v.sampled = sampler.coveredFraction();
    v.statistics = statisticsOf(patches, alpha);
    v.reason = whyUndecidable(sampler.width(), sampler.height(), v.statistics);
    if (!v.reason.empty())
        return v;
    const double noise = roundingVariance(sampler.type());
    const std::vector<Products> products = productsOf(patches, v.statistics, noise);
    double usableCells = 0, cells = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        usableCells += products[i].cells;
        cells += double(patches[i].texels.width - 1) * double(patches[i].texels.height - 1);
    }
    v.used = cells > 0 ? usableCells / cells : 0;
    decide(v, products, noise);
    return v;
}

GreenVerdict greenOf(const Image& image, AlphaUse alpha)
{
    PatchSampler sampler(image.width, image.height, image.type);
    sampler.add(image, 0);
    return greenOf(sampler, alpha);
}

NormalStatistics statisticsOfSample(const Image& image)
{
    PatchSampler sampler(image.width, image.height, image.type, 16);
    sampler.add(image, 0);
    return statisticsOf(sampler.patches(), AlphaUse::ignored);
}

// ---- patches -------------------------------------------------------------------------------

namespace {

constexpr int kMaxASide = 16;
constexpr int kMinSide = 3; // texels

} // namespace

PatchSampler::PatchSampler(int width, int height, PixelType type, int largest)
    : width_(width), height_(height), type_(type)
{
    const int longer = std::max(width, height);
    square_ = std::max(kMinSide, (longer + kMaxASide - 1) / kMaxASide);
    side_ = longer <= kMaxASide * largest ? square_ : largest;
    const int margin = (square_ - side_) / 2;
    for (int y = 0; y < height; y += square_)
        for (int x = 0; x < width; x += square_) {
            Patch patch{std::min(x + margin, width - 1), std::min(y + margin, height - 1), {}};
            patch.texels = makeImage(std::min(side_ + 1, width - patch.x), std::min(side_ + 1, height - patch.y), type);
            patches_.push_back(std::move(patch));
        }
}

void PatchSampler::add(const Image& strip, int firstRow)
{
    const std::size_t pixel = strip.bytesPerPixel();
    for (Patch& patch : patches_) {
        const int first = std::max(patch.y, firstRow),
                  last = std::min(patch.y + patch.texels.height, firstRow + strip.height);
        const std::size_t bytes = std::size_t(patch.texels.width) * pixel;
        for (int y = first; y < last; ++y)
            std::memcpy(patch.texels.data.data() + std::size_t(y - patch.y) * bytes,
                        strip.data.data()
                            + (std::size_t(y - firstRow) * std::size_t(width_) + std::size_t(patch.x)) * pixel,
                        bytes);
    }
}

double PatchSampler::coveredFraction() const
{
    double texels = 0;
    for (const Patch& patch : patches_)
        texels += double(std::min(patch.texels.width, side_)) * double(std::min(patch.texels.height, side_));
    return std::min(1.0, texels / (double(width_) * double(height_)));
}

} // namespace cotan::maps
