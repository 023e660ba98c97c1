// Guesses from the bounding boxes whether one of two models is z-up.
#pragma once

#include "cotan/scene.hpp"

namespace cotan::app {

// The bounding box after rotateZUpToYUp (scene/geometry.hpp).
Bounds rotatedZUp(const Bounds& box);

// Which rotation would align two boxes that hardly overlap.
enum class UpMismatch {
    none,
    first,  // rotateZUpToYUp of the first
    second, // rotateZUpToYUp of the second
    either, // the boxes do not tell which
};

// Whether rotating one of two models would align them: the intersection of their boxes is less than half of the union
// of the volumes, and after the rotation at least 0.3 more of it. Flat boxes count as 1 % of their size thick. Returns
// none for an empty box.
UpMismatch findUpMismatch(const Bounds& first, const Bounds& second);

} // namespace cotan::app
