// The value of one pixel of a triangle, or of the background.
#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "projection.hpp"
#include "reference_light.hpp"
#include "surface.hpp"

namespace cotan::reference {

struct Fragment {
    glm::vec4 value{0};     // shaded: linear colour and alpha; otherwise the output's x y z, and 1
    glm::vec3 through{0};   // factors of what is behind, where the material is translucent
    bool discarded = false; // invisible
};

// What all pixels of a picture share.
struct PixelInputs {
    const View& view;
    Projection projection;
    std::vector<PreparedLight> lights;
    ShadowMap shadow;
};

// Always finite. Shaded colours are exposed and, unless the view wants them linear, tone mapped.
Fragment shade(const PixelInputs& all, const SurfaceInputs& in, int lane);

// The background in a pixel of the raster: the environment where the view wants it, otherwise 0.
glm::vec4 background(const PixelInputs& all, int x, int y);

} // namespace cotan::reference
