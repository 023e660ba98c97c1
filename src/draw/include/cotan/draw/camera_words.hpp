// A camera as people write it.
#pragma once

#include <string>

#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// "fit": the whole scene from the front, a little from above; "front": the same, as near as its vertices allow; both
// frame all of an animation (Scene::reach);
// "left", "right", "top", "bottom", "back": the same from that side, straight on; "orbit:AZIMUTH,ELEVATION": from
// any, in degrees as orbitCamera (cotan/scene/front_camera.hpp) has them, at most 360 around and 90 up or down;
// "0", "1", ...: a camera of the scene; or
// "ex,ey,ez,tx,ty,tz": from the eye e to the target t, in world units, y up (-z where it looks straight up or down),
// with a lens of 45 degrees from bottom to top; a seventh number is another lens in degrees, "h" and a number an
// orthographic camera that is so many world units high; three more are the direction up.
// width, height: of the picture, pixels.
// Errors: ErrorKind::usage, with what was expected and found.
Result<Camera> cameraFromWords(const std::string& text, const Scene& scene, int width, int height);

// The words of a camera: cameraFromWords makes the same camera of them, to the bit, but for its name.
std::string cameraWords(const Camera& camera);

} // namespace cotan
