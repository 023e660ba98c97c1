// Stages other than vertex and fragment that derive or use the data of a frame.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cotan::cost {

enum class StageKind {
    mesh,    // replaces the vertex stage: each invocation outputs at most one vertex and one triangle of a meshlet
    pass,    // compute, per frame or at load time: derives data from the positions of the mesh
    resolve, // compute, per pixel of a visibility buffer: all of the shading with one row's frame
    beyond,  // fragment, with the frame `gradient`: specular antialiasing and parallax
};

constexpr std::string_view kindName(StageKind kind)
{
    return kind == StageKind::mesh   ? "mesh"
        : kind == StageKind::pass    ? "pass"
        : kind == StageKind::resolve ? "resolve"
                                     : "beyond";
}

struct Stage {
    StageKind kind;
    std::string_view name;
    // Bytes moved, each array counted once, in a closed mesh with two triangles per vertex. Mesh: frame data stored per
    // vertex and output per triangle. Pass: everything read and written. Resolve: everything read per pixel. Beyond:
    // texels read per pixel.
    int perVertex;
    int perTriangle;
    int perPixel;
    std::span<const std::uint32_t> words;    // SPIR-V
    std::span<const std::uint32_t> consumer; // mesh: a fragment stage that uses all of its outputs
};

// Stages of one kind are consecutive; the first mesh and the first resolve stage have no frame, and the first
// stage beyond adds nothing to it.
const std::vector<Stage>& otherStages();

} // namespace cotan::cost
