// Per-image data besides the scene on the device: matrices, lights, constants per instance. Computed in double relative
// to the eye, then rounded to float. Independent of Vulkan.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "cotan/view.hpp"
#include "gpu_structs.hpp"
#include "scene/geometry.hpp"

namespace cotan {

inline constexpr int kShadowSize = 2048; // texels a side

// View, shadow map and background constants. view: valid by checkView. bounds: of the whole scene in world space; may
// be empty. offset: in raster pixels, from a pixel's centre to the point that it shows.
gpu::CotanView viewConstants(const View& view, const CameraAxes& axes, const Bounds& bounds, glm::dvec2 offset);

// Raster pixels in [x0,x1) x [y0,y1).
struct PixelArea {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

// Bounds on the pixels that an instance may cover, from its mesh's box, with a margin of two pixels; the whole image
// for an instance that reaches behind the near plane.
PixelArea areaOf(const gpu::CotanView& view, const gpu::CotanDraw& draw, const Bounds& box, int width, int height);

// The smallest area that contains both.
PixelArea around(const PixelArea& a, const PixelArea& b);

// Lights in the order of the view, of which the first directional one casts the shadow. Has at least one entry, so that
// its buffer is not empty.
std::vector<gpu::CotanLight> lightConstants(const View& view, const CameraAxes& axes);

bool castsShadow(const View& view);

// The rows of CotanDraw that depend on an instance's matrix; addresses and flags are zero.
gpu::CotanDraw drawConstants(const glm::mat4& toWorld, const glm::dvec3& eye);

} // namespace cotan
