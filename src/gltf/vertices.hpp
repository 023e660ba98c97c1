// The corners of a primitive's triangles, and the vertices of its accessors that they use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cotan {

// Three corners a triangle. order: those of a list, strip or fan (see gltf::Primitive::mode); other modes have no
// triangles. Strips and fans jump by triangles without area: those that join two equal vertices are left out.
std::vector<std::uint32_t> gltfTriangles(int mode, std::vector<std::uint32_t> order);

// The vertices that the corners name, rising, each once; the corners are renumbered to places in
// that list. Many primitives may share one accessor, each with a part of it, so neither time nor
// memory grows with `count`, the number of vertices that there are. Every corner must be below it.
std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count);

} // namespace cotan
