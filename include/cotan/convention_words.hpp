// How a normal map is stored, in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/result.hpp"

namespace cotan {

// A convention in words separated by commas: a preset's name, then what differs from it, such as "unity,xyz" or
// "opengl,biased". Errors (ErrorKind::usage): a word that is not known, or none.
Result<Convention> conventionFromWords(std::string_view text);

// All words that it knows, for help texts.
std::string conventionWords();
std::vector<std::string> conventionWordList();

} // namespace cotan
