// Reads a model file of any supported format into a scene.
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

// Reads a model: .gltf and .glb, .obj, all others (.ply .stl .dae .fbx .3ds) through Assimp. If limits.sandbox names a
// program, all formats but glTF are read in a child process. Data from limits.readFile must be glTF. Unusual but usable
// content is reported in Scene::warnings. Missing normals are generated. limits.up selects a rotation to y up. Only
// files inside the model's own folder are opened.
// Errors: ErrorKind::input with one line: file, field, expected, found; also if the child process crashes or exceeds a
// limit. ErrorKind::unavailable: the child process cannot be started; built without Assimp. Never throws for bad input.
Result<Scene> loadScene(const std::filesystem::path& file, const LoadLimits& limits = {});

// The readers that loadScene uses besides loadGltf of cotan/gltf.hpp.
Result<Scene> loadObj(const std::filesystem::path& file, const LoadLimits& limits = {});
Result<Scene> loadWithAssimp(const std::filesystem::path& file, const LoadLimits& limits = {});

// ---- the reader in a child process, see cotan/files.hpp ------------------------------------

// Whether this process was started as a reader for another process.
bool isReaderProcess(int argc, const char* const* argv);

// Serves the parent's request. Returns an exit code only if there is no parent or no valid request; otherwise exits.
int runReaderProcess();

} // namespace cotan
