// Words of the command line to values. Each error names the option, what it expects and what it got.
#pragma once

#include <string>
#include <utility>

#include "cotan/frame.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/view.hpp"

namespace cotan::app {

// "WxH", each 1..16384.
Result<std::pair<int, int>> parseSize(const std::string& text);

// A frame's name; the error lists all of them.
Result<Frame> parseFrame(const std::string& text);

// "fit", the number of a camera of the file, or "ex,ey,ez,tx,ty,tz" in world units.
Result<Camera> parseCamera(const std::string& text, const Scene& scene, int width, int height);

// All frame names, separated by commas.
std::string frameNames();

} // namespace cotan::app
