// Lighting in tangent space as in common tutorials: vectors are transformed to the map's normal instead of the reverse.
#pragma once

#include "render/reference/pixel.hpp"

namespace cotan::figures {

// Light and view vectors transformed by the transpose of t, b, n at each vertex, and interpolated; as in world space
// for meshes without tangents. For perspective cameras.
reference::LightSpace tangentSpaceOfVertices();

// The same per pixel, by the inverse of the frame; as in world space where it has none.
reference::LightSpace tangentSpaceOfPixels();

} // namespace cotan::figures
