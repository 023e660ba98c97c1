// How far a normal map is off when another frame reads it, at places on the surfaces that show it; and whether
// that asks for a new map. `lint` and `convert` both decide by this.
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

// The stored components at column x, row y, as a sampler gives them: unorm as [0,1].
inline glm::dvec3 storedTexel(const Image& image, int x, int y)
{
    return atTexel(image, x, y, [](const auto* c, int most) { return glm::dvec3(c[0], c[1], c[2]) / double(most); });
}

// The texel that a coordinate falls into along one axis: `size` texels, coordinates in [0,1) the image itself.
inline int wrappedTexel(double coordinate, int size, Wrap wrap)
{
    if (!(std::abs(coordinate) <= kFarthestUv))
        return 0;
    return wrapTexel(std::int64_t(std::floor(coordinate * size)), size, wrap);
}

// The decoded texel, nearest filter, finest level.
inline glm::dvec3 decodedAt(const Image& image, Wrap wrapU, Wrap wrapV, const f64::cotan_normal_format& format,
                            glm::dvec2 uv)
{
    return f64::cotan_decode(
        storedTexel(image, wrappedTexel(uv.x, image.width, wrapU), wrappedTexel(uv.y, image.height, wrapV)), format);
}

// ---- places on surfaces, and how far off a map is there --------------------------------------

// A set of values in short, as reports of lint and convert say it. Takes it by value, because a percentile sorts.
inline ValueSummary summaryOf(ValueStatistics values)
{
    return {values.count(), values.mean(), values.percentile(0.95), values.maximum()};
}

// One surface that reads the map, and how.
struct MapUse {
    MappedSurface surface;
    Convention stored;
    double strength = 1; // the material's factor on the slopes; 0: does not count
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
};

// Whether a use shows anything of its map: factors on the slopes below this flatten it.
inline constexpr double kFlattened = 1e-6;

// A point of a triangle mesh.
struct MeshPoint {
    std::size_t triangle = 0;
    glm::dvec3 barycentric{1, 0, 0};
};

// `count` points at equal steps of area, over the triangles that have area in space and in uv; none where no
// triangle has. The same for the same surface. area: gets that of these triangles; may be null.
std::vector<MeshPoint> pointsOver(const MappedSurface& surface, std::size_t count, double* area = nullptr);

// Degrees between the normals that frames.from makes of `before` and those that frames.to makes of `after`, at
// points spread over the surfaces, weighted by area. Nearest texel of the finest level. Both images: with all
// their data, of any sizes; `after` is stored with the expansion given, or as `before`. Empty (count 0) where no use
// shows anything: no triangle with area in space and uv.
ValueSummary mapError(const Image& before, const Image& after, std::span<const MapUse> uses, const FramePair& frames,
                      std::optional<Expansion> expansionAfter = {});

// The points of one surface by which single figures of a primitive are measured.
inline constexpr std::size_t kPointsOfSurface = 4096;

// The same for several pairs of frames, at the same points. points: of a surface at most; fewer of many surfaces.
std::vector<ValueSummary> mapErrors(const Image& before, const Image& after, std::span<const MapUse> uses,
                                    std::span<const FramePair> frames, std::optional<Expansion> expansionAfter = {},
                                    std::size_t points = kPointsOfSurface);

// How many points each of so many surfaces has: together no more than 128 have at kPointsOfSurface, while each has 16.
std::size_t pointsOfEach(std::size_t surfaces);

// Degrees between the ways in which frames.from and frames.to stretch highlights (KHR_materials_anisotropy), as lines,
// at points spread over the surface (pointsOver). Empty where there are none, or a frame has no direction.
ValueSummary directionTurn(const MappedSurface& surface, const std::vector<MeshPoint>& points, const FramePair& frames);

// What of a surface has to be derived for mapError and directionTurn with frames.from and frames.to. stored: whether
// the surface has tangents of its file.
FrameSet framesRead(const FramePair& frames, bool stored);

// Degrees, of 95 % of the area: a streak that turns by less is still the same streak.
inline constexpr double kTurnedDirection = 5;

// Whether highlights stay stretched as they are, being turned by so much.
inline bool directionStays(const ValueSummary& turn) { return turn.percentile95 <= kTurnedDirection; }

// Degrees, of 95 % of the area: what writing a map anew in 8 bits costs by itself.
inline constexpr double kAsRounding = 0.3;

// Whether a map stays as it is, being off by so much when it is read with the new frame: where a new one, rounded,
// would be no better, and where nothing shows it.
inline bool fitsAsItIs(const ValueSummary& off) { return !(off.percentile95 > kAsRounding); }

} // namespace cotan
