// BC7 of normal maps, in its mode 6: red, green, blue and alpha on one line in each block, between two ends of 7 bits
// and one that the channels share, at 16 places. Microsoft, BC7 Format; Khronos Data Format 1.3, section 20.
#include "block.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "block_texels.hpp"

namespace cotan::maps {

namespace bc7 {

namespace {

// Codes of 0 to 255; and unit normals, or zero where lengths count.
struct Texels {
    std::array<Values, 4> codes;
    std::array<Values, 3> n;
    float zero = 128;       // the code of 0
    bool opaque = true;     // alpha is 255 in all
    bool directions = true; // lengths do not count
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

// Two ends as they are stored: 7 bits of each channel, and the lowest bit of all four.
struct Ends {
    std::array<std::array<int, 4>, 2> high{};
    std::array<int, 2> low{};

    float code(std::size_t end, std::size_t c) const { return float(high[end][c] * 2 + low[end]); }
};

// The texels of four, seen from the first end: where on the line, from 0 to 1, is the nearest to each.
Four nearestPlace(const Texels& t, std::size_t i, const Color& from, const Color& step, float length)
{
    if (t.directions && t.opaque) { // the smallest angle: of n and a + place * d
        float aa = 0, ad = 0, dd = 1e-9f;
        Four na = kNone, nd = kNone;
        for (std::size_t c = 0; c < 3; ++c) {
            const float a = from[c] - t.zero;
            aa += a * a;
            ad += a * step[c];
            dd += step[c] * step[c];
            na += t.n[c][i] * a;
            nd += t.n[c][i] * step[c];
        }
        const Four below = na * dd - nd * ad;
        return below > 1e-6f ? (nd * aa - na * ad) / below : kNone;
    }
    Four along = kNone;
    for (std::size_t c = 0; c < 4; ++c)
        along += (t.codes[c][i] - from[c]) * step[c];
    return along * (1 / length);
}

// The sum of squares in codes: of alpha, and of vectors or, where only these count, directions. Sets places, of 0 to
// 15, to the nearest along the line.
float errorOf(const Ends& ends, const Texels& t, Values& places)
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
        places[i] = rounded(least(most(nearestPlace(t, i, from, step, length), kNone), kNone + 1) * 15);
        // As they are read: of 64ths, each channel to a whole code.
        const Four weight = rounded(places[i] * (64.0f / 15)) * (1.0f / 64);
        std::array<Four, 4> read;
        for (std::size_t c = 0; c < 4; ++c)
            read[c] = rounded(from[c] + step[c] * weight);
        const Four alpha = read[3] - t.codes[3][i];
        sum += alpha * alpha;
        Four off = kNone, square = kNone, along = kNone;
        for (std::size_t c = 0; c < 3; ++c) {
            const Four v = read[c] - t.zero, apart = read[c] - t.codes[c][i];
            off += apart * apart;
            square += v * v;
            along += t.n[c][i] * v;
        }
        if (!t.directions) {
            sum += off;
            continue;
        }
        // The square of the distance between unit vectors, of which one is 127 codes.
        constexpr float kUnit = 127 * 127;
        sum += 2 * kUnit * (1 - along / rootOf(most(square, kNone + 1)));
    }
    return sumOf(sum);
}

struct Line {
    std::array<Color, 2> ends{};
};

// Through the mean, along the way in which the texels differ most.
Line principal(const Texels& t)
{
    Color mean{}, way{};
    for (std::size_t c = 0; c < 4; ++c) {
        const Values& v = t.codes[c];
        mean[c] = sumOf(v[0] + v[1] + v[2] + v[3]) / 16;
        way[c] = most(v) - least(v);
    }
    std::array<Color, 4> covariance{};
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a; b < 4; ++b) {
            Four sum{};
            for (std::size_t i = 0; i < 4; ++i)
                sum += (t.codes[a][i] - mean[a]) * (t.codes[b][i] - mean[b]);
            covariance[a][b] = covariance[b][a] = sumOf(sum);
        }
    std::size_t widest = 0; // the box's diagonal may be across: signs are those beside what varies most
    for (std::size_t c = 1; c < 4; ++c)
        widest = covariance[c][c] > covariance[widest][widest] ? c : widest;
    for (std::size_t c = 1; c < 4; ++c)
        way[c] = std::signbit(covariance[widest][c]) != std::signbit(covariance[widest][0]) ? -way[c] : way[c];
    for (int round = 0; round < 6; ++round) {
        Color next{};
        float largest = 0;
        for (std::size_t a = 0; a < 4; ++a) {
            for (std::size_t b = 0; b < 4; ++b)
                next[a] += covariance[a][b] * way[b];
            largest = std::max(largest, std::abs(next[a]));
        }
        if (!(largest > 1e-6f))
            break;
        for (std::size_t c = 0; c < 4; ++c)
            way[c] = next[c] / largest;
    }
    float square = 0;
    for (const float w : way)
        square += w * w;
    Line line{{mean, mean}};
    if (!(square > 0))
        return line;
    Four first = kNone + 1e9f, last = kNone - 1e9f;
    for (std::size_t i = 0; i < 4; ++i) {
        Four place = kNone;
        for (std::size_t c = 0; c < 4; ++c)
            place += (t.codes[c][i] - mean[c]) * (way[c] / square);
        first = least(first, place);
        last = most(last, place);
    }
    for (std::size_t c = 0; c < 4; ++c) {
        line.ends[0][c] += way[c] * least(first);
        line.ends[1][c] += way[c] * most(last);
    }
    return line;
}

// The ends that fit best with every texel at its place.
Line leastSquares(const Line& from, const Texels& t, const Values& places)
{
    Four aa4{}, ab4{}, bb4{};
    Values weights{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Four b = places[i] * (1.0f / 15), a = 1 - b;
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
    Values places{};
    float error = 1e30f;

    void offer(const Ends& to, const Texels& t)
    {
        Values there{};
        if (const float e = errorOf(to, t, there); e < error) {
            ends = to;
            places = there;
            error = e;
        }
    }
};

// Moves each number by one as long as that helps, a few times at most.
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
        for (int k = t.opaque ? 3 : 0; k < 4; ++k) // 255 has the lowest bit
            here.offer(stored(line, k & 1, k >> 1), t);
        line = leastSquares(line, t, here.places);
        if (here.error < fit.error)
            fit = here;
    }
    descend(fit, t);
    return fit;
}

// Where directions count: from the vectors that fit best on, which are no bad place to begin.
Fit fittedFrom(Texels t)
{
    const bool directions = t.directions;
    t.directions = false;
    Fit fit = fitted(t);
    if (!directions)
        return fit;
    t.directions = true;
    fit.error = errorOf(fit.ends, t, fit.places);
    descend(fit, t);
    return fit;
}

// Bits from the lowest on.
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
    Values places = fit.places;
    // The first place is stored without its highest bit.
    const bool turned = at(places, 0) > 7;
    const std::size_t first = turned ? 1 : 0;
    Bits bits(to);
    bits.put(0x40, 7); // mode 6
    for (std::size_t c = 0; c < 4; ++c)
        for (const std::size_t e : {first, 1 - first})
            bits.put(unsigned(fit.ends.high[e][c]), 7);
    for (const std::size_t e : {first, 1 - first})
        bits.put(unsigned(fit.ends.low[e]), 1);
    for (std::size_t i = 0; i < 16; ++i) {
        const int place = int(at(places, i));
        bits.put(unsigned(turned ? 15 - place : place), i == 0 ? 3 : 4);
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

} // namespace cotan::maps
