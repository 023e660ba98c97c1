#include "gltf/json/placed.hpp"

#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "gltf/json/lookup.hpp"
#include "mesh.hpp"
#include "scene/geometry.hpp"
#include "structure.hpp"

namespace cotan {

using gltf::Json;

std::vector<std::vector<glm::dmat3>> gltfPlacings(const Json& root)
{
    std::vector<std::vector<glm::dmat3>> result(countOf(root, "meshes"));
    const std::vector<gltf::Node> nodes = gltf::readAll(&root, "nodes", gltf::readNode);
    std::vector<bool> child(nodes.size(), false);
    for (const gltf::Node& node : nodes)
        for (const int c : node.children)
            child[std::size_t(c)] = true;
    std::vector<std::pair<std::size_t, glm::dmat3>> open;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (!child[n])
            open.emplace_back(n, glm::dmat3(1));
    while (!open.empty()) { // a forest: openGltfDocument has checked it
        const auto [n, above] = open.back();
        open.pop_back();
        const gltf::Node& node = nodes[n];
        const glm::dmat3 here = above * glm::dmat3(gltf::localMatrix(node));
        for (const int c : node.children)
            open.emplace_back(std::size_t(c), here);
        if (node.mesh >= 0) // a skin replaces the node
            addPlacing(result[std::size_t(node.mesh)], node.skin >= 0 ? glm::dmat3(1) : here);
    }
    placeUnshown(result);
    return result;
}

void makeUnit(std::vector<glm::vec3>& normals)
{
    for (glm::vec3& n : normals)
        n = unitNormal(n);
}

Mesh gltfMesh(GltfGeometry geometry)
{
    Mesh mesh;
    mesh.positions = std::move(geometry.positions);
    mesh.normals = std::move(geometry.normals);
    mesh.tangents = std::move(geometry.tangents);
    mesh.texcoords[0] = std::move(geometry.texcoords);
    mesh.indices = std::move(geometry.indices);
    makeUnit(mesh.normals);
    if (!mesh.normals.empty())
        return mesh;
    Mesh flat;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 &a = mesh.positions[mesh.indices[i]], &b = mesh.positions[mesh.indices[i + 1]],
                        &c = mesh.positions[mesh.indices[i + 2]];
        const glm::vec3 n = f32::cotan_normalize_or(glm::cross(b - a, c - a), glm::vec3(0));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[i + k];
            flat.positions.push_back(mesh.positions[v]);
            flat.normals.push_back(n);
            if (!mesh.texcoords[0].empty())
                flat.texcoords[0].push_back(mesh.texcoords[0][v]);
            flat.indices.push_back(std::uint32_t(i + k));
        }
    }
    return flat;
}

} // namespace cotan
