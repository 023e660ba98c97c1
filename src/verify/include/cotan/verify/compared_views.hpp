// What drawing something twice and comparing the normals gives.
#pragma once

#include <cstddef>
#include <vector>

#include "cotan/report/statistics.hpp"
#include "cotan/scene/image.hpp"

namespace cotan {

// Seen from one side. The degrees are angles between the two normals of a pixel, over the pixels that show the
// inside of a surface in both: those whose eight neighbours show one, too. The pictures are square, unorm8.
struct ComparedView {
    AngleStatistics degrees;
    Image expected; // normals n as n * 0.5 + 0.5, transparent where nothing is
    Image drawn;
    Image difference; // a heat map: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 degrees; grey: not compared;
                      // of a bake magenta: the map shows another surface than the camera sees
    std::size_t others = 0, pixels = 0; // of a bake: the magenta ones, and all for which that is known
};

struct ComparedViews {
    std::vector<ComparedView> views;
    AngleStatistics all;                // over the pixels of all views
    std::size_t others = 0, pixels = 0; // of a bake: the sums over the views
    bool mapped = false; // a normal map was drawn; if not, nothing is compared, as no frame has a part in the normals
};

// Why a comparison with mapped == false has nothing in it.
inline constexpr const char* kNoNormalMap = "no normal map is drawn";

} // namespace cotan
