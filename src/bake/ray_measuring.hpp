// Measures how far the high surface stands off the low one, for the starts of rays and the bands in which they bend.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/ray_starts.hpp"

namespace cotan {

inline constexpr float kRaySpacing = 1.0f / 256; // of the diagonal: distance between points of large triangles

// Group numbers of vertices, equal for vertices of one instance at one position.
struct VertexGroups {
    std::vector<std::uint32_t> of; // per vertex
    std::uint32_t count = 0;
};

// The low surface and the rest as one tree, and their dimensions.
struct LowBody {
    std::optional<LowTree> tree;
    std::vector<glm::vec3> outwardNormals; // per triangle: unit, on the side of the vertices' normals
    std::vector<std::int64_t> highGroups;  // per triangle: group of the high surface, -1 for all; empty for all
    float diagonal = 0, edge = 0;          // of the bounding box; typical one of a triangle
};

struct StandOff {
    std::vector<float> distances; // per vertex of the low surface
    std::vector<float> needs;     // per hard edge: the distance from it to what its rays must show
    std::size_t every = 1;        // 1: all points were used, 2: every second, because triangles overlap there
};

// starts: directions, skip, limit and tree are read. options: with an extrusion all distances are that. Errors: those
// of makeRayStarts. Uses the threads of the caller.
Result<StandOff> measureStandOff(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                 const LowBody& body, const VertexGroups& groups, const RayStarts& starts,
                                 const HardEdges& edges);

} // namespace cotan
