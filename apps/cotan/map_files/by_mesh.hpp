// Conversion between tangent and object space, which needs the mesh of the map.
#pragma once

#include "cotan/maps.hpp"
#include "map_files/convert.hpp"

namespace cotan::app {

// Converts a map between tangent and object space: one of settings.from and settings.to is object space, whose axes are
// those of the file after node transforms. Texels that the mesh covers are transformed by the frame there; the others
// get the value of the nearest chart. Lengths become 1; strength, normalise and firstRow are ignored. covered: receives
// the number of texels that the mesh covers.
// Errors: as loadScene and makeLowSurface; ErrorKind::stopped.
Result<Image> recodeByMesh(const Image& map, const maps::RecodeSettings& settings, const MeshOfMap& mesh,
                           const Progress& progress, maps::RecodeCounts& counts, std::size_t& covered);

} // namespace cotan::app
