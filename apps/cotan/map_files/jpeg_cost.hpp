// Estimates what JPEG has cost a normal map.
#pragma once

#include <optional>

#include "cotan/scene.hpp"

namespace cotan::app {

// Estimates what its JPEG file has cost a map of three channels, read as c*2-1, in degrees on average. map: as decoded
// from the file that is in Image::jpeg; about 2,048 of its units of 8 or 16 texels are looked at.
//
// Each coefficient of the file says in which interval the coefficient of the lost map lay. Where in it, on average,
// follows from the distribution of the coefficients of one frequency: Laplace's, with a scale for the frequency times
// one for the activity of the unit (E. Lam and J. Goodman, "A mathematical analysis of the DCT coefficient
// distributions for images", 2000). Both are those under which the coefficients of the file are most likely (T.
// Brandao and M. Queluz, "No-reference image quality assessment based on DCT domain statistics", 2008). Where Cb and Cr
// have half the resolution, the file lacks their finer half; it is taken to be to that of Y as the coarser halves are
// to each other.
//
// Nothing if the file is grey or CMYK, has fewer than 16 whole units, or stores a component at other
// than the whole or half resolution, Y at less than the whole, or the build has no libjpeg.
std::optional<double> jpegCost(const Image& map);

} // namespace cotan::app
