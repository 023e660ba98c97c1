#include "cotan/triangle.hpp"

#include <algorithm>
#include <cmath>

#include "cotan/portable.hpp"
#include "loops.hpp"
#include "tangents_mesh.hpp"

namespace cotan {

std::vector<TriangleVectors> triangleVectors(const MeshView& mesh, int threads)
{
    if (!tangents::usable(mesh))
        return {};
    std::vector<TriangleVectors> out(mesh.indices.size() / 3);
    runParts(out.size(), threadsFor(out.size(), 10000, threads), [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const std::uint32_t a = mesh.indices[3 * f], b = mesh.indices[3 * f + 1], c = mesh.indices[3 * f + 2];
            const f32::cotan_triangle t = f32::cotan_triangle_of_vertices(
                mesh.positions[a], mesh.positions[b], mesh.positions[c], mesh.texcoords[a], mesh.texcoords[b],
                mesh.texcoords[c], mesh.normals[a], mesh.normals[b], mesh.normals[c]);
            out[f] = {t.u, t.v};
        }
    });
    return out;
}

namespace {

bool sizesMatch(std::span<const glm::vec3> normals, const Cotangents& c)
{
    return c.u.size() == normals.size() && c.v.size() == normals.size();
}

// Returns pack(i) for all i < count.
template<class Pack> auto packAll(std::size_t count, const Pack& pack)
{
    std::vector<decltype(pack(count))> out;
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(pack(i));
    return out;
}

} // namespace

std::vector<std::array<std::uint32_t, 3>> packTriangles(std::span<const TriangleVectors> triangles)
{
    return packAll(triangles.size(), [&](std::size_t i) {
        const f32::cotan_packed_triangle p = f32::cotan_pack_triangle(triangles[i].u, triangles[i].v);
        return std::array{p.a, p.b, p.c};
    });
}

Cotangents unitCotangents(const Cotangents& cotangents)
{
    Cotangents out = cotangents;
    for (std::size_t i = 0; i < out.u.size() && i < out.v.size(); ++i) {
        const f32::cotan_triangle unit = f32::cotan_triangle_unit(out.u[i], out.v[i], 1.0f);
        out.u[i] = unit.u;
        out.v[i] = unit.v;
    }
    return out;
}

std::vector<std::array<std::int16_t, 4>> packSmooth8(std::span<const glm::vec3> normals, const Cotangents& cotangents)
{
    const auto number = [](float x) {
        return static_cast<std::int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * 32767));
    };
    return packAll(sizesMatch(normals, cotangents) ? normals.size() : 0, [&](std::size_t i) {
        const glm::vec4 q = f32::cotan_pack_smooth8(normals[i], cotangents.u[i], cotangents.v[i]);
        return std::array{number(q.x), number(q.y), number(q.z), number(q.w)};
    });
}

std::vector<std::uint32_t> packSmooth4(std::span<const glm::vec3> normals, const Cotangents& cotangents)
{
    return packAll(sizesMatch(normals, cotangents) ? normals.size() : 0, [&](std::size_t i) -> std::uint32_t {
        return f32::cotan_pack_smooth4(normals[i], cotangents.u[i], cotangents.v[i]);
    });
}

std::vector<std::uint16_t> packTangents2(std::span<const glm::vec3> normals, std::span<const glm::vec4> tangents)
{
    return packAll(normals.size() == tangents.size() ? normals.size() : 0, [&](std::size_t i) {
        return static_cast<std::uint16_t>(f32::cotan_pack_tangent2(normals[i], glm::vec3(tangents[i]), tangents[i].w));
    });
}

} // namespace cotan
