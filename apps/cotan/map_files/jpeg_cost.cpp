#include "jpeg_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "image/codecs.hpp"

namespace cotan::app {

namespace {

constexpr std::size_t kFrequencies = 64;
using Spectrum = std::array<double, kFrequencies>; // by frequency: 8 v + u

// ---- Laplace's distribution, in steps of the quantisation ----------------------------------------------------------

// What a quantised value k says of a coefficient x if the mean of |x| is `scale`.
struct Bin {
    double logProbability = 0;
    double error = 0;  // expected square of x - k
    double energy = 0; // expected square of x
};

constexpr int kLargest = 255; // value; larger ones count as this one
constexpr int kOctaves = 16, kScales = 2 * kOctaves + 1;

double scaleOf(int index) { return std::exp2(index / 2.0 - 7); } // two an octave, from 1/128 to 512

Bin binOf(double scale, int k)
{
    const double low = k > 0 ? k - 0.5 : 0, width = k > 0 ? 1 : 0.5; // of the interval of |x|
    // Below t are distances from `low`, distributed exponentially in the interval.
    const double w = width / scale, inside = -std::expm1(-w), outside = std::exp(-w) / inside;
    const bool flat = w < 1e-3; // there the differences below would cancel
    const double t = flat ? width / 2 : scale - width * outside;
    const double t2 = flat ? width * width / 3 : 2 * scale * scale - outside * width * (width + 2 * scale);
    Bin bin;
    bin.logProbability = -low / scale + std::log(inside) - (k > 0 ? std::numbers::ln2 : 0);
    bin.energy = low * low + 2 * low * t + t2;
    bin.error = bin.energy - 2 * k * (low + t) + double(k) * k;
    return bin;
}

const Bin& bin(int scale, int k)
{
    static const std::vector<Bin> table = [] {
        std::vector<Bin> bins;
        for (int s = 0; s < kScales; ++s)
            for (int value = 0; value <= kLargest; ++value)
                bins.push_back(binOf(scaleOf(s), value));
        return bins;
    }();
    return table[std::size_t(std::clamp(scale, 0, kScales - 1) * (kLargest + 1) + std::min(k, kLargest))];
}

// ---- the coefficients of a file ------------------------------------------------------------------------------------

// Activities of units: factors of the scales, an octave apart, from 1/256 to 16.
constexpr int kActivities = 13;
constexpr int shiftOf(int activity) { return 2 * activity - 16; }

using Activities = std::array<double, kActivities>; // a number for each

// Magnitudes of one frequency of a component: those of the blocks of a unit, unit after unit.
struct Frequency {
    std::size_t component = 0, index = 0; // index: 8 v + u
    std::size_t perUnit = 1;              // blocks
    std::vector<std::uint8_t> values{};
    int scale = 0; // in a unit of activity 1
};

// For each unit, the probabilities of its activities.
std::vector<Activities> weightsOf(std::span<const Frequency> group, const Activities& logPrior)
{
    std::vector<Activities> weights(group.front().values.size() / group.front().perUnit, logPrior);
    for (std::size_t unit = 0; unit < weights.size(); ++unit) {
        Activities& w = weights[unit];
        for (const Frequency& f : group)
            for (std::size_t i = unit * f.perUnit; i < (unit + 1) * f.perUnit; ++i)
                for (int a = 0; a < kActivities; ++a)
                    w[std::size_t(a)] += bin(f.scale + shiftOf(a), f.values[i]).logProbability;
        const double most = *std::ranges::max_element(w);
        for (double& x : w)
            x = std::exp(x - most);
        const double sum = std::accumulate(w.begin(), w.end(), 0.0);
        for (double& x : w)
            x /= sum;
    }
    return weights;
}

// The most likely scale.
int fitScale(const Frequency& f, std::span<const Activities> weights)
{
    const int largest = *std::ranges::max_element(f.values);
    std::vector<Activities> counts(std::size_t(largest) + 1); // by value
    for (std::size_t i = 0; i < f.values.size(); ++i)
        for (std::size_t a = 0; a < kActivities; ++a)
            counts[f.values[i]][a] += weights[i / f.perUnit][a];
    std::array<double, kScales> likelihoods{};
    for (int s = 0; s < kScales; ++s)
        for (int value = 0; value <= largest; ++value)
            for (int a = 0; a < kActivities; ++a)
                likelihoods[std::size_t(s)] +=
                    counts[std::size_t(value)][std::size_t(a)] * bin(s + shiftOf(a), value).logProbability;
    return int(std::ranges::max_element(likelihoods) - likelihoods.begin());
}

// Fits scales and activities to each other by turns.
std::vector<Activities> fit(std::span<Frequency> group)
{
    constexpr int kRounds = 6;
    constexpr double kRare = 0.1; // units of each activity that are assumed beside those seen
    // Scales start a little above the means: where all values are 0, many small scales are equally likely.
    for (Frequency& f : group) {
        const double mean = std::accumulate(f.values.begin(), f.values.end(), 0.0) / double(f.values.size());
        f.scale = std::clamp(int(std::lround(2 * (std::log2(mean + 1.0 / 32) + 7))), 0, kScales - 1);
    }
    Activities logPrior{};
    std::vector<Activities> weights = weightsOf(group, logPrior);
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t a = 0; a < kActivities; ++a) {
            double sum = kRare;
            for (const Activities& w : weights)
                sum += w[a];
            logPrior[a] = std::log(sum / (double(weights.size()) + kRare * kActivities));
        }
        for (Frequency& f : group)
            f.scale = fitScale(f, weights);
        weights = weightsOf(group, logPrior);
    }
    return weights;
}

