// The reference renderer: on the CPU, in 2x2 quads, slow, obvious, the judge.
#pragma once

#include "cotan/progress.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

// Draws the scene as a GPU would: pixels in 2x2 quads whose helper lanes extrapolate the triangle,
// derivatives as differences inside the quad, clipping against the near plane, the portable text
// in float. The picture is the same, byte for byte, for any number of threads.
// threads: 0 means all cores. progress is called from several threads.
// Translucent materials are composed per sample in the order of their distance, whatever their number
// of layers; of equally far ones the one drawn later is in front.
// Errors: those of checkView (cotan/scene/view_check.hpp); ErrorKind::usage for a size over 16384 a side;
// ErrorKind::input over kMostTrianglesDrawn (cotan/scene/bounds.hpp); ErrorKind::unavailable without the memory, or
// where more than 1024 translucent layers a pixel meet in a tile of 32 x 32 pixels.
Result<Image> renderReference(const Scene& scene, const View& view, int threads = 0, const Progress& progress = {});

} // namespace cotan
