// Files to Scene.
#pragma once

#include <filesystem>

#include "cotan/files/limits.hpp"
#include "cotan/gltf/load.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// Reads a model: .gltf and .glb, .obj, everything else (.ply .stl .dae .fbx .3ds)
// through Assimp; all but glTF in a process of its own where limits.sandbox says so. What comes from limits.readFile is
// glTF. What was odd but usable is said
// in Scene::warnings. Missing normals are generated. limits.up says
// whether it is turned. Only files inside the model's own folder are opened.
// Errors: ErrorKind::input with one line: file, field, expected, found; a reader's process that crashed,
// or was stopped at a limit, is one, too. ErrorKind::unavailable: it could not be started; not built with Assimp.
// Never throws
// for bad input.
Result<Scene> loadScene(const std::filesystem::path& file, const LoadLimits& limits = {});

// The readers behind loadScene, with loadGltf of cotan/gltf/load.hpp.
Result<Scene> loadObj(const std::filesystem::path& file, const LoadLimits& limits = {});
Result<Scene> loadWithAssimp(const std::filesystem::path& file, const LoadLimits& limits = {});

} // namespace cotan
