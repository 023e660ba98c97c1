// Which way green points, from the map alone.
//
// The slopes a = dh/dx and b = dh/dy of a height h satisfy da/dy = db/dx. A map whose green is
// negated satisfies da/dy = -db/dx instead, and one with red and green exchanged has them in each
// other's place. What cannot be told: whether bumps are dents. (x,-y) and (-x,y) are the same
// relief, once seen as bumps and once as dents; we take red to point right, as every convention has it.
//
// Maps of charts are judged by their charts: what lies between them (alpha 0, black, white, one colour) says
// nothing, and where two charts meet the slopes jump, so that large steps count no more than small ones.
#pragma once

#include <string>

#include "cotan/maps/normal_statistics.hpp"
#include "cotan/maps/patches.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

enum class Green { up, down, undecidable };
enum class Swapped { no, yes, undecidable };
enum class Confidence { none, likely, certain };

struct GreenVerdict {
    Green green = Green::undecidable;
    Swapped swapped = Swapped::undecidable; // red and green exchanged
    Confidence confidence = Confidence::none;
    std::string reason; // one sentence: why, or why not
    // Correlation of da/dy with db/dx, green taken to point up: +1 for green up, -1 for green down,
    // near 0 when there is nothing to tell. `exchanged`: the same with red and green exchanged.
    double agreement = 0, exchanged = 0;
    double deviations = 0;       // |agreement| in units of its uncertainty, from patches left out in turn
    double residualRatio = 1;    // what the other way leaves unexplained over what this way leaves
    double votes = 0;            // share of the patches, by weight, that agree with the verdict
    double used = 0;             // share of the texel cells in the patches that say something
    double sampled = 1;          // share of the picture that the patches hold
    NormalStatistics statistics; // of the patches
};

const char* name(Green green);           // up, down, undecidable
const char* name(Swapped swapped);       // no, yes, undecidable
const char* name(Confidence confidence); // none, likely, certain

GreenVerdict greenOf(const PatchSampler& sampler);
GreenVerdict greenOf(const Image& image); // sampled in the same way; needs pixels

} // namespace cotan::maps
