// A normal map that was made for one frame, made for another: per texel, what the one makes of it at
// its place on the surface, and what the other needs there for the same.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "cotan/lint/spread.hpp"
#include "cotan/lint/surface.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// One surface that reads the map, and how.
struct MapUse {
    MappedSurface surface;
    f64::cotan_normal_format format; // strength: the material's factor on the slopes; 0: does not count
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
};

struct FramePair {
    Frame from = Frame::mikktspace, to = Frame::cotangent;           // view independent, both
    TangentOrigin fromTangents = TangentOrigin::stored, toTangents = TangentOrigin::generated;
};

inline constexpr double kDisagree = 0.5;       // degrees: about what rounding to 8 bits costs at worst
inline constexpr std::size_t kMostPlaces = 16; // of one texel; of more, evenly chosen ones count

struct Reencoded {
    Image image;                // as large as the old one
    std::size_t covered = 0;    // texels whose centre some triangle covers
    std::size_t padded = 0;     // others, converted as at the nearest place
    std::size_t several = 0;    // covered by more than one place
    std::size_t disagreeing = 0; // ... and off by over kDisagree in one of them, before rounding
    std::size_t belowHorizon = 0; // texels with z <= 0
    Spread moved;               // degrees between old and new decoded texel, covered ones
    Spread unconverted;         // degrees of the worst place if the old map were read with the new frame
    Spread disagreement;        // degrees of the worst place, before rounding, of the disagreeing
    Spread error;               // degrees of the worst place after rounding, of the covered that agree
};

// map: with all its data. bits: 8 or 16 a component of the result. threads: 0 for all cores. rowDone is called for every row from any thread.
// Alpha is kept; texels that stand for nothing (decoded z <= 0 where no triangle is, or a map that no
// use covers) are kept as they are. Mip levels are not part of an image here: viewers make them from
// the result. The same result whatever the number of threads.
Reencoded reencode(const Image& map, std::span<const MapUse> uses, const FramePair& frames, int bits,
                   int threads = 0, const std::function<void()>& rowDone = {});

// How many copies of the image the triangles' boxes cover in all: what the work is proportional to.
double copiesOf(std::span<const MapUse> uses);

} // namespace cotan
