// Fits the modes 4 and 5 of BC7 with a rotation: a line of two channels, and one channel by itself.
#include "bc7_fit.hpp"

#include <algorithm>
#include <cmath>

#include "bc7_values.hpp"

namespace cotan::maps::bc7 {

namespace {

// Sum of squared angles. Chooses for each texel the pair of indices with the smallest.
float planesError(const Ends& ends, const Texels& t, const PlanesCode& code, Values& indices, Values& scalarIndices)
{
    const auto end = [&](std::size_t e, std::size_t c) {
        return float(expanded(ends[e][c], c < 3 ? code.colorBits : code.scalarBits));
    };
    float error = 0;
    runLanes([&]<class V>() __attribute__((always_inline)) {
        const V zero{};
        const auto s = std::size_t(code.scalar), u = (s + 1) % 3, v = (s + 2) % 3;
        const float low = end(0, 3), step = end(1, 3) - low, last = float((1 << code.scalarIndexBits) - 1);
        const float inverse = step != 0 ? last / step : 0, toWeight = 64 / last;
        const int levels = 1 << code.lineIndexBits;
        std::array<float, 8> lineU, lineV;
        for (int k = 0; k < levels; ++k) {
            const float weight = weightOf(kZero + float(k), code.lineIndexBits)[0] * (1.0f / 64);
            const auto level = [&](std::size_t c) {
                return float(int(end(0, c) + (end(1, c) - end(0, c)) * weight + 0.5f)) - t.zero;
            };
            lineU[std::size_t(k)] = level(u);
            lineV[std::size_t(k)] = level(v);
        }
        TexelSums<V> sums;
        for (std::size_t i = 0; i < 16; i += sums.kWidth) {
            const V ns = lanesOf<V>(t.n[s], i), nu = lanesOf<V>(t.n[u], i), nv = lanesOf<V>(t.n[v], i);
            V least = zero + 1e30f, best = zero, bestScalar = zero;
            for (int k = 0; k < levels; ++k) {
                const float atU = lineU[std::size_t(k)], atV = lineV[std::size_t(k)], square = atU * atU + atV * atV;
                const V along = nu * atU + nv * atV;
                const V nearest = ns * square / maxOf(along, zero + 1e-3f); // has the smallest angle
                const V index = rounded(minOf(maxOf((nearest + (t.zero - low)) * inverse, zero), zero + last));
                const V scalar = wholeOf(low + step * (rounded(index * toWeight) * (1.0f / 64))) - t.zero;
                const V here = squaredAngle(along + ns * scalar, scalar * scalar + (square + 1e-6f));
                const auto better = here < least;
                least = better ? here : least;
                best = better ? zero + float(k) : best;
                bestScalar = better ? index : bestScalar;
            }
            sums.add(i, least);
            storeLanes(indices, i, best);
            storeLanes(scalarIndices, i, bestScalar);
        }
        error = sums.total();
    });
    return error;
}

void offerPlanes(PlanesFit& fit, const Ends& ends, const Texels& t, const PlanesCode& code)
{
    Values indices{}, scalarIndices{};
    if (const float error = planesError(ends, t, code, indices, scalarIndices); error < fit.error)
        fit = {ends, indices, scalarIndices, error};
}

} // namespace

PlanePoints planePoints(const Texels& t, int scalar)
{
    const auto s = std::size_t(scalar), u = (s + 1) % 3, v = (s + 2) % 3;
    PlanePoints p;
    auto& [alongU, alongV] = p.along;
    const auto& n = t.n;
    alongU = sumOf((n[u][0] + n[u][2]) + (n[u][1] + n[u][3]));
    alongV = sumOf((n[v][0] + n[v][2]) + (n[v][1] + n[v][3]));
    const float length = std::sqrt(alongU * alongU + alongV * alongV);
    if (length < 1) {
        p.along = {};
        return p;
    }
    alongU /= length;
    alongV /= length;
    for (std::size_t i = 0; i < 4; ++i) {
        const Four along = maxOf(n[u][i] * alongU + n[v][i] * alongV, kZero + 0.05f);
        p.scalar[i] = n[s][i] / along;
        p.across[i] = (n[v][i] * alongU - n[u][i] * alongV) / along;
        p.weight[i] = along * along;
    }
    return p;
}

PlanesFit fitPlanes(const Texels& t, const PlanePoints& points, const PlanesCode& code, float limit)
{
    const auto s = std::size_t(code.scalar), u = (s + 1) % 3, v = (s + 2) % 3;
    const auto& [scalar, across, weight, along] = points;
    const auto [alongU, alongV] = along;
    constexpr int kPlaneLengths = 6;
    PlanesFit best;
    std::array<float, 2> scalars{minOf(scalar), maxOf(scalar)}, acrosses{minOf(across), maxOf(across)};
    for (int round = 0; round < kRounds; ++round) {
        float longest = 1e9f;
        for (std::size_t e = 0; e < 2; ++e)
            longest = std::min({longest, growthOf(scalars[e], t.zero), growthOf(alongU - acrosses[e] * alongV, t.zero),
                                growthOf(alongV + acrosses[e] * alongU, t.zero)});
        PlanesFit here;
        const float by = longest * float(1 << (8 - code.colorBits)) / 127; // about one step of a color
        for (int k = 0; k < kPlaneLengths; ++k) {
            const float scale = longest - float(k) * by;
            Ends ends{};
            for (std::size_t e = 0; e < 2; ++e) {
                ends[e][s] = (1 << code.colorBits) - 1; // alpha, after the rotation
                const FourInts stored = nearestStored(
                    t.zero + scale * Four{alongU - acrosses[e] * alongV, alongV + acrosses[e] * alongU, 0, 0},
                    code.colorBits, false, 0);
                ends[e][u] = stored[0];
                ends[e][v] = stored[1];
                ends[e][3] = nearestStored(kZero + (t.zero + scale * scalars[e]), code.scalarBits, false, 0)[0];
            }
            offerPlanes(here, ends, t, code);
        }
        if (here.error < best.error)
            best = here;
        if (best.error > limit)
            break;
        const LeastSquares ofScalar(weight, here.scalarIndices, code.scalarIndexBits),
            ofLine(weight, here.indices, code.lineIndexBits);
        if (ofScalar.solvable())
            ofScalar.solve(scalar, scalars[0], scalars[1]);
        if (ofLine.solvable())
            ofLine.solve(across, acrosses[0], acrosses[1]);
    }
    return best;
}

void refinePlanes(PlanesFit& fit, const Texels& t, const PlanesCode& code, int rounds)
{
    for (int round = 0; round < rounds; ++round) {
        const float before = fit.error;
        for (std::size_t c = 0; c < 4; ++c)
            for (int move = 0; move < (int(c) == code.scalar ? 0 : 6); ++move) {
                Ends to = fit.ends; // one end, or both
                const int by = move % 2 ? 1 : -1;
                to[0][c] += move / 2 != 1 ? by : 0;
                to[1][c] += move / 2 != 0 ? by : 0;
                const int end = 1 << (c < 3 ? code.colorBits : code.scalarBits);
                if (std::min(to[0][c], to[1][c]) >= 0 && std::max(to[0][c], to[1][c]) < end)
                    offerPlanes(fit, to, t, code);
            }
        if (!(fit.error < before))
            break;
    }
}

} // namespace cotan::maps::bc7
