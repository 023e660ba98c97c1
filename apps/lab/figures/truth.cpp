#include "truth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "inspect/angles.hpp"

namespace cotan::figures {

namespace {

constexpr double kRadians = std::numbers::pi / 180;

glm::dvec3 perturbed(const SurfaceGradients& g, const HeightSample& h)
{
    const double s = 1 / std::max(glm::length(g.u), glm::length(g.v));
    return glm::normalize(g.normal - s * (h.hu * g.u + h.hv * g.v));
}

Compared compared(std::vector<float> degrees, int width, int height)
{
    return {angleStatistics(degrees), heatMap(degrees, width, height)};
}

} // namespace

Chart patchChart(double stretch, double shear, bool mirrored, double repeat)
{
    const double sign = mirrored ? -1 : 1;
    // u = (x - shear y) / stretch with y downwards, so the world's y has the opposite sign.
    const SurfaceGradients g{
        {0, 0, 1}, glm::dvec3(1, shear, 0) * (sign * repeat / stretch), glm::dvec3(0, -1, 0) * repeat};
    return [g](glm::dvec2) { return g; };
}

Chart sphereChart(glm::dvec2 repeat)
{
    return [=](glm::dvec2 uv) -> std::optional<SurfaceGradients> {
        const double longitude = 2 * std::numbers::pi * (uv.x / repeat.x + 0.5);
        const double colatitude = std::numbers::pi * uv.y / repeat.y;
        const double ring = std::sin(colatitude);
        if (std::abs(colatitude - std::numbers::pi / 2) > 75 * kRadians)
            return std::nullopt;
        SurfaceGradients g;
        g.normal = {ring * std::sin(longitude), std::cos(colatitude), ring * std::cos(longitude)};
        // Positions are on the unit sphere; a common factor does not matter.
        g.u = glm::dvec3(std::cos(longitude), 0, -std::sin(longitude)) * (repeat.x / (2 * std::numbers::pi * ring));
        g.v = glm::dvec3(std::cos(colatitude) * std::sin(longitude), -ring, std::cos(colatitude) * std::cos(longitude))
            * (repeat.y / std::numbers::pi);
        return g;
    };
}

Image truthNormals(const Image& uv, const Height& height, const Chart& chart, double minTilt)
{
    Image truth = makeImage(uv.width, uv.height, PixelType::float32, "truth");
    const double maxCosine = std::cos(minTilt * kRadians);
    for (std::size_t i = 0; i < uv.pixelCount(); ++i) {
        const float* at = uv.floats() + 4 * i;
        const glm::dvec2 c(at[0], at[1]);
        const auto surface = at[3] > 0 ? chart(c) : std::nullopt;
        if (!surface)
            continue;
        const glm::dvec3 n = perturbed(*surface, height(c.x, c.y));
        if (minTilt > 0 && glm::dot(n, surface->normal) > maxCosine)
            continue;
        float* out = truth.floats() + 4 * i;
        for (int k = 0; k < 3; ++k)
            out[k] = float(n[k]);
        out[3] = 1;
    }
    return truth;
}

Height domeHeight()
{
    return [](double u, double v) { return relief(Relief::domes, u, v); };
}

Image heightMap16(const Height& height, int side)
{
    Image image = makeImage(side, side, PixelType::unorm16, "height");
    std::uint16_t* texel = image.words();
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column, texel += 4) {
            const HeightSample h = height((column + 0.5) / side, (row + 0.5) / side);
            const glm::dvec3 m = glm::normalize(glm::dvec3(-h.hu, h.hv, 1));
            for (int k = 0; k < 3; ++k)
                texel[k] = std::uint16_t(std::lround(f64::cotan_compress(m[k], COTAN_EXPAND_EXACT16) * 65535));
            texel[3] = 65535;
        }
    return image;
}

void addError(Figure& figure, std::size_t panel, std::string_view measure, std::string_view what)
{
    for (const Measure& m : figure.measures)
        if (m.name == measure) {
            std::string& caption = figure.panels[panel].caption;
            caption += fmt::format("{}{}: {:.2f} degrees on average, {:.1f} at 95 %.", caption.empty() ? "" : " ", what,
                                   m.degrees.mean, m.degrees.percentile95);
        }
}

Compared compareNormals(const Image& a, const Image& b) { return compared(anglesBetween(a, b), a.width, a.height); }

Compared compareInterior(const Image& a, const Image& b) { return compared(interiorAngles(a, b), a.width, a.height); }

} // namespace cotan::figures
