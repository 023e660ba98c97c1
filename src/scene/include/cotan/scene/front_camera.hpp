// A camera that fills the picture with a scene.
#pragma once

#include "cotan/scene/scene.hpp"

namespace cotan {

// From the front, a little from the right and above, with a lens of 30 degrees: as near as all vertices stay inside
// the picture less a margin of 4 % on each side, with equal room on both sides; in an
// animation (Scene::reach) at all of its moments. Beyond kMostPlacedVertices
// (cotan/scene/bounds.hpp) the corners of the meshes' boxes stand for their vertices.
// What is flat is seen straight on. Nothing finite to see gives the default camera.
Camera frontCamera(const Scene& scene, int width, int height);

} // namespace cotan
