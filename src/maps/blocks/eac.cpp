#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "block.hpp"
#include "block_texels.hpp"
#include "image/etc.hpp"

namespace cotan::maps {

namespace {

constexpr float kHighestCode = 2047; // codes have 11 bits

// One channel of a block: codes 8 base + 4 + modifier * step, where step is 8 * factor, or 1 for factor 0.
struct Levels {
    int table, base, factor;
};

template<class V> [[gnu::always_inline]] inline V stepOf(V factor) { return maxOf(8 * factor, V{} + 1); }

// Vectors of two bytes a lane, as long as V, and half as long.
template<class V> struct LaneShorts {
    using Type __attribute__((vector_size(sizeof(V)))) = std::uint16_t;
    using Half __attribute__((vector_size(sizeof(V) / 2))) = std::uint16_t;
};

// Squared distances to the nearest level of each of the 16 tables, in 64ths of a squared step: a row for each sixteenth
// of a step between a value and the centre. The modifiers of a table are symmetric, m and -m - 1, so values on both
// sides of the centre share the rows. The sum of 16 distances has 16 bits.
constexpr std::size_t kParts = 16, kRows = 24 * kParts;
using SquaresRow = std::array<std::uint16_t, 16>;

constexpr std::array<SquaresRow, kRows> kSquares = [] {
    std::array<SquaresRow, kRows> rows{};
    for (std::size_t row = 0; row < kRows; ++row)
        for (std::size_t table = 0; table < 16; ++table) {
            float least = 4095.0f / 64;
            for (std::size_t i = 4; i < 8; ++i) {
                const float off = (float(row) + 0.5f) / kParts - float(kEacModifiers[table][i]) - 0.5f;
                least = std::min(least, off * off);
            }
            rows[row][table] = std::uint16_t(64 * least + 0.5f);
        }
    return rows;
}();

// Factors and bases that are tried with all tables, for values with a range up to `range`: factors above the least one
// worth a try, and bases from that in the middle, in units of half a step, but at least of 1. For each range those that
// together had the least errors on ten maps.
struct Starts {
    float range;
    std::size_t count;
    std::array<float, 16> factors, bases;
};

constexpr std::array<Starts, 12> kStarts{
    {{16, 4, {0, 0, 0, 1}, {-1, 0, 1, -1}},
     {32, 5, {0, 0, 0, 1, 1}, {-1, 0, 1, -1, 0}},
     {48, 5, {0, 0, 0, 1, 3}, {-1, 0, 1, 0, -3}},
     {80, 7, {0, 0, 0, 0, 0, 1, 1}, {-2, -1, 0, 1, 2, 0, 1}},
     {128, 12, {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1}, {-4, -3, -2, -1, 0, 1, 2, 3, 4, -1, 0, 1}},
     {190, 8, {0, 0, 0, 0, 0, 0, 0, 0}, {-4, -3, -2, -1, 0, 1, 2, 3}},
     {260, 9, {0, 0, 0, 1, 1, 1, 1, 1, 1}, {-1, 0, 1, -3, -2, -1, 0, 2, 3}},
     {352, 10, {1, 1, 1, 1, 1, 1, 1, 1, 1, 2}, {-4, -3, -2, -1, 0, 1, 2, 3, 4, -4}},
     {508, 12, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1}, {-2, -1, 0, 1, 2, -4, -3, -1, 0, 1, 3, 4}},
     {704, 12, {1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 3, 3}, {-1, 0, 1, -3, -2, -1, 0, 1, 2, 3, -2, 2}},
     {1016, 12, {1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 4, 4}, {-1, 0, 1, -1, 0, 1, 3, -1, 0, 1, 0, 1}},
     {kHighestCode, 12, {2, 3, 3, 3, 4, 4, 4, 5, 5, 5, 5, 5}, {0, 0, 1, 3, -1, 0, 1, -3, -1, 0, 1, 3}}}};

const Starts& startsFor(float range)
{
    std::size_t k = 0;
    for (std::size_t i = 0; i + 1 < kStarts.size(); ++i)
        k += range > kStarts[i].range;
    return kStarts[k];
}

// The largest modifiers reach 14.5 steps from the centre; few values that lie farther cost less than larger steps.
float leastFactor(float range) { return range <= 48 ? 0.0f : float(int(range / 352) + 1); }

using SixteenFloats = std::array<float, 16>;

template<class V> [[gnu::always_inline]] inline V loaded(const SixteenFloats& from, std::size_t first)
{
    V lanes;
    std::memcpy(&lanes, &from[first], sizeof lanes);
    return lanes;
}

template<class V> [[gnu::always_inline]] inline void store(SixteenFloats& to, std::size_t first, V lanes)
{
    std::memcpy(&to[first], &lanes, sizeof lanes);
}

// Starts for the values of a channel, the parts of a step that a code takes, and squared steps.
struct PlacedStarts {
    alignas(32) SixteenFloats factors, bases, centers, inverses, squares;

