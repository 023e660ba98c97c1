#include "curved_normals.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/groups.hpp"
#include "core/loops.hpp"
#include "core/other_axis.hpp"

namespace cotan {

namespace {

// Derivatives of the height over a vertex's tangent plane: second (xx, xy, yy), third (xxx, xxy, xyy, yyy), fourth.
constexpr int kUnknowns = 12;

// The normal equations of the fit at one vertex.
struct Fit {
    std::array<std::array<double, kUnknowns>, kUnknowns> a{};
    std::array<double, kUnknowns> b{};

    void add(const std::array<double, kUnknowns>& row, double value)
    {
        for (int i = 0; i < kUnknowns; ++i) {
            for (int j = 0; j <= i; ++j)
                a[i][j] += row[i] * row[j];
            b[i] += row[i] * value;
        }
    }

    // Solves by Cholesky. Tikhonov regularisation: `regularisation` is the weight for second derivatives, relative to
    // the largest diagonal term; third derivatives have 100 times and fourth derivatives 10,000 times that weight.
    std::array<double, kUnknowns> solve(double regularisation)
    {
        double largest = 0;
        for (int i = 0; i < kUnknowns; ++i)
            largest = std::max(largest, a[i][i]);
        if (!(largest > 0))
            return {};
        for (int i = 0; i < kUnknowns; ++i)
            a[i][i] += largest * regularisation * (i < 3 ? 1 : i < 7 ? 100 : 10000);
        for (int i = 0; i < kUnknowns; ++i)
            for (int j = 0; j <= i; ++j) {
                double sum = a[i][j];
                for (int k = 0; k < j; ++k)
                    sum -= a[i][k] * a[j][k];
                a[i][j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / a[j][j];
            }
        for (int i = 0; i < kUnknowns; ++i) {
            for (int k = 0; k < i; ++k)
                b[i] -= a[i][k] * b[k];
            b[i] /= a[i][i];
        }
        for (int i = kUnknowns - 1; i >= 0; --i) {
            for (int k = i + 1; k < kUnknowns; ++k)
                b[i] -= a[k][i] * b[k];
            b[i] /= a[i][i];
        }
        return b;
    }
};

ShapeOperator fitted(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals, std::uint32_t v,
                     std::span<const std::uint32_t> neighbours)
{
    const glm::dvec3 p(positions[v]), n(normals[v]);
    if (!(glm::dot(n, n) > 0.5))
        return {};
    const glm::dvec3 e1 = glm::normalize(glm::cross(otherAxis(n), n)), e2 = glm::cross(n, e1);
    double size2 = 0; // squared unit of length
    for (const std::uint32_t j : neighbours)
        size2 = std::max(size2, glm::dot(glm::dvec3(positions[j]) - p, glm::dvec3(positions[j]) - p));
    if (!(size2 > 0))
        return {};
    const double size = std::sqrt(size2);
    Fit fit;
    for (const std::uint32_t j : neighbours) {
        const glm::dvec3 step = (glm::dvec3(positions[j]) - p) / size, m(normals[j]);
        const double x = glm::dot(step, e1), y = glm::dot(step, e2), up = glm::dot(m, n);
        if (!(up > 0.1) || !(x * x + y * y > 0))
            continue;
        const double z = glm::dot(step, n), x2 = x * x / 2, y2 = y * y / 2, x3 = x * x2 / 3, y3 = y * y2 / 3;
        fit.add({x, y, 0, x2, x * y, y2, 0, x3, x2 * y, x * y2, y3, 0}, -glm::dot(m, e1) / up);
        fit.add({0, x, y, 0, x2, x * y, y2, 0, x3, x2 * y, x * y2, y3}, -glm::dot(m, e2) / up);
        fit.add({x2, x * y, y2, x3, x2 * y, x * y2, y3, x * x3 / 4, x3 * y, x2 * y2, x * y3, y * y3 / 4}, z);
    }
    const std::array<double, kUnknowns> h = fit.solve(1e-8);
    const double xx = -h[0] / size, xy = -h[1] / size, yy = -h[2] / size; // dn = -H d
    auto entry = [&](int i, int j) {
        return float(xx * e1[i] * e1[j] + xy * (e1[i] * e2[j] + e2[i] * e1[j]) + yy * e2[i] * e2[j]);
    };
    return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

glm::vec3 times(const ShapeOperator& w, glm::vec3 d)
{
    return {w[0] * d.x + w[1] * d.y + w[2] * d.z, w[1] * d.x + w[3] * d.y + w[4] * d.z,
            w[2] * d.x + w[4] * d.y + w[5] * d.z};
}

// The step along a surface with normal n that lies above the step d in the face's plane.
glm::vec3 above(glm::vec3 d, glm::vec3 n, glm::vec3 face) { return d - face * (glm::dot(n, d) / glm::dot(n, face)); }

} // namespace

std::vector<ShapeOperator> shapeOperators(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                          std::span<const std::uint32_t> indices, int threads)
{
    // The other corners of the triangles at each vertex. Edges with a triangle on both sides count twice in the fit.
    const auto eachNeighbour = [&](const auto& add) {
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                add(indices[i + k], indices[i + (k + 1) % 3]);
                add(indices[i + k], indices[i + (k + 2) % 3]);
            }
    };
    std::vector<std::uint32_t> first, neighbours;
    listByGroup(positions.size(), eachNeighbour, first, neighbours);
    std::vector<ShapeOperator> shapes(positions.size());
    withThreads(threads, [&] {
        parallelFor(std::size_t(0), positions.size(), [&](std::size_t v) {
            shapes[v] = fitted(positions, normals, std::uint32_t(v),
                               {neighbours.data() + first[v], neighbours.data() + first[v + 1]});
        });
    });
    return shapes;
}

glm::vec3 curvedNormal(const CurvedTriangle& t, float b1, float b2, glm::vec3 direction)
{
    const glm::vec3 edge1 = t.positions[1] - t.positions[0], edge2 = t.positions[2] - t.positions[0];
    const glm::vec3 area = glm::cross(edge1, edge2);
    const float area2 = glm::dot(area, area);
    if (!(area2 > 0))
        return glm::vec3(0);
    // Orients the face normal to the side of the vertex normals, whatever the order of the corners.
    const glm::vec3 face = area / std::copysign(std::sqrt(area2), glm::dot(area, t.normals[0]));
    const float along = glm::dot(direction, face);
    const glm::vec3 sidewards = direction - face * along;
    if (!(std::abs(along) > 0.05f * glm::length(direction)))
        return glm::vec3(0);
    const float longest =
        std::sqrt(std::max({glm::dot(edge1, edge1), glm::dot(edge2, edge2), glm::dot(edge2 - edge1, edge2 - edge1)}));
    for (const glm::vec3& n : t.normals)
        if (!(glm::dot(n, face) > 0.1f))
            return glm::vec3(0);

    // Control points of the normals, from corner i towards corner j.
    const glm::vec3 edges[3] = {edge1, edge2 - edge1, -edge2}; // from corner i to the next
    glm::vec3 forth[3], back[3], middle(0);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        forth[i] = t.normals[i] + times(t.shapes[i], above(edges[i], t.normals[i], face)) / 3.0f;
        back[i] = t.normals[j] - times(t.shapes[j], above(edges[i], t.normals[j], face)) / 3.0f;
        middle += (forth[i] + back[i]) / 4.0f - t.normals[i] / 6.0f;
    }

