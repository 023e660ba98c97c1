#include "point_finder.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cotan::convert {

namespace {

constexpr std::size_t kMinPointsPerTexel = 4; // however large the map

int foldOf(Wrap wrap) { return wrap == Wrap::mirror ? 2 : 1; }

glm::dvec3 barycentricOf(const UvSample& p) { return {1 - double(p.b1) - double(p.b2), p.b1, p.b2}; }

} // namespace

PointFinder::PointFinder(std::span<const MapUse> uses, int width, int height)
    : uses_(uses), width_(width), height_(height),
      maxPerTexel_(std::clamp(kMaxPointsPerMap / (std::size_t(width) * std::size_t(height)), kMinPointsPerTexel,
                              kMaxPointsPerTexel))
{
    std::map<std::pair<Wrap, Wrap>, std::vector<std::uint32_t>> byWrap;
    for (std::uint32_t i = 0; i < uses.size(); ++i)
        if (std::abs(uses[i].strength) > kFlattened && uses[i].surface.hasUv())
            byWrap[{uses[i].wrapU, uses[i].wrapV}].push_back(i);
    for (const auto& [wraps, members] : byWrap) {
        Layer& layer = layers_.emplace_back();
        std::tie(layer.wrapU, layer.wrapV) = wraps;
        for (const std::uint32_t use : members)
            addTo(layer, use);
    }
    for (Layer& layer : layers_) { // whose arrays no longer move
        const glm::ivec2 folds(foldOf(layer.wrapU), foldOf(layer.wrapV));
        layer.raster.emplace(UvTriangles{layer.texcoords, layer.indices, 1.0f / glm::vec2(folds)}, width * folds.x,
                             height * folds.y, glm::ivec2(0), /*wrap*/ true);
    }
}

// Uses of one surface are consecutive, one for each placing.
void PointFinder::addTo(Layer& layer, std::uint32_t use)
{
    const MappedSurface& surface = uses_[use].surface;
    if (!layer.parts.empty() && uses_[layer.parts.back().uses.front()].surface.shared == surface.shared)
        return layer.parts.back().uses.push_back(use);
    layer.parts.push_back({layer.indices.size() / 3, {use}});
    const auto base = std::uint32_t(layer.texcoords.size());
    layer.texcoords.insert(layer.texcoords.end(), surface.shared->uv.begin(), surface.shared->uv.end());
    for (const std::uint32_t index : surface.shared->mesh->indices)
        layer.indices.push_back(base + index);
}

UvLimits PointFinder::limitsOf(const Layer& layer) const
{
    UvLimits limits{.maxPerTexel = maxPerTexel_};
    if (layer.wrapU == Wrap::clamp || layer.wrapV == Wrap::clamp)
        limits.accepts = [&](const UvSample& p) {
            const std::uint32_t* const v = &layer.indices[3 * std::size_t(p.triangle)];
            const glm::dvec2 uv = atCorners(layer.texcoords, v, barycentricOf(p));
            return (layer.wrapU != Wrap::clamp || (uv.x >= 0 && uv.x <= 1))
                && (layer.wrapV != Wrap::clamp || (uv.y >= 0 && uv.y <= 1));
        };
    return limits;
}

void PointFinder::addFound(const Layer& layer, const UvRow& row, int x, std::vector<Found>& found) const
{
    const auto add = [&](std::size_t column) {
        for (const UvSample& p : row.of(column)) {
            const Part& part = *std::prev(std::ranges::upper_bound(layer.parts, p.triangle, {}, &Part::firstTriangle));
            const SurfacePoint point{part.uses.front(), std::uint32_t(p.triangle - part.firstTriangle),
                                     barycentricOf(p), p.covers};
            found.push_back({&part, std::uint32_t(found.size()), point});
        }
    };
    add(std::size_t(x));
    if (foldOf(layer.wrapU) == 2)
        add(std::size_t(2 * width_ - 1 - x));
}

void PointFinder::choose(std::vector<Found>& found, std::vector<SurfacePoint>& points) const
{
    if (std::ranges::any_of(found, [](const Found& f) { return f.point.covers; }))
        std::erase_if(found, [](const Found& f) { return !f.point.covers; });
    std::ranges::sort(found, {}, [](const Found& f) { return std::pair(f.point.use, f.order); });
    std::size_t count = 0; // of all points for all uses: a part's for its first use, then for the next
    for (const Found& f : found)
        count += f.part->uses.size();
    const std::size_t chosen = std::min(count, maxPerTexel_);
    std::size_t before = 0, k = 0;
    for (auto first = found.begin(); first != found.end();) {
        const auto last = std::find_if(first, found.end(), [&](const Found& f) { return f.part != first->part; });
        const auto here = std::size_t(last - first);
        const std::vector<std::uint32_t>& uses = first->part->uses;
        for (; k < chosen && k * count / chosen < before + here * uses.size(); ++k) {
            const std::size_t at = k * count / chosen - before;
            points.push_back(first[std::ptrdiff_t(at % here)].point);
            points.back().use = uses[at / here];
        }
        before += here * uses.size();
        first = last;
    }
}

void PointFinder::rows(int first, int last, const RowWork& work) const
{
    struct Drawn {
        const Layer* layer;
        std::vector<UvRow> rows; // from the top down, then the rows that mirror them, from the bottom up
    };
    const auto count = std::size_t(last - first + 1);
    std::vector<Drawn> drawn;
    for (const Layer& layer : layers_) {
        Drawn& d = drawn.emplace_back(Drawn{&layer, std::vector<UvRow>(count * std::size_t(foldOf(layer.wrapV)))});
        const UvLimits limits = limitsOf(layer);
        layer.raster->rows(first, std::span(d.rows).first(count), limits);
        layer.raster->rows(2 * height_ - 1 - last, std::span(d.rows).subspan(count), limits);
        for (UvRow& row : d.rows)
            row.scratch = {}; // frees as much memory as the samples take
    }
    std::vector<Found> found;
    SamplesOfRow<SurfacePoint> row;
    for (std::size_t k = 0; k < count; ++k) {
        row.first.assign(1, 0);
        row.samples.clear();
        for (int x = 0; x < width_; ++x) {
            found.clear();
            for (const Drawn& d : drawn) {
                addFound(*d.layer, d.rows[k], x, found);
                if (d.rows.size() > count)
                    addFound(*d.layer, d.rows[2 * count - 1 - k], x, found);
            }
            choose(found, row.samples);
            row.first.push_back(std::uint32_t(row.samples.size()));
        }
        work(first + int(k), row);
    }
}

} // namespace cotan::convert
