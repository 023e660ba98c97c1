#include "motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace {

// Weight of the upper of two bones, which meet at the origin, and its derivative by height.
struct Weight {
    double value = 0, slope = 0;
};
Weight upperWeight(double y)
{
    const double x = std::clamp(y / 2.4 + 0.5, 0.0, 1.0); // bones blend within 1.2 of the joint
    return {x * x * (3 - 2 * x), x > 0 && x < 1 ? 6 * x * (1 - x) / 2.4 : 0};
}

// Rotations about an axis.
glm::dmat3 aboutZ(double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}
glm::dmat3 aboutY(double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}

glm::dmat3 blended(const glm::dmat3& upper, double y)
{
    const double w = upperWeight(y).value;
    return glm::dmat3(1) * (1 - w) + upper * w;
}

// Derivative of the skinned position by p. The changing weight adds (upper p - p) times its slope to the column of y.
glm::dmat3 derivativeOf(const glm::dmat3& upper, glm::dvec3 p)
{
    glm::dmat3 d = blended(upper, p.y);
    d[1] += (upper * p - p) * upperWeight(p.y).slope;
    return d;
}

template<glm::dmat3 upper(double angle), int degrees> struct Skinned {
    static glm::dmat3 bone(double s) { return upper(s * degrees * std::numbers::pi / 180); }
    static glm::dmat3 blend(glm::dvec3 p, double s) { return blended(bone(s), p.y); }
    static glm::dvec3 position(glm::dvec3 p, double s) { return blend(p, s) * p; }
    static glm::dmat3 derivative(glm::dvec3 p, double s) { return derivativeOf(bone(s), p); }
};
using Bend = Skinned<aboutZ, 100>;
using Twist = Skinned<aboutY, 100>;

struct Shear {
    static glm::dvec3 position(glm::dvec3 p, double s) { return {p.x + s * p.y, p.y, p.z}; }
    static glm::dmat3 derivative(glm::dvec3, double s) { return {{1, 0, 0}, {s, 1, 0}, {0, 0, 1}}; }
};

} // namespace

const std::array<Motion, 3> kMotions = {{
    {"bend", "two bones, the upper one turned by 100 degrees about z", Bend::position, Bend::derivative, Bend::blend},
    {"twist", "two bones, the upper one turned by 100 degrees about the tube", Twist::position, Twist::derivative,
     Twist::blend},
    {"shear", "a morph target that leans the tube by 45 degrees; it holds positions and normals", Shear::position,
     Shear::derivative, nullptr},
}};

glm::dvec3 Motion::exactNormal(glm::dvec3 p, glm::dvec3 n, double s) const
{
    return glm::normalize(glm::transpose(glm::inverse(derivative(p, s))) * n);
}

glm::dvec3 Motion::carriedNormal(glm::dvec3 p, glm::dvec3 n, double s) const
{
    return glm::normalize(blend ? blend(p, s) * n : n * (1 - s) + exactNormal(p, n, 1) * s);
}

glm::dvec3 Motion::carriedTangent(glm::dvec3 p, glm::dvec3 t, double s) const
{
    return blend ? glm::normalize(blend(p, s) * t) : t;
}

Mesh posed(const Mesh& rest, const Motion& motion, double s, Normals normals)
{
    Mesh mesh = rest;
    for (std::size_t v = 0; v < rest.positions.size(); ++v) {
        const glm::dvec3 p(rest.positions[v]), n(rest.normals[v]);
        mesh.positions[v] = motion.position(p, s);
        mesh.normals[v] = normals == Normals::exact ? motion.exactNormal(p, n, s) : motion.carriedNormal(p, n, s);
    }
    return mesh;
}
