// Portable text to a tree.
#pragma once

#include <map>
#include <span>
#include <string_view>

#include "syntax.hpp"

namespace cotan::shader_text {

struct PortablePart {
    std::string_view name; // of the file, without ".h"
    std::string_view text;
};

// The files of shaders/cotan/, embedded, in the order in which they are joined.
std::span<const PortablePart> portableParts();

// What is left of a text when its #if branches are chosen. A comment above a directive stays
// above what follows it, except for a #define, which takes its comment with it.
struct Preprocessed {
    std::string text;
    std::map<std::string, std::string> constants; // COTAN_NAME to its value
};

// language: COTAN_LANG_GLSL or COTAN_LANG_CPP, the one macro that is defined.
Preprocessed preprocess(std::string_view text, std::string_view language);

// Appends what `text` defines. Constants are put in the place of their names; `constants` holds
// those of earlier texts and receives the new ones.
// Throws std::runtime_error with the line where the text leaves the small language.
void parsePart(Module& module, std::map<std::string, Expression>& constants, std::string_view part,
               std::string_view text, std::string_view language);

} // namespace cotan::shader_text
