// What `cotan map from-height` and `to-height` share.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "cotan/maps/height.hpp"
#include "cotan/result.hpp"

namespace cotan::app {

// "W" or "WxH" in metres, for a picture of that many texels; a single number is the width, texels are square then.
Result<std::pair<double, double>> parseMetres(const std::string& text, int width, int height);

std::optional<maps::Kernel> kernelFromName(const std::string& name);

} // namespace cotan::app
