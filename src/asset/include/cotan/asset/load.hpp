// Files to Scene.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include "cotan/asset/sandbox.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// Which images of a model are decoded. Images without pixels have a name and no size.
enum class Pixels {
    all,           // those that are used; one that cannot be read is an error
    whereReadable, // the same, but those in a format that glTF extensions allow and nothing here reads (foreignFormat in
                   // image_file.hpp) stay without pixels, and a warning names them
    none,          // no image
};

// Limits on what a file may ask for. Over a limit the file is refused before memory is taken.
struct LoadLimits {
    std::size_t fileBytes = std::size_t(2) << 30;   // of the model file or one of its buffers
    std::size_t vertices = 100'000'000;             // of all meshes together
    std::size_t triangles = 100'000'000;            // instances not multiplied
    std::size_t nodes = 1'000'000;
    // glTF: what the vertices and triangles may take in memory beyond sixteen times the size of the
    // file and its buffers. A few bytes can ask for any amount, by accessors without data and by
    // primitives that share them.
    std::size_t geometryBytes = std::size_t(64) << 20;
    int imageSide = 16384;                          // pixels
    std::size_t imageBytes = std::size_t(640) << 20; // decoded, of one image
    std::size_t allImageBytes = std::size_t(8) << 30; // decoded, of all images of one model
    Pixels pixels = Pixels::all;                    // of a glTF model
    Sandbox sandbox = defaultSandbox();             // where models other than glTF, and third-party formats of pictures, are read
    // Told of bytes that are about to be decoded, once their number has been found within the limits: how a reader in
    // a process of its own is given room for them. May be empty.
    std::function<void(std::size_t)> expect;
};

// Reads a model: .gltf and .glb through tinygltf, .obj, everything else (.ply .stl .dae .fbx .3ds)
// through Assimp; all but glTF in a process of its own where limits.sandbox says so. What was odd but usable is said
// in Scene::warnings. Missing normals are generated. Only files inside the model's own folder are opened.
// Errors: ErrorKind::input with one line: file, field, expected, found; a reader's process that crashed,
// or was stopped at a limit, is one, too. ErrorKind::unavailable: it could not be started. Never throws
// for bad input.
Result<Scene> loadScene(const std::filesystem::path& file, const LoadLimits& limits = {});

// The three readers behind loadScene.
Result<Scene> loadGltf(const std::filesystem::path& file, const LoadLimits& limits = {});
Result<Scene> loadObj(const std::filesystem::path& file, const LoadLimits& limits = {});
Result<Scene> loadWithAssimp(const std::filesystem::path& file, const LoadLimits& limits = {});

} // namespace cotan