// What is expected of a component of the lost map, in squares of 8-bit codes.
struct Expected {
    Spectrum gains{};                 // by which the energy of an error changes where the component is enlarged
    std::vector<double> errors{};     // of each block, on average over its texels
    std::vector<Spectrum> energies{}; // of each block, without its mean
};

// Frequencies of lines along u, of lines along v, and all others. Units have an activity for each group.
int groupOf(std::size_t index)
{
    const std::size_t u = index % 8, v = index / 8;
    return u >= 2 * v ? 0 : v >= 2 * u ? 1 : 2;
}

// Fills errors and energies.
void expect(const JpegBlocks& file, std::array<Expected, 3>& expected)
{
    for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t blocks = file.components[c].coefficients.size() / kFrequencies;
        const double step = file.components[c].steps[0]; // of the means, which may lie anywhere in it
        expected[c].errors.assign(blocks, expected[c].gains[0] * step * step / 12 / kFrequencies);
        expected[c].energies.resize(blocks);
    }
    for (int group = 0; group < 3; ++group) {
        std::vector<Frequency> members;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 1; i < kFrequencies; ++i) {
                if (groupOf(i) != group)
                    continue;
                const std::vector<std::int16_t>& coefficients = file.components[c].coefficients;
                Frequency& f =
                    members.emplace_back(Frequency{c, i, coefficients.size() / kFrequencies / file.units.size()});
                for (std::size_t at = i; at < coefficients.size(); at += kFrequencies)
                    f.values.push_back(std::uint8_t(std::min(std::abs(int(coefficients[at])), kLargest)));
            }
        const auto zero = [](const Frequency& f) { return *std::ranges::max_element(f.values) == 0; };
        if (std::ranges::all_of(members, zero)) // flat, or too fine to be seen
            continue;
        const std::vector<Activities> weights = fit(members);
        for (const Frequency& f : members) {
            Expected& out = expected[f.component];
            const double step = file.components[f.component].steps[f.index];
            for (std::size_t b = 0; b < f.values.size(); ++b)
                for (int a = 0; a < kActivities; ++a) {
                    const Bin& x = bin(f.scale + shiftOf(a), f.values[b]);
                    const double weight = weights[b / f.perUnit][std::size_t(a)] * step * step;
                    out.errors[b] += weight * out.gains[f.index] * x.error / kFrequencies;
                    out.energies[b][f.index] += weight * x.energy;
                }
        }
    }
}

// ---- components of half the resolution -----------------------------------------------------------------------------

// Encoders take the mean of two texels, and decoders interpolate at quarters, along each halved direction. A wave of
// frequency f, in [0, pi], comes back with the amplitude `back`, and as a wave of pi - f with `alias`.
struct Halving {
    double back = 1, alias = 0;
};

double interpolated(double f) { return 0.75 * std::cos(f / 2) + 0.25 * std::cos(1.5 * f); }

