// What a conversion did, in lines, as `cotan convert` prints them.
#pragma once

#include <string>
#include <vector>

#include "cotan/convert.hpp"
#include "files/report/json.hpp"

namespace cotan {

// What became of a map; `to`: the new frame's name.
std::vector<std::string> linesOf(const ConvertedMap& map, const std::string& to);

// What became of the tangents, and of highlights that are stretched along them; empty where nothing did.
std::vector<std::string> tangentsLines(const ConvertModelReport& report, const std::string& to);

// How many vertices the triangles used before and use now; provoking: "first" or "last".
std::string provokingLine(const std::vector<GltfProvoked>& primitives, const std::string& provoking);
Json provokingJson(const std::vector<GltfProvoked>& primitives, const std::string& provoking);

} // namespace cotan
