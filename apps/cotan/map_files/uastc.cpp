// UASTC encoder for normal maps of three channels: the files of Basis Universal that every device turns into a format
// of its own. Source: R. Geldreich, in Khronos Data Format Specification 1.4, chapter 25. Of its 19 modes those serve
// that hold opaque colours: one line of values (0, 18, 5), one for two channels and one for the third (6), and two
// lines in two parts of the block (2, 4).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "block.hpp"
#include "block_texels.hpp"
#include "image/uastc_modes.hpp"

namespace cotan::app {

namespace uastc {

namespace {

struct Texels {
    std::array<glm::vec3, 16> codes, normals; // 0 to 255; unit vectors, or zero if lengths count
};

Texels texelsOf(const Image& map, int left, int top, const CodeScale& scale, bool lengths)
{
    Texels t;
    for (int i = 0; i < 16; ++i) {
        const float* const texel = texelAt(map, left, top, i);
        const glm::vec3 n = 2.0f * glm::vec3(texel[0], texel[1], texel[2]) - 1.0f;
        t.codes[std::size_t(i)] = glm::clamp(scale.zero + scale.unit * n, 0.0f, 255.0f);
        const float length = glm::length(n);
        t.normals[std::size_t(i)] = length > 1e-3f && !lengths ? n / length : glm::vec3(0);
    }
    return t;
}

// An endpoint's values of 8 bits in a mode, ascending, with their digits and low bits.
struct EndpointValue {
    int value = 0, digit = 0, low = 0;
};
using EndpointValues = std::vector<EndpointValue>;

const EndpointValues& endpointValues(std::size_t mode)
{
    static const std::array<EndpointValues, 19> all = [] {
        std::array<EndpointValues, 19> values;
        for (std::size_t m = 0; m < values.size(); ++m) {
            const UastcMode& facts = kUastcModes[m];
            for (int digit = 0; digit < facts.levels; ++digit)
                for (int low = 0; low < 1 << facts.endpointBits; ++low)
                    values[m].push_back({uastcEndpoint(facts.levels, digit, facts.endpointBits, low), digit, low});
            std::ranges::sort(values[m], {}, &EndpointValue::value);
        }
        return values;
    }();
    return all[mode];
}

int nearestIndex(const EndpointValues& values, float code)
{
    const auto above =
        std::ranges::lower_bound(values, code, {}, [](const EndpointValue& v) { return float(v.value); });
    const auto i = int(above - values.begin());
    if (i == 0 || (i < int(values.size()) && float(above->value) - code < code - float((above - 1)->value)))
        return i;
    return i - 1;
}

// The block in a mode: for each subset two ends, as indices of endpointValues, and for each texel a weight of each
// plane, 0 to 2^weightBits - 1.
struct Block {
    std::size_t mode = 0, pattern = 0;
    int own = -1; // the channel with weights of its own
    std::array<std::array<std::array<int, 3>, 2>, 2> ends{};
    std::array<std::array<int, 16>, 2> weights{};
    float error = 1e30f; // squared codes across the normal

