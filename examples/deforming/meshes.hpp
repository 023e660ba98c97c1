// The meshes to deform, centred at the origin. Tubes are 4 units tall. Others fit into 2 and do not fold when bent.
#pragma once

#include <cotan/tangents.hpp>

#include "../triangle/mesh.hpp"

inline cotan::MeshView viewOf(const Mesh& mesh) { return {mesh.positions, mesh.normals, mesh.texcoords, mesh.indices}; }

constexpr double kTubeRadius = 0.5, kTubeHeight = 4;

// A tube around the y axis. Texcoords are in units of length: u to the right as seen from outside, v down.
Mesh tube(std::uint32_t around, std::uint32_t along);
// name: `teapot`; `tube`; `seam`: a tube whose back mirrors its front; `strange`: a tube with all kinds of degenerate
// triangles; `large`: a tube of a million triangles; else a file, whose first mesh with texcoords is taken in its rest
// pose. Vertices that mirrored and unmirrored triangles share are split. Throws std::runtime_error.
Mesh named(const std::string& name);
