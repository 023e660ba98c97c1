// From camera-relative world space to the raster.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "cotan/view.hpp"
#include "scene/geometry.hpp"

namespace cotan::reference {

// toRaster takes a position relative to the eye (world axes) to (x*w, y*w, z*w, w), where x and
// y are pixels from the first raster row's first corner and z is reversed depth: 1 at the near plane,
// falling with distance, linear over the picture.
//   perspective   w is the distance along the view axis, z = near/w
//   orthographic  w = 1, z = 1 - distance/far
struct Projection : CameraAxes {
    glm::dmat4 toRaster{1};
    int width = 0; // pixels
    int height = 0;
    bool orthographic = false;
    bool rowsUpward = false; // raster row 0 is the bottom of the picture
    glm::dvec2 moved{0};     // pixels: what the middle of one sees lies there
};

// The sphere around a scene.
struct Ball {
    glm::dvec3 centre{0};
    double radius = 1;
};

// The sphere around the box of all finite vertex positions; the default one if there are none.
Ball boundingBall(const Scene& scene);

// The view's camera; checkView has passed the view. The near plane lies at 1e-4 of the distance to the far side of the
// ball, so that models seen from inside are cut as late as possible.
Projection cameraProjection(const View& view, const Ball& ball);

// The same with the middle of each pixel seeing what lies `place` pixels from it in the raster.
Projection movedBy(Projection projection, glm::dvec2 place);

// A square map of that many texels that looks along `direction` at the whole ball. Positions stay relative to `eye`.
Projection shadowProjection(glm::dvec3 direction, const Ball& ball, glm::dvec3 eye, int texels);

// The unit direction, in the world, of the view ray through a raster position.
glm::vec3 rayDirection(const Projection& projection, double x, double y);

// Where that ray starts, relative to the eye.
glm::dvec3 rayOrigin(const Projection& projection, double x, double y);

} // namespace cotan::reference