Halving halvingOf(bool halved, double f)
{
    constexpr double kPi = std::numbers::pi;
    return halved ? Halving{std::cos(f / 2) * interpolated(f), std::cos(f / 2) * interpolated(kPi - f)} : Halving{};
}

// By frequency of the small image: the factor by which the energy of an error changes where the image is enlarged.
Spectrum gainsOf(bool halfX, bool halfY)
{
    const auto gain = [](bool half, std::size_t u) {
        const double f = std::numbers::pi * double(u) / 16;
        return half ? std::pow(interpolated(f), 2) + std::pow(interpolated(std::numbers::pi - f), 2) : 1;
    };
    Spectrum gains;
    for (std::size_t i = 0; i < kFrequencies; ++i)
        gains[i] = gain(halfX, i % 8) * gain(halfY, i / 8);
    return gains;
}

// By frequency of the large image: the fraction of the energy that halving takes or puts elsewhere.
Spectrum lossesOf(bool halfX, bool halfY)
{
    Spectrum losses;
    for (std::size_t i = 0; i < kFrequencies; ++i) {
        const Halving x = halvingOf(halfX, std::numbers::pi * double(i % 8) / 8);
        const Halving y = halvingOf(halfY, std::numbers::pi * double(i / 8) / 8);
        losses[i] =
            1 - 2 * x.back * y.back + (x.back * x.back + x.alias * x.alias) * (y.back * y.back + y.alias * y.alias);
    }
    return losses;
}

Spectrum meanOf(const std::vector<Spectrum>& energies)
{
    Spectrum mean{};
    for (const Spectrum& block : energies)
        for (std::size_t i = 0; i < kFrequencies; ++i)
            mean[i] += block[i] / double(energies.size());
    return mean;
}

// The energy of a halved component over that of Y, at the frequencies that both store.
double ratioToLuma(const Spectrum& halved, const Spectrum& luma, bool halfX, bool halfY)
{
    // The waves of the large image that are seen as frequency u of the small one.
    const auto sources = [](bool half, int u) {
        using Source = std::pair<int, double>; // frequency, and the square of what the mean of two texels leaves of it
        if (!half)
            return std::vector<Source>{{u, 1}};
        const auto left = [](int w) { return std::pow(std::cos(std::numbers::pi * w / 16), 2) / 2; };
        std::vector<Source> waves{{u / 2, left(u / 2)}};
        if (u > 0)
            waves.emplace_back(8 - u / 2, left(8 - u / 2));
        return waves;
    };
    double sum = 0, expected = 0;
    for (int v = 0; v < 8; v += halfY ? 2 : 1)
        for (int u = 0; u < 8; u += halfX ? 2 : 1) {
            if (u + v == 0) // energies lack the means
                continue;
            sum += halved[std::size_t(8 * v + u)];
            for (const auto& [y, ky] : sources(halfY, v))
                for (const auto& [x, kx] : sources(halfX, u))
                    expected += kx * ky * luma[std::size_t(8 * y + x)];
        }
    return expected > 0 ? sum / expected : 0;
}

// ---- angles --------------------------------------------------------------------------------------------------------

// The mean angle, in radians, of a vector of length over 0 whose components have normal errors with these covariances.
double meanAngle(const glm::dvec3& vector, const glm::dmat3& covariance)
{
    const double length = glm::length(vector);
    const glm::dvec3 n = vector / length, s = covariance * n;
    // Of the errors at right angles to the vector: the sums of the two variances and of their squares.
    const double along = glm::dot(n, s), sum = covariance[0][0] + covariance[1][1] + covariance[2][2] - along;
    double squares = along * along - 2 * glm::dot(s, s);
    for (int i = 0; i < 3; ++i)
        squares += glm::dot(covariance[i], covariance[i]);
    const double difference = std::sqrt(std::max(0.0, 2 * squares - sum * sum));
    const double a = std::sqrt(std::max(0.0, sum + difference) / 2), b = std::sqrt(std::max(0.0, sum - difference) / 2);
    // The mean length of the error is sqrt(2 / pi) times a quarter of the circumference of the ellipse with the half
    // axes a and b, by Ramanujan's formula.
    const double round = std::numbers::pi * (3 * (a + b) - std::sqrt((3 * a + b) * (a + 3 * b)));
    return std::sqrt(2 / std::numbers::pi) * round / 4 / length;
}

