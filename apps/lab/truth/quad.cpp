#include "truth/quad.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cotan/vector.hpp"

namespace cotan {

PixelCamera PixelCamera::lookAt(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up, double focal, bool orthographic)
{
    PixelCamera c;
    c.eye = eye;
    c.forward = glm::normalize(target - eye);
    c.right = glm::normalize(glm::cross(c.forward, up));
    c.up = glm::cross(c.right, c.forward);
    c.focal = focal;
    c.orthographic = orthographic;
    return c;
}

glm::dvec2 PixelCamera::project(glm::dvec3 p) const
{
    const glm::dvec3 e = p - eye;
    const double scale = orthographic ? focal : focal / glm::dot(e, forward);
    return {glm::dot(e, right) * scale, glm::dot(e, up) * scale * (rowsDown ? -1 : 1)};
}

glm::dvec3 PixelCamera::meet(glm::dvec2 pixel, glm::dvec3 pointOfPlane, glm::dvec3 normal) const
{
    const double y = rowsDown ? -pixel.y : pixel.y;
    if (orthographic) {
        const glm::dvec3 o = eye + right * (pixel.x / focal) + up * (y / focal);
        return o + forward * (glm::dot(normal, pointOfPlane - o) / glm::dot(normal, forward));
    }
    const glm::dvec3 d = forward * focal + right * pixel.x + up * y;
    return eye + d * (glm::dot(normal, pointOfPlane - eye) / glm::dot(normal, d));
}

Differences<double> screenDifferences(const PixelCamera& camera, const AffinePatch& patch, glm::dvec3 point,
                                      double step, bool normalizedView)
{
    const glm::dvec2 pixel = camera.project(point);
    const glm::dvec3 p0 = camera.meet(pixel, patch.origin, patch.normal);
    const glm::dvec3 px = camera.meet(pixel + glm::dvec2(step, 0), patch.origin, patch.normal);
    const glm::dvec3 py = camera.meet(pixel + glm::dvec2(0, step), patch.origin, patch.normal);
    auto position = [&](glm::dvec3 p) { return normalizedView ? glm::normalize(p - camera.eye) : p; };
    Differences<double> d;
    d.dpdx = Vector3d(position(px) - position(p0));
    d.dpdy = Vector3d(position(py) - position(p0));
    d.duvdx = patch.uvAt(px) - patch.uvAt(p0);
    d.duvdy = patch.uvAt(py) - patch.uvAt(p0);
    return d;
}

Differences<float> toFloat(const Differences<double>& d)
{
    Differences<float> f;
    f.dpdx = Vector3f(glm::vec3(d.dpdx.raw()));
    f.dpdy = Vector3f(glm::vec3(d.dpdy.raw()));
    f.duvdx = glm::vec2(d.duvdx);
    f.duvdy = glm::vec2(d.duvdy);
    return f;
}

double commonScale(glm::dvec3 gradU, glm::dvec3 gradV)
{
    return 1 / std::sqrt(std::max(glm::dot(gradU, gradU), glm::dot(gradV, gradV)));
}

double degreesBetween(glm::dvec3 a, glm::dvec3 b) { return angleBetween(a, b) * 180 / std::numbers::pi; }

} // namespace cotan
