// Measures errors of perturbed normals against those of the exact deformed surface.
#pragma once

#include <array>
#include <vector>

#include "motion.hpp"
#include "passes.hpp"

struct Way {
    const char* name;
    const char* text;
};
// The methods that are compared, in the order of the arrays of Errors.
constexpr std::array<Way, 6> kWays = {{
    {"normal alone", "The interpolated normal against the exact one, without a map."},
    {"mikktspace, stored", "Tangents of the rest pose, carried along by the engine."},
    {"mikktspace, derived", "Orthonormal tangents of the pose (tangents.comp)."},
    {"cotangent", "From screen derivatives."},
    {"triangle", "U and V of each triangle as halfs (triangles.comp)."},
    {"smooth", "Averaged cotangents in 8 bytes a vertex (smooth.comp)."},
}};

struct Errors {
    std::array<double, kWays.size()> mean{}, most95{};      // degrees
    std::array<std::vector<float>, kWays.size()> triangles; // mean of each triangle
};

// A tube with its compute passes.
class Measured {
public:
    Measured(const Gpu& gpu, std::uint32_t around, std::uint32_t along);
    // Errors at time s of a motion, with normals carried along by the engine or derived from the pose (normals.comp).
    Errors at(const Motion& motion, double s, bool deriveNormals);
    const Mesh& rest() const { return rest_; }

private:
    Mesh rest_;
    std::vector<glm::vec4> tangents_; // of each vertex in the rest pose
    Passes passes_;
};
