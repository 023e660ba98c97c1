#include "bake/convert/reencode.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "bake/surface/nearest_texels.hpp"
#include "core/loops.hpp"
#include "cotan/vector.hpp"
#include "point_finder.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

// ---- one texel for several surface points -----------------------------------------------------

namespace {

constexpr int kMaxIterations = 12;   // quadratic convergence: four or five suffice
constexpr double kMinStep = 1e-10;   // a shorter step ends the iteration
constexpr double kMinLength = 1e-12; // of a vector that has a direction

double costOf(std::span<const Demand> demands, glm::dvec3 texel)
{
    double cost = 0;
    for (const Demand& d : demands)
        if (invertible(d.frame)) {
            const glm::dvec3 r = unitOr(d.frame * texel, glm::dvec3(0), kMinLength) - d.target;
            cost += glm::dot(r, r);
        }
    return cost;
}

// The Gauss-Newton step from a unit texel, perpendicular to it.
glm::dvec3 stepFrom(std::span<const Demand> demands, glm::dvec3 texel)
{
    glm::dmat3 normal(0);
    glm::dvec3 gradient(0);
    for (const Demand& d : demands) {
        if (!invertible(d.frame))
            continue;
        const glm::dvec3 v = d.frame * texel;
        const double length = glm::length(v);
        const glm::dvec3 u = v / length;
        const glm::dmat3 jacobian = (d.frame - glm::outerProduct(u, glm::transpose(d.frame) * u)) * (1 / length);
        normal += glm::transpose(jacobian) * jacobian;
        gradient += glm::transpose(jacobian) * (u - d.target);
    }
    // The length of the texel is free; a term along the texel fixes it.
    const double trace = normal[0][0] + normal[1][1] + normal[2][2];
    normal += glm::outerProduct(texel, texel) * trace;
    const double determinant = glm::determinant(normal);
    if (!(std::abs(determinant) > 1e-18 * trace * trace * trace))
        return glm::dvec3(0);
    return -(glm::inverse(normal) * gradient);
}

} // namespace

bool invertible(const glm::dmat3& f)
{
    const double determinant = glm::determinant(f);
    const double size = glm::length(f[0]) * glm::length(f[1]) * glm::length(f[2]);
    return std::isfinite(determinant) && std::abs(determinant) > 1e-9 * size && size > 1e-12;
}

glm::dvec3 solveTexel(std::span<const Demand> demands, glm::dvec3 otherwise)
{
    glm::dvec3 sum(0), first(0);
    std::size_t count = 0;
    for (const Demand& d : demands)
        if (invertible(d.frame)) {
            const glm::dvec3 own = unitOr(glm::inverse(d.frame) * d.target, glm::dvec3(0, 0, 1), kMinLength);
            first = count == 0 ? own : first;
            sum += own;
            ++count;
        }
    if (count == 0)
        return otherwise;
    if (count == 1)
        return first;
    glm::dvec3 texel = unitOr(sum, first, kMinLength);
    double cost = costOf(demands, texel);
    for (int i = 0; i < kMaxIterations && cost > 1e-18; ++i) {
        glm::dvec3 step = stepFrom(demands, texel);
        if (!(glm::length(step) > kMinStep))
            break;
        bool better = false;
        for (int halving = 0; halving < 6 && !better; ++halving, step *= 0.5) {
            const glm::dvec3 tried = unitOr(texel + step, texel, kMinLength);
            const double triedCost = costOf(demands, tried);
            better = triedCost < cost;
            if (better) {
                texel = tried;
                cost = triedCost;
            }
        }
        if (!better)
            break;
    }
    return texel;
}

double degreesOff(const Demand& d, glm::dvec3 texel) { return glm::degrees(angleBetween(d.frame * texel, d.target)); }

// ---- all texels of a map ----------------------------------------------------------------------

namespace {

using convert::SurfacePoint, convert::PointFinder;

struct RowCounts {
    std::size_t covered = 0, padded = 0, several = 0, disagreeing = 0, belowHorizon = 0;
    std::vector<float> moved, disagreement; // degrees, until countAngles
};

// Rows whose angles are held in memory until they are counted.
constexpr int kRowsAtATime = 128;
// Texels whose surface points a thread holds, at most 4 rows of them.
constexpr int kTexelsAtATime = 1 << 14;

class Reencoder {
public:
    Reencoder(const Image& map, std::span<const MapUse> uses, const FramePair& frames, int bits,
              std::optional<Expansion> expansion)
        : map_(map), uses_(uses), frames_(frames), finder_(uses, map.width, map.height), rows_(std::size_t(map.height)),
          owner_(map.pixelCount(), kNoTexel), nearest_(std::size_t(map.height))
    {
        Convention stored = uses.empty() ? Convention{} : uses.front().stored;
        read_ = toFormat<f64::cotan_normal_format>(stored, map.type);
        expansion_ = stored.expansion = expansion.value_or(stored.expansion);
        written_ = toFormat<f64::cotan_normal_format>(stored, 1, bits);
        read_.green = written_.green = 1;
        result_.image = makeImage(map.width, map.height, bits == 16 ? PixelType::unorm16 : PixelType::unorm8, map.name);
    }

