#include "cotan/view.hpp"

#include <span>
#include <utility>

#include "cotan/tangents.hpp"
#include "scene/texture_uv.hpp"

namespace cotan {

namespace {

void applySplit(Mesh& mesh, const VertexSplit& split)
{
    const auto gather = [&](auto& values) { values = gathered(std::span(std::as_const(values)), split); };
    gather(mesh.positions);
    gather(mesh.normals);
    gather(mesh.tangents);
    gather(mesh.texcoords[0]);
    gather(mesh.texcoords[1]);
    gather(mesh.colors);
    gather(mesh.cotangentsU);
    gather(mesh.cotangentsV);
    mesh.indices = split.indices;
}

void deriveCotangents(Mesh& mesh, std::span<const glm::vec2> uv)
{
    SplitCotangents made = splitSmoothCotangents({mesh.positions, mesh.normals, uv, mesh.indices});
    applySplit(mesh, made.split);
    mesh.cotangentsU = std::move(made.cotangents.u);
    mesh.cotangentsV = std::move(made.cotangents.v);
}

void deriveTangents(Mesh& mesh, std::span<const glm::vec2> uv, Frame frame)
{
    const auto corners = generateTangents(frame, {mesh.positions, mesh.normals, uv, mesh.indices});
    const VertexSplit split = splitVertices(mesh.vertexCount(), mesh.indices, corners);
    mesh.tangents.clear();
    applySplit(mesh, split);
    mesh.tangents.resize(mesh.vertexCount());
    for (std::size_t i = 0; i < corners.size(); ++i)
        mesh.tangents[mesh.indices[i]] = corners[i];
}

} // namespace

void deriveVertexFrames(Scene& scene, Frame frame, TangentOrigin tangents)
{
    if (!readsVertices(frame))
        return;
    for (Mesh& mesh : scene.meshes) {
        const std::vector<glm::vec2> uv = textureUv(scene.materials[std::size_t(mesh.material)].normalMap, mesh);
        if (uv.empty() || mesh.indices.empty())
            continue;
        if (readsCotangents(frame))
            deriveCotangents(mesh, uv);
        else if (tangents == TangentOrigin::generated || mesh.tangents.empty())
            deriveTangents(mesh, uv, frame);
    }
}

} // namespace cotan
