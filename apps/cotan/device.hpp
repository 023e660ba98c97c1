// --device: what draws.
#pragma once

#include "common.hpp"
#include "cotan/draw/painter.hpp"

namespace cotan::app {

// Opens the device of that name, as openPainter does; where "auto" falls back to the reference renderer, a warning
// says why. Errors: those of openPainter.
Result<std::unique_ptr<Painter>> openDevice(const std::string& device, const CommonOptions& common);

} // namespace cotan::app
