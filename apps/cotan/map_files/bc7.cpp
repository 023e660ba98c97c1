// BC7 encoder for normal maps that uses only mode 6: the RGBA values of a block lie on one line, at 16 positions
// between two ends, each stored as 7 bits per channel and one bit that its channels share. Microsoft, BC7 Format;
// Khronos Data Format 1.3, section 20.
#include "block.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "block_texels.hpp"

namespace cotan::app {

namespace bc7 {

namespace {

// The texels of a block: codes of 0 to 255, and unit normals, or zero if lengths count.
struct Texels {
    std::array<Values, 4> codes;
    std::array<Values, 3> n;
    float zero = 128;       // the code of 0
    bool opaque = true;     // alpha is 255 in all texels
    bool directions = true; // only directions count, not lengths
};

Texels texelsOf(const Image& map, int left, int top, const CodeScale& scale, bool lengths)
{
    Texels t{};
    t.zero = scale.zero;
    t.directions = !lengths;
    for (std::size_t i = 0; i < 16; ++i) {
        const float* const texel = texelAt(map, left, top, int(i));
        std::array<float, 3> n{};
        float square = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            n[c] = 2 * texel[c] - 1;
            square += n[c] * n[c];
            at(t.codes[c], i) = std::clamp(scale.zero + scale.unit * n[c], 0.0f, 255.0f);
        }
        const float inverse = lengths || !(square > 1e-6f) ? 0 : 1 / std::sqrt(square);
        for (std::size_t c = 0; c < 3; ++c)
            at(t.n[c], i) = n[c] * inverse;
        at(t.codes[3], i) = std::clamp(255 * texel[3], 0.0f, 255.0f);
        t.opaque = t.opaque && texel[3] >= 1;
    }
    return t;
}

using Color = std::array<float, 4>;

// The two ends as stored: 7 bits per channel, and the lowest bit that all four channels share.
struct Ends {
    std::array<std::array<int, 4>, 2> high{};
    std::array<int, 2> low{};

