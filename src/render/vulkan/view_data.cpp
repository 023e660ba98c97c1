#include "view_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/covector.hpp"
#include "cotan/vector.hpp"
#include "scene/environment_map.hpp"

namespace cotan {

namespace {

using glm::dvec3;

constexpr double kShortest = 1e-30; // minimum length of a vector with a direction

gpu::vec4 row(const dvec3& v, double w) { return gpu::vec4(float(v.x), float(v.y), float(v.z), float(w)); }

std::array<dvec3, 8> corners(const Bounds& b)
{
    std::array<dvec3, 8> result;
    for (std::size_t i = 0; i < 8; ++i)
        result[i] = dvec3(i & 1 ? b.high.x : b.low.x, i & 2 ? b.high.y : b.low.y, i & 4 ? b.high.z : b.low.z);
    return result;
}

struct Range {
    double low = 0;
    double high = 0;
};

// The extent of the box along `axis`, measured from `origin`.
Range extent(const Bounds& bounds, const dvec3& axis, const dvec3& origin)
{
    if (bounds.empty())
        return {-1, 1};
    Range range{1e300, -1e300};
    for (const dvec3& corner : corners(bounds)) {
        const double d = glm::dot(corner - origin, axis);
        range.low = std::min(range.low, d);
        range.high = std::max(range.high, d);
    }
    return range;
}

// Distance from the eye to the far side of the scene.
double farDistance(const CameraAxes& axes, const Bounds& bounds)
{
    if (bounds.empty())
        return 1;
    const double radius = glm::length(dvec3(bounds.high) - dvec3(bounds.low)) / 2;
    return std::max(glm::length(dvec3(bounds.centre()) - axes.eye) + radius, 1e-30);
}

// Depth is reversed (1 near, 0 far): floats are densest at 0, and so is perspective depth.
void cameraRows(gpu::CotanView& g, const View& view, const CameraAxes& axes, const Bounds& bounds)
{
    const bool orthographic = view.camera.orthographic;
    // Half the image height: a length, or the tangent of an angle.
    const double halfY = orthographic ? double(view.camera.verticalExtent) / 2
                                      : std::tan(std::min(double(view.camera.verticalFieldOfView), 3.1) / 2);
    const double halfX = halfY * view.width / view.height;
    const double down = view.rowsUpward ? 1 : -1; // Vulkan's clip y points down the raster
    g.clipX = row(axes.right / halfX, 0);
    g.clipY = row(axes.up * (down / halfY), 0);
    g.forward = row(axes.forward, orthographic ? 0 : 1);
    if (orthographic) { // from the eye's plane to behind the scene; right and up stay 0
        g.clipZ = row(axes.forward * (-1 / (farDistance(axes, bounds) * 1.01)), 1);
        g.clipW = row(dvec3(0), 1);
    } else { // no far plane; the near plane is close enough not to cut most models seen from inside
        g.clipZ = row(dvec3(0), 1e-4 * farDistance(axes, bounds));
        g.clipW = row(axes.forward, 0);
        g.right = row(axes.right * halfX, 0);
        g.up = row(axes.up * (down * halfY), 0);
    }
}

// An orthographic square view along the light that just contains the scene.
void shadowRows(gpu::CotanView& g, const Light& light, float softness, const CameraAxes& axes, const Bounds& bounds)
{
    const CameraAxes along = axesAlong(unitOr(dvec3(light.direction), dvec3(0, -1, 0), kShortest), dvec3(0, 1, 0));
    const Range x = extent(bounds, along.right, axes.eye);
    const Range y = extent(bounds, along.up, axes.eye);
    const Range z = extent(bounds, along.forward, axes.eye);
    // Four texels of margin keep the filter inside the map.
    const double margin = 1 + 8.0 / kShadowSize;
    const double size = std::max({x.high - x.low, y.high - y.low, 1e-6}) * margin;
    const double deep = std::max(z.high - z.low, 1e-6) * 1.02;
    const auto unitRow = [&](const dvec3& axis, Range range, double length) {
        return row(axis / length, 0.5 - (range.low + range.high) / 2 / length);
    };
    g.shadowX = unitRow(along.right, x, size);
    g.shadowY = unitRow(along.up, y, size);
    g.shadowZ = unitRow(along.forward, z, deep);
    const double texel = size / kShadowSize;
    // Half a texel of depth bias, in addition to the offset along the normal.
    g.shadow = gpu::vec4(float(texel), float(kShadowSize), float(0.5 * texel / deep), 0);
    g.soft = gpu::vec4(float(softness * deep / size), kMaxPenumbra, float(size / deep), 0);
}

void groundRows(gpu::CotanView& g, const GroundMap& map, const CameraAxes& axes)
{
    const glm::dvec2 scale = 1.0 / glm::dvec2(map.extent);
    const glm::dvec2 offset = (glm::dvec2(axes.eye.x, axes.eye.z) - glm::dvec2(map.low)) * scale;
    g.ground = gpu::vec4(float(scale.x), float(offset.x), float(scale.y), float(offset.y));
    g.tone.z = float(map.height - axes.eye.y);
}

// Shifts the view so that a pixel's centre shows what is `offset` raster pixels from it.
void moveSample(gpu::CotanView& g, const View& view, glm::dvec2 offset)
{
    const float x = float(2 * offset.x / view.width), y = float(2 * offset.y / view.height);
    g.clipX -= g.clipW * x;
    g.clipY -= g.clipW * y;
    g.forward += g.right * x + g.up * y; // w of both is 0
}

} // namespace

gpu::CotanView viewConstants(const View& view, const CameraAxes& axes, const Bounds& bounds, glm::dvec2 offset)
{
    gpu::CotanView g{};
    cameraRows(g, view, axes, bounds);
    if (const Light* light = shadowLight(view))
        shadowRows(g, *light, view.shadowSoftness, axes, bounds);
    g.tone = gpu::vec4(view.exposure, view.backdrop == Backdrop::sharp ? 0 : kBackdropRoughness, 0, 0);
    if (view.ground)
        groundRows(g, *view.ground, axes);
    moveSample(g, view, offset);
    g.counts = gpu::uvec4(static_cast<gpu::uint>(view.lights.size()), view.dither ? 1 : 0,
                          view.rowsUpward ? static_cast<gpu::uint>(view.height) : 0, 0);
    return g;
}

PixelArea areaOf(const gpu::CotanView& view, const gpu::CotanDraw& draw, const Bounds& box, int width, int height)
{
    if (box.empty())
        return {};
    float left = 1e30f, right = -1e30f, top = 1e30f, bottom = -1e30f;
    for (const dvec3& corner : corners(box)) {
        const gpu::vec4 p(corner, 1);
        const gpu::vec4 seen(glm::dot(draw.rowX, p), glm::dot(draw.rowY, p), glm::dot(draw.rowZ, p), 1);
        const float w = glm::dot(view.clipW, seen);
        if (!(w > glm::dot(view.clipZ, seen) && w > 0)) // in front of the near plane, or not finite
            return {0, 0, width, height};
        const float x = (glm::dot(view.clipX, seen) / w * 0.5f + 0.5f) * float(width);
        const float y = (glm::dot(view.clipY, seen) / w * 0.5f + 0.5f) * float(height);
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
    }
    const auto inside = [](float x, int most) { return int(std::clamp(x, 0.0f, float(most))); };
    return {inside(left - 2, width), inside(top - 2, height), inside(right + 3, width), inside(bottom + 3, height)};
}

PixelArea around(const PixelArea& a, const PixelArea& b)
{
    if (a.empty() || b.empty())
        return a.empty() ? b : a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

bool castsShadow(const View& view) { return view.shadows && shadowLight(view) != nullptr; }

std::vector<gpu::CotanLight> lightConstants(const View& view, const CameraAxes& axes)
{
    std::vector<gpu::CotanLight> result;
    const Light* caster = view.shadows ? shadowLight(view) : nullptr;
    for (const Light& light : view.lights) {
        gpu::CotanLight g{};
        const double kind = light.kind == LightKind::directional ? 0 : light.kind == LightKind::point ? 1 : 2;
        g.position = row(dvec3(light.position) - axes.eye, kind);
        g.direction = row(unitOr(dvec3(light.direction), dvec3(0, -1, 0), kShortest), light.range);
        g.color = row(dvec3(light.color) * double(light.intensity), &light == caster ? 1 : 0);
        const float outer = std::cos(light.outerCone);
        // The minimum difference of the cones prevents a division by zero.
        g.cone = gpu::vec4(outer, std::max(std::cos(light.innerCone), outer + 1e-4f), 0, 0);
        result.push_back(g);
    }
    if (result.empty())
        result.push_back({});
    return result;
}

gpu::CotanDraw drawConstants(const glm::mat4& toWorld, const glm::dvec3& eye)
{
    const dvec3 x(toWorld[0]), y(toWorld[1]), z(toWorld[2]);
    const dvec3 origin = dvec3(toWorld[3]) - eye;
    gpu::CotanDraw g{};
    g.rowX = row({x.x, y.x, z.x}, origin.x);
    g.rowY = row({x.y, y.y, z.y}, origin.y);
    g.rowZ = row({x.z, y.z, z.z}, origin.z);

    // Only directions matter, so the matrix is normalised in size.
    const LinearMap<double> map{glm::dmat3(toWorld)};
    glm::dmat3 c = map.planeMatrix();
    const double size = std::max({glm::length(c[0]), glm::length(c[1]), glm::length(c[2])});
    c *= size > 0 && std::isfinite(size) ? 1 / size : 0;
    g.normalX = row({c[0].x, c[1].x, c[2].x}, map.determinant() < 0 ? -1 : 1);
    g.normalY = row({c[0].y, c[1].y, c[2].y}, 0);
    g.normalZ = row({c[0].z, c[1].z, c[2].z}, 0);
    return g;
}

} // namespace cotan
