// What a language computed, compared with double precision.
#pragma once

#include "shader_cases.hpp"

namespace cotan::test {

// The text in C++ double performs the operations of the portable text, except for GLM's order of sums.
inline constexpr double kDoubleDegrees = 1e-9;

const std::vector<Case>& allCases();
const std::vector<Sample>& allSamples();

// 180 if a is not a finite unit vector.
double degreesApart(glm::dvec3 a, glm::dvec3 b);

// Each case on each sample that is defined for it; prints the largest error of each.
void expectParity(const Results& r, const std::vector<Case>& run = allCases());

// Degrees, at most, of a drawn case: clip space unchanged, or with y flipped. The y axes of window space and clip space
// agree in WebGL and Vulkan, and are opposite in WebGPU and Direct3D.
double worstDrawn(const Case& c, const Results& r, std::size_t index, bool flipped);

// All drawn cases, with both directions of y; prints the largest error of each.
void expectDrawn(const Results& r);

} // namespace cotan::test
