// A self-contained page with the tubes over time and the error of each method.
#pragma once

#include <string>

#include "measure.hpp"

// Prints a table of the errors at five times and returns the page.
std::string figure(const Gpu& gpu);