    template<class V> [[gnu::always_inline]] void place(const Starts& starts, float low, float high)
    {
        const float least = leastFactor(high - low);
        for (std::size_t first = 0; first < starts.count; first += sizeof(V) / sizeof(float)) {
            const V factor = minOf(loaded<V>(starts.factors, first) + least, V{} + 15), step = stepOf(factor);
            const V middle = ((low + high + step) * 0.5f - 4) * 0.125f;
            const V base = middle + loaded<V>(starts.bases, first) * maxOf(factor * 0.5f, V{} + 1);
            const V code = rounded(minOf(maxOf(base, V{}), V{} + 255));
            store(factors, first, factor);
            store(bases, first, code);
            store(centers, first, 8 * code + 4 - 0.5f * step);
            store(inverses, first, kParts / step);
            store(squares, first, step * step);
        }
    }
};

// The sums of a start's errors for all tables, in squared steps. rows: of the texels.
template<class V> [[gnu::always_inline]] inline auto errorsOf(const std::array<std::uint32_t, 16>& rows)
{
    using Shorts = typename LaneShorts<V>::Type;
    using HalfShorts = typename LaneShorts<V>::Half;
    std::array<Shorts, 16 * sizeof(std::uint16_t) / sizeof(V)> sums{};
    for (const std::uint32_t r : rows)
        for (std::size_t v = 0; v < sums.size(); ++v) {
            Shorts row;
            std::memcpy(&row, reinterpret_cast<const std::byte*>(&kSquares[r]) + v * sizeof row, sizeof row);
            sums[v] += row;
        }
    std::array<V, 2 * sums.size()> errors;
    for (std::size_t v = 0; v < errors.size(); ++v) {
        HalfShorts sum;
        std::memcpy(&sum, reinterpret_cast<const std::byte*>(sums.data()) + v * sizeof sum, sizeof sum);
        errors[v] = __builtin_convertvector(__builtin_convertvector(sum, typename LaneInts<V>::Type), V);
    }
    return errors;
}

template<class V> [[gnu::always_inline]] inline Levels fitLevels(const Values& values)
{
    using Ints = typename LaneInts<V>::Type;
    constexpr std::size_t kWidth = sizeof(V) / sizeof(float), kVectors = 16 / kWidth;
    const float low = minOf(values), high = maxOf(values);
    const Starts& starts = startsFor(high - low);
    PlacedStarts placed;
    placed.place<V>(starts, low, high);
    // Rows of kSquares. All are stored before they are used, since extracting them from vectors takes longer.
    alignas(32) std::array<std::array<std::uint32_t, 16>, 16> rows;
    for (std::size_t first = 0; first < 16; first += kWidth) {
        const V value = lanesOf<V>(values, first);
        for (std::size_t k = 0; k < starts.count; ++k) {
            const V off = (value - placed.centers[k]) * placed.inverses[k];
            const Ints row = __builtin_convertvector(minOf(maxOf(off, -off), V{} + (kRows - 1)), Ints);
            std::memcpy(&rows[k][first], &row, sizeof row);
        }
    }
    // The least error of each table so far. As an integer, a positive float has the same order; its lowest bits are
    // replaced by the numbers of the table and of the start.
    std::array<Ints, kVectors> best;
    best.fill(Ints{} + 0x7fffffff);
    for (std::size_t k = 0; k < starts.count; ++k) {
        const auto errors = errorsOf<V>(rows[k]);
        for (std::size_t v = 0; v < kVectors; ++v) {
            const V error = errors[v] * placed.squares[k];
            Ints key, table;
            std::memcpy(&key, &error, sizeof key);
            for (std::size_t t = 0; t < kWidth; ++t)
                table[t] = int(kWidth * v + t);
            best[v] = minOf(best[v], (key & ~255) | (table + int(16 * k)));
        }
    }
    int found = best[0][0];
    for (std::size_t t = 1; t < 16; ++t)
        found = std::min(found, int(best[t / kWidth][t % kWidth]));
    const std::size_t start = std::size_t(found >> 4 & 15);
    return {found & 15, int(placed.bases[start]), int(placed.factors[start])};
}

// The base, the factor and the table, then 3 bits for each texel, by columns.
[[gnu::always_inline]] inline void putLevels(const Levels& levels, const Values& indices, std::byte* to)
{
    const Four columns = ((indices[0] * 8 + indices[1]) * 8 + indices[2]) * 8 + indices[3];
    std::uint64_t bits =
        std::uint64_t(levels.base) << 56 | std::uint64_t(levels.factor) << 52 | std::uint64_t(levels.table) << 48;
    for (std::size_t column = 0; column < 4; ++column)
        bits |= std::uint64_t(columns[column]) << (36 - 12 * column);
    for (int i = 0; i < 8; ++i)
        to[i] = std::byte(bits >> (56 - 8 * i) & 0xff);
}

// The levels below and above values: how far they are off, and the number of the lower one in ascending order.
template<class V> struct LevelsAround {
    V below, above, number;

    [[gnu::always_inline]] LevelsAround(const Levels& levels, V value)
    {
        const float step = stepOf(float(levels.factor));
        std::array<float, 8> codes;
        for (std::size_t k = 0; k < 8; ++k) {
            const int modifier = kEacModifiers[std::size_t(levels.table)][k < 4 ? 3 - k : k];
            codes[k] = std::clamp(float(8 * levels.base + 4) + float(modifier) * step, 0.0f, kHighestCode);
        }
        number = V{};
        below = number + codes[0];
        above = number + codes[1];
        for (std::size_t k = 1; k < 7; ++k) {
            below = value > codes[k] ? V{} + codes[k] : below;
            above = value > codes[k] ? V{} + codes[k + 1] : above;
            number = value > codes[k] ? V{} + float(k) : number;
        }
        below -= value;
        above -= value;
    }

    // The index of the lower level, or of the upper one where up is 1.
    [[gnu::always_inline]] V index(V up) const
    {
        const V at = number + up;
        return at < 4.0f ? 3 - at : at;
    }
};

} // namespace

