// PLY, before it is given to a parser that trusts it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "cotan/model.hpp"
#include "cotan/result.hpp"

namespace cotan {

// Checks the header of a PLY file line by line, and walks over what it counts: every row of every
// element, and every value of every list, has to be there, as memory is taken by those counts.
// Source: the PLY description of G. Turk (1994), with the sized type names that are common now.
Status checkPly(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits);

} // namespace cotan
