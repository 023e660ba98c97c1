// Meshes and models of cotan.h, checked and converted.
#pragma once

#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "call.hpp"
#include "cotan/scene.hpp"
#include "cotan/tangents.hpp"

struct cotan_model {
    cotan::Scene scene;
    std::string warnings; // as returned by cotan_model_warnings
};

namespace cotan::c {

inline void checkIndices(const std::string& name, std::size_t vertexCount, std::size_t indexCount,
                         const std::uint32_t* indices)
{
    if (indexCount % 3 != 0)
        fail(ErrorKind::usage, name, "index_count: expected a multiple of 3");
    if (indexCount != 0 && !indices)
        fail(ErrorKind::usage, name, "indices: expected an array, found null");
    for (std::size_t i = 0; i < indexCount; ++i)
        if (indices[i] >= vertexCount)
            fail(ErrorKind::input, name, "indices[", i, "]: expected less than ", vertexCount, ", found ", indices[i]);
}

inline cotan_mesh checkedMesh(const cotan_mesh* given, const char* called, bool needsUv, bool needsNormals = true)
{
    requireStruct(given, called);
    const cotan_mesh m = optionsOf(given, called);
    if (m.vertex_count != 0 && !(m.positions && (m.normals || !needsNormals) && (m.texcoords || !needsUv)))
        fail(ErrorKind::usage, called, ": expected positions", needsNormals ? ", normals" : "",
             needsUv ? " and texcoords" : "", ", found null");
    checkIndices(std::string(called) + ".", m.vertex_count, m.index_count, m.indices);
    return m;
}

static_assert(sizeof(glm::vec2) == 2 * sizeof(float) && sizeof(glm::vec3) == 3 * sizeof(float)
              && sizeof(glm::vec4) == 4 * sizeof(float));

inline void checkFinite(const std::string& name, const float* numbers, std::size_t each, std::size_t vertices)
{
    for (std::size_t i = 0; i < each * vertices; ++i)
        if (!std::isfinite(numbers[i]))
            fail(ErrorKind::input, name, "[", i / each, "]: expected finite numbers, found ",
                 std::isnan(numbers[i]) ? "nan"
                     : numbers[i] > 0   ? "inf"
                                        : "-inf");
}

// Returns the arrays of a checked mesh; missing ones are empty.
inline MeshView arraysOf(const cotan_mesh& m)
{
    return {{reinterpret_cast<const glm::vec3*>(m.positions), m.vertex_count},
            {reinterpret_cast<const glm::vec3*>(m.normals), m.normals ? m.vertex_count : 0},
            {reinterpret_cast<const glm::vec2*>(m.texcoords), m.texcoords ? m.vertex_count : 0},
            {m.indices, m.index_count}};
}

// Checks a mesh with uv and returns its arrays.
inline MeshView viewOf(const cotan_mesh* given)
{
    const cotan_mesh m = checkedMesh(given, "mesh", /*needsUv*/ true);
    checkFinite("mesh.positions", m.positions, 3, m.vertex_count);
    checkFinite("mesh.normals", m.normals, 3, m.vertex_count);
    checkFinite("mesh.texcoords", m.texcoords, 2, m.vertex_count);
    return arraysOf(m);
}

// Copies results into the caller's array. name: for messages.
template<class Value, class Out> void put(const std::vector<Value>& values, Out* out, const char* name)
{
    static_assert(sizeof(Value) % sizeof(Out) == 0); // a value is one or several of the caller's elements
    if (!out && !values.empty())
        fail(ErrorKind::usage, name, ": expected an array, found null");
    if (!values.empty())
        std::memcpy(out, values.data(), values.size() * sizeof(Value));
}

// Converts a checked mesh; its material is the first.
inline Mesh meshOf(const cotan_mesh& m)
{
    const MeshView view = arraysOf(m);
    Mesh mesh;
    mesh.positions.assign(view.positions.begin(), view.positions.end());
    mesh.normals.assign(view.normals.begin(), view.normals.end());
    mesh.texcoords[0].assign(view.texcoords.begin(), view.texcoords.end());
    mesh.indices.assign(view.indices.begin(), view.indices.end());
    if (m.colors)
        mesh.colors.assign(reinterpret_cast<const glm::vec4*>(m.colors),
                           reinterpret_cast<const glm::vec4*>(m.colors) + m.vertex_count);
    return mesh;
}

// Returns a scene of the meshes, with one instance of each. name: for messages.
inline Scene sceneOf(std::vector<Mesh> meshes, const std::string& name)
{
    Scene scene;
    scene.name = name;
    scene.materials.resize(1);
    scene.instances.resize(meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i)
        scene.instances[i].mesh = int(i);
    scene.meshes = std::move(meshes);
    return scene;
}

inline const Scene& sceneOf(const cotan_model* model, const char* name)
{
    if (!model)
        fail(ErrorKind::usage, name, ": expected a model, found null");
    return model->scene;
}

} // namespace cotan::c
