// Texts and reports about the errors of stored tangents.
#pragma once

#include <string>

#include "cotan/tangents.hpp"
#include "files/json.hpp"

namespace cotan::app {

// One line for users. reference: what the tangents were compared with, "MikkTSpace".
std::string toText(const TangentDifference& difference, const std::string& reference);
Json toJson(const TangentDifference& difference);

} // namespace cotan::app
