// Hard edges that texture coordinates do not split. A texel on such an edge belongs to both sides, whose normals, and
// frames, differ: the map can be right for one of them only.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/scene.hpp"

namespace cotan {

// The number of edges at which two triangles meet with the same texture coordinates, and with normals that are more
// than 20 degrees apart at one of the ends. Vertices at the same position are one point. The arrays are those of the
// vertices; three indices per triangle.
std::size_t unsplitHardEdges(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                             std::span<const glm::vec2> uv, std::span<const std::uint32_t> indices);

// What such edges mean, and what helps: the end of a sentence that names them.
inline constexpr const char* kHardEdgeAdvice =
    "hard edges are not split in uv: texels on them belong to both sides, and show a line; split uv at hard edges, or "
    "smooth these";

// One line for each mesh with a normal map that has such edges. beforeBaking: in a scene without normal maps, for each
// mesh with texture coordinates.
std::vector<std::string> hardEdgeHints(const Scene& scene, bool beforeBaking = false);

} // namespace cotan
