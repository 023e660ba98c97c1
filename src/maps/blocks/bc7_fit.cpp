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
float errorOf(const Ends& ends, const Texels& t, const LineCode& code, const Values& mask, Values& indices)
{
    const Line line = decoded(ends, code);
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
    Four sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        Four position = kZero;
        if (angular) { // minimises the angle between n and from + position * step
            Four nFrom = kZero, nStep = kZero;
            for (std::size_t c = 0; c < 3; ++c) {
                nFrom += t.n[c][i] * from[c];
                nStep += t.n[c][i] * step[c];
            }
            const Four below = nFrom * stepStep - nStep * fromStep;
            position = below > 1e-6f ? (nStep * fromFrom - nFrom * fromStep) / below : kZero;
        } else {
            for (std::size_t c = 0; c < channels; ++c)
                position += (t.codes[c][i] - line.from[c]) * step[c];
            position *= 1 / stepStep;
        }
        indices[i] = rounded(minOf(maxOf(position, kZero), kZero + 1) * last);
        const Four weight = weightOf(indices[i], code.indexBits) * (1.0f / 64);
        Four here = kZero, along = kZero, square = kZero + 1e-6f;
        for (std::size_t c = 0; c < channels; ++c) {
            const Four read = wholeOf(line.from[c] + step[c] * weight);
            if (c == 3 || !t.directions) {
                const Four off = read - t.codes[c][i];
                here += off * off;
            } else {
                along += (read - t.zero) * t.n[c][i];
                square += (read - t.zero) * (read - t.zero);
            }
        }
        if (t.directions)
            here += squaredAngle(along, square);
        sum += mask[i] * here;
    }
    return sumOf(sum);
}

// With alpha, lines fit vectors, and only errors are those of directions.
const std::array<Values, 4>& aimOf(const Texels& t, std::size_t channels) { return channels == 4 ? t.codes : t.aim; }

// The line through the mean along the principal axis, clipped to the range of the texels.
Line principal(const Texels& t, std::size_t channels, const Values& mask)
{
    const std::array<Values, 4>& aim = aimOf(t, channels);
    Values weights;
    Four all{};
    for (std::size_t i = 0; i < 4; ++i)
        all += weights[i] = mask[i] * (channels == 4 ? kZero + 1 : t.weight[i]);
    const float inverse = 1 / sumOf(all);
    Color mean{};
    std::array<Values, 4> off;
    for (std::size_t c = 0; c < channels; ++c) {
        Four sum{};
        for (std::size_t i = 0; i < 4; ++i)
            sum += weights[i] * aim[c][i];
        mean[c] = sumOf(sum) * inverse;
        for (std::size_t i = 0; i < 4; ++i)
            off[c][i] = aim[c][i] - mean[c];
    }
    std::array<Color, 4> covariance{};
    for (std::size_t a = 0; a < channels; ++a)
        for (std::size_t b = a; b < channels; ++b) {
            Four sum{};
            for (std::size_t i = 0; i < 4; ++i)
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
    for (std::size_t i = 0; i < 4; ++i) {
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

// An end as stored. Where only directions count, the one of several lengths whose direction is nearest. Returns the
// squared error.
float storeEnd(const Color& end, const Texels& t, const LineCode& code, int low, std::array<int, 4>& stored)
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
    constexpr int kLengths = 16;
    const float longest = anyLength ? growth : 1;
    // A step of the longest channel or, with few bits, as much as leaves enough length.
    const float by = anyLength ? longest * std::min(float(1 << (8 - code.colorBits + code.lowBits)) / 127, 0.04f) : 0;
    Four scale = Four{0, 1, 2, 3} * -by + longest, least = kZero + 1e30f;
    std::array<FourInts, 3> best{};
    for (int k = 0; k < (anyLength ? kLengths : 1); k += 4, scale -= 4 * by) {
        std::array<FourInts, 3> here;
        std::array<Four, 3> read;
        Four along = kZero, readSquare = kZero, error = kZero;
        for (std::size_t c = 0; c < 3; ++c) {
            here[c] = nearestStored(t.zero + v[c] * scale, code.colorBits, code.lowBits, low);
            read[c] = __builtin_convertvector(expanded(here[c], code.colorBits), Four) - t.zero;
            along += read[c] * v[c];
            readSquare += read[c] * read[c];
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const Four off = anyLength ? read[c] - along / square * v[c] : read[c] - v[c];
            error += off * off;
        }
        if (anyLength)
            error = error / maxOf(readSquare, kZero + 1);
        const FourInts better = error < least;
        least = better ? error : least;
        for (std::size_t c = 0; c < 3; ++c)
            best[c] = better ? here[c] : best[c];
    }
    int lane = 0;
    for (int k = 1; k < 4; ++k)
        lane = least[k] < least[lane] ? k : lane;
    for (std::size_t c = 0; c < 3; ++c)
        stored[c] = best[c][lane];
    return least[lane];
}

void offer(Fit& fit, const Ends& ends, const Texels& t, const LineCode& code, const Values& mask)
{
    Values indices;
    if (const float error = errorOf(ends, t, code, mask, indices); error < fit.error)
        fit = {ends, indices, error};
}

// Offers the ends as stored, with all choices of lowest bits.
void offerStored(Fit& fit, const Line& line, const Texels& t, const LineCode& code, const Values& mask)
{
    std::array<Ends, 2> ends{};                                                                 // by lowest bit
    const std::size_t first = code.lowBits && code.channels == 3 && code.alphaBits > 0 ? 1 : 0; // 255 is odd
    const std::size_t lows = code.lowBits ? 2 : 1;
    for (std::size_t low = first; low < lows; ++low) {
        storeEnd(line.from, t, code, int(low), ends[low][0]);
        storeEnd(line.to, t, code, int(low), ends[low][1]);
    }
    for (std::size_t a = first; a < lows; ++a)
        for (std::size_t b = code.oneLowBit ? a : first; b < (code.oneLowBit ? a + 1 : lows); ++b)
            offer(fit, {ends[a][0], ends[b][1]}, t, code, mask);
}

} // namespace

Fit fitLine(const Texels& t, const LineCode& code, const Values& mask, float limit)
{
    const auto channels = std::size_t(code.channels);
    Line line = principal(t, channels, mask);
    Values weights;
    for (std::size_t i = 0; i < 4; ++i)
        weights[i] = mask[i] * (channels == 4 ? kZero + 1 : t.weight[i]);
    Fit best;
    for (int round = 0; round < kRounds; ++round) {
        Fit here;
        offerStored(here, line, t, code, mask);
        if (here.error < best.error)
            best = here;
        if (best.error > limit)
            break;
        const LeastSquares fit(weights, here.indices, code.indexBits);
        if (!fit.solvable())
            break;
        for (std::size_t c = 0; c < channels; ++c)
            fit.solve(aimOf(t, channels)[c], line.from[c], line.to[c]);
    }
    return best;
}

void refineLine(Fit& fit, const Texels& t, const LineCode& code, const Values& mask, int rounds)
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
                        offer(fit, to, t, code, mask);
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
