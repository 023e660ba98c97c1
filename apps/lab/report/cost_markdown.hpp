// Functions shared by the reports of `cotan cost`.
#pragma once

#include <string>
#include <vector>

#include "cost/price.hpp"

namespace cotan {

using Table = std::vector<std::vector<std::string>>; // the first row is the header

// Formats a markdown table with aligned columns: the first left-aligned, the others right-aligned.
std::string aligned(const Table& table);

// The name of a device in tables: its family, or else its own name.
std::string title(const cost::DeviceCode& device);

// Devices whose driver reports this value for fragment shaders.
using Measure = std::optional<double> cost::StageCode::*;
std::vector<const cost::DeviceCode*> devicesWith(const cost::CostReport& report, Measure measure);

// A table with `header` and a column for each device, headed by two lines: maker and name.
Table tableOf(std::vector<std::string> header, const std::vector<const cost::DeviceCode*>& devices);

// Formats a number of pixels with up to about three digits.
std::string pixelsText(double pixels);

// Compares each form with stored tangents over all GPUs. Empty if no driver reported anything.
std::string againstStored(const cost::CostReport& report);

// Tables of the pixels per vertex and per triangle at which frames are cheaper. Empty if no driver reported anything.
std::string breakEven(const cost::CostReport& report);

} // namespace cotan
