#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "block.hpp"
#include "block_texels.hpp"
#include "image/etc.hpp"

namespace cotan::maps {

namespace {

constexpr float kHighestCode = 2047; // codes have 11 bits

// One channel of a block: codes 8 base + 4 + modifier * step, where step is 8 * factor, or 1 for factor 0.
struct Levels {
    int table = 0, base = 0, factor = 1;

    float code(std::size_t i) const
    {
        const int step = factor > 0 ? 8 * factor : 1;
        return std::clamp(float(8 * base + 4 + kEacModifiers[std::size_t(table)][i] * step), 0.0f, kHighestCode);
    }
};

// The modifiers of a table are symmetric: m and -m - 1. So a texel's distance from the centre, in steps, is compared
// with four of them: the larger ones plus a half. Of eight tables, or eight times of one.
using Modifiers = std::array<CandidateValues, 4>;

struct ModifierTables {
    std::array<Modifiers, 2> all{};  // tables 0 to 7, 8 to 15
    std::array<Modifiers, 16> one{}; // eight times
};

constexpr ModifierTables kModifierTables = [] {
    ModifierTables tables;
    for (std::size_t t = 0; t < 16; ++t)
        for (std::size_t i = 0; i < 4; ++i) {
            tables.all[t / 8][i][t % 8] = float(kEacModifiers[t][i + 4]) + 0.5f;
            tables.one[t][i].fill(float(kEacModifiers[t][i + 4]) + 0.5f);
        }
    return tables;
}();

// Eight candidates.
struct LevelsList {
    CandidateValues base, factor;
    const Modifiers& modifiers;

    // The levels of the tables whose ends lie at the ends of the values.
    static LevelsList spanning(const Modifiers& tables, float low, float high)
    {
        LevelsList list{{}, {}, tables};
        for (std::size_t k = 0; k < kCandidates; ++k) {
            const float range = 16 * tables[3][k];
            list.factor[k] = std::min(float(int((high - low) / range + 0.5f)), 15.0f);
            list.base[k] = std::clamp(((low + high + stepOf(list.factor[k])) / 2 - 4) / 8 + 0.5f, 0.0f, 255.0f);
            list.base[k] = float(int(list.base[k]));
        }
        return list;
    }
    static float stepOf(float factor) { return factor > 0 ? 8 * factor : 1; }
};

// Weighted sums of squared errors, each texel at the nearest level. Levels outside of the codes count as if they were
// inside, which matters only there.
struct LevelsErrors {
    const LevelsList& list;
    const Values& values;
    const Values& weights;
    CandidateValues& errors;

