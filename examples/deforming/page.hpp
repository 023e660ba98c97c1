// A page that stands alone: the tubes over time and how far each way is off.
#pragma once

#include <string>

#include "measure.hpp"

// Prints the table at five times, and returns the page.
std::string figure(const Gpu& gpu);
