// COLLADA, before it is given to a parser that trusts it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "cotan/result.hpp"

namespace cotan {

// Checks two things that Assimp 5.2 does not: counts, offsets and strides, by which memory is
// taken, are no larger than the file; and lists of indices hold nothing but whole numbers (at
// anything else the parser repeats the last number until memory ends).
Status checkCollada(std::span<const std::byte> bytes, const std::string& name);

} // namespace cotan