    float code(std::size_t end, std::size_t c) const { return float(high[end][c] * 2 + low[end]); }
};

// The positions on the line, from 0 at the first end to 1, that are nearest to four texels.
Four nearestPosition(const Texels& t, std::size_t i, const Color& from, const Color& step, float length)
{
    if (t.directions && t.opaque) { // minimises the angle between n and a + position * d
        float aa = 0, ad = 0, dd = 1e-9f;
        Four na = kZero, nd = kZero;
        for (std::size_t c = 0; c < 3; ++c) {
            const float a = from[c] - t.zero;
            aa += a * a;
            ad += a * step[c];
            dd += step[c] * step[c];
            na += t.n[c][i] * a;
            nd += t.n[c][i] * step[c];
        }
        const Four below = na * dd - nd * ad;
        return below > 1e-6f ? (nd * aa - na * ad) / below : kZero;
    }
    Four along = kZero;
    for (std::size_t c = 0; c < 4; ++c)
        along += (t.codes[c][i] - from[c]) * step[c];
    return along * (1 / length);
}

// Sum of squared errors in codes: of alpha, and of vectors or, if only these count, directions. Sets positions, 0 to
// 15, to the nearest on the line.
float errorOf(const Ends& ends, const Texels& t, Values& positions)
{
    Color from{}, step{};
    float length = 1e-9f; // squared
    for (std::size_t c = 0; c < 4; ++c) {
        from[c] = ends.code(0, c);
        step[c] = ends.code(1, c) - from[c];
        length += step[c] * step[c];
    }
    Four sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        positions[i] = rounded(minOf(maxOf(nearestPosition(t, i, from, step, length), kZero), kZero + 1) * 15);
        // As a decoder interpolates: with weights in 64ths, rounded to whole codes.
        const Four weight = rounded(positions[i] * (64.0f / 15)) * (1.0f / 64);
        std::array<Four, 4> read;
        for (std::size_t c = 0; c < 4; ++c)
            read[c] = rounded(from[c] + step[c] * weight);
        const Four alpha = read[3] - t.codes[3][i];
        sum += alpha * alpha;
        Four vectorError = kZero, square = kZero, along = kZero;
        for (std::size_t c = 0; c < 3; ++c) {
            const Four v = read[c] - t.zero, difference = read[c] - t.codes[c][i];
            vectorError += difference * difference;
            square += v * v;
            along += t.n[c][i] * v;
        }
        if (!t.directions) {
            sum += vectorError;
            continue;
        }
        // Squared distance of unit vectors, in codes: length 1 is 127 codes.
        constexpr float kUnit = 127 * 127;
        sum += 2 * kUnit * (1 - along / rootOf(maxOf(square, kZero + 1)));
    }
    return sumOf(sum);
}

struct Line {
    std::array<Color, 2> ends{};
};

// The line through the mean along the principal axis, clipped to the range of the texels.
Line principal(const Texels& t)
{
    Color mean{}, axis{};
    for (std::size_t c = 0; c < 4; ++c) {
        const Values& v = t.codes[c];
        mean[c] = sumOf(v[0] + v[1] + v[2] + v[3]) / 16;
        axis[c] = maxOf(v) - minOf(v);
    }
    std::array<Color, 4> covariance{};
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a; b < 4; ++b) {
            Four sum{};
            for (std::size_t i = 0; i < 4; ++i)
                sum += (t.codes[a][i] - mean[a]) * (t.codes[b][i] - mean[b]);
            covariance[a][b] = covariance[b][a] = sumOf(sum);
        }
    std::size_t widest = 0; // its covariances give the signs, since the box's diagonal may be perpendicular to the axis
    for (std::size_t c = 1; c < 4; ++c)
        widest = covariance[c][c] > covariance[widest][widest] ? c : widest;
    for (std::size_t c = 1; c < 4; ++c)
        axis[c] = std::signbit(covariance[widest][c]) != std::signbit(covariance[widest][0]) ? -axis[c] : axis[c];
    for (int round = 0; round < 6; ++round) {
        Color next{};
        float largest = 0;
        for (std::size_t a = 0; a < 4; ++a) {
            for (std::size_t b = 0; b < 4; ++b)
                next[a] += covariance[a][b] * axis[b];
            largest = std::max(largest, std::abs(next[a]));
        }
        if (!(largest > 1e-6f))
            break;
        for (std::size_t c = 0; c < 4; ++c)
            axis[c] = next[c] / largest;
    }
    float square = 0;
    for (const float w : axis)
        square += w * w;
    Line line{{mean, mean}};
    if (!(square > 0))
        return line;
    Four first = kZero + 1e9f, last = kZero - 1e9f;
    for (std::size_t i = 0; i < 4; ++i) {
        Four position = kZero;
        for (std::size_t c = 0; c < 4; ++c)
            position += (t.codes[c][i] - mean[c]) * (axis[c] / square);
        first = minOf(first, position);
        last = maxOf(last, position);
    }
    for (std::size_t c = 0; c < 4; ++c) {
        line.ends[0][c] += axis[c] * minOf(first);
        line.ends[1][c] += axis[c] * maxOf(last);
    }
    return line;
}

// The ends that fit best if every texel keeps its position.
Line leastSquares(const Line& from, const Texels& t, const Values& positions)
{
    Four aa4{}, ab4{}, bb4{};
    Values weights{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Four b = positions[i] * (1.0f / 15), a = 1 - b;
        weights[i] = b;
        aa4 += a * a;
        ab4 += a * b;
        bb4 += b * b;
    }
    const float aa = sumOf(aa4), ab = sumOf(ab4), bb = sumOf(bb4), determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-4f * aa * bb))
        return from;
    Line to;
    for (std::size_t c = 0; c < 4; ++c) {
        Four av4{}, bv4{};
        for (std::size_t i = 0; i < 4; ++i) {
            av4 += (1 - weights[i]) * t.codes[c][i];
            bv4 += weights[i] * t.codes[c][i];
        }
        const float av = sumOf(av4), bv = sumOf(bv4);
        to.ends[0][c] = (bb * av - ab * bv) / determinant;
        to.ends[1][c] = (aa * bv - ab * av) / determinant;
    }
    return to;
}

