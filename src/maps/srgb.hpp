// The curve of sRGB, on stored values.
#pragma once

#include <cmath>

namespace cotan::maps {

inline float fromSrgb(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }
inline float toSrgb(float c) { return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }

} // namespace cotan::maps
