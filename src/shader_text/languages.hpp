// The words and grammar of the languages, and the printer. A further language needs a name in Language, a row in
// languages.cpp and, if its words differ from all others, a column of Word.
#pragma once

#include <string>
#include <string_view>

#include "cotan/shader_text.hpp"
#include "syntax.hpp"

namespace cotan::shader_text {

// The names of a type or function of the portable text in each language; empty: the portable name.
struct Word {
    std::string_view portable, glsl, hlsl, wgsl, msl;
};

// The words and the grammar of a language.
struct Grammar {
    std::string_view Word::*words = nullptr; // column of Word; null: the portable names
    std::string_view floatSuffix{};          // after a literal, such as 1.0f
    std::string_view functionPrefix{};       // before a function, such as "inline "
    bool realCalls = false;                  // literals stay in cotan_real(...)
    bool braces = false;                     // vectors are constructed with {} instead of ()
    bool typesAfterNames = false;            // types follow names in declarations; there is no ?:
    bool structs = true;                     // false: their parts are separate variables
};

struct LanguageInfo {
    std::string_view name{};                        // in the command line and the C API
    std::string_view title{};                       // in comments
    std::string_view titleWithHalfs{};              // if the text packs halfs; empty: the same
    std::string_view branch = "COTAN_LANG_GLSL";    // the macro of lang.h whose branch is printed
    std::string_view sample{};                      // an expression that samples the normal map
    std::string_view scope{};                       // prefix of our names in calls, such as "cotan_shader::"
    std::string_view cornersIn = "storage buffers"; // where a vertex stage can read the corners of its triangle
    std::string_view limits{};                      // whole lines of the introduction; may be empty
    std::string_view prelude{};                     // before the structs, such as C++'s vectors
    std::string_view halfs{};                       // functions that pack and unpack halfs, if the language has none
    std::string_view postlude{};                    // after the functions
    Grammar grammar{};
};

const LanguageInfo& infoOf(Language language);

// Returns the language's word for a portable name; the name itself if it has none.
std::string wordOf(Language language, const std::string& portable);

std::string print(const Module& module, Language language);

} // namespace cotan::shader_text
