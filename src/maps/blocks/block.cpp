#include "maps/blocks/block.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "block_texels.hpp"

namespace cotan::maps {

namespace {

// One channel of a block: two ends, the first of which is larger. A texel's position between them is 0 (at `low`) to 7.
struct Ends {
    int high = 1, low = 0;
};

// Rounds to an integer of 0 to `most`.
template<class V> [[gnu::always_inline]] inline V roundedWithin(V value, float most)
{
    return rounded(minOf(maxOf(value, V{}), V{} + most));
}

Four positionOf(Four value, float low, float inverseStep) { return roundedWithin((value - low) * inverseStep, 7); }

// The position below, at most 6.
template<class V> [[gnu::always_inline]] inline V positionBelow(V value, float low, float inverseStep)
{
    const V clamped = minOf(maxOf((value - low) * inverseStep, V{}), V{} + 6);
    return __builtin_convertvector(__builtin_convertvector(clamped, typename LaneInts<V>::Type), V);
}

bool valid(const Ends& ends) { return ends.low >= 0 && ends.high <= 255 && ends.high > ends.low; }

// The two adjacent codes around a value.
Ends aroundOne(float value)
{
    const int low = std::clamp(int(value), 0, 254);
    return {low + 1, low};
}

int codeOf(float value) { return int(std::min(std::max(value, 0.0f), 255.0f) + 0.5f); }

// The ends that fit best if every texel keeps its position.
Ends leastSquares(const Ends& from, const Values& values, const Values& weights)
{
    const float low = float(from.low), inverse = 7 / float(from.high - from.low);
    Four aa4{}, ab4{}, bb4{}, av4{}, bv4{}; // normal equations of low and high
    for (std::size_t i = 0; i < 4; ++i) {
        const Four position = positionOf(values[i], low, inverse) * (1.0f / 7), rest = 1 - position;
        const Four a = weights[i] * rest, b = weights[i] * position;
        aa4 += a * rest;
        ab4 += a * position;
        bb4 += b * position;
        av4 += a * values[i];
        bv4 += b * values[i];
    }
    const float aa = sumOf(aa4), ab = sumOf(ab4), bb = sumOf(bb4), av = sumOf(av4), bv = sumOf(bv4);
    const float determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-4f * aa * bb))
        return from;
    const Ends to{codeOf((aa * bv - ab * av) / determinant), codeOf((bb * av - ab * bv) / determinant)};
    return valid(to) ? to : from;
}

// The ends themselves, then with one or both of them moved by one.
constexpr CandidateValues kLowMoves{0, 1, 1, 0, 0, -1, -1, 1}, kHighMoves{0, -1, 0, -1, 1, 0, 1, 1};

Ends moved(const Ends& ends, std::size_t move)
{
    return {ends.high + int(kHighMoves[move]), ends.low + int(kLowMoves[move])};
}

// Candidates for the ends of a channel: those that are not valid are the ends themselves.
template<class V> struct EndsLanes {
    V low, step, inverse;

    [[gnu::always_inline]] EndsLanes(const Ends& around, std::size_t first)
    {
        V high;
        loadLanes(low, kLowMoves, first);
        loadLanes(high, kHighMoves, first);
        const V zero{}, aroundLow = zero + float(around.low), aroundHigh = zero + float(around.high);
        low += aroundLow;
        high += aroundHigh;
        const V inside =
            (low < zero ? zero : zero + 1) * (high > zero + 255 ? zero : zero + 1) * (high > low ? zero + 1 : zero);
        low = inside > zero ? low : aroundLow;
        high = inside > zero ? high : aroundHigh;
        step = (high - low) * (1.0f / 7);
        inverse = 1 / step;
    }
};

// Weighted sums of squared errors.
CandidateValues endsErrors(const Ends& around, const Values& values, const Values& weights)
{
    CandidateValues errors;
    runLanes([&]<class V>() __attribute__((always_inline)) {
        for (std::size_t first = 0; first < kCandidates; first += sizeof(V) / sizeof(float)) {
            const EndsLanes<V> ends(around, first);
            const auto& [low, step, inverse] = ends;
            V sum{};
            for (std::size_t i = 0; i < 16; ++i) {
                const V above = values[i / 4][i % 4] - low, position = roundedWithin(above * inverse, 7);
                const V off = above - position * step;
                sum += weights[i / 4][i % 4] * (off * off);
            }
            std::memcpy(errors.data() + first, &sum, sizeof sum);
        }
    });
    return errors;
}

