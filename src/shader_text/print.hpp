// A tree to the text of a language.
#pragma once

#include <map>

#include "cotan/shader_text.hpp"
#include "syntax.hpp"

namespace cotan::shader_text {

// What a language calls things.
struct Names {
    std::map<std::string, std::string> words; // portable name of a type or function to the language's
    std::string floatSuffix;                  // after a literal, such as 1.0f
    std::string functionPrefix;               // before a function, such as "inline "
    std::string ddx, ddy;                     // screen derivatives; empty where there are none
    bool realCalls = false;                   // literals stay in cotan_real(...)
    bool braces = false;                      // vectors are made with {} instead of ()
    bool wgsl = false;                        // declarations the other way round, no ?:
    bool structs = true;                      // else their parts are variables of their own
};

const Names& namesOf(Language language);

// What comes before the structs, such as C++'s vectors; and after the functions.
std::string_view prelude(Language language);
// What packs and unpacks halfs, where the language has no function for it.
std::string_view halfs(Language language);
std::string_view postlude(Language language);

std::string print(const Module& module, Language language);

// The word of the language for a portable name; the name itself if it has none.
std::string wordOf(Language language, const std::string& name);

} // namespace cotan::shader_text
