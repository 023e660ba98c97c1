#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "block.hpp"
#include "block_texels.hpp"
#include "image/etc.hpp"

namespace cotan::app {

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

// Weighted sum of squared errors, each texel at the nearest level.
float levelsError(const Levels& levels, const Values& values, const Values& weights)
{
    std::array<Four, 4> nearest;
    nearest.fill(kZero + std::numeric_limits<float>::max());
    for (std::size_t k = 0; k < 8; ++k) {
        const float code = levels.code(k);
        for (std::size_t i = 0; i < 4; ++i) {
            const Four off = values[i] - code;
            nearest[i] = minOf(nearest[i], off * off);
        }
    }
    Four sum{};
    for (std::size_t i = 0; i < 4; ++i)
        sum += weights[i] * nearest[i];
    return sumOf(sum);
}

// The levels of a table whose ends lie at the ends of the values.
Levels spanning(int table, float low, float high)
{
    const std::array<int, 8>& m = kEacModifiers[std::size_t(table)]; // m[3] is the lowest, m[7] the highest
    const int factor = std::clamp(int((high - low) / float(8 * (m[7] - m[3])) + 0.5f), 0, 15);
    const float step = factor > 0 ? float(8 * factor) : 1;
    const float middle = (low + high) / 2 - 4 - step * float(m[3] + m[7]) / 2;
    return {table, std::clamp(int(middle / 8 + 0.5f), 0, 255), factor};
}

// Changes base and factor while that reduces the error, in at most kRounds rounds.
void descendLevels(Levels& best, float& error, const Values& values, const Values& weights)
{
    constexpr int kRounds = 4;
    constexpr std::array<std::array<int, 2>, 8> kLevelMoves{
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
    bool moved = true;
    for (int round = 0; moved && round < kRounds; ++round) {
        moved = false;
        for (const auto& [base, factor] : kLevelMoves) {
            const Levels to{best.table, best.base + base, best.factor + factor};
            if (to.base < 0 || to.base > 255 || to.factor < 0 || to.factor > 15)
                continue;
            if (const float there = levelsError(to, values, weights); there < error) {
                best = to;
                error = there;
                moved = true;
            }
        }
    }
}

Levels fitLevels(const Values& values, const Values& weights)
{
    constexpr std::size_t kRefined = 4; // of the 16 tables
    const float low = minOf(values), high = maxOf(values);
    std::array<std::pair<float, Levels>, 16> starts;
    for (int table = 0; table < 16; ++table) {
        const Levels levels = spanning(table, low, high);
        starts[std::size_t(table)] = {levelsError(levels, values, weights), levels};
    }
    std::partial_sort(starts.begin(), starts.begin() + kRefined, starts.end(),
                      [](const auto& a, const auto& b) { return a.first < b.first; });
    std::pair<float, Levels> best = starts[0];
    for (std::size_t i = 0; i < kRefined; ++i) {
        descendLevels(starts[i].second, starts[i].first, values, weights);
        if (starts[i].first < best.first)
            best = starts[i];
    }
    return best.second;
}

using LevelIndices = std::array<int, 16>;

// The base, the factor and the table, then 3 bits for each texel, by columns.
void putLevels(const Levels& levels, const LevelIndices& indices, std::byte* to)
{
    std::uint64_t bits =
        std::uint64_t(levels.base) << 56 | std::uint64_t(levels.factor) << 52 | std::uint64_t(levels.table) << 48;
    for (std::size_t i = 0; i < 16; ++i)
        bits |= std::uint64_t(indices[i % 4 * 4 + i / 4]) << (45 - 3 * i);
    for (int i = 0; i < 8; ++i)
        to[i] = std::byte(bits >> (56 - 8 * i) & 0xff);
}

// The two levels nearest to a value.
std::array<int, 2> nearestLevels(const std::array<float, 8>& codes, float value)
{
    std::array<int, 2> found{0, 0};
    std::array<float, 2> off{std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    for (int k = 0; k < 8; ++k) {
        const float here = std::abs(codes[std::size_t(k)] - value);
        if (here < off[0]) {
            found = {k, found[0]};
            off = {here, off[0]};
        } else if (here < off[1]) {
            found[1] = k;
            off[1] = here;
        }
    }
    return found;
}

void encodePair(NormalTexels& t, std::byte* to)
{
    const Levels x = fitLevels(t.x, t.weightX), y = fitLevels(t.y, t.weightY);
    std::array<float, 8> codesX, codesY;
    for (std::size_t k = 0; k < 8; ++k) {
        codesX[k] = x.code(k);
        codesY[k] = y.code(k);
    }
    LevelIndices indicesX{}, indicesY{};
    for (std::size_t i = 0; i < 16; ++i) {
        float smallest = std::numeric_limits<float>::max();
        for (const int a : nearestLevels(codesX, at(t.x, i)))
            for (const int b : nearestLevels(codesY, at(t.y, i))) {
                const float dx = codesX[std::size_t(a)] - at(t.x, i), dy = codesY[std::size_t(b)] - at(t.y, i);
                const float along = at(t.u, i) * dx + at(t.v, i) * dy, there = dx * dx + dy * dy + along * along;
                if (there < smallest) {
                    smallest = there;
                    indicesX[i] = a;
                    indicesY[i] = b;
                }
            }
    }
    putLevels(x, indicesX, to);
    putLevels(y, indicesY, to + 8);
}

} // namespace

std::vector<std::byte> encodeEacRg11(const Image& map, const CodeScale& scale)
{
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        NormalTexels texels = normalTexels(map, left, top, scale, kHighestCode);
        encodePair(texels, to);
    });
}

std::vector<std::byte> encodeEacR11(const Image& image)
{
    return encodeBlocks(image, 8, [&](int left, int top, std::byte* to) {
        Values values, unused, ones;
        loadCodes(image, left, top, 0, kHighestCode, kHighestCode, values, unused);
        ones.fill(kZero + 1);
        const Levels levels = fitLevels(values, ones);
        std::array<float, 8> codes;
        for (std::size_t k = 0; k < 8; ++k)
            codes[k] = levels.code(k);
        LevelIndices indices{};
        for (std::size_t i = 0; i < 16; ++i)
            indices[i] = nearestLevels(codes, at(values, i))[0];
        putLevels(levels, indices, to);
    });
}

} // namespace cotan::app
