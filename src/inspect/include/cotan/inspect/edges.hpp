// The edges of triangles, and those where texture coordinates break, over a picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/scene/scene.hpp"

namespace cotan {

enum class EdgeKind : std::uint8_t {
    inner,        // uv go on across it
    seam,         // they do not
    mirroredSeam, // and are mirrored on one side
    border,       // of one triangle only
};

struct SurfaceEdge {
    glm::vec3 a{0}, b{0}; // world
    EdgeKind kind = EdgeKind::inner;
};

// Every edge once; vertices at one position count as one. uv: those of the normal map, set 0 where there is none. Of an
// edge of more than two triangles the first two count.
std::vector<SurfaceEdge> surfaceEdges(const Scene& scene);

struct EdgesShown {
    bool triangles = false; // all; grey
    bool seams = false;     // seams in yellow, mirrored ones in magenta, borders in cyan
};

// Draws them one pixel wide where they are not hidden. picture: 8 bits, what the camera sees. depth: a picture of
// Output::depth of the same camera and size.
void drawEdges(Image& picture, const Image& depth, const Camera& camera, std::span<const SurfaceEdge> edges,
               EdgesShown shown);

} // namespace cotan
