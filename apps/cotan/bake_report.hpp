// What `cotan bake` says and reports of the maps that it wrote.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake_options.hpp"
#include "cotan/bake.hpp"
#include "files/json.hpp"

namespace cotan::app {

// What is baked at once, and where it goes.
struct MapJob {
    std::string object; // empty: all
    BakeFiles files;
};

// Maps that were written.
struct MapReport {
    MapJob job; // with the files of the tile
    int tile = 1001;
    std::vector<std::string> warnings; // of reading and preparing
    BakeStatistics statistics;
    std::vector<BakeProblem> problems;
    std::string verdict;
    std::vector<double> units; // of each map, BakedMap::unit
    Bounds box;                // of the high surface
    std::vector<IdColor> ids;  // of a map of ids
    std::size_t highTriangles = 0, lowTriangles = 0, objects = 0;
    double prepareSeconds = 0, writeSeconds = 0;
    std::optional<Json> verified;
};

// Says what the maps became, and warns of what their statistics reveal.
void tell(const BakeJob& job, const MapReport& done);

// Which engines can use a normal map for this frame, and how.
std::string readersOf(Frame frame);

Json toJson(const BakeJob& job, const MapReport& done);

} // namespace cotan::app
