#include "bake/bake_model.hpp"

#include <chrono>

#include <fmt/format.h>

namespace cotan {

namespace {

constexpr int kFirstUdim = 1001; // 1001 + u + 10 v, v upwards
constexpr int kUdimColumns = 10;

// The unit square of uv of a UDIM tile. The numbers count v upwards from the bottom of the first
// tile, our v runs down from its top.
glm::ivec2 squareOf(int udim)
{
    const int n = udim - kFirstUdim;
    return {n % kUdimColumns, -(n / kUdimColumns)};
}

} // namespace

Result<BakedMap> bakeTile(const BakeSetup& setup, int tile, const Progress& progress)
{
    if (tile < kFirstUdim)
        return about("options.tiles",
                     usageError(fmt::format("expected numbers from {} on; found {}", kFirstUdim, tile)));
    BakeOptions options = setup.options.bake;
    options.tile = squareOf(tile);
    auto baked = bake(setup.low, setup.high, options, progress);
    if (!baked)
        return baked.error();
    if (baked->statistics.covered + baked->statistics.touched == 0)
        return about("options.tiles",
                     inputError(fmt::format("no triangle lies on tile {} of the texture coordinates", tile)));
    const auto start = std::chrono::steady_clock::now();
    if (setup.options.padding >= 0)
        padCharts(*baked, setup.options.padding);
    baked->statistics.padSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    BakedMap map;
    map.tile = tile;
    map.image = storeBaked(*baked, options.kind, setup.options.stored);
    if (options.kind == BakeKind::normal)
        map.image.frame = name(options.frame);
    map.format = storedFormat(options.kind, setup.options.stored.format);
    if (setup.options.mask)
        map.mask = maskOf(*baked);
    map.statistics = baked->statistics;
    return map;
}

Result<BakedModel> bakeModel(const Scene& low, HighModel high, const BakeModelOptions& options,
                             const Progress& progress)
{
    auto setup = prepareBake(low, std::move(high), options);
    if (!setup)
        return setup.error();
    BakedModel model;
    model.warnings = std::move(setup->warnings);
    for (const int tile : options.tiles) {
        auto map = bakeTile(*setup, tile, partOf(progress, model.maps.size(), options.tiles.size()));
        if (!map)
            return map.error();
        model.maps.push_back(std::move(*map));
    }
    return model;
}

} // namespace cotan
