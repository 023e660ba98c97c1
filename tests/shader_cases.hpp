// Cases that run in every shading language: the shader text, a call, and the expected result in double precision.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/shader_text.hpp"

namespace cotan::test {

// Input of a case in every language: 16 floats.
struct Vectors {
    glm::vec3 n, dpdx, dpdy;
    glm::vec2 duvdx, duvdy;
    glm::vec3 texel;
};
static_assert(sizeof(Vectors) == 16 * sizeof(float));

// For `light`, the vectors hold n, to the light, to the eye, (metallic, roughness), two parameters, and a colour.
enum class Kind { sound, degenerate, nonFinite, light, moved };

struct Sample {
    Vectors v;
    Kind kind = Kind::sound;
    // For `moved`: the sample before a transform that scales and perhaps mirrors x, and what its vectors are, which
    // decides how they transform.
    Vectors from = {};
    float scale = 1;
    bool mirrored = false;
    FrameSource source = FrameSource::differences;
};

// Random sound samples (mirrored or not, y up and y down, both facings), then degenerate ones, non-finite ones, lit
// surfaces, and moved ones.
std::vector<Sample> samples();
std::vector<Sample> litSamples();

// Rounding error of float: half a unit in the last place of 1.
inline constexpr double kRounding = 1.0 / (1 << 24);

struct Case {
    std::string name;
    std::string call;        // an expression in (n, dpdx, dpdy, duvdx, duvdy, m)
    Kind last = Kind::sound; // the hardest kind of sample that is defined for it
    std::function<std::string(shader_text::Language)> text;
    std::function<glm::dvec3(const Vectors&)> expected;
    bool light = false; // compared on lit surfaces as numbers; otherwise as directions
    bool halfs = false; // two stages with half floats between them: an error of up to 0.03 degrees
    // What the vectors are, for the frames whose result moves with the object: a scale does not change it.
    std::optional<FrameSource> moves = {};
    bool anyScale = true; // false: the caller scales the vectors of `moves`
    // For `light`: maximum change of the result by one rounding of the result and of each input.
    std::function<glm::dvec3(const Vectors&)> allowance;
};

// Every frame in each form, map encodings, two uv sets, and every function of gradient.h, blend.h, light.h, sheen.h,
// environment.h, tone.h and shadow.h.
std::vector<Case> cases();
std::vector<Case> frameCases(bool drawn = false); // only the frames
std::vector<Case> godotCases();                   // cases that do not access the bits of floats
std::vector<Case> litCases();                     // light, environment, tone mapping and shadow

// A render target of kTiles x kTiles tiles with constant derivatives inside each, for the functions that take
// screen-space derivatives themselves.
inline constexpr int kTile = 4; // pixels
inline constexpr int kTiles = 8;
inline constexpr int kTarget = kTile * kTiles;

// A corner of a triangle as vertex data: 13 floats.
struct Corner {
    glm::vec2 at; // clip space, y increasing with the rows of tiles
    glm::vec3 n, p;
    glm::vec2 uv;
    glm::vec3 texel;
};
static_assert(sizeof(Corner) == 13 * sizeof(float));

std::vector<Vectors> tiles(); // in row order
std::vector<Corner> corners(const std::vector<Vectors>& tiles);

// Cases called with (n, p, uv, m); `expected` takes the derivatives.
std::vector<Case> drawnCases();

// Results of one language, for each case and each sample; if it cannot run here, no values and the reason in `skipped`.
struct Results {
    std::string language;
    std::string skipped;
    std::vector<std::vector<glm::dvec3>> values;
};

Results runCpp(const std::vector<Case>& cases, const std::vector<Sample>& samples, bool doubles);
Results runMsl(const std::vector<Case>& cases, const std::vector<Sample>& samples);
// Compiles the printed GLSL to SPIR-V and that to Metal text by SPIRV-Cross, and runs the result.
Results runSpirvCross(const std::vector<Case>& cases, const std::vector<Sample>& samples);
// language: GLSL, HLSL or Godot, whose functions are GLSL without changes.
Results runVulkan(const std::vector<Case>& cases, const std::vector<Sample>& samples, shader_text::Language language);

// For each drawn case its pixels in memory order, first with clip space unchanged, then with y flipped.
Results drawVulkan(const std::vector<Case>& drawn, const std::vector<Corner>& corners, shader_text::Language language);

struct BrowserResults {
    Results essl, wgsl, drawnEssl, drawnWgsl;
};
BrowserResults runBrowser(const std::vector<Case>& cases, const std::vector<Sample>& samples,
                          const std::vector<Case>& drawn, const std::vector<Corner>& corners);

} // namespace cotan::test
