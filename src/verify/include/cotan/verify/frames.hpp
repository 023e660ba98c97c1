// One view of a loaded scene drawn with two frames, and what they differ by.
#pragma once

#include <array>
#include <string>

#include "cotan/draw/painter.hpp"
#include "cotan/frame.hpp"
#include "cotan/report/statistics.hpp"
#include "cotan/verify/compared_views.hpp"

namespace cotan {

// Whether a view of a scene shows normal maps, so that the frame has a part in the normals.
bool showsNormalMaps(const Scene& scene, const View& view);

struct ComparedFrames {
    std::array<Image, 2> shaded;
    AngleStatistics normals;                           // degrees between the two; empty unless `mapped`
    Image difference;                                  // a heat map of the same
    bool mapped = false;                               // showsNormalMaps
    double tangentsOpposed = 0, bitangentsOpposed = 0; // share of the pixels; NaN where nothing was compared
    std::string verdict; // what tells an inverted or turned tangent from a small difference
};

inline constexpr int kComparedFramesPictures = 8; // that compareFrames draws, each told to painter.progress

// Draws what is loaded, `scene`, with both. Errors: those of Painter::draw.
Result<ComparedFrames> compareFrames(Painter& painter, const Scene& scene, View view, std::array<Frame, 2> frames);

// The figures, or why there are none.
std::string toText(const ComparedFrames& compared);

struct FrameError {
    AngleStatistics degrees; // empty where no normal map is drawn
    Image difference;        // a heat map
};

// How far the view's frame is from the exact one. Draws two pictures. Errors: those of Painter::draw.
Result<FrameError> errorAgainstExact(Painter& painter, const Scene& scene, View view);

} // namespace cotan
