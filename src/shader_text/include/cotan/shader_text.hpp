// Prints the portable text as one self-contained set of functions in a shader language.
//
//     namespace text = cotan::shader_text;
//     auto shader = text::makeShaderText({.language = text::Language::glsl, .frame = cotan::Frame::cotangent});
//     if (!shader)
//         return fail(shader.error().message);
//     std::printf("%s", shader->text.c_str());
//     std::printf("// call %s\n", shader->entry.c_str());
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/frame.hpp"
#include "cotan/result.hpp"

namespace cotan::shader_text {

// The shader text consists of the needed functions of the portable text, in one language.

enum class Language {
    glsl,
    essl,
    hlsl,
    wgsl,
    msl,
    cpp,
    godot, // a whole spatial shader, for Godot 3.2 and later and Godot 4
};
inline constexpr Language kLanguages[] = {Language::glsl, Language::essl, Language::hlsl, Language::wgsl,
                                          Language::msl,  Language::cpp,  Language::godot};
std::string_view name(Language language);
// Returns all names as in an error or a help text: "glsl, essl ... or godot".
std::string languageNames();
std::optional<Language> languageFromName(std::string_view name);

// How the perturbed normal is computed.
enum class Form {
    fused, // frame and texel in one step (fused.h), for the frames that have this form
    total, // the frame as three covectors, which is then applied (frame.h)
    seen,  // only `cotangent`: fused, for a normal on the visible side and a sign from the caller; the cheapest
    area,  // only `cotangent`: fused, the same on square texels; stretched uv make slopes steeper
};
inline constexpr Form kForms[] = {Form::fused, Form::total, Form::seen, Form::area};
std::string_view name(Form form);

// The stage of the fused text of `triangle`: the pixel stage, or the earlier one that makes U and V.
enum class Stage {
    all,
    fragment,
    vertex,  // at the provoking vertex
    mesh,    // for each primitive
    compute, // both in one stage
};
// The stages that have a name for users; `all` is the default.
inline constexpr Stage kStages[] = {Stage::fragment, Stage::vertex, Stage::mesh, Stage::compute};
std::string_view name(Stage stage);
std::optional<Stage> stageFromName(std::string_view name);

// Additional functions: all those of one or two parts of the portable text.
enum class Set {
    gradient,
    blend,
    space,    // vectors into texture space, the direction of grooves
    mapping,  // decals and projectors, coordinates that jump, hex tiles
    parallax, // offset, relief and its own shadow
    light,    // light.h and sheen.h
    environment,
    tone,
    shadow,
};
inline constexpr Set kSets[] = {Set::gradient, Set::blend,       Set::space, Set::mapping, Set::parallax,
                                Set::light,    Set::environment, Set::tone,  Set::shadow};
std::string_view name(Set set);
// Whether the language has the set. Godot implements environment, tone and shadows itself.
bool hasSet(Language language, Set set);

// Which frame to print for which maps. A shader that reads a map with another frame than it was baked for has errors of
// degrees.
struct FrameAdvice {
    std::string_view frames, maps;
};
inline constexpr FrameAdvice kFrameAdvice[] = {
    {"orthonormal", "for maps that were baked for MikkTSpace, as most are"},
    {"smooth or cotangent", "for maps that you bake for this shader"},
};

// The frame where the caller names none: for Godot, whose text is the material of a model, orthonormal. Errors (usage):
// another language; the message has kFrameAdvice.
Result<Frame> frameIfNoneIsNamed(Language language);

struct Choice {
    Language language = Language::glsl;
    Frame frame = Frame::orthonormal; // the right one for most maps; see kFrameAdvice
    Convention convention{};          // only expansion, channels and green are used
    std::optional<Form> form{};     // nothing: fused if the frame has that form and reads no vertices, otherwise total
    int uvSets = 1;                 // 1 to 4; more than one: gradients are added, fused only for `cotangent`
    Stage stage = Stage::all;       // other than `all`: only for the fused form of `triangle`
    bool callerDifferences = false; // omit the function that takes derivatives itself. Godot: a frame that reads vertex
                                    // data keeps its whole shader, where meshes without the data have no bumps
    bool functionsOnly = false;     // Godot: without shader_type, the map, vertex(), fragment() and light()
    bool twoSided = false;          // Godot: back faces are visible, as those of a thin sheet
    std::vector<Set> sets{};        // in any order
};

struct ShaderText {
    std::string text;
    Form form = Form::total;
    std::string entry;                  // the function to call, which every language has
    std::vector<std::string> functions; // in the order of the text
};

// Whether a frame has a fused form, and the names of the frames that have one, in alphabetical order.
bool hasFusedForm(Frame frame);
std::string fusedFrameNames(std::string_view beforeLast = ", ");

// Errors (usage): a form that the frame does not have; uvSets out of range, or above 1 for a frame without differences;
// features that the language lacks. Equal choices give equal bytes.
Result<ShaderText> makeShaderText(const Choice& choice);

// For tests: prints the functions of `extra`, portable text appended after all parts, and their callees; no header.
std::string translate(Language language, std::string_view extra);

} // namespace cotan::shader_text
