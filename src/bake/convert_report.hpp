// What a conversion did, as JSON.
#pragma once

#include "cotan/convert.hpp"
#include "files/report/json.hpp"

namespace cotan {

// What became of a map.
Json toJson(const ConvertedMap& map);

// What became of the tangents, and of highlights that are stretched along them.
Json tangentsJson(const ConvertModelReport& report);

} // namespace cotan
