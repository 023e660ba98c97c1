// UASTC encoder for normal maps of three channels: the files of Basis Universal that every device turns into a format
// of its own. Source: R. Geldreich, in Khronos Data Format Specification 1.4, chapter 25. Of its 19 modes those serve
// that hold opaque colours: one line of values (0, 18, 5), one for two channels and one for the third (6), and two
// lines in two parts of the block (2, 4).
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "block.hpp"
#include "block_texels.hpp"
#include "image/etc.hpp"
#include "image/uastc_modes.hpp"
#include "uastc_fit.hpp"

namespace cotan::maps {

namespace uastc {

namespace {

// How a transcoder to ETC1 cuts the block and which table of modifiers each half has. Those with the least error for
// the mean colour of a half, whose brightness the modifiers change.
struct Etc1Hint {
    int flip = 0, tables[2] = {};
};

Etc1Hint etc1Hint(const Texels& t)
{
    static const auto modifiers = [] { // of four tables, the small ones and the large ones
        std::array<std::array<Four, 2>, 2> all{};
        for (std::size_t table = 0; table < 8; ++table)
            for (std::size_t size = 0; size < 2; ++size)
                all[table / 4][size][table % 4] = float(kEtcModifiers[table][size]);
        return all;
    }();
    Etc1Hint best;
    float least = 1e30f;
    for (int flip = 0; flip < 2; ++flip) {
        Etc1Hint hint{flip, {}};
        float error = 0;
        for (int half = 0; half < 2; ++half) {
            const auto inside = [&](std::size_t i) { return int((flip != 0 ? i / 4 : i % 4) / 2) == half; };
            glm::vec3 mean(0);
            for (std::size_t i = 0; i < 16; ++i)
                mean += inside(i) ? t.codes[i] / 8.0f : glm::vec3(0);
            std::array<Four, 2> errors{}; // a lane for each table
            for (std::size_t i = 0; i < 16; ++i)
                for (std::size_t k = 0; inside(i) && k < 2; ++k) {
                    Four nearest = kZero + 1e30f;
                    for (const Four& modifier : modifiers[k])
                        for (const float sign : {-1.0f, 1.0f}) {
                            std::array<Four, 3> off;
                            for (int c = 0; c < 3; ++c)
                                off[std::size_t(c)] = mean[c] + sign * modifier - t.codes[i][c];
                            nearest = minOf(off[0] * off[0] + off[1] * off[1] + off[2] * off[2], nearest);
                        }
                    errors[k] += nearest;
                }
            float leastHere = 1e30f;
            for (std::size_t table = 0; table < 8; ++table)
                if (errors[table / 4][table % 4] < leastHere) {
                    leastHere = errors[table / 4][table % 4];
                    hint.tables[half] = int(table);
                }
            error += leastHere;
        }
        if (error < least) {
            least = error;
            best = hint;
        }
    }
    return best;
}

// One colour: the code, red to alpha, then the same for ETC1: differential, table, selector, and its base of 5 bits.
void putSolid(const glm::ivec3& color, std::byte* to)
{
    BlockBits bits(to);
    bits.put(kUastcModes[kSolidUastc].code, kUastcModes[kSolidUastc].codeBits);
    for (int c = 0; c < 3; ++c)
        bits.put(color[c], 8);
    bits.put(255, 8);
    bits.put(1, 1);
    int bestTable = 0, bestSelector = 0, least = 1 << 30;
    glm::ivec3 best(0);
    for (int table = 0; table < 8; ++table)
        for (int selector = 0; selector < 4; ++selector) { // from the darkest to the brightest
            const auto& [small, large] = kEtcModifiers[std::size_t(table)];
            const int modifier = std::array{-large, -small, small, large}[std::size_t(selector)];
            glm::ivec3 base(0);
            int error = 0;
            for (int c = 0; c < 3; ++c) {
                base[c] = std::clamp(((color[c] - modifier) * 31 + 127) / 255, 0, 31);
                const int off = std::clamp((base[c] << 3 | base[c] >> 2) + modifier, 0, 255) - color[c];
                error += off * off;
            }
            if (error < least) {
                least = error;
                bestTable = table;
                bestSelector = selector;
                best = base;
            }
        }
    bits.put(bestTable, 3);
    bits.put(bestSelector, 2);
    for (int c = 0; c < 3; ++c)
        bits.put(best[c], 5);
}

void putEnds(BlockBits& bits, const Block& b, std::size_t subsets)
{
    const UastcMode& mode = kUastcModes[b.mode];
    std::vector<EndpointValue> values;
    for (std::size_t s = 0; s < subsets; ++s)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t e = 0; e < 2; ++e)
                values.push_back(endpointTable(b.mode).values[std::size_t(b.ends[s][e][c])]);
    const auto group = std::size_t(uastcDigitsOfGroup(mode.levels));
    for (std::size_t first = 0; mode.levels > 1 && first < values.size(); first += group) {
        const std::size_t count = std::min(group, values.size() - first);
        int packed = 0;
        for (std::size_t i = first + count; i-- > first;)
            packed = packed * mode.levels + values[i].digit;
        bits.put(packed, uastcBitsOfGroup(mode.levels, int(count)));
    }
    for (const EndpointValue& value : values)
        bits.put(value.low, mode.endpointBits);
}

// The highest bit of the weight of a subset's first texel is not stored: where it is 1, the ends are exchanged.
void settleAnchors(Block& b)
{
    const int most = (1 << kUastcModes[b.mode].weightBits) - 1;
    for (std::size_t s = 0; s < (b.subsets() != 0 ? 2u : 1u); ++s)
        for (std::size_t plane = 0; plane < (b.own < 0 ? 1u : 2u); ++plane) {
            std::size_t anchor = 0;
            while ((b.subsets() >> anchor & 1) != s)
                ++anchor;
            if (b.weights[plane][anchor] <= most / 2)
                continue;
            for (std::size_t i = 0; i < 16; ++i)
                if ((b.subsets() >> i & 1) == s)
                    b.weights[plane][i] = most - b.weights[plane][i];
            for (int c = 0; c < 3; ++c)
                if ((c == b.own) == (plane == 1))
                    std::swap(b.ends[s][0][std::size_t(c)], b.ends[s][1][std::size_t(c)]);
        }
}

void put(Block b, const Etc1Hint& hint, std::byte* to)
{
    const UastcMode& mode = kUastcModes[b.mode];
    settleAnchors(b);
    BlockBits bits(to);
    bits.put(mode.code, mode.codeBits);
    bits.put(0, 2); // no hints for BC1
    bits.put(hint.flip, 1);
    bits.put(0, 1); // halves with bases of their own: each 4 bits a channel
    bits.put(hint.tables[0], 3);
    bits.put(hint.tables[1], 3);
    bits.put(0, 5); // no bias
    const bool two = b.subsets() != 0;
    if (two)
        bits.put(int(b.pattern), 5);
    if (b.own >= 0)
        bits.put(b.own, 2);
    putEnds(bits, b, two ? 2 : 1);
    std::uint32_t met = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        const std::uint32_t subset = 1u << (b.subsets() >> i & 1);
        const int stored = mode.weightBits - ((met & subset) == 0 ? 1 : 0);
        met |= subset;
        bits.put(b.weights[0][i], stored);
        if (b.own >= 0)
            bits.put(b.weights[1][i], stored);
    }
}

void encodeBlock(const Image& map, int left, int top, const CodeScale& scale, bool lengths, std::byte* to)
{
    const Texels t = texelsOf(map, left, top, scale, lengths);
    const glm::ivec3 first(t.codes[0] + 0.5f);
    if (std::ranges::all_of(t.codes, [&](const glm::vec3& code) { return glm::ivec3(code + 0.5f) == first; }))
        putSolid(first, to);
    else
        put(bestBlock(t), etc1Hint(t), to);
}

} // namespace

} // namespace uastc

std::vector<std::byte> encodeUastc(const Image& map, const CodeScale& scale, bool lengths)
{
    return encodeBlocks(
        map, 16, [&](int left, int top, std::byte* to) { uastc::encodeBlock(map, left, top, scale, lengths, to); });
}

} // namespace cotan::maps
