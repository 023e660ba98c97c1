#include "cotan/gltf/placed.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "cotan/gltf/lookup.hpp"
#include "cotan/portable.hpp"
#include "cotan/scene/placings.hpp"

namespace cotan {

using Json = nlohmann::ordered_json;

namespace {

glm::dvec3 vectorOr(const Json& node, const char* member, glm::dvec3 otherwise)
{
    if (!node.contains(member))
        return otherwise;
    const Json& v = node[member];
    return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

// Of a unit vector's length in float. Quantised normals are up to 0.007 off.
constexpr double kRounding = 2e-6;

// What a node does to vectors.
glm::dmat3 linearOf(const Json& node)
{
    glm::dmat3 m(1);
    if (node.contains("matrix")) {
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                m[column][row] = node["matrix"][std::size_t(4 * column + row)].get<double>();
        return m;
    }
    if (node.contains("rotation")) {
        const Json& q = node["rotation"];
        m = glm::mat3_cast(glm::normalize(
            glm::dquat(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>())));
    }
    const glm::dvec3 scale = vectorOr(node, "scale", glm::dvec3(1));
    for (int k = 0; k < 3; ++k)
        m[k] *= scale[k];
    return m;
}

} // namespace

std::vector<std::vector<glm::dmat3>> gltfPlacings(const Json& root)
{
    std::vector<std::vector<glm::dmat3>> result(countOf(root, "meshes"));
    const std::size_t nodes = countOf(root, "nodes");
    std::vector<bool> child(nodes, false);
    for (std::size_t n = 0; n < nodes; ++n)
        for (const Json& c : root["nodes"][n].value("children", Json::array()))
            child[c.get<std::size_t>()] = true;
    std::vector<std::pair<std::size_t, glm::dmat3>> open;
    for (std::size_t n = 0; n < nodes; ++n)
        if (!child[n])
            open.emplace_back(n, glm::dmat3(1));
    while (!open.empty()) { // a forest: openGltfDocument has checked it
        const auto [n, above] = open.back();
        open.pop_back();
        const Json& node = root["nodes"][n];
        const glm::dmat3 here = above * linearOf(node);
        for (const Json& c : node.value("children", Json::array()))
            open.emplace_back(c.get<std::size_t>(), here);
        if (!node.contains("mesh"))
            continue;
        const glm::dmat3 placed = node.contains("skin") ? glm::dmat3(1) : here; // a skin replaces the node
        addPlacing(result[node["mesh"].get<std::size_t>()], placed);
    }
    placeUnshown(result);
    return result;
}

void makeUnit(std::vector<glm::vec3>& normals)
{
    for (glm::vec3& n : normals) {
        const double length = glm::length(glm::dvec3(n));
        if (length > 0 && std::abs(length - 1) > kRounding)
            n = glm::vec3(glm::dvec3(n) / length);
    }
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
