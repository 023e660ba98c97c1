// Exposure by the picture itself.
#pragma once

#include "cotan/draw/painter.hpp"

namespace cotan {

// The exposure for a view of the painter's scene, by what a small picture of it shows without what is behind: the
// logarithms' mean of the brightness of the scene's pixels goes part of the way to a middle grey, so that white stays
// bright and black dark, and the brightest fiftieth stays below what tone curves burn out. Rounded to 1/32 of a stop,
// so that renderers that differ by a rounding agree. 1 where nothing is seen. view.exposure, ground and background are
// not read; drawn with the same curve of tones, so that a device needs no other shaders. Errors: those of
// Painter::draw.
Result<float> meterExposure(Painter& painter, View view);

} // namespace cotan
