// What is peculiar to a language, and a tree as its text. A further one needs its name in Language, a row in
// languages.cpp, and where its words are its own a column of Word.
#pragma once

#include <string>
#include <string_view>

#include "cotan/shader_text.hpp"
#include "syntax.hpp"

namespace cotan::shader_text {

// What languages call a type or function of the portable text; empty: the same.
struct Word {
    std::string_view portable, glsl, hlsl, wgsl, msl;
};

// Words and grammar.
struct Grammar {
    std::string_view Word::*words = nullptr; // its column; null: the portable ones
    std::string_view floatSuffix{};          // after a literal, such as 1.0f
    std::string_view functionPrefix{};       // before a function, such as "inline "
    bool realCalls = false;                  // literals stay in cotan_real(...)
    bool braces = false;                     // vectors are made with {} instead of ()
    bool typesAfterNames = false;            // declarations the other way round, no ?:
    bool structs = true;                     // else their parts are variables of their own
};

struct LanguageInfo {
    std::string_view name{};                        // as the command line and the C API take it
    std::string_view title{};                       // as people call it
    std::string_view titleWithHalfs{};              // where the text packs halfs; empty: the same
    std::string_view branch = "COTAN_LANG_GLSL";    // the macro of lang.h whose branch is printed
    std::string_view sample{};                      // an expression that samples the normal map
    std::string_view scope{};                       // before our names where they are called, such as "cotan_shader::"
    std::string_view cornersIn = "storage buffers"; // where a vertex stage can read the corners of its triangle
    std::string_view limits{};                      // whole lines of the introduction; may be empty
    std::string_view prelude{};                     // before the structs, such as C++'s vectors
    std::string_view halfs{};    // what packs and unpacks halfs, where the language has no function for it
    std::string_view postlude{}; // after the functions
    Grammar grammar{};
};

const LanguageInfo& infoOf(Language language);

// The word of the language for a portable name; the name itself if it has none.
std::string wordOf(Language language, const std::string& portable);

std::string print(const Module& module, Language language);

} // namespace cotan::shader_text
