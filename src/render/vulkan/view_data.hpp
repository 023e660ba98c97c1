// What a picture needs besides the scene on the device: matrices, lights, the numbers for each
// instance. Computed in double, relative to the eye, and only then rounded. No Vulkan here.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "cotan/view.hpp"
#include "gpu_structs.hpp"
#include "scene/geometry.hpp"

namespace cotan {

inline constexpr int kShadowSize = 2048; // texels a side

// View, shadow map and background constants. view: checkView has passed it. bounds: of the whole scene, world space;
// may be empty. place: what the middle of a pixel sees, from there in pixels of the raster.
gpu::CotanView viewConstants(const View& view, const CameraAxes& axes, const Bounds& bounds, glm::dvec2 place);

// Pixels of the raster, from the first to before the last.
struct PixelArea {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

// What an instance whose mesh lies in the box may cover of the picture, two pixels more on each side; all of it for one
// that reaches behind the eye.
PixelArea areaOf(const gpu::CotanView& view, const gpu::CotanDraw& draw, const Bounds& box, int width, int height);

// Around both.
PixelArea around(const PixelArea& a, const PixelArea& b);

// Lights in the order of the view; at least one entry, so that a buffer can be made of it.
// The first directional light is marked as the one that casts the shadow.
std::vector<gpu::CotanLight> lightConstants(const View& view, const CameraAxes& axes);

bool castsShadow(const View& view);

// The rows of CotanDraw that follow from an instance's matrix; addresses and flags are left zero.
gpu::CotanDraw drawConstants(const glm::mat4& toWorld, const glm::dvec3& eye);

} // namespace cotan
