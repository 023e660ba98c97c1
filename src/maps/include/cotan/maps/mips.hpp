// Chains of smaller maps, filtered as vectors, and what that takes from the look.
//
// The mean of unit vectors that spread has a length R below 1. Normalising it loses the spread, and
// a rough surface seen from afar turns smooth. The spread goes into the roughness instead.
#pragma once

#include <vector>

#include "cotan/convention.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

enum class SpreadModel {
    toksvig, // variance (1-R)/R on Blinn-Phong's exponent; M. Toksvig, Mipmapping Normal Maps, 2005
    vmf,     // 2/kappa added, kappa = (3R - R^3)/(1 - R^2); C. Han et al., Frequency Domain Normal Map Filtering, 2007
    lean     // the variance of the slopes themselves; M. Olano, D. Baker, LEAN Mapping, 2010
};

struct MipSettings {
    Convention from{}, to{};
    bool keepLengths = false; // three channels: store the mean vector, not its direction
    SpreadModel model = SpreadModel::lean;
    double roughness = 0.3; // of the material, perceptual: alpha is its square; in [0,1]
    PixelType type = PixelType::unorm8;
};

struct MipLevel {
    Image normals;
    Image roughness;       // grey, perceptual
    double meanLength = 1; // of the mean vectors
    double meanRoughness = 0;
};

// The roughness, perceptual, of a surface of that roughness whose unit normals have a mean of length
// R, or whose slopes have this variance (of x and y together). Each in its valid range: roughness
// [0,1], R [0,1], variance from 0. The result is at most 1.
double roughnessFromLength(double roughness, double length, SpreadModel model); // toksvig, vmf
double roughnessFromVariance(double roughness, double variance);                // lean

// Levels 0 (the map itself, re-encoded) to 1 x 1. Each texel is the mean over its area of the level
// before, also where sizes are odd. Texels that are no direction do not count; slopes are held at
// 128.
std::vector<MipLevel> mipChain(const Image& map, const MipSettings& settings);

} // namespace cotan::maps
