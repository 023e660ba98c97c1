// Stages besides the vertex and the fragment stage that make what a frame needs, or use it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cotan::cost {

enum class StageKind {
    mesh,    // in place of the vertex stage: each invocation makes a vertex and a triangle of a meshlet at most
    pass,    // compute, per picture or at load: derives from the positions of the mesh
    resolve, // compute, per pixel of a visibility buffer: the whole of shading with one row's frame
};

constexpr std::string_view kindName(StageKind kind)
{
    return kind == StageKind::mesh ? "mesh" : kind == StageKind::pass ? "pass" : "resolve";
}

struct Stage {
    StageKind kind;
    std::string_view name;
    // Bytes that are moved for it, each array counted once, in a closed mesh of two triangles a vertex. Mesh: what is
    // stored of the frame a vertex, and handed on a triangle. Passes: all that is read and written. Resolve: all that
    // is read a pixel.
    int perVertex;
    int perTriangle;
    int perPixel;
    std::span<const std::uint32_t> words;    // SPIR-V
    std::span<const std::uint32_t> consumer; // mesh: a fragment stage that uses all it hands on
};

// Those of one kind stand together; of mesh and resolve the first has no frame.
const std::vector<Stage>& otherStages();

} // namespace cotan::cost
