#include "bake/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/baker.hpp"
#include "bake/surface/uv_raster.hpp"
#include "core/loops.hpp"

namespace cotan {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kSmallest = 2e-4; // of the covered texels: smaller problems do not count
constexpr float kHorizon = -0.1f;  // z of a normal 6 degrees below the horizon; less is interpolation at its rim
constexpr double kSameDegrees = 5; // normals that differ less share a texel without being seen
constexpr int kGrid = 256;         // cells along a map's side at which shared texels are compared
constexpr std::size_t kMaxProblems = 3;

// The texels of a map, or cells of several texels, that a problem is about.
struct Marks {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bad;
    std::vector<float> degrees; // of cells

    Marks(int w, int h) : width(w), height(h), bad(std::size_t(w) * std::size_t(h)) {}
    bool at(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height && bad[index(x, y)]; }
    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width) + std::size_t(x); }
};

struct Areas {
    std::size_t marks = 0, largest = 0; // in areas that hold a square of 3 x 3, and in the largest of these
    double degrees = 0;                 // mean
    glm::ivec2 at{0, 0};                // the middle of such a square in the largest area
};

bool isMiddle(const Marks& m, int x, int y)
{
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (!m.at(x + dx, y + dy))
                return false;
    return true;
}

// Unmarks narrow areas, and measures the others. degreesOf: of a mark with this index.
template<class Degrees> Areas areasOf(Marks& m, const Degrees& degreesOf)
{
    constexpr std::uint8_t kCounted = 2;
    Areas areas;
    std::vector<glm::ivec2> open;
    for (int y = 0; y < m.height; ++y)
        for (int x = 0; x < m.width; ++x) {
            if (m.bad[m.index(x, y)] != 1 || !isMiddle(m, x, y))
                continue;
            std::size_t size = 0;
            open.assign(1, {x, y});
            m.bad[m.index(x, y)] = kCounted;
            while (!open.empty()) {
                const glm::ivec2 p = open.back();
                open.pop_back();
                ++size;
                areas.degrees += double(degreesOf(m.index(p.x, p.y)));
                for (const glm::ivec2 d : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
                    if (const glm::ivec2 q = p + d; m.at(q.x, q.y) && m.bad[m.index(q.x, q.y)] == 1) {
                        m.bad[m.index(q.x, q.y)] = kCounted;
                        open.push_back(q);
                    }
            }
            areas.marks += size;
            if (size > areas.largest) {
                areas.largest = size;
                areas.at = {x, y};
            }
        }
    for (std::uint8_t& bad : m.bad)
        bad = bad == kCounted;
    areas.degrees = areas.marks > 0 ? areas.degrees / double(areas.marks) : 0;
    return areas;
}

// The areas of the texels for which isBad(index) holds.
template<class Test> Areas areasWhere(const Baked& baked, const Test& isBad)
{
    Marks marks(baked.width, baked.height);
    for (std::size_t i = 0; i < marks.bad.size(); ++i)
        marks.bad[i] = isBad(i);
    return areasOf(marks, [](std::size_t) { return 0.0f; });
}

// The areas of the texels of a map of normals that point below the horizon, by the degrees below it.
Areas areasBelowHorizon(const Baked& normals)
{
    Marks marks(normals.width, normals.height);
    for (const auto& [texel, z] : normals.below)
        marks.bad[texel] = z < kHorizon;
    return areasOf(marks, [&](std::size_t i) {
        const auto below = std::lower_bound(normals.below.begin(), normals.below.end(), i,
                                            [](const Baked::Below& b, std::size_t texel) { return b.texel < texel; });
        return float(std::asin(double(std::min(-below->z, 1.0f))) * kDegrees);
    });
}

struct TracedCells { // rays of the same number of cells
    std::vector<UvSample> samples;
    LowPoints points;
    Probes probes;
    Hits hits;
};

// Marks cells of `step` texels, some of those in which at least `each` triangles lie. examine(marks, cells, traced):
// gets up to kLanes cells, and for each of the first `each` triangles what a ray of it finds.
template<std::size_t each, class Examine>
Marks marksOf(const LowSurface& low, const Baker& baker, const std::vector<std::uint32_t>& indices,
              const BakeOptions& options, int step, const Examine& examine)
{
    Marks marks((options.width + step - 1) / step, (options.height + step - 1) / step);
    marks.degrees.resize(marks.bad.size());
    const UvRaster raster({low.texcoords, indices}, marks.width, marks.height, options.tile);
    const UvLimits limits{.maxPerTexel = each, .accepts = [](const UvSample& s) { return s.covers; }};
    parallelRanges(0, marks.height, UvRaster::kBlockRows, [&](int begin, int end) {
        std::vector<UvRow> rows(static_cast<std::size_t>(end - begin));
        raster.rows(begin, rows, limits);
        std::array<TracedCells, each> traced;
        std::vector<std::size_t> cells;
        const auto trace = [&] {
            for (TracedCells& t : traced) {
                pointsOf(low, t.samples, t.points);
                baker.aim(t.points, t.samples, t.probes);
                baker.find(t.samples, t.probes, t.hits);
            }
            examine(marks, cells, traced);
            for (TracedCells& t : traced)
                t.samples.clear();
            cells.clear();
        };
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < marks.width; ++x) {
                const auto samples = rows[std::size_t(y - begin)].of(std::size_t(x));
                if (samples.size() < each)
                    continue;
                for (std::size_t k = 0; k < each; ++k)
                    traced[k].samples.push_back(samples[k]);
                cells.push_back(marks.index(x, y));
                if (cells.size() == kLanes)
                    trace();
            }
        if (!cells.empty())
            trace();
    });
    return marks;
}

