#include "bc7_fit.hpp"

#include <algorithm>
#include <cmath>

#include "bc7_values.hpp"

namespace cotan::maps::bc7 {

namespace {

using Color = std::array<float, 4>;

struct Line {
    Color from{}, to{};
};

Line decoded(const Ends& ends, const LineCode& code)
{
    Line line{{0, 0, 0, 255}, {0, 0, 0, 255}};
    for (std::size_t c = 0; c < std::size_t(code.channels); ++c) {
        const int bits = c < 3 ? code.colorBits : code.alphaBits;
        line.from[c] = float(expanded(ends[0][c], bits));
        line.to[c] = float(expanded(ends[1][c], bits));
    }
    return line;
}

// Sum of squared errors. Sets the indices to the nearest levels of the line.
float lineError(const Line& line, const Texels& t, const LineCode& code, Values& indices)
{
    float error = 0;
    runLanes([&]<class V>() __attribute__((always_inline)) {
        const V zero{};
        const auto channels = std::size_t(code.channels);
        const bool angular = t.directions && channels == 3;
        const float last = float((1 << code.indexBits) - 1);
        Color step{}, from{};
        float fromFrom = 0, fromStep = 0, stepStep = 1e-9f;
        for (std::size_t c = 0; c < channels; ++c) {
            step[c] = line.to[c] - line.from[c];
            from[c] = line.from[c] - t.zero;
            fromFrom += from[c] * from[c];
            fromStep += from[c] * step[c];
            stepStep += step[c] * step[c];
        }
        TexelSums<V> sums;
        for (std::size_t i = 0; i < t.count; i += sums.kWidth) {
            V position = zero;
            if (angular) { // minimises the angle between n and from + position * step
                V nFrom = zero, nStep = zero;
                for (std::size_t c = 0; c < 3; ++c) {
                    const V n = lanesOf<V>(t.n[c], i);
                    nFrom += n * from[c];
                    nStep += n * step[c];
                }
                const V below = nFrom * stepStep - nStep * fromStep;
                position = below > 1e-6f ? (nStep * fromFrom - nFrom * fromStep) / below : zero;
            } else {
                for (std::size_t c = 0; c < channels; ++c)
                    position += (lanesOf<V>(t.codes[c], i) - line.from[c]) * step[c];
                position *= 1 / stepStep;
            }
            const V index = rounded(minOf(maxOf(position, zero), zero + 1) * last);
            storeLanes(indices, i, index);
            const V weight = weightOf(index, code.indexBits) * (1.0f / 64);
            V here = zero, along = zero, square = zero + 1e-6f;
            std::array<V, 3> read;
            for (std::size_t c = 0; c < channels; ++c) {
                const V code8 = wholeOf(line.from[c] + step[c] * weight);
                if (c == 3 || !t.directions) {
                    const V off = code8 - lanesOf<V>(t.codes[c], i);
                    here += off * off;
                } else {
                    read[c] = code8 - t.zero;
                    along += read[c] * lanesOf<V>(t.n[c], i);
                    square += read[c] * read[c];
                }
            }
            if (t.directions) {
                const V scale = maxOf(along, zero) / square;
                V sine = zero;
                for (std::size_t c = 0; c < 3; ++c) {
                    const V off = read[c] * scale - lanesOf<V>(t.n[c], i);
                    sine += off * off;
                }
                here += sine * (kRadian * kRadian);
            }
            sums.add(i, lanesOf<V>(t.mask, i) * here);
        }
        error = sums.total();
    });
    return error;
}

// With alpha, lines fit vectors, and only errors are those of directions.
const std::array<Values, 4>& aimOf(const Texels& t, std::size_t channels) { return channels == 4 ? t.codes : t.aim; }

// The line through the mean along the principal axis, clipped to the range of the texels.
Line principal(const Texels& t, std::size_t channels)
{
    const std::size_t groups = t.count / 4;
    const Values& mask = t.mask;
    const std::array<Values, 4>& aim = aimOf(t, channels);
    Values weights;
    Four all{};
    for (std::size_t i = 0; i < groups; ++i)
        all += weights[i] = mask[i] * (channels == 4 ? kZero + 1 : t.weight[i]);
    const float inverse = 1 / sumOf(all);
    Color mean{};
    std::array<Values, 4> off;
    for (std::size_t c = 0; c < channels; ++c) {
        Four sum{};
        for (std::size_t i = 0; i < groups; ++i)
            sum += weights[i] * aim[c][i];
        mean[c] = sumOf(sum) * inverse;
        for (std::size_t i = 0; i < groups; ++i)
            off[c][i] = aim[c][i] - mean[c];
    }
    std::array<Color, 4> covariance{};
    for (std::size_t a = 0; a < channels; ++a)
        for (std::size_t b = a; b < channels; ++b) {
            Four sum{};
            for (std::size_t i = 0; i < groups; ++i)
                sum += weights[i] * off[a][i] * off[b][i];
            covariance[a][b] = covariance[b][a] = sumOf(sum);
        }
    std::size_t widest = 0;
    for (std::size_t c = 1; c < channels; ++c)
        widest = covariance[c][c] > covariance[widest][widest] ? c : widest;
    Color axis = covariance[widest];
    for (int round = 0; round < 5; ++round) { // power iteration
        Color next{};
        float largest = 0;
        for (std::size_t a = 0; a < channels; ++a) {
            for (std::size_t b = 0; b < channels; ++b)
                next[a] += covariance[a][b] * axis[b];
            largest = std::max(largest, std::abs(next[a]));
        }
        if (!(largest > 1e-6f))
            break;
        for (std::size_t c = 0; c < channels; ++c)
            axis[c] = next[c] / largest;
    }
    float square = 0;
    for (const float a : axis)
        square += a * a;
    Line line{mean, mean};
    if (!(square > 0))
        return line;
    Four first = kZero + 1e9f, last = kZero - 1e9f;
    for (std::size_t i = 0; i < groups; ++i) {
        Four position = kZero;
        for (std::size_t c = 0; c < channels; ++c)
            position += off[c][i] * (axis[c] / square);
        const FourInts in = mask[i] > 0.5f;
        first = minOf(first, in ? position : first);
        last = maxOf(last, in ? position : last);
    }
    for (std::size_t c = 0; c < channels; ++c) {
        line.from[c] += axis[c] * minOf(first);
        line.to[c] += axis[c] * maxOf(last);
    }
    return line;
}

// An end as stored. Where only directions count, the one of several lengths whose direction is nearest.
void storeEnd(const Color& end, const Texels& t, const LineCode& code, int low, std::array<int, 4>& stored)
{
    if (code.channels == 4)
        stored[3] = nearestStored(kZero + end[3], code.alphaBits, code.lowBits, low)[0];
    else if (code.alphaBits > 0)
        stored[3] = (1 << code.alphaBits) - 1;
    const bool anyLength = t.directions && code.channels == 3; // with alpha, positions are those of unit vectors
    Color v{};
    float square = 1e-9f, growth = 1e9f;
    for (std::size_t c = 0; c < 3; ++c) {
        v[c] = end[c] - t.zero;
        square += v[c] * v[c];
        growth = std::min(growth, growthOf(v[c], t.zero));
    }
    if (!anyLength) {
        for (std::size_t c = 0; c < 3; ++c)
            stored[c] = nearestStored(kZero + end[c], code.colorBits, code.lowBits, low)[0];
        return;
    }
    // A step of the longest channel or, with few bits, as much as leaves enough length.
    const float by = growth * std::min(float(1 << (8 - code.colorBits + code.lowBits)) / 127, 0.04f);
    constexpr std::size_t kLengths = 16;
    std::array<float, kLengths> errors;
    std::array<std::array<std::int32_t, kLengths>, 3> ends;
    runLanes([&]<class V>() __attribute__((always_inline)) {
        constexpr std::size_t kWidth = sizeof(V) / sizeof(float);
        for (std::size_t first = 0; first < kLengths; first += kWidth) {
            std::array<V, 3> read;
            V scale, along{}, readSquare{}, error{};
            for (std::size_t k = 0; k < kWidth; ++k)
                scale[k] = growth - float(first + k) * by;
            for (std::size_t c = 0; c < 3; ++c) {
                const auto here = nearestStored(t.zero + v[c] * scale, code.colorBits, code.lowBits, low);
                std::memcpy(&ends[c][first], &here, sizeof here);
                read[c] = __builtin_convertvector(expanded(here, code.colorBits), V) - t.zero;
                along += read[c] * v[c];
                readSquare += read[c] * read[c];
            }
            for (std::size_t c = 0; c < 3; ++c) {
                const V off = read[c] - along * (1 / square) * v[c];
                error += off * off;
            }
            error /= maxOf(readSquare, V{} + 1);
            std::memcpy(&errors[first], &error, sizeof error);
        }
    });
    const auto least = std::size_t(std::min_element(errors.begin(), errors.end()) - errors.begin());
    for (std::size_t c = 0; c < 3; ++c)
        stored[c] = ends[c][least];
}

void offer(Fit& fit, const Ends& ends, const Texels& t, const LineCode& code)
{
    Values indices{};
    if (const float error = lineError(decoded(ends, code), t, code, indices); error < fit.error)
        fit = {ends, indices, error};
}

// Offers the ends as stored, with all choices of lowest bits, unless the first has three times the error `limit`.
void offerStored(Fit& fit, const Line& line, const Texels& t, const LineCode& code, float limit)
{
    std::array<Ends, 2> ends{};                                                                 // by lowest bit
    const std::size_t first = code.lowBits && code.channels == 3 && code.alphaBits > 0 ? 1 : 0; // 255 is odd
    const std::size_t lows = code.lowBits ? 2 : 1;
    for (std::size_t low = first; low < lows; ++low) {
        storeEnd(line.from, t, code, int(low), ends[low][0]);
        storeEnd(line.to, t, code, int(low), ends[low][1]);
        offer(fit, ends[low], t, code);
        if (fit.error > 3 * limit)
            return;
    }
    for (std::size_t a = first; a < lows && lows > first + 1 && !code.oneLowBit; ++a)
        offer(fit, {ends[a][0], ends[1 - a][1]}, t, code);
}

} // namespace

Fit fitLine(const Texels& t, const LineCode& code, float limit)
{
    const auto channels = std::size_t(code.channels);
    Line line = principal(t, channels);
    Values weights;
    for (std::size_t i = 0; i < 4; ++i)
        weights[i] = t.mask[i] * (channels == 4 ? kZero + 1 : t.weight[i]);
    Fit best;
    for (int round = 0; round < kRounds; ++round) {
        Fit here;
        offerStored(here, line, t, code, limit);
        if (here.error < best.error)
            best = here;
        if (best.error > kImproved * limit)
            break;
        const LeastSquares fit(weights, here.indices, code.indexBits);
        if (!fit.solvable())
            break;
        for (std::size_t c = 0; c < channels; ++c)
            fit.solve(aimOf(t, channels)[c], line.from[c], line.to[c]);
    }
    return best;
}

void refineLine(Fit& fit, const Texels& t, const LineCode& code, int rounds)
{
    const int step = code.lowBits ? 2 : 1;
    for (int round = 0; round < rounds; ++round) {
        const float before = fit.error;
        for (std::size_t e = 0; e < 2; ++e)
            for (std::size_t c = 0; c < std::size_t(code.channels); ++c)
                for (const int by : {-step, step}) {
                    Ends to = fit.ends;
                    to[e][c] += by;
                    if (to[e][c] >= 0 && to[e][c] < 1 << (c < 3 ? code.colorBits : code.alphaBits))
                        offer(fit, to, t, code);
                }
        if (!(fit.error < before))
            break;
    }
}

Fit fitAlpha(const Texels& t, int bits, int indexBits)
{
    const Values& values = t.codes[3];
    const float last = float((1 << indexBits) - 1);
    Values ones;
    ones.fill(kZero + 1);
    float from = minOf(values), to = maxOf(values);
    Fit best;
    for (int round = 0; round < 3; ++round) {
        Fit here;
        here.ends[0][3] = nearestStored(kZero + from, bits, false, 0)[0];
        here.ends[1][3] = nearestStored(kZero + to, bits, false, 0)[0];
        const float low = float(expanded(here.ends[0][3], bits)), step = float(expanded(here.ends[1][3], bits)) - low;
        Four sum{};
        for (std::size_t i = 0; i < 4; ++i) {
            const Four position = step != 0 ? (values[i] - low) / step : kZero;
            here.indices[i] = rounded(minOf(maxOf(position, kZero), kZero + 1) * last);
            const Four off = wholeOf(low + step * weightOf(here.indices[i], indexBits) * (1.0f / 64)) - values[i];
            sum += off * off;
        }
        here.error = sumOf(sum);
        if (here.error < best.error)
            best = here;
        const LeastSquares fit(ones, here.indices, indexBits);
        if (!fit.solvable())
            break;
        fit.solve(values, from, to);
    }
    return best;
}

} // namespace cotan::maps::bc7
