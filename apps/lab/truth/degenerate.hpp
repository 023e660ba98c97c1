// Nineteen kinds of pixel, most of them degenerate, as test input for frames.
#pragma once

#include <functional>
#include <vector>

#include "truth/patch.hpp"

namespace cotan {

// The inputs of a fragment shader at one pixel.
struct PixelInput {
    glm::vec3 n; // interpolated, not normalised
    Differences<float> d;
    glm::vec3 m; // the decoded texel
};

struct DegenerateCase {
    const char* name;
    std::function<void(Random&, PixelInput&)> modify; // turns a well-conditioned pixel into this case
    bool plainNormal = false;                         // the correct result is the plain normal, to rounding
    double leanDegrees = 10;                          // angle between n and the face normal
    bool mirrored = false;
};

const std::vector<DegenerateCase>& degenerateCases();

// Returns a random pixel of that case.
PixelInput makeInput(Random& random, const DegenerateCase& c);

// Treats denormal arguments and results as zero during its lifetime, as GPUs may. Does nothing on processors other than
// x86.
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
