// From Assimp's structures to ours.
#pragma once

#include <string>

#include "cotan/model.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "model_textures.hpp"

struct aiMaterial;
struct aiMesh;
struct aiScene;

namespace cotan {

// ---- assimp_material.cpp --------------------------------------------------------------------

Material convertMaterial(const aiMaterial& source, TextureReader& textures, Scene& scene);

// ---- assimp_mesh.cpp ------------------------------------------------------------------------

struct MeshChoices {
    bool regenerateNormals = false; // the format's normals are those of faces only
    float creaseDegrees = 60;       // where normals are made
};

// Checks every index, count and position before it is used. A mesh without triangles comes back
// empty. Errors: what a broken or hostile file can make Assimp deliver.
Result<Mesh> convertMesh(const aiMesh& source, const std::string& file, const MeshChoices& choices, Scene& scene);

// ---- assimp_nodes.cpp -----------------------------------------------------------------------

// Instances and cameras from the tree of nodes. meshes: for every mesh of the source its index in
// the scene, or -1.
Status convertNodes(const aiScene& source, const std::string& file, const std::vector<int>& meshes,
                    const LoadLimits& limits, Scene& scene);

} // namespace cotan
