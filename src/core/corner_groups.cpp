#include "corner_groups.hpp"

#include "cotan/portable.hpp"
#include "tangents_mesh.hpp"

namespace cotan::tangents {

Edges edgesAt(const MeshView& mesh, std::size_t f, std::size_t k)
{
    const std::uint32_t a = mesh.indices[3 * f + k], b = mesh.indices[3 * f + (k + 1) % 3],
                        c = mesh.indices[3 * f + (k + 2) % 3];
    const glm::dvec3 p(mesh.positions[a]);
    const glm::dvec2 t(mesh.texcoords[a]);
    return {glm::dvec3(mesh.positions[b]) - p, glm::dvec3(mesh.positions[c]) - p, glm::dvec2(mesh.texcoords[b]) - t,
            glm::dvec2(mesh.texcoords[c]) - t};
}

Side sideAt(const Edges& e, glm::vec3 normal)
{
    const glm::dvec3 face = glm::cross(e.dp1, e.dp2);
    const glm::dvec3 n(normal);
    // A vertex without a normal takes the triangle's.
    const double facing = n == glm::dvec3(0) ? glm::dot(face, face) : glm::dot(face, n);
    const double side = e.uvArea() * facing;
    if (!std::isfinite(side) || side == 0)
        return Side::none;
    return side > 0 ? Side::mirrored : Side::unmirrored;
}

// How much a triangle has to say about which side a vertex is on: |cosine| of its plane to the vertex's. One that is
// seen edge-on can take half a turn as seen along the normal, and folds over to the other side by rounding.
static float openness(const Edges& e, glm::vec3 normal)
{
    const glm::dvec3 face = glm::cross(e.dp1, e.dp2);
    const double lengths = glm::length(face) * glm::length(glm::dvec3(normal));
    return lengths > 0 ? float(std::abs(glm::dot(face, glm::dvec3(normal))) / lengths) : 1.0f;
}

std::vector<Side> cornerSides(const MeshView& mesh, std::size_t threads)
{
    std::vector<Side> sides(mesh.indices.size());
    runParts(sides.size(), threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c != end; ++c)
            sides[c] = sideAt(edgesAt(mesh, c / 3, c % 3), mesh.normals[mesh.indices[c]]);
    });
    return sides;
}

namespace {

// Lists of the vertices that are equal, and of the corners at each; both in rising order, ended by kNone.
struct Chains {
    LargeArray<std::uint32_t> equalVertex; // the next one; a list begins at its first vertex
    LargeArray<std::uint32_t> firstCorner; // of each vertex
    LargeArray<std::uint32_t> nextCorner;
};

Chains chainsOf(const MeshView& mesh, const LargeArray<std::uint32_t>& first)
{
    const std::size_t count = mesh.positions.size();
    Chains chains{makeLargeArray<std::uint32_t>(count), makeLargeArray<std::uint32_t>(count),
                  makeLargeArray<std::uint32_t>(mesh.indices.size())};
    std::fill_n(chains.equalVertex.get(), count, kNone);
    for (std::size_t v = count; v-- > 0;)
        if (first[v] != v) {
            chains.equalVertex[v] = chains.equalVertex[first[v]];
            chains.equalVertex[first[v]] = std::uint32_t(v);
        }
    std::fill_n(chains.firstCorner.get(), count, kNone);
    for (std::size_t c = mesh.indices.size(); c-- > 0;) {
        chains.nextCorner[c] = chains.firstCorner[mesh.indices[c]];
        chains.firstCorner[mesh.indices[c]] = std::uint32_t(c);
    }
    return chains;
}

// Of the triangles on one side.
struct Sum {
    glm::vec3 u{0}, v{0};
    float weight = 0;

    bool isEmpty() const { return !(weight > 0); }
};

// Adds the gradients of a corner's triangle; returns the weight that they got.
float addCorner(const Edges& e, glm::vec3 n, Sum& sum)
{
    const glm::vec3 dp1(e.dp1), dp2(e.dp2);
    const f32::cotan_frame frame = f32::cotan_frame_gradient(n, dp1, dp2, glm::vec2(e.duv1), glm::vec2(e.duv2));
    const float weight = projectedAngle(glm::vec3(0), dp1, dp2, n);
    if (!(weight > 0) || (isZero(frame.t) && isZero(frame.b)))
        return 0;
    sum.u += frame.t * weight;
    sum.v += frame.b * weight;
    sum.weight += weight;
    return weight;
}

int isUsual(float squared) { return int(squared > 1e-12f) & int(squared < 1e12f); }

// The same as sideAt and addCorner for a corner of a triangle that is neither thin nor tiny nor huge, in space or uv:
// to the bit, since what is left out there scales by powers of two and changes no sign. False for any other, of which
// nothing is done. unit: n at length 1.
bool addUsualCorner(const MeshView& mesh, std::size_t c, glm::vec3 n, glm::vec3 unit, Sum (&sums)[2],
                    float (&weights)[2])
{
    constexpr float kThin = 1e-6f; // of a squared sine; floats are sure of the sign of one from 1e-12
    const std::size_t k = c % 3;
    const std::uint32_t at = mesh.indices[c], next = mesh.indices[k == 2 ? c - 2 : c + 1],
                        previous = mesh.indices[k == 0 ? c + 2 : c - 1];
    const glm::vec3 dp1 = mesh.positions[next] - mesh.positions[at],
                    dp2 = mesh.positions[previous] - mesh.positions[at];
    const glm::vec2 duv1 = mesh.texcoords[next] - mesh.texcoords[at],
                    duv2 = mesh.texcoords[previous] - mesh.texcoords[at];
    const float p1 = glm::dot(dp1, dp1), p2 = glm::dot(dp2, dp2), uv1 = glm::dot(duv1, duv1),
                uv2 = glm::dot(duv2, duv2);
    const glm::vec3 acrossNext = glm::cross(dp2, unit), acrossPrevious = glm::cross(unit, dp1);
    const float facing = glm::dot(dp1, acrossNext), uvArea = duv1.x * duv2.y - duv1.y * duv2.x;
    const float longer = std::max(p1, p2);
    // Without branches: they are a seventh of the time.
    const int usual = isUsual(p1) & isUsual(p2) & isUsual(uv1) & isUsual(uv2)
        & int(facing * facing > kThin * std::max(p1 * p2, kThin * longer * longer))
        & int(uvArea * uvArea > kThin * uv1 * uv2);
    if (usual == 0)
        return false;
    const std::size_t side = std::size_t((facing > 0) == (uvArea > 0) ? Side::mirrored : Side::unmirrored);
    const float weight = projectedAngle(glm::vec3(0), dp1, dp2, n), scale = 1 / facing;
    Sum& sum = sums[side];
    sum.u += (acrossNext * duv1.x + acrossPrevious * duv2.x) * scale * weight;
    sum.v += (acrossNext * duv1.y + acrossPrevious * duv2.y) * scale * weight;
    sum.weight += weight;
    weights[side] += weight;
    return true;
}

// The averages of vertices that are equal.
class Averaging {
public:
    Averaging(const MeshView& mesh, const Chains& chains, std::vector<Side>& sides, const Averages& averages)
        : mesh_(mesh), chains_(chains), sides_(sides), averages_(averages)
    {
    }

