#include "truth/surface.hpp"

#include <array>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "truth/quad.hpp"
#include "truth/random.hpp"

namespace cotan {

namespace {

constexpr double kPi = std::numbers::pi;

JetVector sphere(Jet s, Jet t)
{
    const Jet longitude = s * (2 * kPi), latitude = (t - 0.5) * (kPi * 150 / 180);
    return {cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude)};
}

JetVector mercator(Jet s, Jet t)
{
    const Jet longitude = s * (2 * kPi), y = (t - 0.5) * 4.0;
    return {sech(y) * cos(longitude), sech(y) * sin(longitude), tanh(y)};
}

JetVector torus(Jet s, Jet t)
{
    const Jet a = s * (2 * kPi), b = t * (2 * kPi);
    const Jet distance = Jet(1) + cos(b) * 0.4;
    return {distance * cos(a), distance * sin(a), sin(b) * 0.4};
}

std::array<Jet, 4> bernstein(Jet x)
{
    const Jet y = Jet(1) - x;
    return {y * y * y, x * y * y * 3.0, x * x * y * 3.0, x * x * x};
}

// A bicubic patch: a spine along t that bends upwards, with a tapering half tube around s.
JetVector spout(Jet s, Jet t)
{
    constexpr double spineX[] = {0, 0.8, 1.2, 1.8}, spineZ[] = {0, 0.1, 0.9, 1.1};
    constexpr double radius[] = {0.6, 0.5, 0.25, 0.15};
    constexpr double outX[] = {0.1, -0.3, -0.8, -0.3}, outZ[] = {1, 0.95, 0.6, 0.95};
    constexpr double across[] = {-1, -1, 1, 1}, height[] = {0, 1.33, 1.33, 0};
    const auto bs = bernstein(s), bt = bernstein(t);
    JetVector p;
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
            const Jet weight = bs[i] * bt[j];
            p.x = p.x + weight * (spineX[j] + radius[j] * outX[j] * height[i]);
            p.y = p.y + weight * (radius[j] * across[i]);
            p.z = p.z + weight * (spineZ[j] + radius[j] * outZ[j] * height[i]);
        }
    return p;
}

} // namespace

glm::dvec2 Surface::parameters(glm::dvec2 uv) const { return glm::inverse(uvOfParameters) * uv; }

SurfacePoint Surface::at(glm::dvec2 parameters) const
{
    const JetVector j = position({parameters.x, 1, 0, 0, 0, 0}, {parameters.y, 0, 1, 0, 0, 0});
    SurfacePoint p;
    p.parameters = parameters;
    p.uv = uv(parameters);
    p.position = j.value();
    p.ps = j.s();
    p.pt = j.t();
    const double side = inward ? -1 : 1;
    const glm::dvec3 area = glm::cross(p.ps, p.pt) * side;
    const glm::dvec3 areaS = (glm::cross(j.ss(), p.pt) + glm::cross(p.ps, j.st())) * side;
    const glm::dvec3 areaT = (glm::cross(j.st(), p.pt) + glm::cross(p.ps, j.tt())) * side;
    const double length = glm::length(area);
    p.normal = area / length;
    p.ns = (areaS - p.normal * glm::dot(p.normal, areaS)) / length;
    p.nt = (areaT - p.normal * glm::dot(p.normal, areaT)) / length;
    const glm::dmat2 inverse = glm::inverse(uvOfParameters); // columns: (s,t) per u, per v
    p.dpdu = p.ps * inverse[0].x + p.pt * inverse[0].y;
    p.dpdv = p.ps * inverse[1].x + p.pt * inverse[1].y;
    const glm::dvec3 m = glm::cross(p.dpdu, p.dpdv);
    const double m2 = glm::dot(m, m);
    p.gradU = glm::cross(p.dpdv, m) / m2;
    p.gradV = glm::cross(m, p.dpdu) / m2;
    return p;
}

glm::dvec3 Surface::displacedNormal(const SurfacePoint& p, const ReliefSample& r, double scale) const
{
    const glm::dvec2 slope = glm::dvec2(r.hu, r.hv) * uvOfParameters * scale; // with respect to s and t
    const glm::dvec3 s = p.ps + p.normal * slope.x + p.ns * (r.h * scale);
    const glm::dvec3 t = p.pt + p.normal * slope.y + p.nt * (r.h * scale);
    return glm::normalize(glm::cross(s, t)) * (inward ? -1.0 : 1.0);
}

double Surface::unitsPerUv() const
{
    Random random(11);
    constexpr int kSamples = 4000;
    double sum = 0;
    for (int i = 0; i < kSamples; ++i) {
        const double s = random.unit(), t = random.unit();
        const SurfacePoint p = at({s, t});
        sum += commonScale(p.gradU, p.gradV);
    }
    return sum / kSamples;
}

const std::vector<Surface>& surfaces()
{
    static const std::vector<Surface> list = {
        {"sphere", glm::dmat2(1, 0, 0, 150.0 / 360), false, sphere},
        {"mercator", glm::dmat2(1, 0, 0, 4 / (2 * kPi)), false, mercator},
        {"torus", glm::dmat2(1, 0, 0, 0.4), false, torus},
        {"spout", glm::dmat2(1, 0, 0.25, 1.5), true, spout}, // columns: u = s + t/4, v = 1.5 t
    };
    return list;
}

Surface patchSurface(const Layout& l)
{
    auto position = [l](Jet u, Jet v) { return JetVector{u * l.a + v * l.b, u * l.c + v * l.d, 0}; };
    return {l.name, glm::dmat2(1), l.a * l.d - l.b * l.c < 0, position};
}

glm::dvec3 truthS(const SurfacePoint& p, glm::dvec3 m)
{
    const double s = commonScale(p.gradU, p.gradV);
    return glm::normalize((p.gradU * m.x + p.gradV * m.y) * s + p.normal * m.z);
}

} // namespace cotan
