// Fits the ends and indices of BC7 to the texels of a block.
#pragma once

#include <array>
#include <cstddef>

#include "bc7_layout.hpp"
#include "block_texels.hpp"

namespace cotan::maps::bc7 {

// The texels of a block or of a subset, in their order.
struct Texels {
    std::array<Values, 4> codes; // to be decoded, 0 to 255
    std::array<Values, 3> n;     // unit normals
    std::array<Values, 4> aim;   // where a line should lie: vectors whose lengths do not count are scaled on to a plane
    Values weight;               // of the squared errors of `aim`
    Values mask;                 // 1; 0 beyond the texels of a subset
    std::size_t count = 16;      // of texels, a multiple of 8: more are not looked at
    float zero = 128;            // the code of 0
    bool opaque = true;          // alpha is 255 in all texels
    bool directions = true;      // only directions count, not lengths
};

// How the ends and indices of a line are stored.
struct LineCode {
    int colorBits = 7, alphaBits = 0; // of a channel of an end, with the shared bit
    bool lowBits = false;             // the lowest bit of an end is shared by its channels,
    bool oneLowBit = false;           // and by both ends
    int indexBits = 4;
    int channels = 3; // that the line fits: 4 with alpha. Else alpha is 255, if it is stored at all
};

using Ends = std::array<std::array<int, 4>, 2>; // as stored, with the shared bits

struct Fit {
    Ends ends{};
    Values indices{};
    float error = 1e30f;
};

// Fits a line to the texels. error: the sum of squared errors, in codes; angles are
// in 127ths of a radian. limit: of the error; a first fit near it is not improved.
Fit fitLine(const Texels& t, const LineCode& code, float limit);

// Changes each value of the ends by one step while that reduces the error, in at most `rounds` rounds.
void refineLine(Fit& fit, const Texels& t, const LineCode& code, int rounds);

// Two channels on a line, and one by itself, which the rotation exchanges with alpha.
struct PlanesCode {
    int scalar = 0; // the channel by itself
    int colorBits = 7, scalarBits = 8;
    int lineIndexBits = 2, scalarIndexBits = 2;
};

struct PlanesFit {
    Ends ends{}; // channel 3 has the ends of the scalar
    Values indices{}, scalarIndices{};
    float error = 1e30f;
};

// Unit normals as points of a plane in which the line is one axis and the scalar the other: a vector is
// (scalar, along - across) in the scalar's channel and the other two.
struct PlanePoints {
    Values scalar, across, weight;
    std::array<float, 2> along{}; // unit vector in the other two channels; 0: they are 0 on average
};

PlanePoints planePoints(const Texels& t, int scalar);

// Fits directions, of opaque texels. Points: along is not 0. limit: as of fitLine.
PlanesFit fitPlanes(const Texels& t, const PlanePoints& points, const PlanesCode& code, float limit);
void refinePlanes(PlanesFit& fit, const Texels& t, const PlanesCode& code, int rounds);

// Fits alpha by itself: its ends are those of channel 3.
Fit fitAlpha(const Texels& t, int bits, int indexBits);

} // namespace cotan::maps::bc7