// Marks cells in which two triangles want normals that differ, in the frame or in the world.
Marks disputes(const LowSurface& low, const Baker& baker, const std::vector<std::uint32_t>& indices,
               const BakeOptions& options, bool inWorld, int step)
{
    const auto compare = [&](Marks& marks, const std::vector<std::size_t>& cells,
                             const std::array<TracedCells, 2>& traced) {
        std::array<Lanes3, 2> normals;
        for (std::size_t k = 0; k < 2; ++k)
            baker.valuesOf(inWorld ? BakeKind::objectNormal : BakeKind::normal, traced[k].points, traced[k].probes,
                           traced[k].hits, {}, {}, normals[k]);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const glm::dvec3 a = normals[0].at(i), b = normals[1].at(i);
            const double degrees = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegrees;
            if (!traced[0].hits.found(i) || !traced[1].hits.found(i) || !(degrees > kSameDegrees))
                continue;
            marks.bad[cells[i]] = 1;
            marks.degrees[cells[i]] = float(degrees);
        }
    };
    return marksOf<2>(low, baker, indices, options, step, compare);
}

// Marks cells whose rays find the high surface beyond another part of the low surface, of which the cell sees the
// front. A cell that sees a back lies in that part, where nobody sees it.
Marks beyondParts(const LowSurface& low, const Baker& baker, const std::vector<std::uint32_t>& indices,
                  const BakeOptions& options, int step)
{
    const RayStarts& starts = *options.starts;
    const auto look = [&](Marks& marks, const std::vector<std::size_t>& cells,
                          const std::array<TracedCells, 1>& traced) {
        const auto& [samples, points, probes, hits] = traced[0];
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const float off = hits.distance[i]; // beyond the ray's start it is one of a second ray, from further out
            if (!hits.found(i) || !(off > starts.skip) || off > probes.before[i])
                continue;
            const glm::vec3 out = probes.direction.at(i);
            const LowTree::TreeHit part =
                starts.passed->firstBeside(samples[i].triangle, {probes.point.at(i), out, starts.skip, off});
            marks.bad[cells[i]] = part.found && glm::dot(starts.passed->face(part.triangle), out) < 0 ? 1 : 0;
        }
    };
    return marksOf<1>(low, baker, indices, options, step, look);
}

BakeProblem problemOf(BakeProblem::Kind kind, const Areas& areas, std::size_t texelsOfMark = 1, int step = 1)
{
    return {.kind = kind,
            .texels = areas.marks * texelsOfMark,
            .degrees = areas.degrees,
            .at = areas.at * step + step / 2,
            .text = {}};
}

// What happened, and what helps.
std::string textOf(const BakeProblem& p, const BakeOptions& options, const BakeStatistics& s)
{
    const std::string where =
        fmt::format("{} of {} covered texels, most of them around texel {}, {},", p.texels, s.covered, p.at.x, p.at.y);
    switch (p.kind) {
    case BakeProblem::Kind::noSurface:
        return where
            + " have no high surface in front or behind at any distance: it has holes, or ends before the low mesh "
              "does";
    case BakeProblem::Kind::tooFar:
        return options.cage.empty() ? fmt::format("{} found no high surface within {:g} units; there is one further "
                                                  "away: search further, or use a cage",
                                                  where, s.rayDistance)
                                    : where
                + " found no high surface within the reach of the cage; there is one further away: move the cage "
                  "further out";
    case BakeProblem::Kind::belowHorizon:
        return fmt::format("{} point below the frame's horizon, by {:.0f} degrees on average: the low mesh is too "
                           "coarse there, or rays hit another part: split it there, or use a cage",
                           where, p.degrees);
    case BakeProblem::Kind::beyondPart:
        return fmt::format(
            "{} show another part: rays start {:g} units in front of the low mesh, beyond that part: start "
            "them nearer, or give no distance, so that it is measured",
            where, options.extrusion);
    default:
        return fmt::format("{} are shared by triangles that need normals {:.0f} degrees apart on average; the first in "
                           "the file won: give each its own texture coordinates",
                           where, p.degrees);
    }
}

} // namespace

