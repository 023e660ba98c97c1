// A decal with bumps across a seam of the surface's texture coordinates.
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "figure.hpp"
#include "figure_renderer.hpp"
#include "plot.hpp"
#include "truth/relief.hpp"

namespace cotan::figures {

namespace {

constexpr double kDecalWidth = 1.3, kDecalAlpha = 0.8; // of the decal: a disc in the middle of its box
constexpr Waves kOwnBumps{0.3, 3};                     // the bumps of the surface itself

// A point of an upright cylinder of radius 1, seen from the front. Left of the seam at x = 0 u runs around and v down;
// to the right the chart is turned by 90 degrees.
struct CylinderPoint {
    double angle, y;
    bool isRight;

    glm::dvec3 normal() const { return {std::sin(angle), 0, std::cos(angle)}; }
    glm::dvec3 around() const { return {std::cos(angle), 0, -std::sin(angle)}; }
    glm::dvec2 uv() const { return isRight ? glm::dvec2(y, angle) : glm::dvec2(angle, -y); }
    // The chart keeps lengths, so that gradients and unit tangents are equal.
    f64::cotan_frame frame() const
    {
        const glm::dvec3 up(0, 1, 0);
        return isRight ? f64::cotan_frame{up, around(), normal()} : f64::cotan_frame{around(), -up, normal()};
    }
    glm::dvec2 decalUv() const { return glm::dvec2(std::sin(angle), -y) / kDecalWidth + 0.5; }
};

CylinderPoint pointAt(glm::dvec2 at) { return {std::asin(at.x), at.y, at.x >= 0}; }

bool isInDecal(const CylinderPoint& p) { return glm::length(p.decalUv() - 0.5) < 0.5; }

ReliefSample ownBumps(const CylinderPoint& p) { return kOwnBumps.at(p.uv().x, p.uv().y); }
HeightSample decalBumps(const CylinderPoint& p) { return relief(Relief::domes, p.decalUv().x, p.decalUv().y); }

glm::dvec3 slopeTexel(double hu, double hv) { return glm::normalize(glm::dvec3(-hu, -hv, 1)); }

// The frame of the projector, and gradients that are mixed.
glm::dvec3 projectedNormal(const CylinderPoint& p)
{
    const ReliefSample b = ownBumps(p);
    const HeightSample d = decalBumps(p);
    const auto box = f64::cotan_frame_projected(p.normal(), {1 / kDecalWidth, 0, 0}, {0, -1 / kDecalWidth, 0});
    const glm::dvec3 mine =
        f64::cotan_gradient_of_slope(box, f64::cotan_slope_of_texel(slopeTexel(d.hu, d.hv)) * kDecalWidth);
    const glm::dvec3 under = f64::cotan_gradient_of_slope(p.frame(), f64::cotan_slope_of_texel(slopeTexel(b.hu, b.hv)));
    return f64::cotan_resolve_gradient(p.normal(), glm::mix(under, mine, isInDecal(p) ? kDecalAlpha : 0));
}

// The decal's texels are mixed into those of the surface, and lit by the surface's tangents.
glm::dvec3 tangentNormal(const CylinderPoint& p)
{
    const ReliefSample b = ownBumps(p);
    const HeightSample d = decalBumps(p);
    return f64::cotan_apply(p.frame(),
                            glm::mix(slopeTexel(b.hu, b.hv), slopeTexel(d.hu, d.hv), isInDecal(p) ? kDecalAlpha : 0));
}

// The normal of the surface moved by both heights, by differences of positions.
glm::dvec3 displacedNormal(const CylinderPoint& p)
{
    const double alpha = isInDecal(p) ? kDecalAlpha : 0;
    const auto moved = [&](double dAngle, double dy) {
        CylinderPoint q = p;
        q.angle += dAngle;
        q.y += dy;
        const glm::dvec3 surface(std::sin(q.angle), q.y, std::cos(q.angle));
        return surface + q.normal() * glm::mix(ownBumps(q).h, decalBumps(q).h * kDecalWidth, alpha);
    };
    constexpr double e = 1e-5;
    return glm::normalize(glm::cross(moved(e, 0) - moved(-e, 0), moved(0, e) - moved(0, -e)));
}

glm::dvec3 decalNormal(By by, const CylinderPoint& p)
{
    return by == By::cotan ? projectedNormal(p) : by == By::usual ? tangentNormal(p) : displacedNormal(p);
}

glm::dvec3 decalColor(By by, glm::dvec2 at)
{
    const CylinderPoint p = pointAt(at);
    const glm::dvec3 color = !isInDecal(p) ? glm::dvec3(0.16, 0.17, 0.2)
        : decalBumps(p).h > 0              ? glm::dvec3(0.8, 0.5, 0.08)
                                           : glm::dvec3(0.5, 0.08, 0.06);
    return plotShade(decalNormal(by, p), {0, 0, 1}, color);
}

} // namespace

Figure makeDecalFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "A decal over a seam";
    figure.text = {
        "A round decal with bumps, projected onto a cylinder from the front. The surface below has bumps of its own, "
        "and a seam in the middle, to the right of which its texture is turned by 90 degrees. The projector knows the "
        "gradients of its u and v, so the decal's bumps are lit as they lie. Lit by the surface's tangents, as in "
        "many engines, they turn with the texture below. The truth is the normal of the surface that is displaced by "
        "both heights."};
    figure.measured = "Angles to the normals of the displaced surface, on the decal.";
    plotDirections(figure, studio.height(),
                   {"cotan_frame_projected", "lit by the surface's tangents", decalColor,
                    [](By by, glm::dvec2 at) -> std::optional<glm::dvec3> {
                        const CylinderPoint p = pointAt(at);
                        return isInDecal(p) ? std::optional(decalNormal(by, p)) : std::nullopt;
                    }});
    return figure;
}

} // namespace cotan::figures
