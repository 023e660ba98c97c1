// What is run in every language: a text, the call of it, and what the portable text says in double.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/shader_text/shader_text.hpp"

namespace cotan::test {

// As passed to every language: 16 floats.
struct Vectors {
    glm::vec3 n, dpdx, dpdy;
    glm::vec2 duvdx, duvdy;
    glm::vec3 texel;
};
static_assert(sizeof(Vectors) == 16 * sizeof(float));

enum class Kind { sound, degenerate, nonFinite };

struct Sample {
    Vectors v;
    Kind kind = Kind::sound;
};

// Random, mirrored, y up and y down, both facings; then degenerate ones; then non-finite ones.
std::vector<Sample> samples();

struct Case {
    std::string name;
    std::string call;              // of (n, dpdx, dpdy, duvdx, duvdy, m)
    Kind last = Kind::sound;       // the hardest kind that it is defined for
    std::function<std::string(shader_text::Language)> text;
    std::function<glm::dvec3(const Vectors&)> expected;
};

// Every frame in each form, ways of storing maps, two uv sets, every function of gradient.h and
// blend.h.
std::vector<Case> cases();

// One language's results: for each case, for each sample. Empty, with a reason, if it cannot run
// here.
struct Results {
    std::string language;
    std::string skipped;
    std::vector<std::vector<glm::dvec3>> values;
};

Results runCpp(const std::vector<Case>& cases, const std::vector<Sample>& samples, bool doubles);
Results runMsl(const std::vector<Case>& cases, const std::vector<Sample>& samples);
Results runVulkan(const std::vector<Case>& cases, const std::vector<Sample>& samples, bool hlsl);
// ESSL and WGSL, in this order.
std::array<Results, 2> runBrowser(const std::vector<Case>& cases, const std::vector<Sample>& samples);

} // namespace cotan::test
