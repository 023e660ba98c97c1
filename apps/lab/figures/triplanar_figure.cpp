// A sphere without texture coordinates: three planar maps, blended.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "figure.hpp"
#include "figure_renderer.hpp"
#include "plot.hpp"
#include "truth.hpp"
#include "truth/quad.hpp"
#include "truth/relief.hpp"

namespace cotan::figures {

namespace {

constexpr double kTile = 1.1; // width of a tile of the map; the sphere's radius is 1
constexpr double kNudge = 1e-5;

enum class Weights { smooth, sharp };

// The map in the plane across an axis, read at the coordinates that cotan_gradient_triplanar names: height and slopes.
HeightSample mapAcross(int axis, glm::dvec3 p)
{
    const glm::dvec2 at = axis == 0 ? glm::dvec2(p.z, p.y) : axis == 1 ? glm::dvec2(p.x, p.z) : glm::dvec2(p.x, p.y);
    HeightSample s = relief(Relief::domes, at.x / kTile, at.y / kTile);
    s.h *= kTile;
    return s;
}

glm::dvec3 weightsAt(Weights weights, glm::dvec3 n)
{
    if (weights == Weights::smooth)
        return f64::cotan_triplanar_weights(n);
    const glm::dvec3 a = glm::abs(n);
    return a.x > a.y && a.x > a.z ? glm::dvec3(1, 0, 0) : a.y > a.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
}

glm::dvec3 texelAcross(int axis, glm::dvec3 p)
{
    const HeightSample s = mapAcross(axis, p);
    return glm::normalize(glm::dvec3(-s.hu, -s.hv, 1));
}

glm::dvec3 addedNormal(Weights weights, glm::dvec3 n)
{
    const auto slope = [&](int axis) { return f64::cotan_slope_of_texel(texelAcross(axis, n)); };
    return f64::cotan_resolve_gradient(
        n, f64::cotan_gradient_triplanar(n, weightsAt(weights, n), slope(0), slope(1), slope(2)));
}

// Each texel is added to the normal in the axes of its plane, and scales the part along it; B. Golus, Normal Mapping
// for a Triplanar Shader (2017), whiteout blend.
glm::dvec3 whiteoutNormal(Weights weights, glm::dvec3 n)
{
    const glm::dvec3 x = texelAcross(0, n), y = texelAcross(1, n), z = texelAcross(2, n), w = weightsAt(weights, n);
    return glm::normalize(w.x * glm::dvec3(x.z * n.x, x.y + n.y, x.x + n.z)
                          + w.y * glm::dvec3(y.x + n.x, y.z * n.y, y.y + n.z)
                          + w.z * glm::dvec3(z.x + n.x, z.y + n.y, z.z * n.z));
}

// The blended texel in the tangents of a mesh whose u runs around the sphere and v up.
glm::dvec3 meshTangentNormal(Weights weights, glm::dvec3 n)
{
    const glm::dvec3 w = weightsAt(weights, n);
    const glm::dvec3 texel = w.x * texelAcross(0, n) + w.y * texelAcross(1, n) + w.z * texelAcross(2, n);
    const glm::dvec3 around = glm::normalize(glm::dvec3(n.z, 0, -n.x));
    return glm::normalize(around * texel.x + glm::cross(n, around) * texel.y + n * texel.z);
}

// The normal of the sphere that is displaced by the blended height. sharp: by the height of one map, that of n.
glm::dvec3 displacedSphereNormal(Weights weights, glm::dvec3 n)
{
    const glm::dvec3 x = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.5, 0.81))), y = glm::cross(n, x);
    const auto moved = [&](glm::dvec3 by) {
        const glm::dvec3 p = glm::normalize(n + by * kNudge);
        const glm::dvec3 w = weightsAt(weights, weights == Weights::sharp ? n : p);
        return p * (1 + w.x * mapAcross(0, p).h + w.y * mapAcross(1, p).h + w.z * mapAcross(2, p).h);
    };
    return glm::normalize(glm::cross(moved(x) - moved(-x), moved(y) - moved(-y)));
}

using Method = glm::dvec3 (*)(Weights, glm::dvec3 n);

// The largest angle between the normals on both sides of the planes |x| = |y|, |y| = |z| and |z| = |x|, less that of
// the sphere itself.
double jumpAtSeams(Method method, Weights weights)
{
    double worst = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 2000; ++i) {
            const double a = (i + 0.5) / 2000 * 2 - 1; // along the seam, where the third coordinate is not the largest
            glm::dvec3 p(0);
            p[axis] = a;
            p[(axis + 1) % 3] = i % 2 ? -1 : 1;
            p[(axis + 2) % 3] = i % 4 < 2 ? -1 : 1;
            glm::dvec3 q = p;
            p[(axis + 1) % 3] *= 1 + kNudge;
            q[(axis + 2) % 3] *= 1 + kNudge;
            worst =
                std::max(worst, degreesBetween(method(weights, glm::normalize(p)), method(weights, glm::normalize(q))));
        }
    return worst;
}

void addNumbers(Figure& figure, const std::string& name, Method method)
{
    for (const Weights weights : {Weights::smooth, Weights::sharp}) {
        const std::string kind = name + (weights == Weights::smooth ? ", smooth" : ", sharp");
        const auto errors = plotValues([&](glm::dvec2 at) -> std::optional<double> {
            const glm::dvec3 n = onSphere(at);
            if (glm::length(at) >= 0.95)
                return std::nullopt;
            return degreesBetween(method(weights, n), displacedSphereNormal(weights, n));
        });
        figure.numbers.push_back({kind + ", mean degrees", angleStatistics(errors).mean});
        figure.numbers.push_back({kind + ", worst degrees at a seam", jumpAtSeams(method, weights)});
    }
}

glm::dvec3 triplanarNormal(By by, glm::dvec2 at)
{
    const Method method = by == By::cotan ? addedNormal : by == By::usual ? meshTangentNormal : displacedSphereNormal;
    return method(Weights::smooth, onSphere(at));
}

glm::dvec3 stoneColor(By by, glm::dvec2 at)
{
    if (glm::length(at) > 0.995)
        return glm::dvec3(0.02);
    return plotShade(triplanarNormal(by, at), {0, 0, 1}, {0.42, 0.4, 0.36});
}

} // namespace

Figure makeTriplanarFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "A sphere without texture coordinates";
    figure.text = {
        "Three planar maps of domes, read by position and blended by the normal. cotan_gradient_triplanar gives one "
        "gradient, with the right sign on all six sides. Lit by the tangents of the mesh, which many first shaders do, "
        "domes become dents where the plane's axes run the other way. The truth is the normal of the sphere that is "
        "displaced by the blended height."};
    figure.measured = "Angles to the normals of the displaced sphere, without its rim.";
    plotDirections(figure, studio.height(),
                   {"cotan_gradient_triplanar", "lit by the mesh's tangents", stoneColor, [](By by, glm::dvec2 at) {
                        return glm::length(at) < 0.95 ? std::optional(triplanarNormal(by, at)) : std::nullopt;
                    }});
    addNumbers(figure, "cotan", addedNormal);
    addNumbers(figure, "whiteout", whiteoutNormal);
    addNumbers(figure, "tangents", meshTangentNormal);
    return figure;
}

} // namespace cotan::figures
