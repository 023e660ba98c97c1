// The relief of the table `curved` as a scene that a renderer can draw, and the errors of the images drawn.
#pragma once

#include <vector>

#include "cotan/view.hpp"
#include "truth/measurement.hpp"
#include "truth/surface.hpp"

namespace cotan {

// A tessellated surface with the relief as a 16-bit normal map in its material.
struct PaintedScene {
    Scene scene;
    Surface surface;
    double mapSide = 1; // uv units that the map spans: map coordinate = (uv - origin) / mapSide
    glm::dvec2 mapOrigin{0};
    double unitsPerUv = 1; // see Surface::unitsPerUv
    std::vector<Camera> cameras;
};

// The map has `texelsPerUnit` texels per uv unit. At 2048 the error of bilinear filtering is at most 0.05 degrees, 0.01
// on average.
PaintedScene paintedScene(const Surface& surface, int segments, int texelsPerUnit = 2048);

// Sets the strength of the map for a frame: unscaled slopes for scale-invariant frames, slopes of metric height for
// `gradient`.
void setStrengthFor(PaintedScene& painted, Frame frame);

// Adds the angle between each pixel's normal and the truth for `frame` (S; E for `gradient`). normals, uv: float32
// images of Output::normal and Output::uv of the same view. Pixels without surface (alpha 0) are skipped.
void addPaintedAngles(const PaintedScene& painted, Frame frame, const Image& normals, const Image& uv,
                      AngleCollector& angles);

} // namespace cotan
