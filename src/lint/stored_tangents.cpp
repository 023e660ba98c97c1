#include <cmath>

#include <glm/geometric.hpp>

#include "parts.hpp"

namespace cotan::lint {

StoredTangents storedTangents(const MappedSurface& s)
{
    StoredTangents result;
    result.present = !s.stored.empty();
    if (!result.present || s.uv.empty())
        return result;
    double compared = 0;
    std::vector<std::pair<double, double>> angles;
    for (std::size_t i = 0; i < s.triangleCount(); ++i) {
        if (orientationOf(s, i) == 0)
            continue;
        const double third = areaOf(s, i) / 3;
        for (std::size_t k = 0; k < 3; ++k) {
            glm::dvec3 corner(0);
            corner[int(k)] = 1;
            // Tangent first: t along dP/du, b on the side of +v.
            const f64::cotan_frame f = frameAt(s, Frame::orthonormal, TangentOrigin::generated, i, corner);
            const glm::dvec4 stored = s.stored[3 * i + k];
            const glm::dvec3 t =
                f64::cotan_normalize_or(glm::dvec3(stored) - f.n * glm::dot(glm::dvec3(stored), f.n), glm::dvec3(0));
            if (f.t == glm::dvec3(0))
                continue;
            compared += third;
            const double expected = glm::dot(glm::cross(f.n, f.t), f.b) < 0 ? -1 : 1;
            result.reversedW += stored.w * expected < 0 ? third : 0;
            const double degrees = t == glm::dvec3(0) ? 180 : degreesBetween(t, f.t);
            result.turned += degrees > kTurned ? third : 0;
            angles.emplace_back(degrees, third);
        }
    }
    result.reversedW /= compared; // of nothing: NaN
    result.turned /= compared;
    result.angle = spreadOf(std::move(angles));
    return result;
}

} // namespace cotan::lint
