// Facets: the step of the perturbed normal across the edge between two triangles, and its error inside the triangles,
// for a map of constant tilt.
#include "rows.hpp"
#include "tables.hpp"
#include "truth/tessellation.hpp"

#include <map>

#include <fmt/format.h>

namespace cotan {

namespace {

constexpr int kFacetSamples = 6000;
constexpr Frame kFrames[] = {Frame::paperFull, Frame::cotangent, Frame::exact,  Frame::triangle,  Frame::orthonormal,
                             Frame::gradient,  Frame::smooth,    Frame::vertex, Frame::mikktspace};

// An edge shared by two triangles: the index of each, and which of its corners are the ends of the edge.
struct Edge {
    std::size_t triangles[2];
    int corners[2][2];
};

std::vector<Edge> interiorEdges(const Tessellation& mesh)
{
    struct Side {
        std::size_t triangle;
        int corners[2]; // at the lower and at the higher vertex index
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Side> open;
    std::vector<Edge> edges;
    for (std::size_t f = 0; f < mesh.triangleCount(); ++f)
        for (int k = 0; k < 3; ++k) {
            int a = k, b = (k + 1) % 3;
            if (mesh.indices[3 * f + std::size_t(a)] > mesh.indices[3 * f + std::size_t(b)])
                std::swap(a, b);
            const std::pair key(mesh.indices[3 * f + std::size_t(a)], mesh.indices[3 * f + std::size_t(b)]);
            const auto [found, inserted] = open.try_emplace(key, Side{f, {a, b}});
            if (inserted)
                continue;
            const Side& other = found->second;
            edges.push_back({{other.triangle, f}, {{other.corners[0], other.corners[1]}, {a, b}}});
        }
    return edges;
}

Interpolated onEdge(const Tessellation& mesh, const Edge& edge, int side, double t)
{
    TrianglePoint p;
    p.triangle = edge.triangles[side];
    p.weights = {0, 0, 0};
    p.weights[std::size_t(edge.corners[side][0])] = 1 - t;
    p.weights[std::size_t(edge.corners[side][1])] = t;
    return interpolate(mesh, p);
}

// Any two differences will do, because these frames do not depend on the view.
glm::dvec3 shadeByEdges(const FrameRows::Row& row, const Interpolated& x, glm::dvec3 texel)
{
    return shade(row.frame, row.single, x, x.edges, texel);
}

void measure(const AccuracySelection& selection, const Surface& surface, int segments, bool irregular,
             std::vector<Measurement>& result)
{
    const Tessellation mesh = tessellate(surface, segments, irregular);
    const std::vector<Edge> edges = interiorEdges(mesh);
    const std::string setting = fmt::format("{}{}", segments, irregular ? " irregular" : "");
    FrameRows steps, inside;
    for (Frame frame : kFrames) {
        steps.add(selection, frame, {"facets", surface.name, setting, "", "across the edge", ""});
        if (frame != Frame::gradient) // a constant tilt and truth E have no common scale
            inside.add(selection, frame, {"facets", surface.name, setting, "", "S", ""});
    }
    const double unitsPerUv = surface.unitsPerUv();
    Random random(61);
    for (int i = 0; i < kFacetSamples; ++i) {
        const glm::dvec3 texel = tiltedTexel(random, 35);
        const glm::dvec3 metric = glm::normalize(glm::dvec3(texel.x * unitsPerUv, texel.y * unitsPerUv, texel.z));
        const Edge& edge = edges[std::size_t(random.unit() * double(edges.size()))];
        const double t = random.unit();
        const Interpolated a = onEdge(mesh, edge, 0, t), b = onEdge(mesh, edge, 1, t);
        for (FrameRows::Row& row : steps.rows) {
            const glm::dvec3 m = row.frame == Frame::gradient ? metric : texel;
            row.angles.add(degreesBetween(shadeByEdges(row, a, m), shadeByEdges(row, b, m)));
        }
        const Interpolated x = interpolate(mesh, randomPoint(random, mesh));
        const glm::dvec3 truth = truthS(surface.at(x.parameters), texel);
        for (FrameRows::Row& row : inside.rows)
            row.angles.add(degreesBetween(shadeByEdges(row, x, texel), truth));
    }
    steps.finish(result);
    inside.finish(result);
}

} // namespace

std::vector<Measurement> measureFacets(const AccuracySelection& selection)
{
    std::vector<Measurement> result;
    for (const Surface& surface : surfaces())
        if (selection.wantsScene(surface.name))
            for (bool irregular : {false, true})
                for (int segments : {8, 16, 32, 64, 128})
                    measure(selection, surface, segments, irregular, result);
    return result;
}

} // namespace cotan
