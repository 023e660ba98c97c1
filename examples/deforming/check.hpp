// Compares the compute passes with the C++ functions.
#pragma once

#include "passes.hpp"

// Prints for each motion the maximum difference and the time of each pass.
void check(const Gpu& gpu, const Mesh& rest);
