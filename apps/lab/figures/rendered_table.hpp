// The table `rendered` of `cotan accuracy`: curved surfaces drawn by a device.
#pragma once

#include <vector>

#include "cotan/render.hpp"
#include "cotan/result.hpp"
#include "truth/measurement.hpp"

namespace cotan::figures {

// Draws every surface in some tessellations with every frame, reads back normals and uv, and compares them with the
// analytic truth. The rows' arithmetic is "vulkan" or "reference". Errors: those of the renderer; ErrorKind::stopped.
Result<std::vector<Measurement>> measureRendered(Renderer& renderer, const AccuracySelection& selection,
                                                 const Progress& progress = {});

} // namespace cotan::figures
