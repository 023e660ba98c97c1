// What is probably not as its author wanted it, before anything is baked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake_surfaces.hpp"

namespace cotan {

// A flat low surface that fills its tile of the texture coordinates once.
struct FlatTile {
    glm::vec3 corner, along, across; // world: where u and v begin, and steps of one tile along u and v
};
std::optional<FlatTile> flatTileOf(const LowSurface& low);

// Adds the parts of the high model that come in at the tile's borders, and up to a tenth of it beyond, if its
// neighbours are the same. Only parts that are needed are copied.
void repeatAround(const FlatTile& tile, HighModel& high);

// One line for each thing that looks wrong: models that are exchanged, or of different units; hard edges that uv do not
// split; triangles that no map shows; a tile that needs options.wrap. Lines about an option begin with its name.
std::vector<std::string> bakeHints(const LowSurface& low, const HighSurface& high, const BakeModelOptions& options,
                                   const std::vector<BakeKind>& kinds);

// Whether the models seem to be exchanged: the high one has less than an eighth of the triangles.
bool seemExchanged(std::size_t lowTriangles, std::size_t highTriangles);

} // namespace cotan