    void average(std::uint32_t first)
    {
        Sum sums[2]; // by side
        unit_ = f32::cotan_normalize_or(mesh_.normals[first], glm::vec3(0));
        for (std::uint32_t v = first; v != kNone; v = chains_.equalVertex[v])
            sides_[v] = addVertex(v, sums);
        const auto isEmpty = [&](std::size_t slot) { return sums[slot % 2].isEmpty(); };
        for (std::uint32_t v = first; v != kNone; v = chains_.equalVertex[v]) {
            sides_[v] = sideOrNearest(sides_[v], first, isEmpty);
            store(sums[std::size_t(sides_[v])], v);
            if (averages_.copies.empty() || averages_.copies[v] == kNone)
                continue;
            const Side other = averages_.keepers[v] == Side::mirrored ? Side::unmirrored : Side::mirrored;
            const bool known = !sums[std::size_t(other)].isEmpty();
            store(sums[std::size_t(sideOrNearest(known ? other : Side::none, first, isEmpty))], averages_.copies[v]);
        }
    }

private:
    void store(const Sum& sum, std::uint32_t vertex)
    {
        if (!averages_.cotangents)
            return;
        const float scale = sum.isEmpty() ? 0 : 1 / sum.weight;
        averages_.cotangents->u[vertex] = sum.u * scale;
        averages_.cotangents->v[vertex] = sum.v * scale;
    }
    // Returns the side whose average it takes.
    Side addVertex(std::uint32_t vertex, Sum (&sums)[2])
    {
        const glm::vec3 n = mesh_.normals[vertex];
        float weights[2] = {0, 0};
        for (std::uint32_t c = chains_.firstCorner[vertex]; c != kNone; c = chains_.nextCorner[c]) {
            if (addUsualCorner(mesh_, c, n, unit_, sums, weights))
                continue;
            const Edges e = edgesAt(mesh_, c / 3, c % 3);
            if (const Side side = sideAt(e, n); side != Side::none)
                weights[std::size_t(side)] += addCorner(e, n, sums[std::size_t(side)]);
        }
        if (weights[0] > 0 && weights[1] > 0)
            return averages_.keepers.empty() ? largerSide(vertex, n) : averages_.keepers[vertex];
        return weights[0] > 0 ? Side::unmirrored : weights[1] > 0 ? Side::mirrored : Side::none;
    }
    // Where triangles of both sides index a vertex: that of the larger sum of angle times openness.
    Side largerSide(std::uint32_t vertex, glm::vec3 n) const
    {
        float shares[2] = {0, 0};
        for (std::uint32_t c = chains_.firstCorner[vertex]; c != kNone; c = chains_.nextCorner[c]) {
            const Edges e = edgesAt(mesh_, c / 3, c % 3);
            Sum sum;
            if (const Side side = sideAt(e, n); side != Side::none)
                shares[std::size_t(side)] += addCorner(e, n, sum) * openness(e, n);
        }
        return shares[0] + shares[1] == 0 ? Side::none : shares[1] > shares[0] ? Side::mirrored : Side::unmirrored;
    }

    const MeshView& mesh_;
    const Chains& chains_;
    std::vector<Side>& sides_;
    const Averages& averages_;
    glm::vec3 unit_{0}; // normal of the equal vertices, at length 1
};

} // namespace

CornerGroups groupCorners(const MeshView& mesh, std::size_t threads, const Averages& averages, const Listener& listener)
{
    constexpr double kWelded = 0.3, kChained = 0.4; // of the time
    const std::size_t count = mesh.positions.size();
    CornerGroups groups{weld(mesh, threads), std::vector<Side>(count)};
    if (!listener(kWelded))
        return {};
    const Chains chains = chainsOf(mesh, groups.first);
    const bool done = listener(kChained)
        && runToldParts(count, threads, listener, kChained, 1, [&](std::size_t begin, std::size_t end) {
                          Averaging averaging(mesh, chains, groups.sides, averages);
                          for (std::size_t v = begin; v != end; ++v)
                              if (groups.first[v] == v)
                                  averaging.average(std::uint32_t(v));
                      });
    return done ? std::move(groups) : CornerGroups{};
}

} // namespace cotan::tangents
