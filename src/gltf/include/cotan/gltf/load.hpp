// glTF files to Scene.
#pragma once

#include <filesystem>

#include "cotan/files/limits.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// Reads .gltf and .glb. What was odd but usable is said in Scene::warnings. Missing normals are flat ones, as
// glTF asks. Only files inside the model's own folder are opened.
// Errors: ErrorKind::input with one line: file, field, expected, found. Never throws for bad input.
Result<Scene> loadGltf(const std::filesystem::path& file, const LoadLimits& limits = {});

} // namespace cotan
