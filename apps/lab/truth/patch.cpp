#include "truth/patch.hpp"

#include <cmath>

namespace cotan {

AffinePatch patchOf(const Layout& l)
{
    const double determinant = l.a * l.d - l.b * l.c;
    AffinePatch p;
    p.gradU = {l.d / determinant, -l.b / determinant, 0};
    p.gradV = {-l.c / determinant, l.a / determinant, 0};
    return p;
}

AffinePatch randomPatch(Random& random, bool mirrored)
{
    AffinePatch p;
    p.normal = random.direction();
    const glm::dvec3 e = glm::normalize(glm::cross(p.normal, random.direction()));
    const glm::dvec3 h = glm::cross(p.normal, e);
    const double a = random.azimuth();
    p.gradU = (e * std::cos(a) + h * std::sin(a)) * random.range(0.5, 2);
    p.gradV = (h * std::cos(a) - e * std::sin(a)) * (random.range(0.5, 2) * (mirrored ? -1 : 1))
        + p.gradU * random.range(-0.4, 0.4);
    return p;
}

glm::dvec3 tiltedTexel(Random& random, double degrees)
{
    const double azimuth = random.azimuth();
    const double s = std::sin(degrees * kDegree);
    return {s * std::cos(azimuth), s * std::sin(azimuth), std::cos(degrees * kDegree)};
}

glm::dvec3 domeTexel(double u, double v)
{
    constexpr double radius = 0.1, height = 0.6 * radius;
    const double x = u - (std::floor(u * 4) + 0.5) / 4, y = v - (std::floor(v * 4) + 0.5) / 4;
    const double w = 1 - (x * x + y * y) / (radius * radius); // the dome is height * w^2
    if (w <= 0)
        return {0, 0, 1};
    const double slope = -4 * height * w / (radius * radius);
    return glm::normalize(glm::dvec3(-slope * x, -slope * y, 1));
}

glm::dvec3 truthS(const AffinePatch& p, glm::dvec3 m)
{
    const double s = commonScale(p.gradU, p.gradV);
    return glm::normalize(p.gradU * (s * m.x) + p.gradV * (s * m.y) + p.normal * m.z);
}

glm::dvec3 truthE(const AffinePatch& p, glm::dvec3 m)
{
    return glm::normalize(p.gradU * m.x + p.gradV * m.y + p.normal * m.z);
}

PixelCamera viewAt(Random& random, double tiltDegrees, bool orthographic)
{
    const double a = tiltDegrees * kDegree;
    const double z = random.azimuth();
    const glm::dvec3 eye{5 * std::sin(a) * std::cos(z), 5 * std::sin(a) * std::sin(z), 5 * std::cos(a)};
    const glm::dvec3 up = tiltDegrees < 1 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    return PixelCamera::lookAt(eye, {0, 0, 0}, up, 900, orthographic);
}

glm::dvec3 shade(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 m)
{
    return perturb(makeFrame(frame, Covector3d(n), d), m).raw();
}

glm::dvec3 shadeFloat(Frame frame, glm::dvec3 n, const Differences<float>& d, glm::dvec3 m)
{
    const auto f = makeFrame(frame, Covector3f(glm::vec3(n)), d);
    return glm::dvec3(perturb(f, glm::vec3(m)).raw());
}

glm::dvec3 shadeFloat(Frame frame, glm::dvec3 n, const Differences<double>& d, glm::dvec3 m)
{
    return shadeFloat(frame, n, toFloat(d), m);
}

} // namespace cotan
