// The highlight of grooves on a sphere whose texture coordinates are turned and sheared.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include "cotan/portable.hpp"
#include "figure.hpp"
#include "figure_renderer.hpp"
#include "plot.hpp"

namespace cotan::figures {

namespace {

constexpr double kPixel = 2.0 / 360; // over which a shader takes derivatives

// Longitude and latitude of a point of the unit sphere, and back.
glm::dvec2 anglesOf(glm::dvec3 p) { return {std::atan2(p.x, p.z), std::asin(p.y)}; }
glm::dvec3 pointOf(glm::dvec2 a)
{
    return {std::sin(a.x) * std::cos(a.y), std::sin(a.y), std::cos(a.x) * std::cos(a.y)};
}

// uv of longitude and latitude: sheared by 45 degrees, then turned by 30.
glm::dmat2 uvOfAngles()
{
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    return glm::dmat2({c, s}, {-s, c}) * glm::dmat2({1, 0}, {1, 1});
}

// The frame of two neighbours, those nearer to the middle, as a pixel sees it.
f64::cotan_frame pixelFrame(glm::dvec2 at)
{
    const glm::dvec3 p = onSphere(at);
    const glm::dvec2 uv = uvOfAngles() * anglesOf(p);
    const glm::dvec3 x = onSphere(at + glm::dvec2(at.x > 0 ? -kPixel : kPixel, 0));
    const glm::dvec3 y = onSphere(at + glm::dvec2(0, at.y > 0 ? -kPixel : kPixel));
    return f64::cotan_frame_gradient(p, x - p, y - p, uvOfAngles() * anglesOf(x) - uv, uvOfAngles() * anglesOf(y) - uv);
}

// The direction along which the grooves run at a point of the image: dP/du, where v is constant.
glm::dvec3 groovesAt(By by, glm::dvec2 at)
{
    const glm::dvec3 n = onSphere(at);
    if (by == By::truth) {
        const glm::dvec2 step = glm::inverse(uvOfAngles()) * glm::dvec2(1e-5, 0), here = anglesOf(n);
        return glm::normalize(pointOf(here + step) - pointOf(here - step));
    }
    const auto f = pixelFrame(at);
    return by == By::cotan ? f64::cotan_tangent_direction(f, n, {1, 0}) : glm::normalize(f.t);
}

glm::dvec3 brushedColor(By by, glm::dvec2 at)
{
    if (glm::length(at) > 0.99)
        return glm::dvec3(0.02);
    const glm::dvec3 n = onSphere(at), t = groovesAt(by, at), v(0, 0, 1);
    const double lines = 0.85 + 0.15 * std::sin((uvOfAngles() * anglesOf(n)).y * 90);
    double light = 0.05 + 0.05 * n.y;
    for (const glm::dvec3 l : {plotLight(), glm::normalize(glm::dvec3(0.5, 0.2, 0.8))})
        light += std::max(glm::dot(n, l), 0.0) * (0.06 + f64::cotan_ggx_anisotropic(n, v, l, 0.35, 0.85, t));
    return glm::dvec3(0.9, 0.75, 0.55) * (light * lines);
}

} // namespace

Figure makeGroovesFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Grooves on a sphere with turned uv";
    figure.text = {
        "Brushed metal, whose grooves run along u. The uv are longitude and latitude, sheared by 45 degrees and turned "
        "by 30. A highlight of grooves is long across them. cotan_tangent_direction finds the grooves from the frame "
        "of each pixel. The frame's t is another vector: the gradient of u, perpendicular to the lines of "
        "constant u. The fine lines show where the grooves are. The truth is the curve of constant v on the sphere."};
    figure.measured = "Angles between directions of grooves and the curves of constant v, without the sphere's rim.";
    plotDirections(figure, studio.height(),
                   {"cotan_tangent_direction", "the frame's t", brushedColor, [](By by, glm::dvec2 at) {
                        return glm::length(at) < 0.9 ? std::optional(groovesAt(by, at)) : std::nullopt;
                    }});
    return figure;
}

} // namespace cotan::figures