Ends stored(const Line& line, int low0, int low1)
{
    Ends ends;
    ends.low = {low0, low1};
    for (std::size_t e = 0; e < 2; ++e)
        for (std::size_t c = 0; c < 4; ++c)
            ends.high[e][c] = std::clamp(int(std::floor((line.ends[e][c] - float(ends.low[e])) / 2 + 0.5f)), 0, 127);
    return ends;
}

struct Fit {
    Ends ends;
    Values positions{};
    float error = 1e30f;

    void offer(const Ends& to, const Texels& t)
    {
        Values there{};
        if (const float e = errorOf(to, t, there); e < error) {
            ends = to;
            positions = there;
            error = e;
        }
    }
};

// Coordinate descent: changes each value by one while that reduces the error, in at most kRounds rounds.
void descend(Fit& fit, const Texels& t)
{
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
        const float before = fit.error;
        for (std::size_t e = 0; e < 2; ++e)
            for (std::size_t c = 0; c < (t.opaque ? 3u : 4u); ++c)
                for (const int by : {-1, 1}) {
                    Ends to = fit.ends;
                    to.high[e][c] += by;
                    if (to.high[e][c] >= 0 && to.high[e][c] <= 127)
                        fit.offer(to, t);
                }
        if (!(fit.error < before))
            break;
    }
}

Fit fitted(const Texels& t)
{
    Line line = principal(t);
    Fit fit;
    for (int round = 0; round < 3; ++round) {
        Fit here;
        for (int k = t.opaque ? 3 : 0; k < 4; ++k) // 255 has the lowest bit set
            here.offer(stored(line, k & 1, k >> 1), t);
        line = leastSquares(line, t, here.positions);
        if (here.error < fit.error)
            fit = here;
    }
    descend(fit, t);
    return fit;
}

// Fits vectors and, if only directions count, refines this fit for directions.
Fit fittedFrom(Texels t)
{
    const bool directions = t.directions;
    t.directions = false;
    Fit fit = fitted(t);
    if (!directions)
        return fit;
    t.directions = true;
    fit.error = errorOf(fit.ends, t, fit.positions);
    descend(fit, t);
    return fit;
}

// Writes bits, lowest first.
class Bits {
public:
    explicit Bits(std::byte* to) : to_(to) { std::fill(to, to + 16, std::byte(0)); }
    void put(unsigned value, unsigned count)
    {
        for (unsigned i = 0; i < count; ++i, ++at_)
            to_[at_ / 8] |= std::byte((value >> i & 1) << at_ % 8);
    }

private:
    std::byte* to_;
    std::size_t at_ = 0;
};

void write(const Fit& fit, std::byte* to)
{
    Values positions = fit.positions;
    // The highest bit of the first index is not stored. If it is set, the ends are swapped.
    const bool swapped = at(positions, 0) > 7;
    const std::size_t first = swapped ? 1 : 0;
    Bits bits(to);
    bits.put(0x40, 7); // mode 6
    for (std::size_t c = 0; c < 4; ++c)
        for (const std::size_t e : {first, 1 - first})
            bits.put(unsigned(fit.ends.high[e][c]), 7);
    for (const std::size_t e : {first, 1 - first})
        bits.put(unsigned(fit.ends.low[e]), 1);
    for (std::size_t i = 0; i < 16; ++i) {
        const int position = int(at(positions, i));
        bits.put(unsigned(swapped ? 15 - position : position), i == 0 ? 3 : 4);
    }
}

} // namespace

} // namespace bc7

std::vector<std::byte> encodeBc7(const Image& map, const CodeScale& scale, bool lengths)
{
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        bc7::write(bc7::fittedFrom(bc7::texelsOf(map, left, top, scale, lengths)), to);
    });
}

} // namespace cotan::app
