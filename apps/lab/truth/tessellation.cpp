#include "truth/tessellation.hpp"

#include "cotan/triangle.hpp"
#include "truth/patch.hpp"

namespace cotan {

namespace {

glm::dvec3 corner(const std::vector<glm::vec3>& values, std::size_t i)
{
    return i < values.size() ? glm::dvec3(values[i]) : glm::dvec3(0);
}

// Gradients of u and v in the plane of the edges. `outwards` selects the side of the normal.
AffinePatch planeOf(glm::dvec3 origin, const Differences<double>& edges, glm::dvec3 outwards)
{
    AffinePatch p;
    const glm::dvec3 e1 = edges.dpdx.raw(), e2 = edges.dpdy.raw();
    const glm::dvec3 area = glm::cross(e1, e2);
    const double a2 = glm::dot(area, area);
    const glm::dvec3 r1 = glm::cross(e2, area) / a2, r2 = glm::cross(area, e1) / a2;
    p.origin = origin;
    p.normal = area / std::sqrt(a2) * (glm::dot(area, outwards) < 0 ? -1.0 : 1.0);
    p.gradU = r1 * edges.duvdx.x + r2 * edges.duvdy.x;
    p.gradV = r1 * edges.duvdx.y + r2 * edges.duvdy.y;
    return p;
}

template<class Real> glm::dvec3 shadeFromVertices(Frame frame, const Interpolated& x, glm::dvec3 m)
{
    using Vec3 = packed::vec<3, Real>;
    const glm::dvec4 t = x.tangents[std::size_t(frame)];
    const auto f = readsCotangents(frame) ? evaluateCotangents(frame, Vec3(x.n), Vec3(x.cotangentU), Vec3(x.cotangentV))
                                          : evaluateTangents(frame, Vec3(x.n), Vec3(t), Real(t.w));
    return glm::dvec3(cotan_apply(f, Vec3(m)));
}

} // namespace

Tessellation tessellate(const Surface& surface, int segments, bool irregular, bool vertexFrames)
{
    Tessellation mesh;
    const int columns = segments, rows = surface.name == "spout" ? segments : segments / 2;
    Random random(99);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            glm::dvec2 cell(i, j);
            if (irregular && i > 0 && i < columns && j > 0 && j < rows) {
                cell.x += random.range(-0.3, 0.3);
                cell.y += random.range(-0.3, 0.3);
            }
            const SurfacePoint p = surface.at(cell / glm::dvec2(columns, rows));
            mesh.positions.emplace_back(p.position);
            mesh.normals.emplace_back(p.normal);
            mesh.texcoords.emplace_back(p.uv);
            mesh.parameters.push_back(p.parameters);
        }
    auto addTriangle = [&](int a, int b, int c) {
        if (surface.inward)
            std::swap(b, c);
        for (int k : {a, b, c})
            mesh.indices.push_back(std::uint32_t(k));
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
            if (irregular && random.unit() < 0.5) {
                addTriangle(a, b, d);
                addTriangle(b, c, d);
            } else {
                addTriangle(a, b, c);
                addTriangle(a, c, d);
            }
        }
    if (vertexFrames) {
        const MeshView view{mesh.positions, mesh.normals, mesh.texcoords, mesh.indices};
        for (const FrameInfo& f : frames())
            if (readsTangents(f.frame))
                mesh.tangents[std::size_t(f.frame)] = generateTangents(f.frame, view);
        Cotangents cotangents = smoothCotangents(view);
        mesh.unitCotangents = unitCotangents(cotangents);
        mesh.cotangentsU = std::move(cotangents.u);
        mesh.cotangentsV = std::move(cotangents.v);
    }
    return mesh;
}

TrianglePoint randomPoint(Random& random, const Tessellation& mesh)
{
    TrianglePoint p;
    p.triangle = std::size_t(random.unit() * double(mesh.triangleCount()));
    double a = random.unit(), b = random.unit();
    if (a + b > 1) {
        a = 1 - a;
        b = 1 - b;
    }
    p.weights = {a, b, 1 - a - b};
    return p;
}

Interpolated interpolate(const Tessellation& mesh, const TrianglePoint& at)
{
    Interpolated x{};
    const std::size_t first = 3 * at.triangle;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.indices[first + k];
        const double w = at.weights[k];
        x.position += glm::dvec3(mesh.positions[v]) * w;
        x.n += glm::dvec3(mesh.normals[v]) * w;
        x.parameters += mesh.parameters[v] * w;
        x.uv += glm::dvec2(mesh.texcoords[v]) * w;
        x.cotangentU += corner(mesh.cotangentsU, v) * w;
        x.unitU += corner(mesh.unitCotangents.u, v) * w;
        x.unitV += corner(mesh.unitCotangents.v, v) * w;
        x.cotangentV += corner(mesh.cotangentsV, v) * w;
        for (std::size_t f = 0; f < mesh.tangents.size(); ++f)
            if (!mesh.tangents[f].empty()) // the first corner gives the sign
                x.tangents[f] += glm::dvec4(glm::dvec3(mesh.tangents[f][first + k]) * w,
                                            k == 0 ? double(tangentAlongV(mesh.tangents[f][first]).w) : 0);
    }
    const std::uint32_t* v = &mesh.indices[first];
    auto edge = [&](int k) { return Vector3d(glm::dvec3(mesh.positions[v[k]]) - glm::dvec3(mesh.positions[v[0]])); };
    auto uvEdge = [&](int k) { return glm::dvec2(mesh.texcoords[v[k]]) - glm::dvec2(mesh.texcoords[v[0]]); };
    x.edges = {edge(1), edge(2), uvEdge(1), uvEdge(2)};
    x.plane = planeOf(glm::dvec3(mesh.positions[v[0]]), x.edges, x.n);
    return x;
}

glm::dvec3 shade(Frame frame, bool single, const Interpolated& x, const Differences<double>& screen, glm::dvec3 m)
{
    if (readsVertices(frame))
        return single ? shadeFromVertices<float>(frame, x, m) : shadeFromVertices<double>(frame, x, m);
    const Differences<double>& d = info(frame).source == FrameSource::triangle ? x.edges : screen;
    const glm::dvec3 n = glm::normalize(x.n);
    return single ? shadeFloat(frame, n, d, m) : shade(frame, n, d, m);
}

} // namespace cotan
