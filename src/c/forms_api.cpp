// cotan.h: storage forms of what is made at vertices and triangles.
#include "call.hpp"
#include "cotan/gpu_meshes.hpp"
#include "cotan/triangle.hpp"
#include "meshes.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

std::span<const glm::vec3> vectors(const float* array, std::size_t count, const char* name)
{
    if (!array && count != 0)
        fail(ErrorKind::usage, name, ": expected an array, found null");
    return {reinterpret_cast<const glm::vec3*>(array), count};
}

template<class T> std::vector<T> toVector(std::span<const T> values) { return {values.begin(), values.end()}; }

void putSplit(const VertexSplit& split, uint32_t* indices, uint32_t* sources, size_t* count)
{
    require(count, "split_count: expected a pointer, found null");
    put(split.indices, indices, "split_indices");
    put(split.sources, sources, "sources");
    *count = split.sources.size();
}

} // namespace

cotan_status cotan_split_vertices(size_t vertex_count, size_t index_count, const uint32_t* indices,
                                  const float* corners, uint32_t* split_indices, uint32_t* sources, size_t* split_count,
                                  char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        checkIndices("", vertex_count, index_count, indices);
        require(corners || index_count == 0, "corners: expected an array, found null");
        putSplit(splitVertices(vertex_count, {indices, index_count},
                               {reinterpret_cast<const glm::vec4*>(corners), index_count}),
                 split_indices, sources, split_count);
    });
}

cotan_status cotan_split_mirrored(const cotan_mesh* mesh, uint32_t* split_indices, uint32_t* sources,
                                  size_t* split_count, char* message, size_t message_size)
{
    return call(message, message_size,
                [&] { putSplit(splitMirrored(viewOf(mesh)), split_indices, sources, split_count); });
}

cotan_status cotan_triangle_vectors(const cotan_mesh* mesh, int threads, float* u, float* v, char* message,
                                    size_t message_size)
{
    return call(message, message_size, [&] {
        require(threads >= 0, "threads: expected 0 or more");
        require(u && v, "u and v: expected arrays, found null");
        const std::vector<TriangleVectors> made = triangleVectors(viewOf(mesh), threads);
        for (std::size_t f = 0; f < made.size(); ++f) {
            std::memcpy(u + 3 * f, &made[f].u, sizeof(glm::vec3));
            std::memcpy(v + 3 * f, &made[f].v, sizeof(glm::vec3));
        }
    });
}

cotan_status cotan_pack_triangles(size_t count, const float* u, const float* v, uint32_t* words, char* message,
                                  size_t message_size)
{
    return call(message, message_size, [&] {
        const auto us = vectors(u, count, "u"), vs = vectors(v, count, "v");
        std::vector<TriangleVectors> triangles(count);
        for (std::size_t f = 0; f < count; ++f)
            triangles[f] = {us[f], vs[f]};
        put(packTriangles(triangles), words, "packed");
    });
}

cotan_status cotan_pack_smooth8(size_t count, const float* normals, const float* u, const float* v, int16_t* packed,
                                char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const Cotangents cotangents{toVector(vectors(u, count, "u")), toVector(vectors(v, count, "v"))};
        put(packSmooth8(vectors(normals, count, "normals"), cotangents), packed, "packed");
    });
}

cotan_status cotan_pack_smooth4(size_t count, const float* normals, const float* u, const float* v, uint32_t* packed,
                                char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const Cotangents cotangents{toVector(vectors(u, count, "u")), toVector(vectors(v, count, "v"))};
        put(packSmooth4(vectors(normals, count, "normals"), cotangents), packed, "packed");
    });
}

cotan_status cotan_pack_tangents(size_t count, const float* normals, const float* tangents, uint16_t* packed,
                                 char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(tangents || count == 0, "tangents: expected an array, found null");
        put(packTangents2(vectors(normals, count, "normals"), {reinterpret_cast<const glm::vec4*>(tangents), count}),
            packed, "packed");
    });
}

cotan_status cotan_provoking(size_t vertex_count, size_t index_count, const uint32_t* indices, int last,
                             uint32_t* made_indices, uint32_t* sources, size_t* made_count, uint32_t* corners,
                             char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        checkIndices("", vertex_count, index_count, indices);
        require(made_count, "made_count: expected a pointer, found null");
        const ProvokingMesh made = provokingMesh({indices, index_count}, vertex_count,
                                                 last != 0 ? ProvokingVertex::last : ProvokingVertex::first);
        put(made.indices, made_indices, "made_indices");
        put(made.sources, sources, "sources");
        put(made.corners, corners, "corners");
        *made_count = made.sources.size();
    });
}
