// Whether a scene holds together, for scenes that were filled by hand or came from somewhere that is not trusted, and
// whether a view can be drawn.
#pragma once

#include <string>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

struct View;

// What may be asked for beyond sizes and indices.
struct SceneRules {
    bool finite = true; // all numbers but those of pictures are finite
    bool pixels = true; // every picture has them; where false, it may also have no size and no data
};

// Checks that pictures have all their bytes; that indices of images, uv sets, materials, meshes and vertices lead to
// something; that every array of a mesh is empty or has one entry a vertex, and normals are there; and the rules.
// Scenes that a reader of Cotan gives always pass, but for pictures that it was told not to read. Bakers, linters and
// painters ask for as much as they need by themselves and return the same error.
// name: begins the message. Errors: ErrorKind::input, one line: what, where, expected, found.
Status checkScene(const Scene& scene, const std::string& name = "scene", const SceneRules& rules = {});

// Checks what both renderers ask of a view: a size from 1 pixel a side; a frame that there is; 1, 4 or 16 samples;
// finite numbers; a camera whose eye is not its target, whose up is not along that line, and whose lens opens by more
// than nothing and less than half a turn. Both renderers call it. Errors: ErrorKind::usage, one line that begins with
// the field: "view.camera: ".
Status checkView(const View& view);

} // namespace cotan