    const glm::vec3 flat = edge1 * b1 + edge2 * b2;
    glm::vec3 y = flat;
    const int kSteps = 2; // the second step moves y by the square of what the first does
    for (int step = 0;; ++step) {
        const float c1 = glm::dot(glm::cross(y, edge2), area) / area2,
                    c2 = glm::dot(glm::cross(edge1, y), area) / area2;
        const float b[3] = {1 - c1 - c2, c1, c2};
        if (step == kSteps) {
            glm::vec3 normal = 6 * b[0] * b[1] * b[2] * middle;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3;
                normal += b[i] * (b[i] * b[i] * t.normals[i] + 3 * b[j] * (b[i] * forth[i] + b[j] * back[i]));
            }
            const float length = glm::length(normal);
            return length > 1e-6f ? normal / length : glm::vec3(0);
        }
        float height = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3 n = t.normals[i], d = y - (t.positions[i] - t.positions[0]), s = above(d, n, face);
            height +=
                b[i] * (2.0f / 3 * glm::dot(s, face) - glm::dot(s, times(t.shapes[i], s)) / glm::dot(n, face) / 6);
        }
        y = flat + sidewards * (height / along);
        if (!(glm::length(y - flat) < longest))
            return glm::vec3(0);
    }
}

} // namespace cotan
