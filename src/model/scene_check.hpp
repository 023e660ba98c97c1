// What everybody who takes a Scene relies on.
#pragma once

#include <string>

#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// Checks that pictures have all their bytes; that indices of images, uv sets, materials, meshes and vertices lead to
// something; that every array of a mesh is empty or has one entry a vertex, and normals are there; that all numbers
// but those of pictures are finite. file: for messages. Errors: ErrorKind::input, one line.
Status checkScene(const Scene& scene, const std::string& file);

} // namespace cotan
