// COLLADA, before it is given to a parser that trusts it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "cotan/result.hpp"

namespace cotan {

// Checks three things that Assimp 5.2 does not: counts, offsets and strides, by which memory is
// taken, are no larger than the file; lists of indices hold nothing but whole numbers (at anything
// else the parser repeats the last number until memory ends); and accessors reach no further than
// the array of numbers that they read.
Status checkCollada(std::span<const std::byte> bytes, const std::string& name);

} // namespace cotan
