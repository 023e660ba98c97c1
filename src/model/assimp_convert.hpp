// Converts Assimp's structures to a Scene, and checks files before Assimp reads them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cotan/model.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "source_material.hpp"

struct aiMaterial;
struct aiMesh;
struct aiScene;

namespace cotan {

// ---- conversion ------------------------------------------------------------------------------

Material convertMaterial(const aiMaterial& source, TextureReader& textures, Scene& scene);

// Checks every index and position before use. A mesh without triangles gives an empty one. regenerateNormals: the
// format stores face normals only. Throws (failModel) for broken or malicious data.
Mesh convertMesh(const aiMesh& source, bool regenerateNormals, Scene& scene);

// Adds instances and cameras from the node tree. meshes: for every mesh of the source its index in the scene, or -1.
// Throws (failModel) for too many nodes and transforms that are not finite.
void convertNodes(const aiScene& source, const std::vector<int>& meshes, const LoadLimits& limits, Scene& scene);

// ---- checks, which throw (failModel) ---------------------------------------------------------

// Checks each line of a PLY header, then that every counted row and list value exists, because Assimp allocates memory
// by these counts. Source: the PLY description of G. Turk (1994), with the sized type names that are common now.
void checkPly(std::span<const std::byte> bytes, const LoadLimits& limits);

// Checks three properties of COLLADA that Assimp 5.2 does not check. Counts, offsets and strides, which determine
// allocations, must not exceed the file size. Index lists must contain only integers: at anything else the parser
// repeats the last number until memory is exhausted. Accessors must stay within their array of numbers.
void checkCollada(std::span<const std::byte> bytes);

} // namespace cotan