    Reencoded run(CountedSteps* rows)
    {
        for (int first = 0; first < map_.height; first += kRowsAtATime) {
            const int last = std::min(first + kRowsAtATime, map_.height);
            eachBlock(first, last, [&](int top, int bottom) {
                if (rows && rows->stopped())
                    return;
                finder_.rows(top, bottom, [&](int y, const SamplesOfRow<SurfacePoint>& row) {
                    solveRow(y, row);
                    if (rows)
                        rows->step();
                });
            });
            countAngles(first, last);
        }
        if (rows && rows->stopped())
            return std::move(result_);
        propagateNearest(owner_, map_.width, map_.height, TieBreak::beside);
        collectSources();
        eachBlock(0, map_.height, [&](int top, int bottom) {
            if (std::all_of(&nearest_[std::size_t(top)], &nearest_[std::size_t(bottom)] + 1,
                            [](const std::vector<PaddingSource>& source) { return source.empty(); }))
                return;
            finder_.rows(top, bottom, [&](int y, const SamplesOfRow<SurfacePoint>& row) {
                for (PaddingSource& source : nearest_[std::size_t(y)])
                    source.point = row.of(std::size_t(source.x)).front();
            });
        });
        parallelFor(0, map_.height, [&](int y) { padRow(y); });
        for (const RowCounts& r : rows_) {
            result_.covered += r.covered;
            result_.padded += r.padded;
            result_.several += r.several;
            result_.disagreeing += r.disagreeing;
            result_.belowHorizon += r.belowHorizon;
        }
        result_.moved = summaryOf(std::move(moved_));
        result_.disagreement = summaryOf(std::move(disagreement_));
        result_.unconverted = mapError(map_, map_, uses_, frames_);
        result_.error = mapError(map_, result_.image, uses_, frames_, expansion_);
        return std::move(result_);
    }

private:
    // The stored direction along (red, green, blue), regardless of the direction of green.
    glm::dvec3 oldTexel(int x, int y) const { return f64::cotan_decode(storedTexel(map_, x, y), read_); }

    Demand demandAt(const SurfacePoint& p, glm::dvec3 old) const
    {
        const MapUse& use = uses_[p.use];
        const f64::cotan_frame from =
            frameAt(use.surface, frames_.from, frames_.fromTangents, p.triangle, p.barycentric);
        const f64::cotan_frame to = frameAt(use.surface, frames_.to, frames_.toTangents, p.triangle, p.barycentric);
        // Factors on the texel's components along t, b and n.
        const glm::dvec3 factors(use.strength, greenAlongV(use.stored) ? use.strength : -use.strength, 1);
        // If the sum vanishes, `mikktspace` returns its n, which is not unit.
        return {{to.t * factors.x, to.b * factors.y, to.n},
                f64::cotan_normalize_or(f64::cotan_apply(from, old * factors), to.n)};
    }

    std::size_t indexOf(int x, int y) const { return std::size_t(y) * std::size_t(map_.width) + std::size_t(x); }

    // Keeps the alpha of the map.
    void put(int x, int y, glm::dvec3 stored)
    {
        const double alpha = atTexel(map_, x, y, [](const auto* c, int scale) { return double(c[3]) / scale; });
        const glm::dvec4 values(stored, alpha);
        for (int k = 0; k < 4; ++k) {
            const std::size_t at = 4 * indexOf(x, y) + std::size_t(k);
            const double value = std::clamp(values[k], 0.0, 1.0);
            if (result_.image.type == PixelType::unorm16)
                result_.image.words()[at] = std::uint16_t(std::lround(value * 65535));
            else
                result_.image.bytes8()[at] = std::uint8_t(std::lround(value * 255));
        }
    }

    void write(int x, int y, glm::dvec3 texel) { put(x, y, f64::cotan_encode_texel(texel, written_)); }

    void keep(int x, int y)
    {
        glm::dvec3 stored = storedTexel(map_, x, y);
        for (int k = 0; k < 3 && read_.expansion != written_.expansion; ++k)
            stored[k] = f64::cotan_compress(f64::cotan_expand(stored[k], read_.expansion), written_.expansion);
        put(x, y, stored);
    }

