// Which axis of a model is up: y in a scene, z in the files of many programs.
#pragma once

#include "cotan/scene.hpp"

namespace cotan {

// Turns all of a scene by 90 degrees about x, so that what was along +z is along +y (and +y along -z): instances,
// lights, cameras and reach. Meshes stay as they are.
void turnZUp(Scene& scene);

} // namespace cotan
