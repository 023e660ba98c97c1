// The portable text of shaders/cotan/ as C++: once over float in cotan::f32, once over double in
// cotan::f64. The same names as in a shader: cotan::f32::cotan_frame_cotangent and so on.
// For other scalar types (half, an operation counter) include the text the same way.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define COTAN_LANG_CPP

namespace cotan::f32 {
#define COTAN_CPP_REAL float
#include "cotan/portable_text.inc"
#undef COTAN_CPP_REAL
} // namespace cotan::f32

namespace cotan::f64 {
#define COTAN_CPP_REAL double
#include "cotan/portable_text.inc"
#undef COTAN_CPP_REAL
} // namespace cotan::f64

#undef COTAN_LANG_CPP
