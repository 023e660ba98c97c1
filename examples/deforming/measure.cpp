#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include <cotan/portable.hpp>
#include <cotan/triangle.hpp>

namespace {

namespace f32 = cotan::f32;

double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

// The normal map: waves with slopes of up to 0.7, two per unit of uv. x is along +u, y along +v, z outwards.
glm::dvec3 texel(glm::dvec2 uv)
{
    constexpr double kTurn = 4 * std::numbers::pi;
    return glm::normalize(glm::dvec3(0.7 * std::sin(kTurn * uv.x), 0.7 * std::sin(kTurn * uv.y), 1));
}

struct Truth {
    glm::dvec3 normal, perturbed;
};

// The exact normal of the deformed tube at these texcoords, and the normal perturbed with the gradients of u and v on
// the exact surface, scaled so that the longer has length 1.
Truth truthAt(const Motion& motion, double s, glm::dvec2 uv, glm::dvec3 m)
{
    const double turn = uv.x / kTubeRadius;
    const glm::dvec3 out(std::sin(turn), 0, std::cos(turn)),
        p = out * kTubeRadius + glm::dvec3(0, kTubeHeight / 2 - uv.y, 0);
    const glm::dmat3 d = motion.derivative(p, s);
    const glm::dvec3 pu = d * glm::dvec3(out.z, 0, -out.x), pv = d * glm::dvec3(0, -1, 0); // dP/du, dP/dv
    const glm::dvec3 n = motion.exactNormal(p, out, s);
    const glm::dvec3 u = glm::cross(pv, n) / glm::dot(pu, glm::cross(pv, n)),
                     v = glm::cross(n, pu) / glm::dot(pv, glm::cross(n, pu));
    const double scale = 1 / std::max(glm::length(u), glm::length(v));
    return {n, glm::normalize(n * m.z + (u * m.x + v * m.y) * scale)};
}

// Interpolates vertex attributes at a point of a triangle, like the pixel stage.
struct Corners {
    std::array<std::uint32_t, 3> v;
    glm::dvec3 weights;

    template<class T> T operator()(const std::vector<T>& values) const
    {
        return values[v[0]] * float(weights.x) + values[v[1]] * float(weights.y) + values[v[2]] * float(weights.z);
    }
};

glm::vec3 byTangent(glm::vec3 n, glm::vec4 t, glm::vec3 m)
{
    // The bitangent of glTF points against increasing v.
    return f32::cotan_apply(f32::cotan_frame_mikktspace(n, glm::vec3(t), t.w), {m.x, -m.y, m.z});
}

} // namespace

Measured::Measured(const Gpu& gpu, std::uint32_t around, std::uint32_t along)
    : rest_(tube(around, along)), tangents_(rest_.positions.size()),
      passes_(gpu, rest_, cotan::makeAdjacency(viewOf(rest_)), cotan::makeNormalAdjacency(viewOf(rest_)))
{
    const std::vector<glm::vec4> corners = cotan::mikktspaceTangents(viewOf(rest_));
    for (std::size_t c = 0; c < corners.size(); ++c)
        tangents_[rest_.indices[c]] = corners[c]; // no triangle is mirrored, so all corners of a vertex agree
}

Errors Measured::at(const Motion& motion, double s, bool deriveNormals)
{
    Mesh pose = posed(rest_, motion, s, Normals::carried);
    passes_.pose(pose.positions, pose.normals);
    if (deriveNormals) {
        passes_.run(Pass::normals);
        pose.normals = passes_.normals();
    }
    passes_.run(Pass::tangents);
    const std::vector<glm::vec4> derived = passes_.frames();
    passes_.run(Pass::triangles);
    const auto triangles = passes_.triangles();
    passes_.run(Pass::smooth);
    const std::vector<glm::vec4> packed = passes_.frames();
    std::vector<glm::vec3> t, b;
    std::vector<glm::vec4> stored;
    for (std::size_t v = 0; v < packed.size(); ++v) {
        const f32::cotan_covectors c = f32::cotan_unpack_smooth8(pose.normals[v], packed[v]);
        t.push_back(c.t);
        b.push_back(c.b);
        stored.emplace_back(glm::vec3(motion.carriedTangent(rest_.positions[v], glm::vec3(tangents_[v]), s)),
                            tangents_[v].w);
    }

    Errors errors;
    std::array<std::vector<double>, kWays.size()> all;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        Corners at{{rest_.indices[3 * f], rest_.indices[3 * f + 1], rest_.indices[3 * f + 2]}, {}};
        const f32::cotan_packed_triangle halfs{triangles[f][0], triangles[f][1], triangles[f][2]};
        const glm::vec3 u = f32::cotan_unpack_triangle_u(halfs), v = f32::cotan_unpack_triangle_v(halfs);
        const auto edge = [&](const auto& values, int k) { return values[at.v[std::size_t(k)]] - values[at.v[0]]; };
        std::array<double, kWays.size()> sum{};
        for (const glm::dvec3 weights : {glm::dvec3(1, 1, 1) / 3.0, glm::dvec3(4, 1, 1) / 6.0,
                                         glm::dvec3(1, 4, 1) / 6.0, glm::dvec3(1, 1, 4) / 6.0}) {
            at.weights = weights;
            const glm::vec2 uv = at(rest_.texcoords);
            const glm::dvec3 texelThere = texel(uv);
            const glm::vec3 m(texelThere), n = at(pose.normals);
            const Truth truth = truthAt(motion, s, uv, texelThere);
            const f32::cotan_frame cotangent =
                f32::cotan_frame_cotangent(n, edge(pose.positions, 1), edge(pose.positions, 2),
                                           edge(rest_.texcoords, 1), edge(rest_.texcoords, 2));
            const std::array<glm::vec3, kWays.size()> found = {n,
                                                               byTangent(n, at(stored), m),
                                                               byTangent(n, at(derived), m),
                                                               f32::cotan_apply(cotangent, m),
                                                               f32::cotan_perturb_triangle(n, u, v, m),
                                                               f32::cotan_perturb_smooth(n, at(t), at(b), m)};
            for (std::size_t way = 0; way < found.size(); ++way) {
                const double degrees = degreesBetween(found[way], way == 0 ? truth.normal : truth.perturbed);
                all[way].push_back(degrees);
                sum[way] += degrees / 4;
            }
        }
        for (std::size_t way = 0; way < sum.size(); ++way)
            errors.triangles[way].push_back(float(sum[way]));
    }
    for (std::size_t way = 0; way < all.size(); ++way) {
        std::sort(all[way].begin(), all[way].end());
        for (const double degrees : all[way])
            errors.mean[way] += degrees / double(all[way].size());
        errors.most95[way] = all[way][all[way].size() * 95 / 100];
    }
    return errors;
}
