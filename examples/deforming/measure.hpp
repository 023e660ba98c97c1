// How far perturbed normals are from those of the exact deformed surface.
#pragma once

#include <array>
#include <vector>

#include "motion.hpp"
#include "passes.hpp"

struct Way {
    const char* name;
    const char* text;
};
// In the order of the numbers below.
constexpr std::array<Way, 6> kWays = {{
    {"normal alone", "the interpolated normal against the exact one, without a map"},
    {"mikktspace, stored", "rest tangents, carried along like the normals"},
    {"mikktspace, derived", "orthonormal tangents of the pose (tangents.comp)"},
    {"cotangent", "from screen derivatives of the pose"},
    {"triangle", "U and V of the pose as halfs (triangles.comp)"},
    {"smooth", "averaged cotangents of the pose in 8 bytes (smooth.comp)"},
}};

struct Errors {
    std::array<double, kWays.size()> mean{}, most95{}; // degrees
    std::array<std::vector<float>, kWays.size()> triangles; // the mean of each triangle
};

// A tube with its passes, ready for any time of a motion.
class Measured {
public:
    Measured(const Gpu& gpu, std::uint32_t around, std::uint32_t along);
    Errors at(const Motion& motion, double s, Normals normals);
    const Mesh& rest() const { return rest_; }

private:
    Mesh rest_;
    std::vector<glm::vec4> tangents_; // at rest, per vertex
    Passes passes_;
};
