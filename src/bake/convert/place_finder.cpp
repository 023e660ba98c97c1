#include "place_finder.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cotan::convert {

namespace {

constexpr std::size_t kMinPlaces = 4; // of a texel, however large the map

int foldOf(Wrap wrap) { return wrap == Wrap::mirror ? 2 : 1; }

glm::dvec3 barycentricOf(const UvSample& p) { return {1 - double(p.b1) - double(p.b2), p.b1, p.b2}; }

} // namespace

PlaceFinder::PlaceFinder(std::span<const MapUse> uses, int width, int height)
    : uses_(uses), width_(width), height_(height),
      most_(std::clamp(kMaxAllPlaces / (std::size_t(width) * std::size_t(height)), kMinPlaces, kMaxPlaces))
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
    for (Layer& layer : layers_) { // that stay where they are from now on
        const glm::ivec2 folds(foldOf(layer.wrapU), foldOf(layer.wrapV));
        layer.raster.emplace(UvTriangles{layer.texcoords, layer.indices, 1.0f / glm::vec2(folds)}, width * folds.x,
                             height * folds.y, glm::ivec2(0), /*wrap*/ true);
    }
}

// Uses of one surface come one after the other, as nodes place it.
void PlaceFinder::addTo(Layer& layer, std::uint32_t use)
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

void PlaceFinder::findRow(const Layer& layer, int y, std::vector<std::vector<Found>>& texels) const
{
    const int foldU = foldOf(layer.wrapU), foldV = foldOf(layer.wrapV);
    const auto partOf = [&](std::uint32_t triangle) -> const Part& {
        return *std::prev(std::ranges::upper_bound(layer.parts, triangle, {}, &Part::firstTriangle));
    };
    UvFew few{.most = most_};
    if (layer.wrapU == Wrap::clamp || layer.wrapV == Wrap::clamp)
        few.counts = [&](const UvSample& p) {
            const std::uint32_t* const v = &layer.indices[3 * std::size_t(p.triangle)];
            const glm::dvec2 uv = atCorners(layer.texcoords, v, barycentricOf(p));
            return (layer.wrapU != Wrap::clamp || (uv.x >= 0 && uv.x <= 1))
                && (layer.wrapV != Wrap::clamp || (uv.y >= 0 && uv.y <= 1));
        };
    UvRow row;
    for (int j = 0; j < foldV; ++j) {
        layer.raster->row(j == 0 ? y : 2 * height_ - 1 - y, row, few);
        for (int x = 0; x < width_ * foldU; ++x) {
            auto& texel = texels[std::size_t(x < width_ ? x : 2 * width_ - 1 - x)];
            for (std::uint32_t i = row.first[std::size_t(x)]; i < row.first[std::size_t(x) + 1]; ++i) {
                const UvSample& p = row.places[i];
                const Part& part = partOf(p.triangle);
                const Place place{part.uses.front(), std::uint32_t(p.triangle - part.firstTriangle), barycentricOf(p),
                                  p.covers};
                texel.push_back({&part, std::uint32_t(texel.size()), place});
            }
        }
    }
}

void PlaceFinder::row(int y, std::vector<std::vector<Place>>& texels) const
{
    std::vector<std::vector<Found>> all;
    all.resize(std::size_t(width_));
    for (const Layer& layer : layers_)
        findRow(layer, y, all);
    texels.assign(std::size_t(width_), {});
    for (std::size_t x = 0; x < all.size(); ++x) {
        std::vector<Found>& found = all[x];
        if (std::ranges::any_of(found, [](const Found& f) { return f.place.covers; }))
            std::erase_if(found, [](const Found& f) { return !f.place.covers; });
        std::ranges::sort(found, {}, [](const Found& f) { return std::pair(f.place.use, f.order); });
        std::size_t count = 0; // of all places for all uses: a part's for its first use, then for the next
        for (const Found& f : found)
            count += f.part->uses.size();
        const std::size_t chosen = std::min(count, most_);
        std::size_t before = 0, k = 0;
        for (auto first = found.begin(); first != found.end();) {
            const auto last = std::find_if(first, found.end(), [&](const Found& f) { return f.part != first->part; });
            const auto places = std::size_t(last - first);
            const std::vector<std::uint32_t>& uses = first->part->uses;
            for (; k < chosen && k * count / chosen < before + places * uses.size(); ++k) {
                const std::size_t at = k * count / chosen - before;
                texels[x].push_back(first[std::ptrdiff_t(at % places)].place);
                texels[x].back().use = uses[at / places];
            }
            before += places * uses.size();
            first = last;
        }
    }
}

} // namespace cotan::convert
