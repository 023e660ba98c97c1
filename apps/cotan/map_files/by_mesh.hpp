// Between tangent and object space, which takes the mesh that the map belongs to.
#pragma once

#include "cotan/maps.hpp"
#include "map_files/convert.hpp"

namespace cotan::maps {

// The map in the other space: one of settings.from and settings.to is of object space, whose axes are those of the
// file as its nodes place the mesh. Every texel that the mesh shows is turned by the frame at its place; the rest
// gets the value of the nearest chart. Lengths become 1; strength, normalise and firstRow are not looked at. shown:
// texels that the mesh shows.
// Errors: as loadScene and makeLowSurface; ErrorKind::stopped.
Result<Image> throughMesh(const Image& map, const RecodeSettings& settings, const MeshOfMap& mesh,
                          const Progress& progress, RecodeCounts& counts, std::size_t& shown);

} // namespace cotan::maps
