// One picture of a scene, in one call.
#pragma once

#include <string>

#include "cotan/result.hpp"
#include "cotan/scene/view.hpp"

namespace cotan {

// Draws the view of the scene on the device of that name, as openPainter (cotan/draw/painter.hpp) takes it.
// Tangents or cotangents that view.frame reads at the vertices are made where the scene has none; pass a
// scene that is no longer needed by std::move. The picture is as view.output says, in View's size.
// threads: of the reference renderer; 0 means all cores. For several pictures, or to know which device
// "auto" has found, open a Painter.
// Errors: those of openPainter, Painter::load and Painter::draw.
Result<Image> drawView(Scene scene, const View& view, const std::string& device = "auto", int threads = 0);

} // namespace cotan
