// The compute passes over one mesh whose positions and normals change for every image.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include <cotan/gpu_meshes.hpp>

#include "../triangle/gpu.hpp"
#include "meshes.hpp"

enum class Pass { normals, smooth, tangents, triangles };

class Passes {
public:
    // Uploads the constant data: texcoords, indices, adjacency.
    Passes(const Gpu& gpu, const Mesh& rest, const cotan::Adjacency& adjacency,
           const cotan::Adjacency& normalAdjacency);

    // Sets the pose for the next passes, in the order of the rest mesh. Pass::normals overwrites the normals.
    void pose(const std::vector<glm::vec3>& positions, const std::vector<glm::vec3>& normals);

    // Runs a pass and waits for it. Returns milliseconds by the device's timestamps; NaN if it has none.
    double run(Pass pass);

    // The output of the last run.
    std::vector<glm::vec3> normals() const;
    std::vector<glm::vec4> frames() const; // smooth: for cotan_unpack_smooth8; tangents: xyz and sign
    std::vector<std::array<std::uint32_t, 3>> triangles() const; // for cotan_unpack_triangle_u and _v

private:
    const Gpu& gpu_;
    std::size_t vertexCount_, triangleCount_;
    // cotan::Adjacency on the device.
    struct Groups {
        std::uint32_t count, firstMirrored;
        Buffer vertexBegin, vertices, cornerBegin, corners;
    };
    static Groups upload(const Gpu& gpu, const cotan::Adjacency& adjacency);
    Groups frameGroups_, normalGroups_;
    Buffer positions_, normals_, texcoords_, indices_, frames_, triangles_;
    vk::raii::PipelineLayout layout_{nullptr};
    vk::raii::QueryPool times_{nullptr};
    std::vector<vk::raii::Pipeline> pipelines_;
};