    std::uint32_t subsets() const { return mode == 2 || mode == 4 ? kTwoSubsetsOfUastc[pattern] : 0; }
};

// The error across the normal; a little of that along it, so that lengths stay near 1.
float errorOf(const glm::vec3& off, const glm::vec3& normal)
{
    const float along = glm::dot(off, normal);
    return glm::dot(off, off) - 0.98f * along * along;
}

// The weight that brings from + w * step nearest to the code, in 0 to most.
int nearestWeight(const glm::vec3& code, const glm::vec3& from, const glm::vec3& step, const glm::vec3& normal,
                  int most)
{
    const glm::vec3 across = step - 0.98f * glm::dot(step, normal) * normal;
    const float length = glm::dot(step, across);
    const float w = length > 1e-6f ? glm::dot(code - from, across) / length : 0;
    return int(std::clamp(w, 0.0f, 1.0f) * float(most) + 0.5f);
}

// Chooses the weights for the ends, and sums the errors of subset `s`.
float weigh(Block& b, const Texels& t, std::size_t s)
{
    const UastcMode& mode = kUastcModes[b.mode];
    const EndpointValues& values = endpointValues(b.mode);
    const int most = (1 << mode.weightBits) - 1;
    glm::vec3 from{}, step{};
    for (int c = 0; c < 3; ++c) {
        from[c] = float(values[std::size_t(b.ends[s][0][std::size_t(c)])].value);
        step[c] = float(values[std::size_t(b.ends[s][1][std::size_t(c)])].value) - from[c];
    }
    glm::vec3 ownStep(0);
    if (b.own >= 0) {
        ownStep[b.own] = step[b.own];
        step[b.own] = 0;
    }
    const auto share = [&](int w) { return float(uastcWeight(mode.weightBits, w)) / 64; };
    float sum = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        if ((b.subsets() >> i & 1) != s)
            continue;
        int& first = b.weights[0][i];
        int& second = b.weights[1][i];
        second = b.own < 0 ? 0 : nearestWeight(t.codes[i], from, ownStep, glm::vec3(0), most);
        first = nearestWeight(t.codes[i] - share(second) * ownStep, from, step, t.normals[i], most);
        if (b.own >= 0)
            second = nearestWeight(t.codes[i] - share(first) * step, from, ownStep, t.normals[i], most);
        sum += errorOf(from + share(first) * step + share(second) * ownStep - t.codes[i], t.normals[i]);
    }
    return sum;
}

// The ends that fit best, channel by channel, if every texel keeps its weights.
void leastSquares(Block& b, const Texels& t, std::size_t s)
{
    const UastcMode& mode = kUastcModes[b.mode];
    const EndpointValues& values = endpointValues(b.mode);
    for (int c = 0; c < 3; ++c) {
        const auto& weights = b.weights[c == b.own ? 1 : 0];
        float aa = 0, ab = 0, bb = 0, av = 0, bv = 0;
        for (std::size_t i = 0; i < 16; ++i) {
            if ((b.subsets() >> i & 1) != s)
                continue;
            const float w = float(uastcWeight(mode.weightBits, weights[i])) / 64, rest = 1 - w, v = t.codes[i][c];
            aa += rest * rest;
            ab += rest * w;
            bb += w * w;
            av += rest * v;
            bv += w * v;
        }
        const float determinant = aa * bb - ab * ab;
        if (!(determinant > 1e-4f))
            continue;
        const std::array<float, 2> fitted{(av * bb - bv * ab) / determinant, (bv * aa - av * ab) / determinant};
        for (std::size_t e = 0; e < 2; ++e)
            b.ends[s][e][std::size_t(c)] = nearestIndex(values, std::clamp(fitted[e], 0.0f, 255.0f));
    }
}

struct Line {
    glm::vec3 mean{0}, direction{0};
    float low = 0, high = 0, rest = 0; // range along it; squared distances to it
};

// The line through the texels of a subset, by power iteration. without: a channel that is left out; -1: none.
Line lineThrough(const Texels& t, std::uint32_t subsets, std::size_t s, int without = -1)
{
    Line line;
    float count = 0;
    std::array<glm::vec3, 16> centred{};
    for (std::size_t i = 0; i < 16; ++i)
        if ((subsets >> i & 1) == s) {
            line.mean += t.codes[i];
            ++count;
        }
    line.mean /= std::max(count, 1.0f);
    std::array<glm::vec3, 3> covariance{};
    float trace = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        if ((subsets >> i & 1) != s)
            continue;
        centred[i] = t.codes[i] - line.mean;
        if (without >= 0)
            centred[i][without] = 0;
        for (int c = 0; c < 3; ++c)
            covariance[std::size_t(c)] += centred[i] * centred[i][c];
        trace += glm::dot(centred[i], centred[i]);
    }
    const auto times = [&](const glm::vec3& v) {
        return glm::vec3(glm::dot(covariance[0], v), glm::dot(covariance[1], v), glm::dot(covariance[2], v));
    };
    glm::vec3 axis(0);
    for (const glm::vec3& row : covariance) // the longest row is no eigenvector's opposite
        axis = glm::dot(row, row) > glm::dot(axis, axis) ? row : axis;
    float largest = 0;
    for (int round = 0; round < 4; ++round) {
        const float length = glm::length(axis);
        if (!(length > 1e-6f))
            break;
        line.direction = axis / length;
        axis = times(line.direction);
        largest = glm::dot(axis, line.direction);
    }
    line.rest = std::max(trace - largest, 0.0f);
    line.low = 1e9f;
    line.high = -1e9f;
    for (std::size_t i = 0; i < 16; ++i) {
        if ((subsets >> i & 1) != s)
            continue;
        const float along = glm::dot(centred[i], line.direction);
        line.low = std::min(line.low, along);
        line.high = std::max(line.high, along);
    }
    return line;
}

// Fits one subset: ends of the line, then twice weights and ends in turn.
float fitSubset(Block& b, const Texels& t, std::size_t s)
{
    const EndpointValues& values = endpointValues(b.mode);
    const Line line = lineThrough(t, b.subsets(), s, b.own);
    for (int c = 0; c < 3; ++c) {
        float low = line.mean[c] + line.low * line.direction[c], high = line.mean[c] + line.high * line.direction[c];
        if (c == b.own) {
            low = 255, high = 0;
            for (const glm::vec3& code : t.codes) {
                low = std::min(low, code[c]);
                high = std::max(high, code[c]);
            }
        }
        b.ends[s][0][std::size_t(c)] = nearestIndex(values, std::clamp(low, 0.0f, 255.0f));
        b.ends[s][1][std::size_t(c)] = nearestIndex(values, std::clamp(high, 0.0f, 255.0f));
    }
    float error = weigh(b, t, s);
    for (int round = 0; round < 2; ++round) {
        Block next = b;
        leastSquares(next, t, s);
        const float there = weigh(next, t, s);
        if (!(there < error))
            break;
        b = next;
        error = there;
    }
    return error;
}

Block fit(std::size_t mode, const Texels& t, std::size_t pattern = 0, int own = -1)
{
    Block b;
    b.mode = mode;
    b.pattern = pattern;
    b.own = own;
    b.error = fitSubset(b, t, 0);
    if (b.subsets() != 0)
        b.error += fitSubset(b, t, 1);
    return b;
}

// Moves each value of the ends to its neighbours while that reduces the error.
void descend(Block& b, const Texels& t)
{
    const int most = int(endpointValues(b.mode).size()) - 1;
    const std::size_t subsets = b.subsets() != 0 ? 2 : 1;
    for (std::size_t s = 0; s < subsets; ++s) {
        float error = weigh(b, t, s);
        const float before = error;
        for (std::size_t e = 0; e < 2; ++e)
            for (std::size_t c = 0; c < 3; ++c)
                for (const int by : {-1, 1}) {
                    Block next = b;
                    int& value = next.ends[s][e][c];
                    value = std::clamp(value + by, 0, most);
                    const float there = weigh(next, t, s);
                    if (there < error) {
                        b = next;
                        error = there;
                    }
                }
        weigh(b, t, s);
        b.error += error - before;
    }
}

// The patterns of two subsets with the least squared distances to two lines, best first.
std::array<std::size_t, 2> bestPatterns(const Texels& t)
{
    std::array<std::size_t, 2> best{};
    std::array<float, 2> rests{1e30f, 1e30f};
    for (std::size_t p = 0; p < kTwoSubsetsOfUastc.size(); ++p) {
        const std::uint32_t subsets = kTwoSubsetsOfUastc[p];
        const float rest = lineThrough(t, subsets, 0).rest + lineThrough(t, subsets, 1).rest;
        if (rest < rests[0]) {
            best = {p, best[0]};
            rests = {rest, rests[0]};
        } else if (rest < rests[1]) {
            best[1] = p;
            rests[1] = rest;
        }
    }
    return best;
}

Block bestBlock(const Texels& t)
{
    std::vector<Block> blocks{fit(0, t), fit(18, t), fit(5, t)};
    constexpr float kFine = 0.25f * 16; // squared codes: half a code on average
    if (blocks[0].error > kFine) {
        for (int own = 0; own < 3; ++own)
            blocks.push_back(fit(6, t, 0, own));
        for (const std::size_t pattern : bestPatterns(t))
            for (const std::size_t mode : {2, 4})
                blocks.push_back(fit(mode, t, pattern));
    }
    std::ranges::sort(blocks, {}, &Block::error);
    blocks.resize(std::min<std::size_t>(blocks.size(), 3));
    for (Block& b : blocks)
        descend(b, t);
    return *std::ranges::min_element(blocks, {}, &Block::error);
}

// Bits from the lowest of the first byte upwards.
class Bits {
public:
    explicit Bits(std::byte* to) : to_(to) { std::fill_n(to, 16, std::byte(0)); }
    void put(int value, int count)
    {
        for (int i = 0; i < count; ++i, ++at_)
            to_[at_ / 8] |= std::byte((value >> i & 1) << at_ % 8);
    }

private:
    std::byte* to_;
    int at_ = 0;
};

// How a transcoder to ETC1 cuts the block and which table of modifiers each half has. Those with the least error for
// the mean colour of a half, whose brightness the modifiers change.
struct Etc1Hint {
    int flip = 0, tables[2] = {};
};

constexpr int kModifiers[8][2] = {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}};