    // Calls work(top, bottom) for blocks of the rows [first, last), on all threads.
    template<class Work> void eachBlock(int first, int last, const Work& work) const
    {
        const int rows = std::clamp(kTexelsAtATime / map_.width, 1, UvRaster::kBlockRows / 2);
        parallelFor(0, (last - first + rows - 1) / rows,
                    [&](int i) { work(first + i * rows, std::min(first + (i + 1) * rows, last) - 1); });
    }

    void solveRow(int y, const SamplesOfRow<SurfacePoint>& row)
    {
        RowCounts& counts = rows_[std::size_t(y)];
        std::vector<Demand> demands;
        for (int x = 0; x < map_.width; ++x) {
            const std::span<const SurfacePoint> points = row.of(std::size_t(x));
            if (points.empty())
                continue;
            const glm::dvec3 old = oldTexel(x, y);
            demands.clear();
            for (const SurfacePoint& p : points)
                demands.push_back(demandAt(p, old));
            if (std::ranges::none_of(demands, invertible, &Demand::frame)) {
                keep(x, y);
                continue; // not a source of padding
            }
            const glm::dvec3 texel = solveTexel(demands, old);
            write(x, y, texel);
            owner_[indexOf(x, y)] = std::uint32_t(indexOf(x, y));
            if (points.front().covers)
                count(counts, demands, old, texel);
            else
                ++counts.padded;
        }
    }

    static void count(RowCounts& c, const std::vector<Demand>& demands, glm::dvec3 old, glm::dvec3 texel)
    {
        ++c.covered;
        c.several += demands.size() > 1;
        c.belowHorizon += texel.z <= 0;
        double conflict = 0; // degrees at the worst point
        for (const Demand& d : demands)
            conflict = std::max(conflict, invertible(d.frame) ? degreesOff(d, texel) : 0);
        if (conflict > kDisagree) {
            ++c.disagreeing;
            c.disagreement.push_back(float(conflict));
        }
        c.moved.push_back(float(degreesOff({glm::dmat3(1), glm::normalize(old)}, texel)));
    }

    // In the order of rows, so that sums do not depend on the number of threads.
    void countAngles(int first, int last)
    {
        for (int y = first; y < last; ++y) {
            RowCounts& row = rows_[std::size_t(y)];
            for (float degrees : std::exchange(row.moved, {}))
                moved_.add(double(degrees));
            for (float degrees : std::exchange(row.disagreement, {}))
                disagreement_.add(double(degrees));
        }
    }

    // Lists the texels that other texels are padded from; only their surface points are kept.
    void collectSources()
    {
        std::vector<bool> needed(owner_.size());
        for (std::size_t i = 0; i < owner_.size(); ++i)
            if (owner_[i] != kNoTexel && owner_[i] != i)
                needed[owner_[i]] = true;
        for (std::size_t i = 0; i < needed.size(); ++i)
            if (needed[i])
                nearest_[i / std::size_t(map_.width)].push_back({int(i % std::size_t(map_.width)), {}});
    }

    void padRow(int y)
    {
        for (int x = 0; x < map_.width; ++x) {
            const std::size_t i = indexOf(x, y);
            if (owner_[i] == i)
                continue;
            const glm::dvec3 old = oldTexel(x, y);
            if (owner_[i] == kNoTexel || !(old.z > 0)) {
                keep(x, y);
                continue;
            }
            const int column = int(owner_[i] % std::size_t(map_.width));
            const auto source =
                std::ranges::lower_bound(nearest_[owner_[i] / std::size_t(map_.width)], column, {}, &PaddingSource::x);
            const Demand demand = demandAt(source->point, old);
            write(x, y, solveTexel({&demand, 1}, old));
            ++rows_[std::size_t(y)].padded;
        }
    }

    struct PaddingSource {
        int x = 0;
        SurfacePoint point;
    };

    const Image& map_;
    std::span<const MapUse> uses_;
    FramePair frames_;
    f64::cotan_normal_format read_{}, written_{}; // of the map and the result, without what differs between uses
    Expansion expansion_ = Expansion::exact;      // of the result
    PointFinder finder_;
    std::vector<RowCounts> rows_;
    ValueStatistics moved_, disagreement_; // degrees
    std::vector<std::uint32_t> owner_;
    std::vector<std::vector<PaddingSource>> nearest_; // per row, by column
    Reencoded result_;
};

} // namespace

Reencoded reencode(const Image& map, std::span<const MapUse> uses, const FramePair& frames, int bits, int threads,
                   CountedSteps* rows, std::optional<Expansion> expansion)
{
    return withThreads(threads, [&] { return Reencoder(map, uses, frames, bits, expansion).run(rows); });
}

} // namespace cotan
