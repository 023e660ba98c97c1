// Which way green points, from the map alone.
//
// The slopes a = dh/dx and b = dh/dy of a height h satisfy da/dy = db/dx. A map whose green is
// negated satisfies da/dy = -db/dx instead, and one with red and green exchanged has them in each
// other's place. What cannot be told: whether bumps are dents. (x,-y) and (-x,y) are the same
// relief, once seen as bumps and once as dents; we take red to point right, as every convention has it.
#pragma once

#include <memory>
#include <string>

#include "cotan/scene/image.hpp"
#include "cotan/maps/normal_statistics.hpp"

namespace cotan::maps {

enum class Green { up, down, undecidable };
enum class Swapped { no, yes, undecidable };
enum class Confidence { none, likely, certain };

struct GreenVerdict {
    Green green = Green::undecidable;
    Swapped swapped = Swapped::undecidable; // red and green exchanged
    Confidence confidence = Confidence::none;
    std::string reason;        // one sentence: why, or why not
    // Correlation of da/dy with db/dx, green taken to point up: +1 for green up, -1 for green down,
    // near 0 when there is nothing to tell. `exchanged`: the same with red and green exchanged.
    double agreement = 0, exchanged = 0;
    double deviations = 0;     // |agreement| in units of its uncertainty, from blocks left out in turn
    double residualRatio = 1;  // what the other way leaves unexplained over what this way leaves
    double votes = 0;          // share of the blocks, by weight, that agree with the verdict
    double used = 0;           // share of the texel cells that were looked at
};

// statistics: of the same image.
GreenVerdict greenOf(const Image& image, const NormalStatistics& statistics);

// The same for a picture that comes in strips from the top.
class GreenSurvey {
public:
    GreenSurvey(int width, int height, PixelType type, const NormalStatistics& statistics);
    ~GreenSurvey();
    // Rows from firstRow on, and the row below them, except at the bottom.
    void add(const Image& strip, int firstRow);
    GreenVerdict verdict() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace cotan::maps
