// Bakes a detailed surface to a map on a simple one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/high_materials.hpp"
#include "bake/high_normal_maps.hpp"
#include "bake/high_surface.hpp"
#include "bake/ray_starts.hpp"
#include "bake/surface/low_surface.hpp"
#include "cotan/bake.hpp"
#include "cotan/result.hpp"

namespace cotan {

// A baked map before it is stored: for each texel a unit texel m, a world direction, a scalar or the 0xrrggbb of an id
// in x with 1 in z, 1 plus the fraction of the high surface's box at which a position lies, 1 plus a linear colour, or
// (1, roughness, metallic); zero if none was found.
struct Baked {
    int width = 0, height = 0;
    std::vector<glm::vec3> values;
    std::vector<std::uint8_t> states; // of the first map of a bake; empty in others
    BakeStatistics statistics;
    Bounds box = {};                      // of the high surface
    float unit = 0;                       // curvature: radius, thickness: length, which is stored as 1
    Image image = {};                     // instead of the values: the map as storeBaked would store it
    std::vector<std::uint8_t> found = {}; // of the first map, if any has an image: per texel, 1 if a ray hit something
    std::vector<std::uint32_t> cancelled = {}; // with an image: texels without a value though rays hit something, since
                                               // their directions cancel out; in increasing order
    struct Below {
        std::uint32_t texel;
        float z;
    };
    std::vector<Below> below = {}; // of a map of normals: texels that point below the horizon; in increasing order

