// From Assimp's structures to ours; and files that Assimp trusts, before they are given to it.
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

// Checks every index, count and position before it is used. A mesh without triangles comes back
// empty. regenerateNormals: the format's normals are those of faces only.
// Throws (failModel): what a broken or hostile file can make Assimp deliver.
Mesh convertMesh(const aiMesh& source, bool regenerateNormals, Scene& scene);

// Instances and cameras from the tree of nodes. meshes: for every mesh of the source its index in the scene, or -1.
// Throws likewise.
void convertNodes(const aiScene& source, const std::vector<int>& meshes, const LoadLimits& limits, Scene& scene);

// ---- checks, which throw likewise ------------------------------------------------------------

// Spaces for line breaks: for messages of one line.
std::string withoutBreaks(std::string text);

// Checks the header of a PLY file line by line, and walks over what it counts: every row of every
// element, and every value of every list, has to be there, as memory is taken by those counts.
// Source: the PLY description of G. Turk (1994), with the sized type names that are common now.
void checkPly(std::span<const std::byte> bytes, const LoadLimits& limits);

// Checks three things of COLLADA that Assimp 5.2 does not: counts, offsets and strides, by which memory is taken, are
// no larger than the file; lists of indices hold nothing but whole numbers (at anything else the parser repeats the
// last number until memory ends); and accessors reach no further than the array of numbers that they read.
void checkCollada(std::span<const std::byte> bytes);

} // namespace cotan
