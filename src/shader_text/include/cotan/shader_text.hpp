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

// One self-contained function set in one language, made from the portable text.

enum class Language {
    glsl,
    essl,
    hlsl,
    wgsl,
    msl,
    cpp,
    godot, // a whole spatial shader, for 3.2 and later and for 4
};
inline constexpr Language kLanguages[] = {Language::glsl, Language::essl, Language::hlsl, Language::wgsl,
                                          Language::msl,  Language::cpp,  Language::godot};
std::string_view name(Language language);
// All of them, as an error or a help text lists them: "glsl, essl ... or godot".
std::string languageNames();
std::optional<Language> languageFromName(std::string_view name);

// How the perturbed normal is computed.
enum class Form {
    fused, // frame and texel in one step (fused.h), of the frames that have it
    total, // the frame as three covectors, then applied (frame.h)
    seen,  // of `cotangent`: fused, with the normal on the side that is seen and the caller's word for its sign;
           // cheapest
    area,  // of `cotangent`: fused, the same on square texels; stretched uv make slopes steeper
};
inline constexpr Form kForms[] = {Form::fused, Form::total, Form::seen, Form::area};
std::string_view name(Form form);

// For which stage the fused text of `triangle` is: its pixels', or the one that makes U and V before.
enum class Stage {
    all,
    fragment,
    vertex,  // at the provoking vertex
    mesh,    // for each primitive
    compute, // both in one
};
// Those that can be asked for by name; `all` is what one gets without asking.
inline constexpr Stage kStages[] = {Stage::fragment, Stage::vertex, Stage::mesh, Stage::compute};
std::string_view name(Stage stage);
std::optional<Stage> stageFromName(std::string_view name);

// More functions than the frame's own: all of one or two parts of the portable text.
enum class Set {
    gradient,
    blend,
    light, // light.h and sheen.h
    environment,
    tone,
    shadow,
};
inline constexpr Set kSets[] = {Set::gradient, Set::blend, Set::light, Set::environment, Set::tone, Set::shadow};
std::string_view name(Set set);
// Whether the language has the set. Godot does its environment, tone and shadows itself.
bool hasSet(Language language, Set set);

struct Choice {
    Language language = Language::glsl;
    Frame frame = Frame::cotangent;
    Convention convention{};        // expansion, channels and green are used
    std::optional<Form> form{};     // nothing: fused where there is one that reads no vertices, else total
    int uvSets = 1;                 // 1..4; more than one: gradients are added, total form
    Stage stage = Stage::all;       // another than `all`: of the fused form of `triangle` only
    bool callerDifferences = false; // leave out the function that takes derivatives itself
    bool functionsOnly = false;     // Godot: without shader_type, the map, vertex(), fragment() and light()
    bool twoSided = false;          // Godot: back faces are seen too, those of a thin sheet
    std::vector<Set> sets{};        // in any order
};

struct ShaderText {
    std::string text;
    Form form = Form::total;
    std::string entry;                  // what a caller calls; every language has it
    std::vector<std::string> functions; // in the order of the text
};

// Whether a frame has a fused form, and the names of those that have one, in alphabetical order.
bool hasFusedForm(Frame frame);
std::string fusedFrameNames(std::string_view beforeLast = ", ");

// Errors (usage): a form that the frame does not have, uvSets out of range or for a frame from
// vertices; what the language does not have. The same choice gives the same bytes.
Result<ShaderText> makeShaderText(const Choice& choice);

// For tests: functions of `extra`, portable text appended after all parts, and what they call, without a header.
std::string translate(Language language, std::string_view extra);

} // namespace cotan::shader_text
