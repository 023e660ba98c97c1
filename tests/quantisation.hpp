// Errors from rounding the components of a normal map.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cotan/convention.hpp"

namespace cotan::maps {

// Maximum angle in degrees between a vector and its decoded value when each component has `bits` bits, from rounding
// alone, on the upper hemisphere up to `tilt` degrees from flat. 32 bits: the error of float arithmetic.
// (docs/reference/maps.md has the table.)
inline double quantisationDegrees(const Convention& convention, int bits, double tilt)
{
    // Half a step in each stored component, as a signed number.
    const double codes = std::pow(2.0, bits);
    const double half = bits >= 32                 ? 3e-7
        : convention.expansion == Expansion::exact ? 1 / (codes - 2)
                                                   : 1 / (codes - 1);
    const double z = std::max(std::cos(tilt * std::numbers::pi / 180), 1e-9);
    // Tangential part of the error, to first order:
    double error = half * std::sqrt(3.0); // xyz: at most the whole error vector
    if (convention.channels == Channels::orthographic)
        error = half * std::sqrt(2.0) / z; // steepest direction: d(tilt) = d(sin)/cos
    if (convention.channels == Channels::stereographic)
        error = half * std::sqrt(2.0) * 2; // |dn/dp| = 2/(1+p^2) <= 2
    if (convention.channels == Channels::slope)
        error = half * std::sqrt(2.0); // |d atan(s)/ds| <= 1
    return error * 180 / std::numbers::pi;
}

} // namespace cotan::maps
