// Measures the error of a normal map that another frame reads, at points on the surfaces that show it, and decides
// whether that requires a new map. Used by both `lint` and `convert`.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/surface/mapped_surface.hpp"
#include "core/value_statistics.hpp"
#include "cotan/convention.hpp"
#include "cotan/convert.hpp"
#include "cotan/lint.hpp"
#include "cotan/portable.hpp"
#include "cotan/scene.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

// ---- texels ----------------------------------------------------------------------------------

// The stored components at column x, row y, as a sampler returns them: unorm as [0,1].
inline glm::dvec3 storedTexel(const Image& image, int x, int y)
{
    return atTexel(image, x, y, [](const auto* c, int scale) { return glm::dvec3(c[0], c[1], c[2]) / double(scale); });
}

// The texel that a coordinate falls into along an axis of `size` texels. The image itself is [0,1).
inline int wrappedTexel(double coordinate, int size, Wrap wrap)
{
    if (!(std::abs(coordinate) <= kFarthestUv))
        return 0;
    return wrapTexel(std::int64_t(std::floor(coordinate * size)), size, wrap);
}

// The decoded texel: nearest filter, finest level.
inline glm::dvec3 decodedAt(const Image& image, Wrap wrapU, Wrap wrapV, const f64::cotan_normal_format& format,
                            glm::dvec2 uv)
{
    return f64::cotan_decode(
        storedTexel(image, wrappedTexel(uv.x, image.width, wrapU), wrappedTexel(uv.y, image.height, wrapV)), format);
}

// ---- points on surfaces, and the error of a map there ----------------------------------------

// Summarises values for the reports of lint and convert. Takes them by value, because a percentile sorts them.
inline ValueSummary summaryOf(ValueStatistics values)
{
    return {values.count(), values.mean(), values.percentile(0.95), values.maximum()};
}

// A surface that reads the map, and how.
struct MapUse {
    MappedSurface surface;
    Convention stored;
    double strength = 1; // the material's factor on the slopes; 0: does not count
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    std::optional<Frame> readWith{}; // in place of FramePair::to
};

// A use shows nothing of its map if its factor on the slopes is below this.
inline constexpr double kFlattened = 1e-6;

// A point of a triangle mesh.
struct MeshPoint {
    std::size_t triangle = 0;
    glm::dvec3 barycentric{1, 0, 0};
};

// `count` points at equal steps of area, over the triangles that have area in space and in uv; none if no triangle has.
// Deterministic. area: receives the area of these triangles; may be null.
std::vector<MeshPoint> pointsOver(const MappedSurface& surface, std::size_t count, double* area = nullptr);

// The number of points of one surface for the statistics of a primitive.
inline constexpr std::size_t kPointsOfSurface = 4096;

// For each pair of frames, degrees between the normals that pair.from makes of `before` and those that pair.to makes of
// `after`, at points spread over the surfaces, weighted by area. Reads the nearest texel of the finest level. Both
// images need all their data, and may differ in size; `after` is stored with the given expansion, or as `before`.
// points: maximum per surface; many surfaces get fewer. Empty (count 0) if no use shows anything: no triangle with area
// in space and uv.
std::vector<ValueSummary> mapErrors(const Image& before, const Image& after, std::span<const MapUse> uses,
                                    std::span<const FramePair> frames, std::optional<Expansion> expansionAfter = {},
                                    std::size_t points = kPointsOfSurface);

// The same for one pair.
inline ValueSummary mapError(const Image& before, const Image& after, std::span<const MapUse> uses,
                             const FramePair& frames, std::optional<Expansion> expansionAfter = {},
                             std::size_t points = kPointsOfSurface)
{
    return mapErrors(before, after, uses, {&frames, 1}, expansionAfter, points).front();
}

// The number of points per surface: at most 128 * kPointsOfSurface in all, but at least 16 per surface.
std::size_t pointsOfEach(std::size_t surfaces);

// Degrees between the directions of anisotropic highlights (KHR_materials_anisotropy) with frames.from and frames.to,
// as lines, at points spread over the surface (pointsOver). Empty without points, or if a frame has no direction.
ValueSummary directionTurn(const MappedSurface& surface, const std::vector<MeshPoint>& points, const FramePair& frames);

// The frames that a surface has to prepare for mapError and directionTurn with frames.from and frames.to. stored:
// whether the surface has the file's tangents.
FrameSet framesRead(const FramePair& frames, bool stored);

// Degrees, on 95 % of the area: anisotropic highlights that rotate by less look the same.
inline constexpr double kTurnedDirection = 5;

// Whether anisotropic highlights look the same after this rotation.
inline bool directionStays(const ValueSummary& turn) { return turn.percentile95 <= kTurnedDirection; }

// Degrees, on 95 % of the area: the error of rounding a new map to 8 bits.
inline constexpr double kAsRounding = 0.3;

// Whether a map with this error under the new frame needs no conversion: rounding costs as much, or nothing shows it.
inline bool fitsAsItIs(const ValueSummary& off) { return !(off.percentile95 > kAsRounding); }

} // namespace cotan
