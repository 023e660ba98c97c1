#include "uastc_fit.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "block_texels.hpp"

namespace cotan::maps::uastc {

Texels texelsOf(const Image& map, int left, int top, const CodeScale& scale, bool lengths)
{
    Texels t{};
    for (int i = 0; i < 16; ++i) {
        const float* const texel = texelAt(map, left, top, i);
        const glm::vec3 n = 2.0f * glm::vec3(texel[0], texel[1], texel[2]) - 1.0f;
        t.codes[std::size_t(i)] = glm::clamp(scale.zero + scale.unit * n, 0.0f, 255.0f);
        const float length = glm::length(n);
        const glm::vec3 normal = length > 1e-3f && !lengths ? n / length : glm::vec3(0);
        for (int c = 0; c < 3; ++c) {
            at(t.codeChannels[std::size_t(c)], std::size_t(i)) = t.codes[std::size_t(i)][c];
            at(t.normalChannels[std::size_t(c)], std::size_t(i)) = normal[c];
        }
    }
    return t;
}

const EndpointTable& endpointTable(std::size_t mode)
{
    static const std::array<EndpointTable, kUastcModes.size()> all = [] {
        std::array<EndpointTable, kUastcModes.size()> tables;
        for (std::size_t m = 0; m < tables.size(); ++m) {
            const UastcMode& facts = kUastcModes[m];
            std::vector<EndpointValue>& values = tables[m].values;
            for (int digit = 0; digit < facts.levels; ++digit)
                for (int low = 0; low < 1 << facts.endpointBits; ++low)
                    values.push_back({uastcEndpoint(facts.levels, digit, facts.endpointBits, low), digit, low});
            std::ranges::sort(values, {}, &EndpointValue::value);
            for (int code = 0; code < 256; ++code)
                tables[m].notBelow[std::size_t(code)] =
                    std::int16_t(std::ranges::lower_bound(values, code, {}, &EndpointValue::value) - values.begin());
        }
        return tables;
    }();
    return all[mode];
}

namespace {

// code: 0 to 255, or NaN.
int nearestIndex(const EndpointTable& table, float code)
{
    const std::vector<EndpointValue>& values = table.values;
    const int whole = code > 0 ? int(code) : 0,
              above = table.notBelow[std::size_t(whole) + (float(whole) < code ? 1 : 0)];
    const auto value = [&](int i) { return float(values[std::size_t(i)].value); };
    if (above == 0 || (above < int(values.size()) && value(above) - code < code - value(above - 1)))
        return above;
    return above - 1;
}

constexpr float kAlong = 0.98f; // of the error along the normal that is left out: a little keeps lengths near 1

// A vector in each of four lanes.
using FourVectors = std::array<Four, 3>;

Four dot(const FourVectors& a, const FourVectors& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

FourVectors operator-(const FourVectors& a, const FourVectors& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

FourVectors times(Four s, const FourVectors& v) { return {s * v[0], s * v[1], s * v[2]}; }

FourVectors inAllLanes(const glm::vec3& v) { return {kZero + v.x, kZero + v.y, kZero + v.z}; }

FourVectors vectorsAt(const std::array<Values, 3>& channels, std::size_t i)
{
    return {channels[0][i], channels[1][i], channels[2][i]};
}

Four sharesOf(int weightBits, FourInts w) // uastcWeight / 64
{
    const FourInts six = weightBits == 5 ? (w << 1 | w >> 4)
        : weightBits == 4                ? (w << 2 | w >> 2)
                                         : w
            * (weightBits == 3       ? 9
                   : weightBits == 2 ? 21
                                     : 63);
    return __builtin_convertvector(six - (six > 32), Four) / 64.0f; // true is -1
}

// The weights that bring from + w * step nearest to the codes, 0 to most. off: codes - from.
FourInts nearestWeights(const FourVectors& off, const FourVectors& step, const FourVectors& normals, int most)
{
    const FourVectors across = step - times(kAlong * dot(step, normals), normals);
    const Four length = dot(step, across);
    const Four w = length > 1e-6f ? dot(off, across) / (length > 1e-6f ? length : kZero + 1) : kZero;
    return __builtin_convertvector(minOf(maxOf(w, kZero), kZero + 1) * float(most) + 0.5f, FourInts);
}

// Chooses the weights for the ends, and sums the errors of subset `s`: those across the normals.
float weigh(Block& b, const Texels& t, std::size_t s)
{
    const int bits = kUastcModes[b.mode].weightBits, most = (1 << bits) - 1;
    const std::vector<EndpointValue>& values = endpointTable(b.mode).values;
    glm::vec3 first{}, toSecond{}, ownToSecond(0);
    for (int c = 0; c < 3; ++c) {
        first[c] = float(values[std::size_t(b.ends[s][0][std::size_t(c)])].value);
        toSecond[c] = float(values[std::size_t(b.ends[s][1][std::size_t(c)])].value) - first[c];
    }
    if (b.own >= 0)
        std::swap(ownToSecond[b.own], toSecond[b.own]);
    const FourVectors from = inAllLanes(first), step = inAllLanes(toSecond), ownStep = inAllLanes(ownToSecond);
    const std::uint32_t subset = s == 0 ? ~b.subsets() : b.subsets();
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t inside = subset >> 4 * i & 15;
        if (inside == 0)
            continue;
        const FourVectors codes = vectorsAt(t.codeChannels, i), normals = vectorsAt(t.normalChannels, i);
        FourInts w, own{};
        if (b.own < 0) {
            w = nearestWeights(codes - from, step, normals, most);
        } else {
            own = nearestWeights(codes - from, ownStep, {}, most);
            w = nearestWeights(codes - times(sharesOf(bits, own), ownStep) - from, step, normals, most);
            own = nearestWeights(codes - times(sharesOf(bits, w), step) - from, ownStep, normals, most);
        }
        const Four share = sharesOf(bits, w), ownShare = sharesOf(bits, own);
        FourVectors off;
        for (std::size_t c = 0; c < 3; ++c)
            off[c] = from[c] + share * step[c] + ownShare * ownStep[c] - codes[c];
        const Four along = dot(off, normals), error = dot(off, off) - kAlong * along * along;
        for (std::size_t lane = 0; lane < 4; ++lane)
            if ((inside >> lane & 1) != 0) {
                b.weights[0][4 * i + lane] = w[lane];
                b.weights[1][4 * i + lane] = own[lane];
                sum += error[lane];
            }
    }
    return sum;
}

// The ends that fit best, channel by channel, if every texel keeps its weights.
void leastSquares(Block& b, const Texels& t, std::size_t s)
{
    const int bits = kUastcModes[b.mode].weightBits;
    const EndpointTable& table = endpointTable(b.mode);
    Four aa{}, ab{}, bb{}, av{}, bv{}; // a lane for each channel
    for (std::size_t i = 0; i < 16; ++i) {
        if ((b.subsets() >> i & 1) != s)
            continue;
        const auto share = [&](std::size_t plane) { return float(uastcWeight(bits, b.weights[plane][i])) / 64; };
        Four w = kZero + share(0);
        if (b.own >= 0)
            w[b.own] = share(1);
        const Four rest = 1 - w, v{t.codes[i].x, t.codes[i].y, t.codes[i].z, 0};
        aa += rest * rest;
        ab += rest * w;
        bb += w * w;
        av += rest * v;
        bv += w * v;
    }
    for (int c = 0; c < 3; ++c) {
        const float determinant = aa[c] * bb[c] - ab[c] * ab[c];
        if (!(determinant > 1e-4f))
            continue;
        const std::array<float, 2> fitted{(av[c] * bb[c] - bv[c] * ab[c]) / determinant,
                                          (bv[c] * aa[c] - av[c] * ab[c]) / determinant};
        for (std::size_t e = 0; e < 2; ++e)
            b.ends[s][e][std::size_t(c)] = nearestIndex(table, std::clamp(fitted[e], 0.0f, 255.0f));
    }
}

// Four lines through texels of a block, each in a lane.
struct FourLines {
    FourVectors mean{}, direction{};
    Four low{}, high{}, rest{}; // range along it; squared distances to it
};

// Texels that a line goes through, as bits, and a channel that is left out; -1: none.
struct OfLine {
    std::uint32_t texels = 0;
    int without = -1;
};

// By power iteration.
FourLines linesThrough(const Texels& t, const std::array<OfLine, 4>& of)
{
    FourLines line;
    std::array<FourVectors, 16> centred;
    std::array<FourInts, 16> inside;
    FourVectors with = inAllLanes(glm::vec3(1)); // 0: the channel is left out
    Four count{};
    FourInts texels{};
    for (std::size_t lane = 0; lane < 4; ++lane) {
        texels[lane] = std::int32_t(of[lane].texels);
        if (of[lane].without >= 0)
            with[std::size_t(of[lane].without)][lane] = 0;
    }
    for (std::size_t i = 0; i < 16; ++i) {
        inside[i] = -(texels >> std::int32_t(i) & 1);
        for (std::size_t c = 0; c < 3; ++c)
            line.mean[c] += inside[i] ? kZero + t.codes[i][int(c)] : kZero;
        count += inside[i] ? kZero + 1 : kZero;
    }
    for (Four& mean : line.mean)
        mean /= maxOf(count, kZero + 1);
    std::array<FourVectors, 3> covariance{};
    Four trace{};
    for (std::size_t i = 0; i < 16; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            centred[i][c] = inside[i] ? (t.codes[i][int(c)] - line.mean[c]) * with[c] : kZero;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t d = c; d < 3; ++d)
                covariance[c][d] = covariance[d][c] += centred[i][d] * centred[i][c];
        trace += dot(centred[i], centred[i]);
    }
    FourVectors axis{};
    for (const FourVectors& row : covariance) { // the longest row is no eigenvector's opposite
        const FourInts longer = dot(row, row) > dot(axis, axis);
        for (std::size_t c = 0; c < 3; ++c)
            axis[c] = longer ? row[c] : axis[c];
    }
    Four largest{};
    FourInts going = kZero == kZero;
    for (int round = 0; round < 4; ++round) {
        const Four length = rootOf(dot(axis, axis));
        going &= length > 1e-6f;
        for (std::size_t c = 0; c < 3; ++c)
            line.direction[c] = going ? axis[c] / (going ? length : kZero + 1) : line.direction[c];
        for (std::size_t c = 0; c < 3; ++c)
            axis[c] = dot(covariance[c], line.direction);
        largest = going ? dot(axis, line.direction) : largest;
    }
    line.rest = maxOf(trace - largest, kZero);
    line.low = kZero + 1e9f;
    line.high = kZero - 1e9f;
    for (std::size_t i = 0; i < 16; ++i) {
        const Four along = dot(centred[i], line.direction);
        line.low = inside[i] ? minOf(along, line.low) : line.low;
        line.high = inside[i] ? maxOf(along, line.high) : line.high;
    }
    return line;
}

// Fits one subset: ends of the line, then twice weights and ends in turn.
float fitSubset(Block& b, const Texels& t, std::size_t s, const FourLines& lines, std::size_t lane)
{
    const EndpointTable& table = endpointTable(b.mode);
    for (int c = 0; c < 3; ++c) {
        const float mean = lines.mean[std::size_t(c)][lane], direction = lines.direction[std::size_t(c)][lane];
        float low = mean + lines.low[lane] * direction, high = mean + lines.high[lane] * direction;
        if (c == b.own)
            low = minOf(t.codeChannels[std::size_t(c)]), high = maxOf(t.codeChannels[std::size_t(c)]);
        b.ends[s][0][std::size_t(c)] = nearestIndex(table, std::clamp(low, 0.0f, 255.0f));
        b.ends[s][1][std::size_t(c)] = nearestIndex(table, std::clamp(high, 0.0f, 255.0f));
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

// lane: of the line through the first subset; that of the second follows.
Block fit(std::size_t mode, const Texels& t, const FourLines& lines, std::size_t lane, std::size_t pattern = 0,
          int own = -1)
{
    Block b;
    b.mode = mode;
    b.pattern = pattern;
    b.own = own;
    b.error = fitSubset(b, t, 0, lines, lane);
    if (b.subsets() != 0)
        b.error += fitSubset(b, t, 1, lines, lane + 1);
    return b;
}

// Moves each value of the ends to its neighbours while that reduces the error.
void descend(Block& b, const Texels& t)
{
    const int most = int(endpointTable(b.mode).values.size()) - 1;
    const std::size_t subsets = b.subsets() != 0 ? 2 : 1;
    for (std::size_t s = 0; s < subsets; ++s) {
        float error = weigh(b, t, s);
        const float before = error;
        for (std::array<int, 3>& end : b.ends[s])
            for (int& value : end)
                for (const int by : {-1, 1}) {
                    const int old = value;
                    value = std::clamp(old + by, 0, most);
                    const float there = value == old ? error : weigh(b, t, s);
                    if (there < error)
                        error = there;
                    else
                        value = old;
                }
        weigh(b, t, s);
        b.error += error - before;
    }
}

std::array<OfLine, 4> linesOfPatterns(std::size_t p, std::size_t q)
{
    const std::uint32_t a = kTwoSubsetsOfUastc[p], b = kTwoSubsetsOfUastc[q];
    return {{{~a}, {a}, {~b}, {b}}};
}

// The patterns of two subsets with the least squared distances to two lines, best first.
std::array<std::size_t, 2> bestPatterns(const Texels& t)
{
    std::array<std::size_t, 2> best{};
    std::array<float, 2> rests{1e30f, 1e30f};
    static_assert(kTwoSubsetsOfUastc.size() % 2 == 0);
    for (std::size_t pair = 0; pair < kTwoSubsetsOfUastc.size(); pair += 2) {
        const Four rests4 = linesThrough(t, linesOfPatterns(pair, pair + 1)).rest;
        for (const std::size_t p : {pair, pair + 1}) {
            const float rest = rests4[2 * (p - pair)] + rests4[2 * (p - pair) + 1];
            if (rest < rests[0]) {
                best = {p, best[0]};
                rests = {rest, rests[0]};
            } else if (rest < rests[1]) {
                best[1] = p;
                rests[1] = rest;
            }
        }
    }
    return best;
}

} // namespace

Block bestBlock(const Texels& t)
{
    const FourLines whole = linesThrough(t, {{{0xffff}, {0xffff, 0}, {0xffff, 1}, {0xffff, 2}}});
    std::vector<Block> blocks{fit(0, t, whole, 0), fit(18, t, whole, 0), fit(5, t, whole, 0)};
    constexpr float kFine = 0.25f * 16; // squared codes: half a code on average
    if (blocks[0].error > kFine) {
        for (int own = 0; own < 3; ++own)
            blocks.push_back(fit(6, t, whole, std::size_t(own) + 1, 0, own));
        const std::array<std::size_t, 2> patterns = bestPatterns(t);
        const FourLines lines = linesThrough(t, linesOfPatterns(patterns[0], patterns[1]));
        for (std::size_t k = 0; k < 2; ++k)
            for (const std::size_t mode : {2, 4})
                blocks.push_back(fit(mode, t, lines, 2 * k, patterns[k]));
    }
    std::ranges::sort(blocks, {}, &Block::error);
    blocks.resize(std::min<std::size_t>(blocks.size(), 3));
    for (Block& b : blocks)
        descend(b, t);
    return *std::ranges::min_element(blocks, {}, &Block::error);
}

} // namespace cotan::maps::uastc
