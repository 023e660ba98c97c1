// Makes a normal map for another frame than the one it was made for: decodes each texel with the old
// frame at its place on the surface, and encodes the normal with the new one.
#pragma once

#include <cstddef>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "bake/lint/map_fit.hpp"
#include "cotan/convert.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/result.hpp"

namespace cotan {

inline constexpr std::size_t kMaxPlaces = 16; // of one texel; of more, some that are spread over all count
// Of a map; larger ones have fewer of a texel, 4 at least.
inline constexpr std::size_t kMaxAllPlaces = std::size_t(1) << 24;

struct Reencoded : ReencodeFigures {
    Image image; // as large as the old one
};

// map: with all its data. bits: 8 or 16 a component of the result. expansion: of the result; none: as the map's.
// threads: 0 for all cores. rows: gets a step for each row; once it is stopped, the result is not to be used. Alpha is
// kept; texels that stand for nothing (decoded z <= 0 where no triangle is, or a map that no use covers) are kept as
// they are. Mip levels are not part of an image here: viewers make them from the result. The same result whatever the
// number of threads. `unconverted` and `error` are measured on the surface: a map may be shown without any triangle
// covering the centre of a texel.
Reencoded reencode(const Image& map, std::span<const MapUse> uses, const FramePair& frames, int bits, int threads = 0,
                   CountedSteps* rows = nullptr, std::optional<Expansion> expansion = {});

// ---- the one texel that several places of a surface share -------------------------------------

// What a place wants: normalize(frame * texel) = target.
struct Demand {
    glm::dmat3 frame{1}; // columns: t and b times the factor on the slopes, n
    glm::dvec3 target{0, 0, 1};
};

// Whether the frame turns different texels into different normals.
bool invertible(const glm::dmat3& frame);

// The unit texel that minimises the sum of |normalize(frame_i * texel) - target_i|^2: exact for one
// place, Gauss-Newton on the sphere of directions from the sum of the places' own texels for more.
// Demands whose frame is not invertible are left out; `otherwise` where there is no other.
glm::dvec3 solveTexel(std::span<const Demand> demands, glm::dvec3 otherwise);

// Degrees between what the place wants and what it gets.
double degreesOff(const Demand& demand, glm::dvec3 texel);

} // namespace cotan
