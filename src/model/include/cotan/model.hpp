// Reads any model file to a scene.
//
//     auto scene = cotan::loadScene("model.glb"); // or .gltf .obj .ply .stl .dae .fbx .3ds
//     if (!scene)
//         return fail(scene.error().message);
//     for (const std::string& warning : scene->warnings)
//         std::fprintf(stderr, "%s\n", warning.c_str());
//     for (const cotan::Mesh& mesh : scene->meshes)
//         std::printf("%s: %zu triangles\n", mesh.name.c_str(), mesh.triangleCount());
#pragma once

#include <filesystem>

#include "cotan/files.hpp"
#include "cotan/gltf.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// ---- to a scene ----------------------------------------------------------------------------

// Reads a model: .gltf and .glb, .obj, everything else (.ply .stl .dae .fbx .3ds) through Assimp; all but glTF in a
// process of its own where limits.sandbox says so. What comes from limits.readFile is glTF. What was odd but usable is
// said in Scene::warnings. Missing normals are generated. limits.up says whether it is turned. Only files inside the
// model's own folder are opened.
// Errors: ErrorKind::input with one line: file, field, expected, found; a reader's process that crashed, or was stopped
// at a limit, is one, too. ErrorKind::unavailable: it could not be started; not built with Assimp. Never throws for bad
// input.
Result<Scene> loadScene(const std::filesystem::path& file, const LoadLimits& limits = {});

// The readers behind loadScene, with loadGltf of cotan/gltf.hpp.
Result<Scene> loadObj(const std::filesystem::path& file, const LoadLimits& limits = {});
Result<Scene> loadWithAssimp(const std::filesystem::path& file, const LoadLimits& limits = {});

// ---- the reader in a child process, see cotan/files.hpp ------------------------------------

// Whether this process was started to read for another one.
bool isReaderProcess(int argc, const char* const* argv);

// Reads what the parent asks for, and answers. Returns the exit code where there is no parent; else it does not return.
int runReaderProcess();

} // namespace cotan
