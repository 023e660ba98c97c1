// A tree to the text of a language.
#pragma once

#include <string>

#include "cotan/shader_text.hpp"
#include "syntax.hpp"

namespace cotan::shader_text {

std::string print(const Module& module, Language language);

} // namespace cotan::shader_text
