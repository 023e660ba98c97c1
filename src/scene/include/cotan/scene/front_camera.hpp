// Cameras that fill the image with a scene.
#pragma once

#include "cotan/scene/scene.hpp"

namespace cotan {

// From the front, a little from the right and above, with a lens of 30 degrees: as near as all vertices stay inside
// the picture less a margin of 4 % on each side, with equal room on both sides; in an
// animation (Scene::reach) at all of its moments. Beyond kMostPlacedVertices
// (cotan/scene/bounds.hpp) the corners of the meshes' boxes stand for their vertices.
// What is flat is seen straight on. Nothing finite to see gives the default camera.
Camera frontCamera(const Scene& scene, int width, int height);

// The same from another side. azimuth: degrees from the front (+z) counter-clockwise as seen from above, so that 90 is
// the right side (+x), -90 the left one and 180 the back; elevation: degrees above the horizon, -90 to 90, where 90
// looks straight down with the front below. Both finite.
Camera orbitCamera(const Scene& scene, double azimuth, double elevation, int width, int height);

} // namespace cotan
