#include "bake/convert/solve_texel.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/vector.hpp"

namespace cotan {

namespace {

constexpr int kSteps = 12;       // quadratic convergence: four or five do
constexpr double kStill = 1e-10; // a step this short ends it

constexpr double kShortest = 1e-12; // a vector that has a direction

double costOf(std::span<const Demand> demands, glm::dvec3 texel)
{
    double cost = 0;
    for (const Demand& d : demands)
        if (invertible(d.frame)) {
            const glm::dvec3 r = unitOr(d.frame * texel, glm::dvec3(0), kShortest) - d.target;
            cost += glm::dot(r, r);
        }
    return cost;
}

// The Gauss-Newton step from a unit texel, perpendicular to it.
glm::dvec3 stepFrom(std::span<const Demand> demands, glm::dvec3 texel)
{
    glm::dmat3 normal(0);
    glm::dvec3 gradient(0);
    for (const Demand& d : demands) {
        if (!invertible(d.frame))
            continue;
        const glm::dvec3 v = d.frame * texel;
        const double length = glm::length(v);
        const glm::dvec3 u = v / length;
        const glm::dmat3 jacobian = (d.frame - glm::outerProduct(u, glm::transpose(d.frame) * u)) * (1 / length);
        normal += glm::transpose(jacobian) * jacobian;
        gradient += glm::transpose(jacobian) * (u - d.target);
    }
    // The length of the texel is free: fixed by a term along it.
    const double trace = normal[0][0] + normal[1][1] + normal[2][2];
    normal += glm::outerProduct(texel, texel) * trace;
    const double determinant = glm::determinant(normal);
    if (!(std::abs(determinant) > 1e-18 * trace * trace * trace))
        return glm::dvec3(0);
    return -(glm::inverse(normal) * gradient);
}

} // namespace

bool invertible(const glm::dmat3& f)
{
    const double determinant = glm::determinant(f);
    const double size = glm::length(f[0]) * glm::length(f[1]) * glm::length(f[2]);
    return std::isfinite(determinant) && std::abs(determinant) > 1e-9 * size && size > 1e-12;
}

glm::dvec3 solveTexel(std::span<const Demand> demands, glm::dvec3 otherwise)
{
    glm::dvec3 sum(0), first(0);
    std::size_t count = 0;
    for (const Demand& d : demands)
        if (invertible(d.frame)) {
            const glm::dvec3 own = unitOr(glm::inverse(d.frame) * d.target, glm::dvec3(0, 0, 1), kShortest);
            first = count == 0 ? own : first;
            sum += own;
            ++count;
        }
    if (count == 0)
        return otherwise;
    if (count == 1)
        return first;
    glm::dvec3 texel = unitOr(sum, first, kShortest);
    double cost = costOf(demands, texel);
    for (int i = 0; i < kSteps && cost > 1e-18; ++i) {
        glm::dvec3 step = stepFrom(demands, texel);
        if (!(glm::length(step) > kStill))
            break;
        bool better = false;
        for (int halving = 0; halving < 6 && !better; ++halving, step *= 0.5) {
            const glm::dvec3 tried = unitOr(texel + step, texel, kShortest);
            const double triedCost = costOf(demands, tried);
            better = triedCost < cost;
            if (better) {
                texel = tried;
                cost = triedCost;
            }
        }
        if (!better)
            break;
    }
    return texel;
}

double degreesOff(const Demand& d, glm::dvec3 texel)
{
    const glm::dvec3 got = d.frame * texel;
    return glm::degrees(angleBetween(got, d.target));
}

} // namespace cotan
