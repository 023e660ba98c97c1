// BC7 encoder for normal maps. Candidates, a mode and a partition each, are ordered by an estimate; the best are
// fitted, and the best of these refined.
#include "maps/blocks/block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bc7_fit.hpp"
#include "bc7_layout.hpp"
#include "block_texels.hpp"

namespace cotan::maps {

namespace bc7 {

namespace {

Texels texelsOf(const Image& map, int left, int top, const CodeScale& scale, bool lengths)
{
    Texels t{};
    t.zero = scale.zero;
    t.directions = !lengths;
    std::array<float, 3> mean{};
    for (std::size_t i = 0; i < 16; ++i) {
        const float* const texel = texelAt(map, left, top, int(i));
        std::array<float, 3> n{};
        float square = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            n[c] = 2 * texel[c] - 1;
            square += n[c] * n[c];
            at(t.codes[c], i) = std::clamp(scale.zero + scale.unit * n[c], 0.0f, 255.0f);
        }
        const float inverse = square > 1e-6f ? 1 / std::sqrt(square) : 0;
        for (std::size_t c = 0; c < 3; ++c) {
            at(t.n[c], i) = n[c] * inverse;
            mean[c] += n[c] * inverse;
        }
        at(t.codes[3], i) = std::clamp(255 * texel[3], 0.0f, 255.0f);
        t.opaque = t.opaque && texel[3] >= 1;
    }
    t.aim = t.codes;
    t.mask.fill(kZero + 1);
    t.weight.fill(kZero + 1);
    const float length = std::sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
    for (std::size_t i = 0; i < 4 && t.directions && length > 1; ++i) {
        Four height = kZero; // above the plane through the origin that is perpendicular to the mean
        for (std::size_t c = 0; c < 3; ++c)
            height += t.n[c][i] * (mean[c] / length);
        height = maxOf(height, kZero + 0.1f);
        t.weight[i] = height * height;
        for (std::size_t c = 0; c < 3; ++c)
            t.aim[c][i] = t.zero + scale.unit * t.n[c][i] / height;
    }
    return t;
}

// ---- estimates -----------------------------------------------------------------------------

// Weighted moments of points, of four sets at once.
struct Moments {
    Four w{}, x{}, y{}, xx{}, xy{}, yy{};
};

Moments operator-(const Moments& a, const Moments& b)
{
    return {a.w - b.w, a.x - b.x, a.y - b.y, a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
}

// Sums of squared distances of points: from the line that fits best, and along it from the mean.
struct Scatter {
    Four off, along;
};

Scatter scatterOf(const Moments& m)
{
    const Four inverse = 1 / maxOf(m.w, kZero + 1e-6f);
    const Four xx = m.xx - m.x * m.x * inverse, xy = m.xy - m.x * m.y * inverse, yy = m.yy - m.y * m.y * inverse;
    const Four middle = (xx + yy) * 0.5f, half = (xx - yy) * 0.5f, root = rootOf(half * half + xy * xy);
    return {maxOf(middle - root, kZero), middle + root};
}

// The error that rounding of values to n levels adds is as if each were off by a part of 1 / (n - 1).
float fineness(int indexBits) { return 1 / float(((1 << indexBits) - 1) * ((1 << indexBits) - 1)); }

// What rounding of the ends adds: a twelfth of a squared step for each of two ends and of the two axes across a
// direction, which texels between the ends take two thirds of.
float roundingOf(int bits)
{
    const float step = float(256 >> std::min(8, bits));
    return 16 * step * step / 8;
}

// For each texel, whether it is in the second subset of two, or in the second and third of three: four partitions at
// once, of three subsets only those of mode 0.
struct Masks {
    std::array<std::array<Four, 16>, 16> two{};
    std::array<std::array<std::array<Four, 16>, 4>, 2> three{};
};

Masks makeMasks()
{
    Masks m;
    for (int p = 0; p < 64; ++p)
        for (int i = 0; i < 16; ++i) {
            m.two[std::size_t(p / 4)][std::size_t(i)][p % 4] = float(subsetOf(2, p, i));
            for (int s = 0; s < 2 && p < 16; ++s)
                m.three[std::size_t(s)][std::size_t(p / 4)][std::size_t(i)][p % 4] = subsetOf(3, p, i) == s + 1;
        }
    return m;
}

// A mode with a partition or, of modes 4 and 5, with the channel by itself and the selection of its indices.
struct Candidate {
    float estimate = 0; // of the error
    int mode = 6, partition = 0, scalar = 0, selection = 0;
};

// Points of a plane, each in all four lanes.
struct Points {
    std::array<Four, 16> w, x, y;
};

Moments momentsOf(const Points& p, const std::array<Four, 16>& mask)
{
    Moments m;
    for (std::size_t i = 0; i < 16; ++i) {
        const Four w = p.w[i] * mask[i];
        m.w += w;
        m.x += w * p.x[i];
        m.y += w * p.y[i];
        m.xx += w * (p.x[i] * p.x[i]);
        m.xy += w * (p.x[i] * p.y[i]);
        m.yy += w * (p.y[i] * p.y[i]);
    }
    return m;
}

// The plane is that of Texels::aim, its origin the mean. Lengths and alpha do not count.
Points pointsOf(const Texels& t)
{
    std::array<float, 3> mean{}, first{}, second{};
    float length = 1e-9f;
    for (std::size_t c = 0; c < 3; ++c) {
        const Values& n = t.n[c];
        mean[c] = sumOf((n[0] + n[2]) + (n[1] + n[3]));
        length += mean[c] * mean[c];
    }
    length = std::sqrt(length);
    for (float& m : mean)
        m /= length;
    const std::size_t least = std::abs(mean[0]) < std::abs(mean[1]) ? 0 : 1;
    float square = 1e-9f;
    for (std::size_t c = 0; c < 3; ++c) {
        first[c] = (c == least) - mean[least] * mean[c];
        square += first[c] * first[c];
    }
    for (float& f : first)
        f /= std::sqrt(square);
    for (std::size_t c = 0; c < 3; ++c)
        second[c] = mean[(c + 1) % 3] * first[(c + 2) % 3] - mean[(c + 2) % 3] * first[(c + 1) % 3];
    Points p;
    for (std::size_t i = 0; i < 4; ++i) {
        Four x = kZero, y = kZero;
        for (std::size_t c = 0; c < 3; ++c) {
            x += (t.aim[c][i] - t.zero) * first[c];
            y += (t.aim[c][i] - t.zero) * second[c];
        }
        for (std::size_t k = 0; k < 4; ++k) {
            p.w[4 * i + k] = kZero + t.weight[i][int(k)];
            p.x[4 * i + k] = kZero + x[int(k)];
            p.y[4 * i + k] = kZero + y[int(k)];
        }
    }
    return p;
}

// The candidates with the least estimates, in their order.
struct Candidates {
    std::array<Candidate, 6> list;
    std::size_t tries, count = 0;

    void add(const Candidate& c)
    {
        if (count == tries && !(c.estimate < list[count - 1].estimate))
            return;
        std::size_t at = count < tries ? count++ : count - 1;
        for (; at > 0 && c.estimate < list[at - 1].estimate; --at)
            list[at] = list[at - 1];
        list[at] = c;
    }
};

// Modes 0, 1, 3 and 6 or, if alpha varies, 6 and 7.
void addLines(const Texels& t, Candidates& to)
{
    static const Masks masks = makeMasks();
    const Points points = pointsOf(t);
    std::array<Four, 16> all;
    all.fill(kZero + 1);
    const Moments whole = momentsOf(points, all);
    const auto add = [&](int mode, const Four& off, const Four& along, int first, int count) {
        const Mode& m = kModes[std::size_t(mode)];
        const Four estimate = off + along * fineness(m.indexBits) + roundingOf(m.colorBits + m.lowBits());
        for (int k = 0; k < count; ++k)
            to.add({estimate[k], mode, first + k, 0, 0});
    };
    const Scatter one = scatterOf(whole);
    add(6, one.off, one.along, 0, 1);
    for (int g = 0; g < 16; ++g) {
        const Moments second = momentsOf(points, masks.two[std::size_t(g)]);
        const Scatter a = scatterOf(whole - second), b = scatterOf(second);
        if (t.opaque) {
            add(1, a.off + b.off, a.along + b.along, 4 * g, 4);
            add(3, a.off + b.off, a.along + b.along, 4 * g, 4);
        } else {
            add(7, a.off + b.off, a.along + b.along, 4 * g, 4);
        }
    }
    for (int g = 0; g < 4 && t.opaque; ++g) {
        const Moments second = momentsOf(points, masks.three[0][std::size_t(g)]),
                      third = momentsOf(points, masks.three[1][std::size_t(g)]);
        const Scatter a = scatterOf(whole - second - third), b = scatterOf(second), c = scatterOf(third);
        add(0, a.off + b.off + c.off, a.along + b.along + c.along, 4 * g, 4);
    }
}

constexpr int kAlpha = 3; // as Candidate::scalar

bool hasPlanes(const Candidate& c) { return c.mode == 4 || c.mode == 5; }

PlanesCode planesCode(const Candidate& c)
{
    const Mode& m = kModes[std::size_t(c.mode)];
    PlanesCode code{c.scalar, m.colorBits, m.alphaBits, m.indexBits, m.secondBits};
    if (c.selection != 0)
        std::swap(code.lineIndexBits, code.scalarIndexBits);
    return code;
}

float varianceOf(const Values& values, const Values& weights)
{
    Four w4{}, x4{}, xx4{};
    for (std::size_t i = 0; i < 4; ++i) {
        w4 += weights[i];
        x4 += weights[i] * values[i];
        xx4 += weights[i] * values[i] * values[i];
    }
    const float x = sumOf(x4);
    return std::max(sumOf(xx4) - x * x / sumOf(w4), 0.0f) * (127 * 127);
}

// Modes 4 and 5. Of texels that are not opaque, alpha is the scalar.
void addPlanes(const Texels& t, const std::array<PlanePoints, 3>& points, Candidates& to)
{
    constexpr std::array<std::pair<int, int>, 3> kModesAndSelections{{{5, 0}, {4, 0}, {4, 1}}};
    for (const auto& [mode, selection] : kModesAndSelections) {
        if (!t.opaque)
            to.add({0, mode, 0, kAlpha, selection});
        for (int scalar = 0; scalar < kAlpha && t.directions && t.opaque; ++scalar) {
            const PlanePoints& p = points[std::size_t(scalar)];
            if (p.along[0] == 0 && p.along[1] == 0)
                continue;
            Candidate c{0, mode, 0, scalar, selection};
            const PlanesCode code = planesCode(c);
            c.estimate = varianceOf(p.scalar, p.weight) * fineness(code.scalarIndexBits)
                + varianceOf(p.across, p.weight) * fineness(code.lineIndexBits) + roundingOf(code.colorBits);
            to.add(c);
        }
    }
}

// ---- fits ----------------------------------------------------------------------------------

struct Result {
    Candidate candidate;
    std::array<Fit, 3> lines; // by subset; of modes 4 and 5 without a rotation: red, green and blue, then alpha
    PlanesFit planes;         // of modes 4 and 5 with a rotation
    float error = 1e30f;
};

LineCode lineCode(const Candidate& c, const Texels& t)
{
    const Mode& m = kModes[std::size_t(c.mode)];
    if (hasPlanes(c))
        return {m.colorBits, 0, false, false, planesCode(c).lineIndexBits, 3};
    return {m.colorBits + m.lowBits(),
            m.alphaBits > 0 ? m.alphaBits + m.lowBits() : 0,
            m.lowBits() > 0,
            m.subsetBits > 0,
            m.indexBits,
            m.alphaBits > 0 && !t.opaque ? 4 : 3};
}

// The texels of a subset.
Texels texelsOf(const Texels& t, const Candidate& c, int subset)
{
    const int subsets = kModes[std::size_t(c.mode)].subsets;
    Texels part = t;
    part.mask.fill(kZero);
    std::size_t to = 0;
    for (std::size_t i = 0; i < 16; ++i)
        if (subsetOf(subsets, c.partition, int(i)) == subset) {
            for (std::size_t k = 0; k < 3; ++k)
                at(part.n[k], to) = at(t.n[k], i);
            for (std::size_t k = 0; k < 4; ++k) {
                at(part.aim[k], to) = at(t.aim[k], i);
                at(part.codes[k], to) = at(t.codes[k], i);
            }
            at(part.weight, to) = at(t.weight, i);
            at(part.mask, to++) = 1;
        }
    part.count = to <= 8 ? 8 : 16;
    return part;
}

// Stops when the error reaches `limit`.
Result fitted(const Texels& t, const std::array<PlanePoints, 3>& points, const Candidate& c, float limit)
{
    Result r;
    r.candidate = c;
    if (hasPlanes(c) && c.scalar < kAlpha) {
        r.planes = fitPlanes(t, points[std::size_t(c.scalar)], planesCode(c), limit);
        r.error = r.planes.error;
        return r;
    }
    r.error = 0;
    for (int s = 0; s < kModes[std::size_t(c.mode)].subsets && r.error < limit; ++s) {
        r.lines[std::size_t(s)] = fitLine(texelsOf(t, c, s), lineCode(c, t), limit - r.error);
        r.error += r.lines[std::size_t(s)].error;
    }
    if (hasPlanes(c)) {
        r.lines[1] = fitAlpha(t, planesCode(c).scalarBits, planesCode(c).scalarIndexBits);
        r.error += r.lines[1].error;
    }
    return r;
}

void refine(Result& r, const Texels& t)
{
    constexpr int kRefinements = 2;
    const Candidate& c = r.candidate;
    if (hasPlanes(c) && c.scalar < kAlpha) {
        refinePlanes(r.planes, t, planesCode(c), kRefinements);
        r.error = r.planes.error;
        return;
    }
    for (int s = 0; s < kModes[std::size_t(c.mode)].subsets; ++s) {
        Fit& line = r.lines[std::size_t(s)];
        r.error -= line.error;
        refineLine(line, texelsOf(t, c, s), lineCode(c, t), kRefinements);
        r.error += line.error;
    }
}

Block blockOf(const Result& r)
{
    const Candidate& c = r.candidate;
    const int subsets = kModes[std::size_t(c.mode)].subsets;
    Block b;
    b.mode = c.mode;
    b.partition = c.partition;
    if (!hasPlanes(c)) {
        for (std::size_t s = 0; s < std::size_t(subsets); ++s)
            b.ends[s] = r.lines[s].ends;
        std::array<std::size_t, 3> next{};
        for (std::size_t i = 0; i < 16; ++i) {
            const auto s = std::size_t(subsetOf(subsets, c.partition, int(i)));
            b.indices[i] = int(at(r.lines[s].indices, next[s]++));
        }
        return b;
    }
    b.rotation = (c.scalar + 1) % 4;
    b.selection = c.selection;
    const bool rotated = c.scalar < kAlpha;
    b.ends[0] = rotated ? r.planes.ends : r.lines[0].ends;
    for (std::size_t e = 0; e < 2 && !rotated; ++e)
        b.ends[0][e][3] = r.lines[1].ends[e][3];
    for (std::size_t i = 0; i < 16; ++i) {
        b.indices[i] = int(at(rotated ? r.planes.indices : r.lines[0].indices, i));
        b.second[i] = int(at(rotated ? r.planes.scalarIndices : r.lines[1].indices, i));
        if (c.selection != 0)
            std::swap(b.indices[i], b.second[i]);
    }
    return b;
}

void encode(const Texels& t, std::byte* to)
{
    // Tries with lines and planes each, and how many of the best are refined: one more of each reduces
    // the error by about 1 %.
    constexpr std::size_t kLineTries = 4, kPlaneTries = 4, kRefined = 2;
    constexpr float kExact = 0.3f; // 0.06 degrees: no more is tried
    Candidates lines{{}, kLineTries}, planes{{}, kPlaneTries};
    addLines(t, lines);
    std::array<PlanePoints, 3> points;
    for (int s = 0; s < kAlpha && t.directions && t.opaque; ++s)
        points[std::size_t(s)] = planePoints(t, s);
    addPlanes(t, points, planes);

    std::array<Result, kRefined> best; // from the smallest error
    for (const Candidates& of : {lines, planes})
        for (std::size_t k = 0; k < of.count && best[0].error > kExact; ++k) {
            Result r = fitted(t, points, of.list[k], best.back().error);
            for (Result& b : best)
                if (r.error < b.error)
                    std::swap(r, b);
        }
    const Result* least = best.data();
    for (Result& r : best) {
        if (least->error > kExact && r.error < 1e29f)
            refine(r, t);
        if (r.error < least->error)
            least = &r;
    }
    write(blockOf(*least), to);
}

} // namespace

} // namespace bc7

std::vector<std::byte> encodeBc7(const Image& map, const CodeScale& scale, bool lengths)
{
    return encodeBlocks(map, 16, [&](int left, int top, std::byte* to) {
        bc7::encode(bc7::texelsOf(map, left, top, scale, lengths), to);
    });
}

} // namespace cotan::maps
