// One of several things of a file, as people name it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cotan {

// The place in names of what is wanted, by its name, of several the first, or by its number. what: for the message, in
// the plural.
// Throws GltfProblem with ErrorKind::usage, which lists the names, where there is no such thing.
std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const char* what);

} // namespace cotan
