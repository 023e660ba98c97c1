// Limits for the harnesses of readers.
#pragma once

#include "cotan/model.hpp"

namespace cotan::fuzz {

// Small enough for -malloc_limit_mb=1024, large enough for every seed.
inline LoadLimits smallLimits()
{
    LoadLimits limits;
    limits.fileBytes = 64 << 20;
    limits.vertices = 1'000'000;
    limits.triangles = 1'000'000;
    limits.nodes = 10'000;
    limits.imageSide = 2048;
    limits.imageBytes = 32 << 20;
    limits.allImageBytes = 64 << 20;
    return limits;
}

} // namespace cotan::fuzz