Etc1Hint etc1Hint(const Texels& t)
{
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
            float leastHere = 1e30f;
            for (int table = 0; table < 8; ++table) {
                float here = 0;
                for (std::size_t i = 0; i < 16; ++i) {
                    if (!inside(i))
                        continue;
                    float nearest = 1e30f;
                    for (const int modifier : kModifiers[table])
                        for (const int sign : {-1, 1}) {
                            const glm::vec3 off = mean + float(sign * modifier) - t.codes[i];
                            nearest = std::min(nearest, glm::dot(off, off));
                        }
                    here += nearest;
                }
                if (here < leastHere) {
                    leastHere = here;
                    hint.tables[half] = table;
                }
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
    Bits bits(to);
    bits.put(kUastcModes[kSolidUastc].code, kUastcModes[kSolidUastc].codeBits);
    for (int c = 0; c < 3; ++c)
        bits.put(color[c], 8);
    bits.put(255, 8);
    bits.put(1, 1);
    int bestTable = 0, bestSelector = 0, least = 1 << 30;
    glm::ivec3 best(0);
    for (int table = 0; table < 8; ++table)
        for (int selector = 0; selector < 4; ++selector) { // from the darkest to the brightest
            const int modifier = selector < 2 ? -kModifiers[table][1 - selector] : kModifiers[table][selector - 2];
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

void putEnds(Bits& bits, const Block& b, std::size_t subsets)
{
    const UastcMode& mode = kUastcModes[b.mode];
    std::vector<EndpointValue> values;
    for (std::size_t s = 0; s < subsets; ++s)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t e = 0; e < 2; ++e)
                values.push_back(endpointValues(b.mode)[std::size_t(b.ends[s][e][c])]);
    // Digits are packed in groups: five trits in 8 bits, fewer in 2, 4, 5 or 7; three quints in 7.
    const std::size_t group = mode.levels == 3 ? 5 : 3;
    for (std::size_t first = 0; mode.levels > 1 && first < values.size(); first += group) {
        constexpr std::array<int, 6> kTritBits{0, 2, 4, 5, 7, 8};
        const std::size_t count = std::min(group, values.size() - first);
        int packed = 0;
        for (std::size_t i = first + count; i-- > first;)
            packed = packed * mode.levels + values[i].digit;
        bits.put(packed, mode.levels == 3 ? kTritBits[count] : 7);
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
    Bits bits(to);
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

} // namespace cotan::app
