// Validation of scenes that were built by hand or come from untrusted sources, and of views before they are drawn.
#pragma once

#include <string>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

struct View;

// Checks beyond sizes and indices.
struct SceneRules {
    bool finite = true; // all numbers except image data must be finite
    bool pixels = true; // every image must have pixels; false: an image may also have no size and no data
};

// Checks that images have all their bytes; that indices of images, uv sets, materials, meshes and vertices are in
// range; that every per-vertex array is empty or has one entry per vertex, with normals present; and the rules. Scenes
// from Cotan's own readers always pass, except for images that were skipped on request. Bakers, linters and other users
// call it with the rules they need and return the same error.
// name: begins the message. Errors: ErrorKind::input, one line: what, where, expected, found.
Status checkScene(const Scene& scene, const std::string& name = "scene", const SceneRules& rules = {});

// Checks a view before drawing; both renderers call it: at least 1 pixel per side; a valid frame; 1, 4 or 16 samples;
// finite numbers; a camera whose eye is not its target, whose up is not parallel to the line of sight, and whose field
// of view is above 0 and below pi. Errors: ErrorKind::usage, one line that begins with the field: "view.camera: ".
Status checkView(const View& view);

} // namespace cotan