// Red, green and blue of Y, Cb and Cr (ITU-T T.871), by columns.
const glm::dmat3 kColours{{1, 1, 1}, {0, -0.344136, 1.772}, {1.402, -0.714136, 0}};

} // namespace

std::optional<double> jpegCost(const Image& map)
{
    constexpr std::size_t kUnits = 2048, kFewest = 16;
    const auto file = readJpegBlocks(map.jpeg, {}, kUnits);
    if (!file || file->units.size() < kFewest || map.type != PixelType::unorm8 || !hasPixels(map))
        return std::nullopt;
    const auto outside = [&](const std::array<int, 2>& unit) { // in a file that is not the map's
        return unit[0] + file->unitWidth > map.width || unit[1] + file->unitHeight > map.height;
    };
    if (std::ranges::any_of(file->units, outside))
        return std::nullopt;
    const int across = file->unitWidth / 8, down = file->unitHeight / 8; // blocks of Y in a unit
    std::array<Expected, 3> expected;
    std::array<std::array<bool, 2>, 3> halved{}; // across and down
    for (std::size_t c = 0; c < 3; ++c) {
        const JpegBlocks::Component& component = file->components[c];
        halved[c] = {component.across != across, component.down != down};
        const bool known =
            (!halved[c][0] || 2 * component.across == across) && (!halved[c][1] || 2 * component.down == down);
        if (!known || (c == 0 && (halved[c][0] || halved[c][1])))
            return std::nullopt;
        expected[c].gains = gainsOf(halved[c][0], halved[c][1]);
    }
    expect(*file, expected);
    // By frequency of Y: the fraction of its energy that halving takes of a component.
    std::array<Spectrum, 3> lost{};
    for (std::size_t c = 1; c < 3; ++c)
        if (const auto [x, y] = halved[c]; x || y) {
            const double ratio = ratioToLuma(meanOf(expected[c].energies), meanOf(expected[0].energies), x, y);
            lost[c] = lossesOf(x, y);
            for (double& fraction : lost[c])
                fraction *= ratio / kFrequencies;
        }

    double sum = 0;
    std::size_t texels = 0;
    const std::size_t perUnit = std::size_t(across * down);
    for (std::size_t block = 0; block < expected[0].errors.size(); ++block) {
        const std::size_t unit = block / perUnit;
        const int column = int(block % perUnit) % across, row = int(block % perUnit) / across;
        const Spectrum& energies = expected[0].energies[block];
        glm::dmat3 covariance(1.0 / 12); // the decoder rounds red, green and blue
        for (std::size_t c = 0; c < 3; ++c) {
            const JpegBlocks::Component& own = file->components[c];
            const int inUnit = row * own.down / down * own.across + column * own.across / across;
            const std::size_t at = unit * std::size_t(own.across * own.down) + std::size_t(inUnit);
            const double rounding = file->rgb ? 0 : 2.0 / 12; // encoder and decoder round Y, Cb and Cr
            const double variance = std::inner_product(energies.begin(), energies.end(), lost[c].begin(),
                                                       expected[c].errors[at] + rounding);
            const glm::dvec3 colour = file->rgb ? glm::dmat3(1)[int(c)] : kColours[int(c)];
            covariance += variance * glm::outerProduct(colour, colour);
        }
        covariance *= 4.0 / (255 * 255);
        for (int i = 0; i < int(kFrequencies); ++i) {
            const int x = file->units[unit][0] + 8 * column + i % 8, y = file->units[unit][1] + 8 * row + i / 8;
            const std::uint8_t* const texel =
                map.bytes8() + 4 * (std::size_t(y) * std::size_t(map.width) + std::size_t(x));
            const glm::dvec3 vector = glm::dvec3(texel[0], texel[1], texel[2]) * (2 / 255.0) - 1.0;
            if (glm::dot(vector, vector) < 0.01) // no direction
                continue;
            sum += meanAngle(vector, covariance);
            ++texels;
        }
    }
    return texels > 0 ? std::optional(glm::degrees(sum / double(texels))) : std::nullopt;
}

} // namespace cotan::app
