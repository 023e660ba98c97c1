// The parts of the portable text that only renderers need, as C++: in cotan::f32 over float and in cotan::f64 over
// double, like cotan/portable.hpp.
#pragma once

#include "cotan/portable.hpp"

#define COTAN_FUNCTION inline

namespace cotan::f32 {
using std::floor;
using std::log2;
#include "cotan/backdrop.h"
#include "cotan/environment.h"
#include "cotan/quantise.h"
#include "cotan/shadow.h"
#include "cotan/tone.h"
} // namespace cotan::f32

#undef COTAN_BACKDROP_H
#undef COTAN_QUANTISE_H
#undef COTAN_SHADOW_H
#undef COTAN_TONE_H
#undef COTAN_ENVIRONMENT_H

namespace cotan::f64 {
using std::floor;
using std::log2;
#include "cotan/backdrop.h"
#include "cotan/environment.h"
#include "cotan/quantise.h"
#include "cotan/shadow.h"
#include "cotan/tone.h"
} // namespace cotan::f64

#undef COTAN_FUNCTION
