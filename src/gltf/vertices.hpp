// The vertices of an accessor that a primitive uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cotan {

// The vertices that the corners name, rising, each once; the corners are renumbered to places in
// that list. Many primitives may share one accessor, each with a part of it, so neither time nor
// memory grows with `count`, the number of vertices that there are. Every corner must be below it.
std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count);

} // namespace cotan