    template<class V> [[gnu::always_inline]] void run() const
    {
        for (std::size_t first = 0; first < kCandidates; first += sizeof(V) / sizeof(float)) {
            V base, factor, sum{};
            std::array<V, 4> level;
            loadLanes(base, list.base, first);
            loadLanes(factor, list.factor, first);
            for (std::size_t k = 0; k < 4; ++k)
                loadLanes(level[k], list.modifiers[k], first);
            const V step = factor > 0.0f ? 8 * factor : V{} + 1, inverse = 1 / step,
                    center = 8 * base + 4 - step * 0.5f;
            for (std::size_t i = 0; i < 16; ++i) {
                const V from = (values[i / 4][i % 4] - center) * inverse, distance = from > -from ? from : -from;
                const V a = distance - level[0], b = distance - level[1], c = distance - level[2],
                        d = distance - level[3];
                const V aa = a * a, bb = b * b, cc = c * c, dd = d * d;
                const V ab = aa < bb ? aa : bb, cd = cc < dd ? cc : dd;
                sum += weights[i / 4][i % 4] * (ab < cd ? ab : cd);
            }
            sum *= step * step;
            std::memcpy(errors.data() + first, &sum, sizeof sum);
        }
    }
};

// The levels of a table around given ones that have a smaller error, in at most kRounds rounds.
void descendLevels(Levels& best, float& error, const Values& values, const Values& weights)
{
    constexpr int kRounds = 4;
    constexpr CandidateValues kBaseMoves{1, -1, 0, 0, 1, -1, 1, -1}, kFactorMoves{0, 0, 1, -1, 1, -1, -1, 1};
    for (int round = 0; round < kRounds; ++round) {
        LevelsList list{{}, {}, kModifierTables.one[std::size_t(best.table)]};
        for (std::size_t k = 0; k < kCandidates; ++k) {
            list.base[k] = std::clamp(float(best.base) + kBaseMoves[k], 0.0f, 255.0f);
            list.factor[k] = std::clamp(float(best.factor) + kFactorMoves[k], 0.0f, 15.0f);
        }
        CandidateValues errors;
        runLanes(LevelsErrors{list, values, weights, errors});
        const std::size_t least = leastOf(errors);
        if (!(errors[least] < error))
            return;
        best = {best.table, int(list.base[least]), int(list.factor[least])};
        error = errors[least];
    }
}

Levels fitLevels(const Values& values, const Values& weights)
{
    constexpr int kRefined = 4; // of the 16 tables
    constexpr float kTaken = std::numeric_limits<float>::max();
    const float low = minOf(values), high = maxOf(values);
    std::array<CandidateValues, 2> errors;
    std::array<LevelsList, 2> starts{LevelsList::spanning(kModifierTables.all[0], low, high),
                                     LevelsList::spanning(kModifierTables.all[1], low, high)};
    for (std::size_t half = 0; half < 2; ++half)
        runLanes(LevelsErrors{starts[half], values, weights, errors[half]});
    Levels best;
    float error = kTaken;
    for (int i = 0; i < kRefined; ++i) {
        const std::size_t first = leastOf(errors[0]), second = leastOf(errors[1]);
        const std::size_t half = errors[1][second] < errors[0][first] ? 1 : 0, k = half == 0 ? first : second;
        Levels here{int(8 * half + k), int(starts[half].base[k]), int(starts[half].factor[k])};
        float there = std::exchange(errors[half][k], kTaken);
        descendLevels(here, there, values, weights);
        if (there < error) {
            best = here;
            error = there;
        }
    }
    return best;
}

// The base, the factor and the table, then 3 bits for each texel, by columns.
void putLevels(const Levels& levels, const Values& indices, std::byte* to)
{
    std::uint64_t bits =
        std::uint64_t(levels.base) << 56 | std::uint64_t(levels.factor) << 52 | std::uint64_t(levels.table) << 48;
    for (std::size_t column = 0; column < 4; ++column) {
        float four = 0;
        for (std::size_t row = 0; row < 4; ++row)
            four = four * 8 + indices[row][int(column)];
        bits |= std::uint64_t(four) << (36 - 12 * column);
    }
    for (int i = 0; i < 8; ++i)
        to[i] = std::byte(bits >> (56 - 8 * i) & 0xff);
}

// The two levels nearest to values: their indices, and how far they are off.
template<class V> struct NearestLevels {
    V index, secondIndex, off, secondOff;

    [[gnu::always_inline]] NearestLevels(const Levels& levels, V value)
    {
        const V zero{};
        off = secondOff = zero + std::numeric_limits<float>::max();
        index = secondIndex = zero;
        V square = zero + std::numeric_limits<float>::max(), secondSquare = square;
        for (std::size_t k = 0; k < 8; ++k) {
            const V here = zero + levels.code(k) - value, hereSquare = here * here, hereIndex = zero + float(k);
            const V pushed = hereSquare < square ? square : hereSquare;
            const V pushedOff = hereSquare < square ? off : here, pushedIndex = hereSquare < square ? index : hereIndex;
            off = hereSquare < square ? here : off;
            index = hereSquare < square ? hereIndex : index;
            square = hereSquare < square ? hereSquare : square;
            secondOff = pushed < secondSquare ? pushedOff : secondOff;
            secondIndex = pushed < secondSquare ? pushedIndex : secondIndex;
            secondSquare = pushed < secondSquare ? pushed : secondSquare;
        }
    }
};

// Chooses for each texel, of the pairs of the two nearest levels, the one with the smallest angle.
struct ChooseLevels {
    const NormalTexels& t;
    const Levels &x, &y;
    Values &indicesX, &indicesY;

    template<class V> [[gnu::always_inline]] void run() const
    {
        for (std::size_t first = 0; first < 16; first += sizeof(V) / sizeof(float)) {
            const NearestLevels<V> ofX(x, lanesOf<V>(t.x, first)), ofY(y, lanesOf<V>(t.y, first));
            const V u = lanesOf<V>(t.u, first), v = lanesOf<V>(t.v, first);
            V smallest = V{} + std::numeric_limits<float>::max(), indexX{}, indexY{};
            for (int k = 0; k < 4; ++k) {
                const V dx = k & 1 ? ofX.secondOff : ofX.off, dy = k & 2 ? ofY.secondOff : ofY.off;
                const V along = u * dx + v * dy, there = dx * dx + dy * dy + along * along;
                indexX = there < smallest ? (k & 1 ? ofX.secondIndex : ofX.index) : indexX;
                indexY = there < smallest ? (k & 2 ? ofY.secondIndex : ofY.index) : indexY;
                smallest = there < smallest ? there : smallest;
            }
            storeLanes(indicesX, first, indexX);
            storeLanes(indicesY, first, indexY);
        }
    }
};

void encodePair(const NormalTexels& t, std::byte* to)
{
    const Levels x = fitLevels(t.x, t.weightX), y = fitLevels(t.y, t.weightY);
    Values indicesX{}, indicesY{};
    runLanes(ChooseLevels{t, x, y, indicesX, indicesY});
    putLevels(x, indicesX, to);
    putLevels(y, indicesY, to + 8);
}

} // namespace

std::vector<std::byte> encodeEacRg11(const Image& map, const CodeScale& scale)
{
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        encodePair(normalTexels(map, left, top, scale, kHighestCode), to);
    });
}

std::vector<std::byte> encodeEacR11(const Image& image)
{
    return encodeBlocks(image, 8, [&](int left, int top, std::byte* to) {
        Values values, unused, ones;
        loadCodes(image, left, top, 0, kHighestCode, kHighestCode, values, unused);
        ones.fill(kZero + 1);
        const Levels levels = fitLevels(values, ones);
        Values indices;
        for (std::size_t i = 0; i < 4; ++i)
            indices[i] = NearestLevels<Four>(levels, values[i]).index;
        putLevels(levels, indices, to);
    });
}

} // namespace cotan::maps
