#include "block.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "block_texels.hpp"

namespace cotan::app {

namespace {

// One channel of a block: two ends, the first of which is larger. A texel's position between them is 0 (at `low`) to 7.
struct Ends {
    int high = 1, low = 0;
};

constexpr Four kAll{7, 7, 7, 7};

Four positionOf(Four value, float low, float inverseStep)
{
    return rounded(minOf(maxOf((value - low) * inverseStep, kZero), kAll));
}

// Weighted sum of squared errors.
float errorOf(const Ends& ends, const Values& values, const Values& weights)
{
    const float low = float(ends.low), step = float(ends.high - ends.low) / 7, inverse = 1 / step;
    Four sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Four off = values[i] - low - positionOf(values[i], low, inverse) * step;
        sum += weights[i] * off * off;
    }
    return sumOf(sum);
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

constexpr std::array<Ends, 6> kMoves{{{-1, 1}, {0, 1}, {-1, 0}, {1, 0}, {0, -1}, {1, -1}}};

// Changes the ends by one while that reduces the error, in at most kRounds rounds.
void descend(Ends& best, float& error, const Values& values, const Values& weights)
{
    constexpr int kRounds = 3;
    for (int round = 0, moved = 1; moved != 0 && round < kRounds; ++round) {
        moved = 0;
        for (const Ends& by : kMoves) {
            const Ends to{best.high + by.high, best.low + by.low};
            if (!valid(to))
                continue;
            if (const float there = errorOf(to, values, weights); there < error) {
                best = to;
                error = there;
                moved = 1;
            }
        }
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
    float error = errorOf(best, values, weights);
    descend(best, error, values, weights);
    return best;
}

using Positions = std::array<int, 16>;

// Writes a BC4 block: the ends, then a 3-bit index per texel: 0 is the first end, 1 the second, 2 to 7 between them.
void put(const Ends& ends, const Positions& positions, std::byte* to)
{
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        const int position = 7 - positions[i];
        const std::uint64_t code = position == 0 ? 0u : position == 7 ? 1u : std::uint64_t(position + 1);
        bits |= code << 3 * i;
    }
    to[0] = std::byte(ends.high);
    to[1] = std::byte(ends.low);
    for (int i = 0; i < 6; ++i)
        to[2 + i] = std::byte(bits >> 8 * i & 0xff);
}

// Chooses for each texel, of the four pairs of positions around it, the one with the smallest angle. Returns the sum of
// squared angles.
float choosePositions(const NormalTexels& t, const Ends& x, const Ends& y, Positions& positionsX, Positions& positionsY)
{
    const float stepX = float(x.high - x.low) / 7, stepY = float(y.high - y.low) / 7;
    const float inverseX = 1 / stepX, inverseY = 1 / stepY;
    Four sum{};
    const auto below = [](Four value, float low, float inverse) {
        return __builtin_convertvector(minOf(maxOf((value - low) * inverse, kZero), kZero + 6), FourInts);
    };
    for (std::size_t i = 0; i < 4; ++i) {
        const FourInts px = below(t.x[i], float(x.low), inverseX), py = below(t.y[i], float(y.low), inverseY);
        const Four dx = float(x.low) + __builtin_convertvector(px, Four) * stepX - t.x[i];
        const Four dy = float(y.low) + __builtin_convertvector(py, Four) * stepY - t.y[i];
        Four smallest = kZero + 1e30f;
        FourInts rightX{}, rightY{};
        for (int k = 0; k < 4; ++k) {
            const Four ex = dx + (k & 1 ? stepX : 0), ey = dy + (k & 2 ? stepY : 0);
            const Four along = t.u[i] * ex + t.v[i] * ey, there = ex * ex + ey * ey + along * along;
            const FourInts better = there < smallest;
            smallest = better ? there : smallest;
            rightX = better ? FourInts{} + (k & 1) : rightX;
            rightY = better ? FourInts{} + (k >> 1) : rightY;
        }
        sum += smallest;
        const FourInts atX = px + rightX, atY = py + rightY;
        std::memcpy(positionsX.data() + 4 * i, &atX, sizeof atX);
        std::memcpy(positionsY.data() + 4 * i, &atY, sizeof atY);
    }
    return sumOf(sum);
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

// Changes each end of both channels by one if that reduces the angles.
void refineTogether(const NormalTexels& t, Ends& x, Ends& y, Positions& positionsX, Positions& positionsY)
{
    float error = choosePositions(t, x, y, positionsX, positionsY);
    for (Ends* const ends : {&x, &y})
        for (const Ends& by : kMoves) {
            const Ends before = *ends;
            *ends = {before.high + by.high, before.low + by.low};
            Positions tryX, tryY;
            const float there = valid(*ends) ? choosePositions(t, x, y, tryX, tryY) : error;
            if (there < error) {
                error = there;
                positionsX = tryX;
                positionsY = tryY;
            } else {
                *ends = before;
            }
        }
}

void encodeNormals(const NormalTexels& t, std::byte* to)
{
    Ends x = fit(t.x, t.weightX), y = fit(t.y, t.weightY);
    Positions positionsX{}, positionsY{};
    if (steep(t))
        refineTogether(t, x, y, positionsX, positionsY);
    else
        choosePositions(t, x, y, positionsX, positionsY);
    put(x, positionsX, to);
    put(y, positionsY, to + 8);
}

} // namespace

void encodeAlpha(Values& values, const Values& weights, std::byte* to)
{
    const Ends ends = fit(values, weights);
    Positions positions{};
    for (std::size_t i = 0; i < 16; ++i)
        positions[i] = int(positionOf(kZero + at(values, i), float(ends.low), 7 / float(ends.high - ends.low))[0]);
    put(ends, positions, to);
}

std::vector<std::byte> encodeBc5(const Image& map, const CodeScale& scale)
{
    return encodeBlocks(
        map, 16, [&](int left, int top, std::byte* to) { encodeNormals(normalTexels(map, left, top, scale), to); });
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

} // namespace cotan::app
