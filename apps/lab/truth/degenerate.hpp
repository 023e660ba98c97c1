// Nineteen kinds of pixel, most of them degenerate, for asking what a frame does with them.
#pragma once

#include <functional>
#include <vector>

#include "cotan/packed_only.hpp"
#include "truth/patch.hpp"

namespace cotan {

// What a fragment shader has at one pixel.
struct PixelInput {
    glm::vec3 n; // as interpolated, not unit
    Differences<float> d;
    glm::vec3 m; // decoded texel
};

struct DegenerateCase {
    const char* name;
    std::function<void(Random&, PixelInput&)> spoil; // turns a good pixel into this case
    bool plainNormal = false;                        // the right answer is the plain normal, to rounding
    double leanDegrees = 10;                         // of n from the face
    bool mirrored = false;
};

const std::vector<DegenerateCase>& degenerateCases();

// A random pixel of that case.
PixelInput makeInput(Random& random, const DegenerateCase& c);

// Treats denormals as zero while it lives, in arguments and results, as GPUs may. Does nothing on
// processors other than x86.
class FlushDenormals {
public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    unsigned saved_ = 0;
};

} // namespace cotan
