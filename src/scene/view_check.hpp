// Whether a view can be drawn.
#pragma once

#include "cotan/result.hpp"
#include "cotan/view.hpp"

namespace cotan {

// Checks what both renderers ask of a view: a size from 1 pixel a side; a frame that there is; 1, 4 or 16 samples;
// finite numbers; a camera whose eye is not its target, whose up is not along that line, and whose lens opens by more
// than nothing and less than half a turn. Both renderers call it. Errors: ErrorKind::usage, one line that begins with
// the field: "view.camera: ".
Status checkView(const View& view);

} // namespace cotan