    // Whether texel i has a value. first: the first map of the bake.
    bool hasValue(const Baked& first, std::size_t i) const
    {
        return values.empty() ? first.found[i] != 0
                && (cancelled.empty() || !std::binary_search(cancelled.begin(), cancelled.end(), std::uint32_t(i)))
                              : values[i] != glm::vec3(0);
    }
};

// Whether the values of a kind are 1 plus a linear colour.
inline bool holdsColors(BakeKind kind) { return kind == BakeKind::baseColor || kind == BakeKind::emissive; }

// Bakes a map. Calls `progress` from several threads after each row. The result does not depend on the number of
// threads. options: frame, cage and starts must belong to the low surface. Errors: those of makeRayStarts;
// ErrorKind::input if triangles overlap in too many rows of texels; ErrorKind::stopped.
Result<Baked> bake(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                   const Progress& progress = {});

// The same for several kinds, of which options.kind need not be one: rays that find the high surface are traced once.
// Each map is what bake() gives for its kind, to the byte. images: how each map is stored that gets Baked::image, which
// takes less memory and time; empty: none. Not for dithered maps and heights in integers.
Result<std::vector<Baked>> bakeMaps(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                    const std::vector<BakeKind>& kinds, const Progress& progress = {},
                                    const std::vector<std::optional<StoredAs>>& images = {});

// Vertex indices of the triangles to rasterise with UvRaster::firsts for an image of that size. Errors:
// ErrorKind::input if triangles overlap in too many rows of texels.
Result<std::vector<std::uint32_t>> indicesToDraw(const LowSurface& low, glm::ivec2 size);

// Tiles of texture coordinates have the UDIM numbers 1001 + u + 10 v, v upwards from the bottom of the first tile.
inline constexpr int kFirstUdim = 1001, kLastUdim = 1999, kUdimColumns = 10;

// The numbers up to kLastUdim of the tiles on which triangles lie that a bake draws, in increasing order.
// outside: receives the number of triangles of which a part lies on none of these tiles, if not null.
std::vector<int> tilesOf(const LowSurface& low, std::size_t* outside = nullptr);

// Measures options.starts if it is null and bake() needs it. Errors: those of makeRayStarts.
Status measureRayStarts(const LowSurface& low, const HighSurface& high, BakeOptions& options, const LowRest& rest = {});

// Fills texels without a value from the nearest texel with one, at most `radius` texels away (0: no limit). Of equally
// near texels the upper one wins, then the left one. Every texel then belongs to its nearest chart. Several maps: of
// one bake; those that have values in the same texels, as nearly all have, are filled from the same ones.
void padCharts(Baked& baked, int radius);
void padCharts(std::vector<Baked>& maps, int radius);

// The format that storeBaked writes for `format`: object-space normals need three channels and have no green to flip.
Convention storedFormat(BakeKind kind, Convention format);

// The image of a baked map. Directions are stored by the format; others, except in float, as BakedMap::image says,
// scalars as grey. Texels without a value become flat normals or zero.
Image storeBaked(const Baked& baked, BakeKind kind, const StoredAs& as);

// The image that storeBaked makes of a map without values, and what then stores the values of some texels in it, not
// dithered. baked: its size, box and unit. Not for heights in integers.
Image emptyImage(const Baked& baked, BakeKind kind, const StoredAs& as);
using StoreTexels =
    std::function<void(std::span<const std::uint32_t> texels, std::span<const glm::vec3> values, Image& image)>;
StoreTexels texelStore(const Baked& baked, BakeKind kind, const StoredAs& as);

// The channels of a packed map as one image, each as storeBaked stores its kind. maps: of these kinds; images in them
// have the type of `as`.
Image packMaps(const std::vector<Baked>& maps, const std::vector<BakeKind>& kinds, const PackedMap& packed,
               const StoredAs& as);

// The colours of a mask. A texel has that of the first of its states.
struct MaskColor {
    std::uint8_t state; // a TexelState
    glm::vec3 color;    // sRGB
    std::string_view meaning;
};
std::span<const MaskColor> maskColors();

// Texel states as these colours; black without one.
Image maskOf(const Baked& baked);

// ---- the steps of bakeModel -------------------------------------------------------------------

// For callers that work between the steps: everything is prepared once, then each tile is baked.

// Input of a bake.
struct BakeSetup {
    LowSurface low;
    HighSurface high;
    BakeModelOptions options;          // with the derived values in `bake`; `cage` and `others` are null
    std::vector<std::string> warnings; // one line each; those about an option begin with "options.NAME: "
};

// The detailed side of bakes.
struct DetailedSurface {
    HighSurface surface;
    std::shared_ptr<const HighNormalMaps> maps;     // null: none are read
    std::shared_ptr<const HighMaterials> materials; // null: no kind reads them
    std::vector<std::string> names;                 // of the instances with triangles
    BakeModelOptions options;                       // that it was opened with
    std::vector<std::string> warnings;
};

// Whether the maps of a tile fit into options.memory; called by prepareBake. Errors: ErrorKind::input.
Status checkMapMemory(const BakeModelOptions& options);

// Derives what the frame needs on the simple scene, and builds the acceleration structure of the detailed scenes, the
// cage's vertices and the matches. Errors: those of checkScene, makeLowSurface, HighSurface::make,
// HighNormalMaps::make and HighMaterials::make. An error about an option begins with its name, "options.material: ".
// ErrorKind::usage: a size, number of samples, frame, distance, number of rays, material or number of maps out of
// range, no tile, and an extrusion or the search `nearest` together with a cage. ErrorKind::input: a cage with another
// number of triangles, a mesh without its match.
Result<BakeSetup> prepareBake(const Scene& low, HighModel high, const BakeModelOptions& options);
Result<BakeSetup> prepareBake(const Scene& low, std::shared_ptr<const DetailedSurface> high,
                              const BakeModelOptions& options);

// Bakes the kinds of one tile, fills around its charts and stores them; of the masks the first map has one. Calls
// `progress` from several threads, not always in order. Errors: ErrorKind::input if no triangle lies on the tile,
// ErrorKind::usage for a number below kFirstUdim, both beginning with "options.tiles: "; ErrorKind::stopped.
Result<std::vector<BakedMap>> bakeTile(const BakeSetup& setup, int tile, const Progress& progress = {});

} // namespace cotan
