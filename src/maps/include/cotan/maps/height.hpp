// Heights to normals and back.
//
// Units: the solvers know heights in texels (a slope of 1 rises one texel's width per texel). What a
// texel is in metres, and what white is, is a factor that the caller applies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

enum class Kernel {
    spectral, // exact for what repeats and is smooth; to-height only
    forward,  // next minus this: sharpest, half a texel off
    central,  // half of next minus previous
    sobel,    // central, smoothed across with 1 2 1
    scharr,   // central, smoothed across with 3 10 3: turns with the relief most evenly
};
enum class Wrap { repeat, clamp, mirror };

struct FromHeightSettings {
    Kernel kernel = Kernel::central; // not spectral
    Wrap wrap = Wrap::repeat;
    double scaleX = 1, scaleY = 1; // slope per unit of stored height and texel
    Convention to;
    PixelType type = PixelType::unorm16;
    bool dither = false;
    bool bordered = false; // the picture's first and last row are neighbours only: the result lacks them, and
                           // wrap is for left and right
    int firstRow = 0;      // where the result lies in a larger picture, for the dither
};

// The normal map of a height picture (red is read). invalid: texels whose heights around are not
// finite; they become flat.
Image normalsFromHeight(const Image& height, const FromHeightSettings& settings, std::size_t& invalid);

enum class Boundary { periodic, free };

struct ToHeightSettings {
    Convention from;
    Boundary boundary = Boundary::periodic;
    Kernel kernel = Kernel::spectral; // how the slopes were made. free: with the borders clamped
    double aspect = 1;                // a texel's height over its width, both in metres
};

struct Heights {
    std::vector<float> texels; // in widths of a texel, mean 0, rows from the top
    double lowest = 0, highest = 0;
    double slope = 0;        // root mean square of the map's slopes
    double residual = 0;     // root mean square of what no height explains: curl, rounding
    double meanTilt = 0;     // degrees; periodic heights cannot follow a tilt of the whole
    std::size_t invalid = 0; // texels that are no direction: taken as flat; slopes are held at 128
};

// Least squares: the height whose slopes are nearest to the map's. Periodic: R. Frankot, R.
// Chellappa, A Method for Enforcing Integrability in Shape from Shading Algorithms, 1988, with the
// kernel's own response in place of the derivative's. Free: the same over heights that are clamped at the
// borders, by cosine transforms; spectral: over differences of neighbours, Poisson's equation with natural
// boundaries.
Heights heightFromNormals(const Image& map, const ToHeightSettings& settings);

// Bytes that heightFromNormals takes beside the map, for a check before it is called: of periodic heights. Free ones
// take a third of the memory, and as long.
std::size_t heightWorkBytes(int width, int height);

} // namespace cotan::maps
