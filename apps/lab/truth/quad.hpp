// Cameras and flat patches in double precision, and the differences that a 2x2 quad of pixels would measure on them.
// The ground truth for tests and tables of accuracy.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/frame.hpp"

namespace cotan {

// A flat patch with affine texture coordinates.
struct AffinePatch {
    glm::dvec3 origin{0};
    glm::dvec3 normal{0, 0, 1}; // unit
    glm::dvec3 gradU{1, 0, 0};  // gradient of u, in the plane
    glm::dvec3 gradV{0, 1, 0};
    glm::dvec2 uvAt(glm::dvec3 p) const { return {glm::dot(gradU, p - origin), glm::dot(gradV, p - origin)}; }
};

// A perspective or orthographic camera with screen coordinates in pixels.
struct PixelCamera {
    glm::dvec3 eye{0};
    glm::dvec3 right{1, 0, 0}; // orthonormal, right-handed: right x up = -forward
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
    double focal = 1000; // pixels; orthographic: pixels per world unit
    bool orthographic = false;
    bool rowsDown = false; // the screen's y axis points down

    static PixelCamera lookAt(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up, double focal,
                              bool orthographic = false);
    // Projects a world point to pixel coordinates.
    glm::dvec2 project(glm::dvec3 p) const;
    // Intersects the ray through a pixel position with a plane, which must not be seen edge-on.
    glm::dvec3 meet(glm::dvec2 pixel, glm::dvec3 pointOfPlane, glm::dvec3 normal) const;
};

// The screen derivatives at a point of the patch, as forward differences of position and uv over `step` pixels. With
// `normalizedView`, positions are replaced by unit vectors from the eye, which models the mistake of passing a
// normalised view vector.
Differences<double> screenDifferences(const PixelCamera& camera, const AffinePatch& patch, glm::dvec3 point,
                                      double step = 1, bool normalizedView = false);

// Rounds the differences to float.
Differences<float> toFloat(const Differences<double>& d);

// The factor s of truth S: 1 over the length of the longer gradient.
double commonScale(glm::dvec3 gradU, glm::dvec3 gradV);

// Angle in degrees between two directions, accurate near 0 and 180; NaN if either is not finite.
double degreesBetween(glm::dvec3 a, glm::dvec3 b);

} // namespace cotan
