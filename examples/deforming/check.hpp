// The passes against the C++ functions.
#pragma once

#include "passes.hpp"

// Prints, for each motion, by how much they differ and how long each pass takes.
void check(const Gpu& gpu, const Mesh& rest);
