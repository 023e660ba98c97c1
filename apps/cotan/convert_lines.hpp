// The lines about a conversion that `cotan convert` prints.
#pragma once

#include <string>
#include <vector>

#include "core/named_values.hpp"
#include "cotan/convert.hpp"
#include "files/json.hpp"

namespace cotan::app {

// How a map was converted; `to`: the new frame's name.
std::vector<std::string> mapLines(const ConvertedMap& map, const std::string& to);

// What happened to the tangents, and to anisotropic highlights along them; empty if nothing did.
std::vector<std::string> tangentsLines(const ConvertModelReport& report, const std::string& to);

inline constexpr Named<ProvokingVertex> kProvokings[] = {{"first", ProvokingVertex::first},
                                                         {"last", ProvokingVertex::last}};

// The number of vertices that the triangles used before and use now.
std::string provokingLine(const std::vector<GltfProvoked>& primitives, ProvokingVertex provoking);
Json provokingJson(const std::vector<GltfProvoked>& primitives, ProvokingVertex provoking);

} // namespace cotan::app