// Changes the ends by one while that reduces the error, in at most kRounds rounds.
void descend(Ends& best, const Values& values, const Values& weights)
{
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
        const std::size_t least = leastOf(endsErrors(best, values, weights));
        if (least == 0)
            return;
        best = moved(best, least);
    }
}

Ends fit(const Values& values, const Values& weights)
{
    const float low = minOf(values), high = maxOf(values);
    if (high - low < 1e-3f)
        return aroundOne(low);
    Ends best{codeOf(high), codeOf(low)};
    if (!valid(best))
        best = aroundOne((low + high) / 2);
    best = leastSquares(best, values, weights);
    descend(best, values, weights);
    return best;
}

// Writes a BC4 block: the ends, then a 3-bit index per texel: 0 is the first end, 1 the second, 2 to 7 between them.
void put(const Ends& ends, const Values& positions, std::byte* to)
{
    std::uint64_t bits = 0;
    for (std::size_t row = 0; row < 4; ++row) {
        const Four code = positions[row] == 7.0f ? kZero : positions[row] == 0.0f ? kZero + 1 : 8 - positions[row];
        bits |= std::uint64_t(sumOf(code * Four{1, 8, 64, 512})) << 12 * row;
    }
    to[0] = std::byte(ends.high);
    to[1] = std::byte(ends.low);
    for (int i = 0; i < 6; ++i)
        to[2 + i] = std::byte(bits >> 8 * i & 0xff);
}

// Chooses for each texel, of the four pairs of positions around it, the one with the smallest angle.
void choosePositions(const NormalTexels& t, const Ends& x, const Ends& y, Values& positionsX, Values& positionsY)
{
    runLanes([&]<class V>() __attribute__((always_inline)) {
        const float stepX = float(x.high - x.low) / 7, stepY = float(y.high - y.low) / 7;
        const float lowX = float(x.low), lowY = float(y.low), inverseX = 1 / stepX, inverseY = 1 / stepY;
        for (std::size_t first = 0; first < 16; first += sizeof(V) / sizeof(float)) {
            const V zero{}, valueX = lanesOf<V>(t.x, first), valueY = lanesOf<V>(t.y, first);
            const V u = lanesOf<V>(t.u, first), v = lanesOf<V>(t.v, first);
            const V belowX = positionBelow(valueX, lowX, inverseX), belowY = positionBelow(valueY, lowY, inverseY);
            const V x0 = lowX + belowX * stepX - valueX, x1 = x0 + stepX;
            const V y0 = lowY + belowY * stepY - valueY, y1 = y0 + stepY;
            const auto error = [&](V ex, V ey) __attribute__((always_inline))
            {
                const V along = u * ex + v * ey;
                return ex * ex + ey * ey + along * along;
            };
            const V e00 = error(x0, y0), e01 = error(x0, y1), e10 = error(x1, y0), e11 = error(x1, y1);
            const V least0 = e01 < e00 ? e01 : e00, least1 = e11 < e10 ? e11 : e10;
            const V up0 = e01 < e00 ? zero + 1 : zero, up1 = e11 < e10 ? zero + 1 : zero;
            storeLanes(positionsX, first, belowX + (least1 < least0 ? zero + 1 : zero));
            storeLanes(positionsY, first, belowY + (least1 < least0 ? up1 : up0));
        }
    });
}

// Whether errors of x and y interact noticeably: for tilts of about 30 degrees and more.
bool steep(const NormalTexels& t)
{
    constexpr float kFrom = 0.3f;
    Four square{};
    for (std::size_t i = 0; i < 4; ++i)
        square = maxOf(square, t.u[i] * t.u[i] + t.v[i] * t.v[i]);
    return maxOf(square) > kFrom;
}

