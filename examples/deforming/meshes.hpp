// The meshes that are deformed, around the origin. Tubes are 4 units tall; others fit into 2, so that bending folds
// none.
#pragma once

#include <cotan/tangents.hpp>

#include "../triangle/mesh.hpp"

inline cotan::MeshView viewOf(const Mesh& mesh) { return {mesh.positions, mesh.normals, mesh.texcoords, mesh.indices}; }

constexpr double kTubeRadius = 0.5, kTubeHeight = 4;

// A tube around the y axis, texcoords as long as the surface: u to the right seen from outside, v down.
Mesh tube(std::uint32_t around, std::uint32_t along);
// `teapot`; `tube`; `seam`: a tube whose back mirrors its front; `strange`: a tube with triangles of all
// degenerate kinds; `large`: a tube of a million triangles; else the first mesh with texcoords of a file, in its
// rest pose. Vertices that mirrored and unmirrored triangles share are split. Throws std::runtime_error.
Mesh named(const std::string& name);
