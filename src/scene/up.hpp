// Which axis of a model is up: y in a scene, z in the files of many programs.
#pragma once

#include "cotan/scene.hpp"

namespace cotan {

// Turns all of a scene by 90 degrees about x, so that what was along +z is along +y (and +y along -z): instances,
// lights, cameras and reach. Meshes stay as they are.
void turnZUp(Scene& scene);

// The box of what turnZUp turns.
Bounds turnedZUp(const Bounds& box);

// What would lay two boxes over one another that are hardly so.
enum class LikelyTurn {
    none,
    first,  // turnZUp of the first
    second, // of the second
    either, // the boxes do not tell which
};

// Whether two models that ought to lie over one another would do so if one of them were turned: their boxes share less
// than half of the volume that they fill together, and turned at least three tenths more of it. Flat boxes count as if
// they were a hundredth of their size thick. none for an empty box.
LikelyTurn likelyTurn(const Bounds& first, const Bounds& second);

} // namespace cotan
