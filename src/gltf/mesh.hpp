// glTF primitives to meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cotan/scene.hpp"
#include "gltf_model.hpp"

namespace cotan {

// A primitive as it stands in the file, triangulated, with the vertices that its triangles use, in
// the order of the file. Arrays are empty or have one entry a vertex.
struct GltfPrimitive {
    std::string field; // meshes[i].primitives[j]
    // Named like the mesh of the file, with the primitive's number where there are several. Its material is an index
    // into the file's; -1: the default material.
    Mesh mesh;
    std::vector<std::vector<glm::uvec4>> joints; // one for each set JOINTS_n with WEIGHTS_n
    std::vector<std::vector<glm::vec4>> weights;
};

// Reads and checks one primitive and applies its morph targets. morphWeights: as in the file,
// empty: all zero. Nothing for points and lines (said in a warning).
std::optional<GltfPrimitive> readGltfPrimitive(GltfModel& model, int mesh, std::size_t primitive,
                                               const std::vector<double>& morphWeights);

// Three corners a triangle. order: those of a list, strip or fan (see gltf::Primitive::mode); other modes have no
// triangles. Strips and fans jump by triangles without area: those that join two equal vertices are left out.
std::vector<std::uint32_t> gltfTriangles(int mode, std::vector<std::uint32_t> order);

// The vertices that the corners name, rising, each once; the corners are renumbered to places in
// that list. Many primitives may share one accessor, each with a part of it, so neither time nor
// memory grows with `count`, the number of vertices that there are. Every corner must be below it.
std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count);

// Moves the vertices to where the joints put them. joints: for each joint of the skin, its world matrix times its
// inverse bind matrix. Normals go by the inverse transpose, tangents with the surface; where the joints mirror,
// TANGENT.w changes sign, and where they mirror everything, so does the winding.
void skinGltfPrimitive(GltfPrimitive& primitive, const std::vector<glm::dmat4>& joints, GltfWarnings& warnings);

// The unit vector of a normal. One that is unit up to rounding keeps its bits: normalising again would make some equal
// that differ, and weld their vertices. Zero where it has no length.
glm::vec3 unitNormal(const glm::vec3& normal);

// Gives each corner of the triangles a vertex of its own: positions, uv and colors; the indices then count up.
void separateCorners(Mesh& mesh);

// Makes the mesh: unit normals (flat ones where the file has none), tangents with w = +-1. What is
// odd about them is said. normalMapSet: the uv set that the material's normal map uses, or -1.
Mesh finishGltfMesh(GltfPrimitive&& primitive, int normalMapSet, GltfWarnings& warnings);

} // namespace cotan
