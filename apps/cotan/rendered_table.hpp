// The table `rendered` of `cotan accuracy`: the curved surfaces drawn by a device.
#pragma once

#include <string>
#include <vector>

#include "common.hpp"
#include "cotan/truth/measurement.hpp"

namespace cotan::app {

// Draws every surface at some tessellations with every frame, reads normals and uv back, and
// compares with the analytic truth. `device`: as for openPainter; the rows' arithmetic is "vulkan"
// or "reference". Errors: those of the device.
Result<std::vector<Measurement>> measureRendered(const std::string& device, const CommonOptions& options,
                                                 const AccuracySelection& selection);

} // namespace cotan::app
