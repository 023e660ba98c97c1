// Small geometry over Scene and Mesh.
#pragma once

#include "cotan/scene/bounds.hpp"
#include "cotan/scene/scene.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

// Replaces the mesh's normals by angle-weighted averages over corners that share a position,
// separated where faces meet at more than `creaseDegrees` (180: everything is smoothed).
// Vertices are split where needed, all attributes with them. Degenerate triangles add nothing; a
// vertex with no usable triangle gets (0,0,1).
void generateNormals(Mesh& mesh, float creaseDegrees = 180);

// A camera that shows the whole box from the front, a little from the right and above.
// An empty box gives the default camera.
Camera fitCamera(const Bounds& box, int width, int height);

// The lights for a scene that brings none: one key light from the upper left, fixed to the camera's
// side of the scene.
std::vector<Light> defaultLights();

} // namespace cotan
