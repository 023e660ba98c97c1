// The tree for a language without structs.
#pragma once

#include "syntax.hpp"

namespace cotan::shader_text {

// Each variable of a struct becomes one variable for each field, NAME_FIELD; parameters too. A function that returns a
// struct returns nothing and has `out` parameters behind its others.
// Throws std::runtime_error where a struct hangs on ?: or a name is taken.
Module withoutStructs(const Module& module);

} // namespace cotan::shader_text
