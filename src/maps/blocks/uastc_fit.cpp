#include "uastc_fit.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "block_texels.hpp"

namespace cotan::maps::uastc {

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

namespace {

int nearestIndex(const EndpointValues& values, float code)
{
    const auto above =
        std::ranges::lower_bound(values, code, {}, [](const EndpointValue& v) { return float(v.value); });
    const auto i = int(above - values.begin());
    if (i == 0 || (i < int(values.size()) && float(above->value) - code < code - float((above - 1)->value)))
        return i;
    return i - 1;
}

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

} // namespace

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

} // namespace cotan::maps::uastc
