// Whether one of two models has z up, by their boxes.
#pragma once

#include "cotan/scene.hpp"

namespace cotan::app {

// The box of what turnZUp (scene/geometry.hpp) turns.
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

} // namespace cotan::app