// Sums of squared angles: candidates for the ends of one channel, x or y, with given ends of the other one. slopes: u
// or v of the same channel.
CandidateValues angleErrors(const Ends& around, const Ends& other, const Values& values, const Values& slopes,
                            const Values& otherValues, const Values& otherSlopes)
{
    CandidateValues errors;
    runLanes([&]<class V>() __attribute__((always_inline)) {
        const float otherStep = float(other.high - other.low) / 7, otherInverse = 1 / otherStep;
        Values near, far; // errors of the other channel at the positions around a value
        for (std::size_t i = 0; i < 4; ++i) {
            near[i] = float(other.low) - otherValues[i]
                + positionBelow(otherValues[i], float(other.low), otherInverse) * otherStep;
            far[i] = near[i] + otherStep;
        }
        for (std::size_t first = 0; first < kCandidates; first += sizeof(V) / sizeof(float)) {
            const EndsLanes<V> ends(around, first);
            const auto& [low, step, inverse] = ends;
            V sum{};
            for (std::size_t i = 0; i < 16; ++i) {
                const V below = low - values[i / 4][i % 4], position = roundedWithin(below * -inverse - 0.5f, 6);
                const V e0 = below + position * step, e1 = e0 + step;
                const float n = near[i / 4][i % 4], f = far[i / 4][i % 4], slope = slopes[i / 4][i % 4];
                const float alongN = otherSlopes[i / 4][i % 4] * n, alongF = otherSlopes[i / 4][i % 4] * f;
                const V along0 = slope * e0, along1 = slope * e1;
                const V a = (along0 + alongN) * (along0 + alongN) + n * n,
                        b = (along0 + alongF) * (along0 + alongF) + f * f;
                const V c = (along1 + alongN) * (along1 + alongN) + n * n,
                        d = (along1 + alongF) * (along1 + alongF) + f * f;
                const V near0 = (a < b ? a : b) + e0 * e0, near1 = (c < d ? c : d) + e1 * e1;
                sum += near0 < near1 ? near0 : near1;
            }
            std::memcpy(errors.data() + first, &sum, sizeof sum);
        }
    });
    return errors;
}

// Changes the ends of each channel by one if that reduces the angles.
void refineTogether(const NormalTexels& t, Ends& x, Ends& y)
{
    x = moved(x, leastOf(angleErrors(x, y, t.x, t.u, t.y, t.v)));
    y = moved(y, leastOf(angleErrors(y, x, t.y, t.v, t.x, t.u)));
}

// most: the highest code of an end.
void encodeNormals(const NormalTexels& t, int most, std::byte* to)
{
    Ends x = fit(t.x, t.weightX), y = fit(t.y, t.weightY);
    if (steep(t))
        refineTogether(t, x, y);
    for (Ends* ends : {&x, &y})
        *ends = {std::min(ends->high, most), std::min(ends->low, most - 1)};
    Values positionsX{}, positionsY{};
    choosePositions(t, x, y, positionsX, positionsY);
    put(x, positionsX, to);
    put(y, positionsY, to + 8);
}

} // namespace

void encodeAlpha(const Values& values, const Values& weights, std::byte* to)
{
    const Ends ends = fit(values, weights);
    Values positions;
    for (std::size_t i = 0; i < 4; ++i)
        positions[i] = positionOf(values[i], float(ends.low), 7 / float(ends.high - ends.low));
    put(ends, positions, to);
}

std::vector<std::byte> encodeBc5(const Image& map, const CodeScale& scale)
{
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        encodeNormals(normalTexels(map, left, top, scale), 255, to);
    });
}

std::vector<std::byte> encodeBc5Signed(const Image& map)
{
    constexpr int kZeroCode = 127, kMost = 254;
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        encodeNormals(normalTexels(map, left, top, {kZeroCode, kZeroCode}, kMost), kMost, to);
        for (std::size_t end : {0u, 1u, 8u, 9u})
            to[end] = std::byte((std::to_integer<int>(to[end]) - kZeroCode) & 0xff);
    });
}

std::vector<std::byte> encodeBc4(const Image& image)
{
    return encodeBlocks(image, 8, [&](int left, int top, std::byte* to) {
        Values values, unused;
        loadCodes(image, left, top, 0, 255, 255, values, unused);
        Values ones;
        ones.fill(kZero + 1);
        encodeAlpha(values, ones, to);
    });
}

} // namespace cotan::maps
