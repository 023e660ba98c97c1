// Small questions about Scene and Mesh: normals, cameras, lights, what is drawn.
#pragma once

#include "cotan/frame.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"
#include "scene/bounds.hpp"

namespace cotan {

// Replaces the mesh's normals by angle-weighted averages over corners that share a position,
// separated where faces meet at more than `creaseDegrees` (180: everything is smoothed).
// Vertices are split where needed, all attributes with them. Degenerate triangles add nothing; a
// vertex with no usable triangle gets (0,0,1).
void generateNormals(Mesh& mesh, float creaseDegrees = 180);

// A camera that shows the whole box from the front, a little from the right and above.
// An empty box gives the default camera.
Camera fitCamera(const Bounds& box, int width, int height);

// The camera carried about the vertical (y) through its target by `angle` radians, counterclockwise as seen
// from above. It keeps its height and its distance, up to rounding.
Camera turnedAbout(Camera camera, double angle);

// Whether anything that is drawn reads a normal map: some instance of a mesh with triangles and the uv set that
// its material's map asks for. Else normals do not differ between frames, and a comparison of them says nothing.
bool drawsNormalMaps(const Scene& scene);

// Whether the scene can be drawn with the frame: every mesh that is drawn and has the uv of its normal map also has
// what the frame reads at its vertices. A renderer would show it without a frame otherwise. Errors: ErrorKind::usage,
// with the mesh, where deriveVertexFrames (cotan/view.hpp) was left out.
Status checkVertexAttributes(const Scene& scene, Frame frame);

} // namespace cotan
