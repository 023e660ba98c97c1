// What is run in every language: a text, the call of it, and what the portable text says in double.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/shader_text.hpp"

namespace cotan::test {

// As passed to every language: 16 floats.
struct Vectors {
    glm::vec3 n, dpdx, dpdy;
    glm::vec2 duvdx, duvdy;
    glm::vec3 texel;
};
static_assert(sizeof(Vectors) == 16 * sizeof(float));

// A lit surface: n, to the light, to the eye, (metallic, roughness), two numbers, colour.
enum class Kind { sound, degenerate, nonFinite, light };

struct Sample {
    Vectors v;
    Kind kind = Kind::sound;
};

// Random, mirrored, y up and y down, both facings; then degenerate ones; then non-finite ones; then
// lit surfaces.
std::vector<Sample> samples();
std::vector<Sample> litSamples();

// A float's: half a unit in the last place of one.
inline constexpr double kRounding = 1.0 / (1 << 24);

struct Case {
    std::string name;
    std::string call;        // of (n, dpdx, dpdy, duvdx, duvdy, m)
    Kind last = Kind::sound; // the hardest kind that it is defined for
    std::function<std::string(shader_text::Language)> text;
    std::function<glm::dvec3(const Vectors&)> expected;
    bool light = false; // compared on lit surfaces, as numbers; else as directions
    // What one rounding of the result and of each input changes at most; where `light`.
    std::function<glm::dvec3(const Vectors&)> allowance;
};

// Every frame in each form, ways of storing maps, two uv sets, every function of gradient.h,
// blend.h, light.h, sheen.h, environment.h, tone.h and shadow.h.
std::vector<Case> cases();
std::vector<Case> frameCases(bool drawn = false); // the frames of them
std::vector<Case> godotCases();                   // what needs no bits of floats
std::vector<Case> litCases();                     // light, environment, tone and shadow

// A target of kTiles x kTiles tiles, each with differences of its own that are constant in it: the
// functions that take derivatives themselves.
inline constexpr int kTile = 4; // pixels
inline constexpr int kTiles = 8;
inline constexpr int kTarget = kTile * kTiles;

// A corner of a triangle, as vertex data: 13 floats.
struct Corner {
    glm::vec2 at; // in clip space, y along with the rows of the tiles
    glm::vec3 n, p;
    glm::vec2 uv;
    glm::vec3 texel;
};
static_assert(sizeof(Corner) == 13 * sizeof(float));

std::vector<Vectors> tiles(); // row by row
std::vector<Corner> corners(const std::vector<Vectors>& tiles);

// Of (n, p, uv, m), with `expected` as of the differences.
std::vector<Case> drawnCases();

// One language's results: for each case, for each sample. Empty, with a reason, if it cannot run
// here.
struct Results {
    std::string language;
    std::string skipped;
    std::vector<std::vector<glm::dvec3>> values;
};

Results runCpp(const std::vector<Case>& cases, const std::vector<Sample>& samples, bool doubles);
Results runMsl(const std::vector<Case>& cases, const std::vector<Sample>& samples);
// What SPIRV-Cross makes of the printed GLSL, as Metal text.
Results runSpirvCross(const std::vector<Case>& cases, const std::vector<Sample>& samples);
// language: GLSL, HLSL, or Godot's, whose functions are GLSL as they stand.
Results runVulkan(const std::vector<Case>& cases, const std::vector<Sample>& samples, shader_text::Language language);

// For each drawn case its pixels in the order of memory, with clip space as it is, then with y
// turned round.
Results drawVulkan(const std::vector<Case>& drawn, const std::vector<Corner>& corners, shader_text::Language language);

struct BrowserResults {
    Results essl, wgsl, drawnEssl, drawnWgsl;
};
BrowserResults runBrowser(const std::vector<Case>& cases, const std::vector<Sample>& samples,
                          const std::vector<Case>& drawn, const std::vector<Corner>& corners);

} // namespace cotan::test
