// What a conversion did, in texts and as JSON.
#pragma once

#include <string>
#include <vector>

#include "cotan/convert.hpp"
#include "files/report/json.hpp"

namespace cotan {

// What became of a map; `to`: the new frame's name.
std::vector<std::string> linesOf(const ConvertedMap& map, const std::string& to);
Json toJson(const ConvertedMap& map);

// What became of the tangents, and of highlights that are stretched along them; empty where nothing did.
std::vector<std::string> tangentsLines(const ConvertModelReport& report, const std::string& to);
Json tangentsJson(const ConvertModelReport& report);

// How many vertices the triangles used before and use now; provoking: "first" or "last".
std::string provokingLine(const std::vector<GltfProvoked>& primitives, const std::string& provoking);
Json provokingJson(const std::vector<GltfProvoked>& primitives, const std::string& provoking);

} // namespace cotan
