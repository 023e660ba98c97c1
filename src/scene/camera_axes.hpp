// The axes of what looks along a direction.
#pragma once

#include <glm/vec3.hpp>

#include "cotan/view.hpp"

namespace cotan {

// right, up and forward: unit and perpendicular to one another, right = cross(forward, up).
struct CameraAxes {
    glm::dvec3 eye{0};
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
};

// forward: unit. `up` is as near to the given one as it can be; where that is zero, not finite, or along forward, y
// takes its place, and -z where forward is nearly vertical. The eye is the origin.
CameraAxes axesAlong(const glm::dvec3& forward, const glm::dvec3& up);

// A camera whose eye is not finite stands at the origin; one that looks nowhere (eye = target) looks along -z.
CameraAxes cameraAxes(const Camera& camera);

} // namespace cotan
