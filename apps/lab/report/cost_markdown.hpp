// What the texts of `cotan cost` share.
#pragma once

#include <string>
#include <vector>

#include "cost/price.hpp"

namespace cotan {

using Table = std::vector<std::vector<std::string>>; // the first row is the header

// As markdown, in columns of even width; the first to the left, the others to the right.
std::string aligned(const Table& table);

// What tables call it: the family, or the name of the device.
std::string title(const cost::DeviceCode& device);

// Devices whose driver gives this number of fragment shaders.
using Measure = std::optional<double> cost::StageCode::*;
std::vector<const cost::DeviceCode*> devicesWith(const cost::CostReport& report, Measure measure);

// `header`, and a column for each of the devices: two lines, their makers over their names.
Table tableOf(std::vector<std::string> header, const std::vector<const cost::DeviceCode*>& devices);

// A number of pixels, in three digits or so.
std::string pixelsText(double pixels);

// How each form stands against stored tangents, over all cards. Empty where no driver said anything.
std::string againstStored(const cost::CostReport& report);

// Where frames pay: by pixels a vertex, and by pixels a triangle. Empty where no driver said anything.
std::string breakEven(const cost::CostReport& report);

} // namespace cotan
