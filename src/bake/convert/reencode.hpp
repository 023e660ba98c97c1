// Converts a normal map to another frame: decodes each texel with the old frame at its surface point, and encodes the
// normal with the new one.
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

inline constexpr std::size_t kMaxPointsPerTexel = 16; // of more, evenly chosen ones count
// Per map; larger maps have fewer per texel, at least 4.
inline constexpr std::size_t kMaxPointsPerMap = std::size_t(1) << 24;

struct Reencoded : ReencodeFigures {
    Image image; // as large as the old one
};

// map: with all its data. bits: 8 or 16 per component of the result. expansion: of the result; none: the map's.
// threads: 0 for all cores. rows: counts a step for each row; once it is stopped, the result must not be used. Alpha is
// kept. Texels without meaning (decoded z <= 0 outside all triangles, or on a map that no use covers) stay as they are.
// Images have no mip levels here: viewers make them from the result. The result does not depend on the number of
// threads. `unconverted` and `error` are measured on the surface, since triangles may show a map without covering the
// centre of a texel.
Reencoded reencode(const Image& map, std::span<const MapUse> uses, const FramePair& frames, int bits, int threads = 0,
                   CountedSteps* rows = nullptr, std::optional<Expansion> expansion = {});

// ---- one texel for several surface points -----------------------------------------------------

// The requirement of a surface point: normalize(frame * texel) = target.
struct Demand {
    glm::dmat3 frame{1}; // columns: t and b times the factor on the slopes, n
    glm::dvec3 target{0, 0, 1};
};

// Whether the frame maps different texels to different normals.
bool invertible(const glm::dmat3& frame);

// The unit texel that minimises the sum of |normalize(frame_i * texel) - target_i|^2: exact for one demand, for more by
// Gauss-Newton on the sphere of directions, from the sum of the demands' own texels. Ignores demands whose frame is not
// invertible; returns `otherwise` if no demand remains.
glm::dvec3 solveTexel(std::span<const Demand> demands, glm::dvec3 otherwise);

// Degrees between the target and the normal that the texel gives.
double degreesOff(const Demand& demand, glm::dvec3 texel);

} // namespace cotan
