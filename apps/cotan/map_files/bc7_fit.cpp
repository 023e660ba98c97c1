#include "bc7_fit.hpp"

#include <algorithm>
#include <cmath>

namespace cotan::app::bc7 {

namespace {

constexpr int kRounds = 2; // of least squares

using Color = std::array<float, 4>;

struct Line {
    Color from{}, to{};
};

constexpr float kRadian = 127; // in codes

// The value of 8 bits of a stored one of `bits`.
template<class Int> Int expanded(Int stored, int bits)
{
    return bits >= 8 ? stored : stored << (8 - bits) | stored >> (2 * bits - 8);
}

// Rounds half up, as decoders do; not negative.
[[gnu::always_inline]] inline Four wholeOf(Four f)
{
    return __builtin_convertvector(__builtin_convertvector(f + 0.5f, FourInts), Four);
}

// The weight of the second end, in 64ths.
[[gnu::always_inline]] inline Four weightOf(Four index, int indexBits)
{
    return rounded(index * (64.0f / float((1 << indexBits) - 1)));
}

// The stored value nearest to a code; low: its lowest bit, if this is shared.
[[gnu::always_inline]] inline FourInts nearestStored(Four code, int bits, bool lowBits, int low)
{
    const float highest = float((1 << bits) - 1);
    const Four value = minOf(maxOf(code * (highest / 255), kZero), kZero + highest);
    if (!lowBits)
        return __builtin_convertvector(value + 0.5f, FourInts);
    const Four half = minOf(maxOf((value - float(low)) * 0.5f + 0.5f, kZero), kZero + float(1 << (bits - 1)) - 0.5f);
    return __builtin_convertvector(half, FourInts) * 2 + low;
}

// Squared angles, from the dot products of vectors with normals and their squared lengths.
[[gnu::always_inline]] inline Four squaredAngle(Four along, Four square)
{
    const Four back = along > 0.0f ? along : -along;
    return (kRadian * kRadian) * (1 - along * back / square);
}

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

// The line through the mean along the principal axis, clipped to the range of the texels.
Line principal(const Texels& t, std::size_t channels, const Values& mask)
{
    Values weights;
    Four all{};
    for (std::size_t i = 0; i < 4; ++i)
        all += weights[i] = mask[i] * t.weight[i];
    const float inverse = 1 / sumOf(all);
    Color mean{};
    std::array<Values, 4> off;
    for (std::size_t c = 0; c < channels; ++c) {
        Four sum{};
        for (std::size_t i = 0; i < 4; ++i)
            sum += weights[i] * t.aim[c][i];
        mean[c] = sumOf(sum) * inverse;
        for (std::size_t i = 0; i < 4; ++i)
            off[c][i] = t.aim[c][i] - mean[c];
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

// Weighted least squares of values on a line whose positions are known. Sums of the weights of both ends.
struct LeastSquares {
    Values first, second;
    float aa = 0, ab = 0, bb = 0, determinant = 0;

    LeastSquares(const Values& weights, const Values& indices, int indexBits)
    {
        Four aa4{}, ab4{}, bb4{};
        for (std::size_t i = 0; i < 4; ++i) {
            const Four b = weightOf(indices[i], indexBits) * (1.0f / 64), a = 1 - b;
            first[i] = weights[i] * a;
            second[i] = weights[i] * b;
            aa4 += first[i] * a;
            ab4 += first[i] * b;
            bb4 += second[i] * b;
        }
        aa = sumOf(aa4);
        ab = sumOf(ab4);
        bb = sumOf(bb4);
        determinant = aa * bb - ab * ab;
    }
    bool solvable() const { return determinant > 1e-4f * aa * bb; }
    void solve(const Values& values, float& from, float& to) const
    {
        Four av4{}, bv4{};
        for (std::size_t i = 0; i < 4; ++i) {
            av4 += first[i] * values[i];
            bv4 += second[i] * values[i];
        }
        const float av = sumOf(av4), bv = sumOf(bv4);
        from = (bb * av - ab * bv) / determinant;
        to = (aa * bv - ab * av) / determinant;
    }
};

// By how much the vector to v may be longer until a code leaves its range.
float growthOf(float v, float zero) { return v > 0 ? (255 - zero) / v : v < 0 ? zero / -v : 1e9f; }

// An end as stored. Where only directions count, the one of several lengths whose direction is nearest. Returns the
// squared error.
float storeEnd(const Color& end, const Texels& t, const LineCode& code, int low, std::array<int, 4>& stored)
{
    if (code.channels == 4)
        stored[3] = nearestStored(kZero + end[3], code.alphaBits, code.lowBits, low)[0];
    else if (code.alphaBits > 0)
        stored[3] = (1 << code.alphaBits) - 1;
    const bool anyLength = t.directions;
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

Fit fitLine(const Texels& t, const LineCode& code, const Values& mask)
{
    const auto channels = std::size_t(code.channels);
    Line line = principal(t, channels, mask);
    Values weights;
    for (std::size_t i = 0; i < 4; ++i)
        weights[i] = mask[i] * t.weight[i];
    Fit best;
    for (int round = 0; round < kRounds; ++round) {
        Fit here;
        offerStored(here, line, t, code, mask);
        if (here.error < best.error)
            best = here;
        const LeastSquares fit(weights, here.indices, code.indexBits);
        if (!fit.solvable())
            break;
        for (std::size_t c = 0; c < channels; ++c)
            fit.solve(t.aim[c], line.from[c], line.to[c]);
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

// ---- a line and a channel by itself --------------------------------------------------------

namespace {

// Sum of squared angles. Chooses for each texel the pair of indices with the smallest.
float planesError(const Ends& ends, const Texels& t, const PlanesCode& code, Values& indices, Values& scalarIndices)
{
    const auto s = std::size_t(code.scalar), u = (s + 1) % 3, v = (s + 2) % 3;
    const auto end = [&](std::size_t e, std::size_t c) {
        return float(expanded(ends[e][c], c < 3 ? code.colorBits : code.scalarBits));
    };
    const float low = end(0, 3), step = end(1, 3) - low, last = float((1 << code.scalarIndexBits) - 1);
    const float inverse = step != 0 ? last / step : 0, toWeight = 64 / last;
    Values least;
    least.fill(kZero + 1e30f);
    for (int k = 0; k < 1 << code.lineIndexBits; ++k) {
        const float weight = weightOf(kZero + float(k), code.lineIndexBits)[0] * (1.0f / 64);
        const auto level = [&](std::size_t c) {
            return float(int(end(0, c) + (end(1, c) - end(0, c)) * weight + 0.5f)) - t.zero;
        };
        const float lineU = level(u), lineV = level(v), square = lineU * lineU + lineV * lineV;
        for (std::size_t i = 0; i < 4; ++i) {
            const Four along = t.n[u][i] * lineU + t.n[v][i] * lineV;
            const Four nearest = t.n[s][i] * square / maxOf(along, kZero + 1e-3f); // has the smallest angle
            const Four index = rounded(minOf(maxOf((nearest + (t.zero - low)) * inverse, kZero), kZero + last));
            const Four scalar = wholeOf(low + step * (rounded(index * toWeight) * (1.0f / 64))) - t.zero;
            const Four error = squaredAngle(along + t.n[s][i] * scalar, scalar * scalar + (square + 1e-6f));
            const FourInts better = error < least[i];
            least[i] = better ? error : least[i];
            indices[i] = better ? kZero + float(k) : indices[i];
            scalarIndices[i] = better ? index : scalarIndices[i];
        }
    }
    return sumOf((least[0] + least[2]) + (least[1] + least[3]));
}

void offerPlanes(PlanesFit& fit, const Ends& ends, const Texels& t, const PlanesCode& code)
{
    Values indices{}, scalarIndices{};
    if (const float error = planesError(ends, t, code, indices, scalarIndices); error < fit.error)
        fit = {ends, indices, scalarIndices, error};
}

} // namespace

PlanePoints planePoints(const Texels& t, int scalar)
{
    const auto s = std::size_t(scalar), u = (s + 1) % 3, v = (s + 2) % 3;
    PlanePoints p;
    auto& [alongU, alongV] = p.along;
    const auto& n = t.n;
    alongU = sumOf((n[u][0] + n[u][2]) + (n[u][1] + n[u][3]));
    alongV = sumOf((n[v][0] + n[v][2]) + (n[v][1] + n[v][3]));
    const float length = std::sqrt(alongU * alongU + alongV * alongV);
    if (length < 1) {
        p.along = {};
        return p;
    }
    alongU /= length;
    alongV /= length;
    for (std::size_t i = 0; i < 4; ++i) {
        const Four along = maxOf(n[u][i] * alongU + n[v][i] * alongV, kZero + 0.05f);
        p.scalar[i] = n[s][i] / along;
        p.across[i] = (n[v][i] * alongU - n[u][i] * alongV) / along;
        p.weight[i] = along * along;
    }
    return p;
}

PlanesFit fitPlanes(const Texels& t, const PlanePoints& points, const PlanesCode& code)
{
    const auto s = std::size_t(code.scalar), u = (s + 1) % 3, v = (s + 2) % 3;
    const auto& [scalar, across, weight, along] = points;
    const auto [alongU, alongV] = along;
    constexpr int kPlaneLengths = 6;
    PlanesFit best;
    std::array<float, 2> scalars{minOf(scalar), maxOf(scalar)}, acrosses{minOf(across), maxOf(across)};
    for (int round = 0; round < kRounds; ++round) {
        float longest = 1e9f;
        for (std::size_t e = 0; e < 2; ++e)
            longest = std::min({longest, growthOf(scalars[e], t.zero), growthOf(alongU - acrosses[e] * alongV, t.zero),
                                growthOf(alongV + acrosses[e] * alongU, t.zero)});
        PlanesFit here;
        const float by = longest * float(1 << (8 - code.colorBits)) / 127; // about one step of a color
        for (int k = 0; k < kPlaneLengths; ++k) {
            const float scale = longest - float(k) * by;
            Ends ends{};
            for (std::size_t e = 0; e < 2; ++e) {
                ends[e][s] = (1 << code.colorBits) - 1; // alpha, after the rotation
                const FourInts stored = nearestStored(
                    t.zero + scale * Four{alongU - acrosses[e] * alongV, alongV + acrosses[e] * alongU, 0, 0},
                    code.colorBits, false, 0);
                ends[e][u] = stored[0];
                ends[e][v] = stored[1];
                ends[e][3] = nearestStored(kZero + (t.zero + scale * scalars[e]), code.scalarBits, false, 0)[0];
            }
            offerPlanes(here, ends, t, code);
        }
        if (here.error < best.error)
            best = here;
        const LeastSquares ofScalar(weight, here.scalarIndices, code.scalarIndexBits),
            ofLine(weight, here.indices, code.lineIndexBits);
        if (ofScalar.solvable())
            ofScalar.solve(scalar, scalars[0], scalars[1]);
        if (ofLine.solvable())
            ofLine.solve(across, acrosses[0], acrosses[1]);
    }
    return best;
}

void refinePlanes(PlanesFit& fit, const Texels& t, const PlanesCode& code, int rounds)
{
    for (int round = 0; round < rounds; ++round) {
        const float before = fit.error;
        for (std::size_t c = 0; c < 4; ++c)
            for (int move = 0; move < (int(c) == code.scalar ? 0 : 6); ++move) {
                Ends to = fit.ends; // one end, or both
                const int by = move % 2 ? 1 : -1;
                to[0][c] += move / 2 != 1 ? by : 0;
                to[1][c] += move / 2 != 0 ? by : 0;
                const int end = 1 << (c < 3 ? code.colorBits : code.scalarBits);
                if (std::min(to[0][c], to[1][c]) >= 0 && std::max(to[0][c], to[1][c]) < end)
                    offerPlanes(fit, to, t, code);
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

} // namespace cotan::app::bc7
