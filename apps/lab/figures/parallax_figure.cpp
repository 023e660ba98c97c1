// Parallax on sheared and mirrored texture coordinates, compared with rays against the displaced surface.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "figure.hpp"
#include "figure_renderer.hpp"
#include "plot.hpp"

namespace cotan::figures {

namespace {

constexpr double kDomeDepth = 0.06; // of the domes, in units of uv and of positions
constexpr double kTexels = 512;     // of the map, per unit of uv
constexpr int kReadings = 64, kHalvings = 6;
constexpr double kGrazing = 0.3; // n . v below which nothing is measured: 72 degrees

// A plane, or a cylinder of radius 1, on which u = |x| + y and v = -y: sheared by 45 degrees and mirrored at x = 0.
struct Ground {
    const char* name;
    bool isCurved;
    double elevation; // of the view, in degrees from the front

    glm::dvec3 toEye() const
    {
        const double a = elevation * std::numbers::pi / 180;
        return {0, -std::sin(a), std::cos(a)};
    }
    // The coordinates along x and the height above the surface.
    double along(glm::dvec3 p) const { return isCurved ? std::atan2(p.x, p.z) : p.x; }
    double above(glm::dvec3 p) const { return isCurved ? std::hypot(p.x, p.z) - 1 : p.z; }
    glm::dvec2 uv(glm::dvec3 p) const { return {std::abs(along(p)) + p.y, -p.y}; }
    glm::dvec3 normal(glm::dvec3 p) const { return isCurved ? glm::dvec3(p.x, 0, p.z) : glm::dvec3(0, 0, 1); }

    // The point of the surface that the view shows at a point of the image.
    std::optional<glm::dvec3> at(glm::dvec2 image) const
    {
        const glm::dvec3 v = toEye();
        image *= isCurved ? 1 : 0.5;
        if (std::abs(image.x) > 0.98 && isCurved)
            return std::nullopt;
        const double z = isCurved ? std::sqrt(1 - image.x * image.x) : 0;
        return glm::dvec3(image.x, (image.y + v.y * z) / v.z, z);
    }
};

double stored(glm::dvec2 uv) { return relief(Relief::domes, uv.x, uv.y).h / kDomeDepth; }

// Where the line of sight meets the domes: small steps in space, then bisection.
glm::dvec2 rayTruth(const Ground& ground, glm::dvec3 p)
{
    const glm::dvec3 v = ground.toEye();
    const double end = 1.5 * kDomeDepth / std::max(glm::dot(ground.normal(p), v), kGrazing);
    const auto inside = [&](double distance) {
        const glm::dvec3 q = p - v * distance;
        return ground.above(q) <= (stored(ground.uv(q)) - 1) * kDomeDepth;
    };
    double low = 0, high = 0;
    while (high < end && !inside(high)) {
        low = high;
        high += end / 400;
    }
    for (int i = 0; i < 30; ++i)
        (inside((low + high) / 2) ? high : low) = (low + high) / 2;
    return ground.uv(p - v * high);
}

f64::cotan_frame gradientFrame(const Ground& ground, glm::dvec3 p)
{
    const glm::dvec3 n = ground.normal(p), up(0, 1, 0);
    return {glm::cross(up, n) * (p.x < 0 ? -1.0 : 1.0) + up, -up, n};
}

// What many shaders do: the view vector by unit tangents, whose bitangent is perpendicular, and heights in uv.
f64::cotan_frame tangentFrame(const f64::cotan_frame& f)
{
    const glm::dvec3 t = f64::cotan_tangent_direction(f, f.n, {1, 0}), b = glm::cross(f.n, t);
    return {t, glm::dot(b, f.b) < 0 ? -b : b, f.n};
}

glm::dvec2 searchedUv(const f64::cotan_frame& f, const Ground& ground, glm::dvec3 p)
{
    f64::cotan_relief r = f64::cotan_relief_start(f, ground.toEye(), ground.uv(p), kDomeDepth, kReadings);
    for (int i = 0; i < kReadings + kHalvings; ++i)
        r = f64::cotan_relief_next(r, stored(r.uv));
    return r.uv;
}

glm::dvec2 foundUv(By by, const Ground& ground, glm::dvec3 p)
{
    if (by == By::truth)
        return rayTruth(ground, p);
    const auto f = gradientFrame(ground, p);
    return searchedUv(by == By::cotan ? f : tangentFrame(f), ground, p);
}

glm::dvec3 domeColor(By by, const Ground& ground, glm::dvec2 at)
{
    const auto p = ground.at(at);
    if (!p)
        return glm::dvec3(0.02);
    const glm::dvec2 uv = foundUv(by, ground, *p);
    const HeightSample h = relief(Relief::domes, uv.x, uv.y);
    const auto f = gradientFrame(ground, *p);
    const glm::dvec3 n = f64::cotan_resolve_gradient(f.n, f64::cotan_gradient_of_slope(f, {h.hu, h.hv}));
    const glm::dvec3 low(0.09, 0.16, 0.3), high(0.75, 0.42, 0.16);
    return plotShade(n, ground.toEye(), glm::mix(low, high, std::min(3 * h.h / kDomeDepth, 1.0)));
}

double meanTexels(By by, const Ground& ground)
{
    const auto texels = plotValues([&](glm::dvec2 at) -> std::optional<double> {
        const auto p = ground.at(at);
        if (!p || glm::dot(ground.normal(*p), ground.toEye()) < kGrazing)
            return std::nullopt;
        return glm::length(foundUv(by, ground, *p) - rayTruth(ground, *p)) * kTexels;
    });
    return std::accumulate(texels.begin(), texels.end(), 0.0) / double(texels.size());
}

} // namespace

Figure makeParallaxFigure(FigureRenderer& studio)
{
    Figure figure;
    figure.title = "Parallax on sheared and mirrored texture coordinates";
    figure.text = {
        "Domes in a height map, seen at 60 degrees on a plane and around a cylinder. u is sheared by 45 degrees, and "
        "mirrored at the middle. With the gradients of u and v the search through the relief follows the line of "
        "sight. The usual form takes the view vector into tangent space by unit tangents and a perpendicular "
        "bitangent: its domes are drawn out along the shear. Both make the same number of readings. The truth is the "
        "line of sight against the displaced surface. Errors are distances in a map of 512 texels per unit of u."};
    const struct {
        By by;
        const char *file, *label;
    } methods[] = {{By::cotan, "cotan", "cotan_relief, gradients"},
                   {By::usual, "usual", "usual form, unit tangents"},
                   {By::truth, "truth", "truth"}};
    for (const Ground& ground : {Ground{"plane", false, 60}, Ground{"cylinder", true, 45}})
        for (const auto& m : methods) {
            std::string caption = "The line of sight against the displaced surface.";
            if (m.by != By::truth) {
                const double texels = meanTexels(m.by, ground);
                figure.numbers.push_back({fmt::format("{}, {}, texels", ground.name, m.file), texels});
                caption = fmt::format("Error: {:.2f} texels on average.", texels);
            }
            figure.panels.push_back(
                {fmt::format("{}-{}", ground.name, m.file), fmt::format("{}: {}", ground.name, m.label), caption,
                 plot(studio.height(), [&](glm::dvec2 at) { return domeColor(m.by, ground, at); })});
        }
    figure.sliders = {{1, 0}, {4, 3}};
    return figure;
}

} // namespace cotan::figures