std::vector<std::byte> encodeEacRg11(const Image& map, const CodeScale& scale)
{
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        // Chooses for each texel, of the pairs of levels around x and y, the one with the smallest angle.
        runLanes([&]<class V>() __attribute__((always_inline)) {
            const NormalTexels t = normalTexels<V>(map, left, top, scale, kHighestCode);
            const Levels x = fitLevels<V>(t.x), y = fitLevels<V>(t.y);
            Values indicesX, indicesY;
            for (std::size_t first = 0; first < 16; first += sizeof(V) / sizeof(float)) {
                const LevelsAround<V> ofX(x, lanesOf<V>(t.x, first)), ofY(y, lanesOf<V>(t.y, first));
                const V u = lanesOf<V>(t.u, first), v = lanesOf<V>(t.v, first), zero{}, one = zero + 1;
                const auto error = [&](V ex, V ey) __attribute__((always_inline))
                {
                    const V along = u * ex + v * ey;
                    return ex * ex + ey * ey + along * along;
                };
                const V e00 = error(ofX.below, ofY.below), e01 = error(ofX.below, ofY.above);
                const V e10 = error(ofX.above, ofY.below), e11 = error(ofX.above, ofY.above);
                const V least0 = minOf(e01, e00), least1 = minOf(e11, e10);
                const V up0 = e01 < e00 ? one : zero, up1 = e11 < e10 ? one : zero;
                storeLanes(indicesX, first, ofX.index(least1 < least0 ? one : zero));
                storeLanes(indicesY, first, ofY.index(least1 < least0 ? up1 : up0));
            }
            putLevels(x, indicesX, to);
            putLevels(y, indicesY, to + 8);
        });
    });
}

std::vector<std::byte> encodeEacR11(const Image& image)
{
    return encodeBlocks(image, 8, [&](int left, int top, std::byte* to) {
        runLanes([&]<class V>() __attribute__((always_inline)) {
            Values red, green, indices;
            loadCodes<V>(image, left, top, 0, kHighestCode, kHighestCode, red, green);
            const Levels levels = fitLevels<V>(red);
            for (std::size_t first = 0; first < 16; first += sizeof(V) / sizeof(float)) {
                const LevelsAround<V> around(levels, lanesOf<V>(red, first));
                storeLanes(indices, first, around.index(around.above < -around.below ? V{} + 1 : V{}));
            }
            putLevels(levels, indices, to);
        });
    });
}

} // namespace cotan::maps
