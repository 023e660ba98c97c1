// The attributes that frames from vertices need, derived from a scene's meshes.
#pragma once

#include "cotan/frame.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// Where the tangents come from that a frame reads, `mikktspace` and `vertex`.
enum class TangentOrigin {
    stored,    // those of the file; generated where it has none
    generated, // always derived from positions, normals and uv
};

// Gives every mesh with uv what `frame` reads at its vertices: cotangents for `smooth`, tangents for `vertex` and
// `mikktspace`. Other frames need nothing, and the scene stays as it is. Vertices are split where tangents differ or
// the uv are mirrored, all attributes with them; the triangles keep their number and order. Renderers refuse a scene
// that lacks it. A mesh without triangles or without the uv set of its normal map (set 0 where there is no map) stays
// as it is. Triangles without an area in space or in uv: see cotan/tangents.hpp.
void deriveVertexFrames(Scene& scene, Frame frame, TangentOrigin tangents);

} // namespace cotan
