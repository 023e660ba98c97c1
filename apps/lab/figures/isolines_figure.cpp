// Lines of constant u and v on a sheared patch, with the tangents and the gradients.
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "figure.hpp"
#include "figure_renderer.hpp"
#include "plot.hpp"
#include "truth/quad.hpp"

namespace cotan::figures {

namespace {

// u = (x - y) / spacing, v = y / spacing: sheared by 45 degrees, a line for each whole number.
constexpr double kLineSpacing = 0.45;
const glm::dvec3 kOfU(0.75, 0.08, 0.03), kOfV(0.02, 0.16, 0.7);

glm::dvec2 uvAt(glm::dvec2 p) { return glm::dvec2(p.x - p.y, p.y) / kLineSpacing; }

// By differences over a pixel.
f64::cotan_frame frameOfPatch()
{
    const glm::dvec2 x(0.01, 0), y(0, -0.01);
    return f64::cotan_frame_gradient({0, 0, 1}, glm::dvec3(x, 0), glm::dvec3(y, 0), uvAt(x), uvAt(y));
}

struct Arrow {
    glm::dvec2 to; // from the origin
    glm::dvec3 color;
};

bool isOnArrow(const Arrow& a, glm::dvec2 p)
{
    constexpr double kHalfWidth = 0.016, kHead = 0.11, kHeadSlope = 0.45;
    const double length = glm::length(a.to);
    const glm::dvec2 d = a.to / length;
    const double along = glm::dot(p, d), across = std::abs(d.x * p.y - d.y * p.x);
    return along > 0 && along < length
        && across < (along > length - kHead ? (length - along) * kHeadSlope : kHalfWidth);
}

Image linesAndArrows(int side, std::span<const Arrow> arrows, const f64::cotan_frame& f)
{
    return plot(side, [&](glm::dvec2 p) {
        for (const Arrow& a : arrows)
            if (isOnArrow(a, p))
                return a.color;
        const glm::dvec2 uv = uvAt(p);
        const auto isOnLine = [](double value, glm::dvec3 gradient) {
            return std::abs(value - std::round(value)) / glm::length(gradient) < 0.007;
        };
        return isOnLine(uv.x, f.t) ? glm::dvec3(1.1, 0.45, 0.35)
            : isOnLine(uv.y, f.b)  ? glm::dvec3(0.35, 0.55, 1.2)
                                   : glm::dvec3(3);
    });
}

} // namespace

Figure makeIsolinesFigure(FigureRenderer& studio)
{
    const auto f = frameOfPatch();
    const glm::dvec3 alongU = f64::cotan_tangent_direction(f, f.n, {1, 0});
    const glm::dvec3 linesOfU(glm::normalize(glm::dvec2(1, 1)), 0), linesOfV(1, 0, 0); // by the formula of uvAt
    const glm::dvec2 dpdu(kLineSpacing, 0), dpdv(kLineSpacing, kLineSpacing);          // to the next line
    Figure figure;
    figure.title = "Why gradients";
    figure.text = {
        "A patch with sheared texture coordinates, with lines of constant u (red) and constant v (blue). The tangents "
        "dP/du (red arrow) and dP/dv (blue arrow) run along the lines of the other coordinate. The gradients of u and "
        "v are perpendicular to their own lines: they are normals of the lines, and longer where lines are closer. A "
        "bump that depends on u only is a ridge along the red lines, so it tilts the normal along the gradient of u, "
        "and not along dP/du. Where lines cross at right angles the two are parallel, and the difference is hidden."};
    const Arrow tangents[] = {{dpdu * 1.0, kOfU}, {dpdv * 1.0, kOfV}};
    // Gradients have the unit 1/length; one line spacing makes them as long as the tangents of square texels.
    const double unit = kLineSpacing * kLineSpacing;
    const Arrow gradients[] = {{glm::dvec2(f.t) * unit, kOfU}, {glm::dvec2(f.b) * unit, kOfV}};
    const double tangentOff = std::abs(90 - degreesBetween(alongU, linesOfU)),
                 gradientOff = std::abs(90 - degreesBetween(f.t, linesOfU));
    figure.numbers = {{"grad u, degrees from the normal of the lines of u", gradientOff},
                      {"dP/du, degrees from the normal of the lines of u", tangentOff},
                      {"dP/du, degrees from the lines of v", degreesBetween(alongU, linesOfV)}};
    const auto caption = [](double off) { return fmt::format("{:.0f} degrees off the normal of the red lines.", off); };
    figure.panels = {
        {"a-tangents", "tangents dP/du, dP/dv", caption(tangentOff), linesAndArrows(studio.height(), tangents, f)},
        {"b-gradients", "gradients of u and v", caption(gradientOff), linesAndArrows(studio.height(), gradients, f)}};
    figure.sliders = {{0, 1}};
    return figure;
}

} // namespace cotan::figures
