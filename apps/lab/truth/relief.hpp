// A smooth relief over texture coordinates with known derivatives.
#pragma once

#include <glm/vec3.hpp>

namespace cotan {

// Height and slopes in uv units; hu is the change of height per unit of u.
struct ReliefSample {
    double h = 0, hu = 0, hv = 0;
};

// Waves along u, v and their diagonal.
struct Waves {
    double slope = 0.8;  // the steepest slope is about 1.1 times this
    double perUnit = 24; // waves per uv unit

    ReliefSample at(double u, double v) const;
};

// The unit texel of slopes multiplied by `scale`: proportional to (-hu, -hv, 1/scale).
glm::dvec3 texelOf(const ReliefSample& sample, double scale = 1);

} // namespace cotan
