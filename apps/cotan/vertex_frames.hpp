// The attributes that frames from vertices need, derived at load.
#pragma once

#include "cotan/frame.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan::app {

// Gives every mesh with uv what `frame` reads: cotangents for `smooth`, tangents for `vertex` and
// `mikktspace` (those in the file are kept unless `regenerate`). Other frames need nothing. Meshes
// are split where tangents differ at a shared vertex.
void deriveVertexFrames(Scene& scene, Frame frame, bool regenerate);

} // namespace cotan::app
