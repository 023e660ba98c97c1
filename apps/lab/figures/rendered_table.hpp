// The table `rendered` of `cotan accuracy`: the curved surfaces drawn by a device.
#pragma once

#include <vector>

#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "truth/measurement.hpp"

namespace cotan::figures {

// Draws every surface at some tessellations with every frame, reads normals and uv back, and
// compares with the analytic truth. The rows' arithmetic is "vulkan" or "reference".
// Errors: those of the renderer; ErrorKind::stopped.
Result<std::vector<Measurement>> measureRendered(Renderer& renderer, const AccuracySelection& selection,
                                                 const Progress& progress = {});

} // namespace cotan::figures