std::vector<BakeProblem> problemsOf(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                    const std::vector<BakeKind>& kinds, std::vector<Baked>& maps)
{
    using enum BakeProblem::Kind;
    Baked& first = maps.front();
    BakeStatistics& s = first.statistics;
    std::vector<BakeProblem> problems;
    const auto lacks = [&](std::size_t i, int flags) {
        const int state = first.states[i] & (texelCovered | texelMissed | texelFurther);
        return state == flags && !first.hasValue(first, i);
    };
    if (s.missed > s.further)
        problems.push_back(problemOf(
            noSurface, areasWhere(first, [&](std::size_t i) { return lacks(i, texelCovered | texelMissed); })));
    if (s.further > 0)
        problems.push_back(problemOf(tooFar, areasWhere(first, [&](std::size_t i) {
                                         return lacks(i, texelCovered | texelMissed | texelFurther);
                                     })));
    const auto normals = std::ranges::find(kinds, BakeKind::normal);
    if (s.negative > 0 && normals != kinds.end())
        problems.push_back(problemOf(belowHorizon, areasBelowHorizon(maps[std::size_t(normals - kinds.begin())])));
    const bool shares = s.twice > 0, passes = options.starts && options.starts->passed;
    const auto drawn = shares || passes ? indicesToDraw(low, {options.width, options.height})
                                        : Result<std::vector<std::uint32_t>>(std::vector<std::uint32_t>());
    const int step = std::max(1, std::min(options.width, options.height) / kGrid);
    if (drawn && !drawn->empty() && passes) {
        Marks marks(0, 0);
        withThreads(options.threads,
                    [&] { marks = beyondParts(low, Baker(low, high, options), *drawn, options, step); });
        problems.push_back(problemOf(beyondPart, areasOf(marks, [](std::size_t) { return 0.0f; }),
                                     std::size_t(step) * std::size_t(step), step));
        problems.back().texels = std::min(problems.back().texels, s.covered);
    }
    if (drawn && !drawn->empty() && shares) {
        const bool inWorld = std::ranges::any_of(kinds, [](BakeKind kind) {
            return kind == BakeKind::objectNormal || kind == BakeKind::objectBentNormal || kind == BakeKind::position;
        });
        Marks marks(0, 0);
        withThreads(options.threads,
                    [&] { marks = disputes(low, Baker(low, high, options), *drawn, options, inWorld, step); });
        problems.push_back(problemOf(disputed, areasOf(marks, [&](std::size_t i) { return marks.degrees[i]; }),
                                     std::size_t(step) * std::size_t(step), step));
        problems.back().texels = std::min(problems.back().texels, s.twice);
        for (Baked& map : maps)
            map.statistics.disputed = problems.back().texels;
        for (int y = 0; y < first.height; ++y)
            for (int x = 0; x < first.width; ++x)
                if (std::uint8_t& state = first.states[std::size_t(y) * std::size_t(first.width) + std::size_t(x)];
                    (state & texelOverlapped) != 0 && !marks.at(x / step, y / step))
                    state = std::uint8_t(state & ~texelOverlapped);
    }
    std::erase_if(problems, [&](const BakeProblem& p) { return double(p.texels) <= kSmallest * double(s.covered); });
    std::stable_sort(problems.begin(), problems.end(),
                     [](const BakeProblem& a, const BakeProblem& b) { return a.texels > b.texels; });
    if (problems.size() > kMaxProblems)
        problems.resize(kMaxProblems);
    for (BakeProblem& p : problems)
        p.text = textOf(p, options, s);
    return problems;
}

std::string verdictOf(const std::vector<BakeProblem>& problems, const BakeStatistics& s)
{
    if (!problems.empty())
        return fmt::format("look at the map before you use it: {} above",
                           problems.size() == 1 ? "one problem" : fmt::format("{} problems", problems.size()));
    if (s.covered == 0)
        return "no texel is covered";
    return fmt::format("usable: {} texels covered; {} without a high surface, {} below the horizon and {} shared by "
                       "triangles that differ",
                       s.covered, s.missed, s.negative, s.disputed);
}

} // namespace cotan
