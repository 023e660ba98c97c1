// Vertices that are equal in everything become one.
#pragma once

#include "cotan/scene.hpp"

namespace cotan {

// Merges vertices whose attributes are equal bit for bit; drops those that no triangle uses.
// The triangles keep their order, the vertices the order of their first use.
void weldVertices(Mesh& mesh);

} // namespace cotan
