#include "block.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "block_texels.hpp"

namespace cotan::maps {

namespace {

// One channel of a block: two ends, the first the larger, and at which seventh between them each texel lies, from 0 at
// the second end.
struct Ends {
    int high = 1, low = 0;
};

constexpr Four kAll{7, 7, 7, 7};

Four placeOf(Four value, float low, float inverseStep)
{
    return rounded(least(most((value - low) * inverseStep, kNone), kAll));
}

// The sum of squares, weighted.
float errorOf(const Ends& ends, const Values& values, const Values& weights)
{
    const float low = float(ends.low), step = float(ends.high - ends.low) / 7, inverse = 1 / step;
    Four sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Four off = values[i] - low - placeOf(values[i], low, inverse) * step;
        sum += weights[i] * off * off;
    }
    return sumOf(sum);
}

bool valid(const Ends& ends) { return ends.low >= 0 && ends.high <= 255 && ends.high > ends.low; }

// Ends that are one apart: the two codes around a value.
Ends aroundOne(float value)
{
    const int low = std::clamp(int(value), 0, 254);
    return {low + 1, low};
}

int codeOf(float value) { return int(std::min(std::max(value, 0.0f), 255.0f) + 0.5f); }

// The ends that fit best with every texel at its nearest place.
Ends leastSquares(const Ends& from, const Values& values, const Values& weights)
{
    const float low = float(from.low), inverse = 7 / float(from.high - from.low);
    Four aa4{}, ab4{}, bb4{}, av4{}, bv4{}; // of low and high
    for (std::size_t i = 0; i < 4; ++i) {
        const Four place = placeOf(values[i], low, inverse) * (1.0f / 7), rest = 1 - place;
        const Four a = weights[i] * rest, b = weights[i] * place;
        aa4 += a * rest;
        ab4 += a * place;
        bb4 += b * place;
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

// Moves ends by one as long as that helps, a few times at most.
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
    const float low = least(values), high = most(values);
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

using Places = std::array<int, 16>;

// A block of BC4: the ends, then for each texel 3 bits: 0 the first end, 1 the second, 2 to 7 from the first to it.
void put(const Ends& ends, const Places& places, std::byte* to)
{
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        const int place = 7 - places[i];
        const std::uint64_t code = place == 0 ? 0u : place == 7 ? 1u : std::uint64_t(place + 1);
        bits |= code << 3 * i;
    }
    to[0] = std::byte(ends.high);
    to[1] = std::byte(ends.low);
    for (int i = 0; i < 6; ++i)
        to[2 + i] = std::byte(bits >> 8 * i & 0xff);
}

// What a small step of a unit vector's x and y turns it by: the square of the angle is dx^2 + dy^2 + (u dx + v dy)^2,
// with u = x / z and v = y / z. Codes, and squares of angles in codes.
struct Texels {
    Values x, y, u, v, weightX, weightY;
};

// Of vectors that lie flat the angle grows with the root of the step; this is where that begins.
constexpr float kMinZ = 0.08f;

// Codes of a block's red and green: what a component of 0 is, and how many more one of 1.
void takeCodes(const Image& map, int left, int top, float none, float one, Values& x, Values& y)
{
    for (int i = 0; i < 16; ++i) {
        const float* const texel = texelAt(map, left, top, i);
        at(x, std::size_t(i)) = none + texel[0] * one;
        at(y, std::size_t(i)) = none + texel[1] * one;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        x[i] = least(most(x[i], kNone), kNone + 255);
        y[i] = least(most(y[i], kNone), kNone + 255);
    }
}

Texels texelsOf(const Image& map, int left, int top, const CodeScale& scale)
{
    Texels t{};
    takeCodes(map, left, top, scale.zero - scale.unit, 2 * scale.unit, t.x, t.y);
    const float inverse = 1 / scale.unit;
    for (std::size_t i = 0; i < 4; ++i) {
        const Four nx = (t.x[i] - scale.zero) * inverse, ny = (t.y[i] - scale.zero) * inverse;
        const Four square = most(1 - nx * nx - ny * ny, kNone + kMinZ * kMinZ);
        const Four z = rootOf(square);
        t.u[i] = nx / z;
        t.v[i] = ny / z;
        t.weightX[i] = 1 + t.u[i] * t.u[i];
        t.weightY[i] = 1 + t.v[i] * t.v[i];
    }
    return t;
}

// Of the four pairs of places around each texel that with the smallest angle. Returns the sum of their squares.
float pairUp(const Texels& t, const Ends& x, const Ends& y, Places& placesX, Places& placesY)
{
    const float stepX = float(x.high - x.low) / 7, stepY = float(y.high - y.low) / 7;
    const float inverseX = 1 / stepX, inverseY = 1 / stepY;
    Four sum{};
    const auto below = [](Four value, float low, float inverse) {
        return __builtin_convertvector(least(most((value - low) * inverse, kNone), kNone + 6), FourInts);
    };
    for (std::size_t i = 0; i < 4; ++i) {
        const FourInts px = below(t.x[i], float(x.low), inverseX), py = below(t.y[i], float(y.low), inverseY);
        const Four dx = float(x.low) + __builtin_convertvector(px, Four) * stepX - t.x[i];
        const Four dy = float(y.low) + __builtin_convertvector(py, Four) * stepY - t.y[i];
        Four smallest = kNone + 1e30f;
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
        std::memcpy(placesX.data() + 4 * i, &atX, sizeof atX);
        std::memcpy(placesY.data() + 4 * i, &atY, sizeof atY);
    }
    return sumOf(sum);
}

// Whether the error of x counts for y: from tilts of some 30 degrees.
bool steep(const Texels& t)
{
    constexpr float kFrom = 0.3f;
    Four square{};
    for (std::size_t i = 0; i < 4; ++i)
        square = most(square, t.u[i] * t.u[i] + t.v[i] * t.v[i]);
    return most(square) > kFrom;
}

// Moves each end of both channels by one where that makes the angles smaller.
void settleTogether(const Texels& t, Ends& x, Ends& y, Places& placesX, Places& placesY)
{
    float error = pairUp(t, x, y, placesX, placesY);
    for (Ends* const ends : {&x, &y})
        for (const Ends& by : kMoves) {
            const Ends before = *ends;
            *ends = {before.high + by.high, before.low + by.low};
            Places tryX, tryY;
            const float there = valid(*ends) ? pairUp(t, x, y, tryX, tryY) : error;
            if (there < error) {
                error = there;
                placesX = tryX;
                placesY = tryY;
            } else {
                *ends = before;
            }
        }
}

void encodeNormals(const Texels& t, std::byte* to)
{
    Ends x = fit(t.x, t.weightX), y = fit(t.y, t.weightY);
    Places placesX{}, placesY{};
    if (steep(t))
        settleTogether(t, x, y, placesX, placesY);
    else
        pairUp(t, x, y, placesX, placesY);
    put(x, placesX, to);
    put(y, placesY, to + 8);
}

} // namespace

std::vector<std::byte> encodeBc5(const Image& map, const CodeScale& scale)
{
    return encodeBlocks(map, 16,
                        [&](int left, int top, std::byte* to) { encodeNormals(texelsOf(map, left, top, scale), to); });
}

std::vector<std::byte> encodeBc4(const Image& picture)
{
    return encodeBlocks(picture, 8, [&](int left, int top, std::byte* to) {
        Values values, unused;
        takeCodes(picture, left, top, 0, 255, values, unused);
        Values ones;
        ones.fill(kNone + 1);
        const Ends ends = fit(values, ones);
        Places places{};
        for (std::size_t i = 0; i < 16; ++i)
            places[i] = int(placeOf(kNone + at(values, i), float(ends.low), 7 / float(ends.high - ends.low))[0]);
        put(ends, places, to);
    });
}

} // namespace cotan::maps
