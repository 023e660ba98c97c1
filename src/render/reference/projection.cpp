#include "projection.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "cotan/vector.hpp"
#include "scene/geometry.hpp"

namespace cotan::reference {

namespace {

constexpr double kShortest = 1e-30; // a vector that has a direction

// A row is dotted with (x, y, z, 1).
glm::dmat4 fromRows(glm::dvec4 x, glm::dvec4 y, glm::dvec4 z, glm::dvec4 w)
{
    return glm::transpose(glm::dmat4(x, y, z, w));
}

// From the middle of the raster, at distance 1 or in a plane across the view.
glm::dvec3 sideways(const Projection& p, double x, double y)
{
    // The first two rows are (axis * pixels + forward * half), so their parts along the axes give the slopes back.
    glm::dmat4 rows = glm::transpose(p.toRaster);
    double pixelsX = glm::dot(glm::dvec3(rows[0]), p.right);
    double pixelsY = glm::dot(glm::dvec3(rows[1]), p.up);
    return p.right * ((x + p.moved.x - 0.5 * p.width) / pixelsX) + p.up * ((y + p.moved.y - 0.5 * p.height) / pixelsY);
}

} // namespace

Ball boundingBall(const Scene& scene)
{
    const Bounds box = bounds(scene);
    if (box.empty())
        return {};
    const glm::dvec3 low(box.low), high(box.high);
    return {low * 0.5 + high * 0.5, std::max(glm::length(high * 0.5 - low * 0.5), 1e-30)};
}

Projection cameraProjection(const View& view, const Ball& ball)
{
    const Camera& camera = view.camera;
    Projection p{cameraAxes(camera)};
    p.width = view.width;
    p.height = view.height;
    p.orthographic = camera.orthographic;
    p.rowsUpward = view.rowsUpward;

    double reach = glm::length(ball.centre - p.eye) + ball.radius;
    double halfWidth = 0.5 * view.width, halfHeight = 0.5 * view.height;
    double pixels; // per unit of slope, or of length
    glm::dvec4 z, w;
    if (camera.orthographic) {
        pixels = view.height / double(camera.verticalExtent);
        z = glm::dvec4(-p.forward / (reach * 1.01), 1);
        w = {0, 0, 0, 1};
    } else {
        double angle = std::min(double(camera.verticalFieldOfView), 3.1);
        pixels = halfHeight / std::tan(0.5 * angle);
        z = {0, 0, 0, 1e-4 * reach};
        w = glm::dvec4(p.forward, 0);
    }
    double down = view.rowsUpward ? 1.0 : -1.0;
    p.toRaster = fromRows(glm::dvec4(p.right * pixels, 0) + w * halfWidth,
                          glm::dvec4(p.up * (pixels * down), 0) + w * halfHeight, z, w);
    return p;
}

Projection movedBy(Projection p, glm::dvec2 place)
{
    glm::dmat4 rows = glm::transpose(p.toRaster);
    rows[0] -= rows[3] * place.x;
    rows[1] -= rows[3] * place.y;
    p.toRaster = glm::transpose(rows);
    p.moved = place;
    return p;
}

Projection shadowProjection(glm::dvec3 direction, const Ball& ball, glm::dvec3 eye, int texels)
{
    Projection p{axesAlong(unitOr(direction, {0, -1, 0}, kShortest), {0, 1, 0})};
    p.eye = eye;
    p.width = p.height = texels;
    p.orthographic = true;
    // One texel of margin, so that the filter finds no edge at the border of the map.
    double pixels = 0.5 * (texels - 2) / ball.radius;
    double depth = 0.5 / (ball.radius * 1.01);
    glm::dvec3 c = ball.centre - eye;
    double half = 0.5 * texels;
    p.toRaster = fromRows(glm::dvec4(p.right * pixels, half - glm::dot(p.right, c) * pixels),
                          glm::dvec4(p.up * -pixels, half + glm::dot(p.up, c) * pixels),
                          glm::dvec4(-p.forward * depth, 0.5 + glm::dot(p.forward, c) * depth), {0, 0, 0, 1});
    return p;
}

glm::vec3 rayDirection(const Projection& p, double x, double y)
{
    return glm::vec3(p.orthographic ? p.forward : unitOr(p.forward + sideways(p, x, y), p.forward, kShortest));
}

glm::dvec3 rayOrigin(const Projection& p, double x, double y)
{
    return p.orthographic ? sideways(p, x, y) : glm::dvec3(0);
}

} // namespace cotan::reference
