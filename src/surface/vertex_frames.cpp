#include "cotan/surface/vertex_frames.hpp"

#include "cotan/scene/texture_uv.hpp"
#include "cotan/tangents.hpp"

namespace cotan {

namespace {

// The uv that the normal map is read with.
std::vector<glm::vec2> normalMapUv(const Mesh& mesh, const Texture& map)
{
    std::vector<glm::vec2> uv = mesh.texcoords[std::size_t(map.present() ? map.texcoord : 0)];
    for (glm::vec2& c : uv)
        c = textureUv(map, c);
    return uv;
}

template<class T> void gather(std::vector<T>& values, const std::vector<std::uint32_t>& sources)
{
    if (values.empty())
        return;
    std::vector<T> gathered;
    gathered.reserve(sources.size());
    for (std::uint32_t s : sources)
        gathered.push_back(values[s]);
    values = std::move(gathered);
}

void applySplit(Mesh& mesh, const VertexSplit& split)
{
    gather(mesh.positions, split.sources);
    gather(mesh.normals, split.sources);
    gather(mesh.tangents, split.sources);
    gather(mesh.texcoords[0], split.sources);
    gather(mesh.texcoords[1], split.sources);
    gather(mesh.colors, split.sources);
    gather(mesh.cotangentsU, split.sources);
    gather(mesh.cotangentsV, split.sources);
    mesh.indices = split.indices;
}

void deriveCotangents(Mesh& mesh, const Texture& map)
{
    std::vector<glm::vec2> uv = normalMapUv(mesh, map);
    applySplit(mesh, splitMirrored({mesh.positions, mesh.normals, uv, mesh.indices}));
    uv = normalMapUv(mesh, map);
    Cotangents c = smoothCotangents({mesh.positions, mesh.normals, uv, mesh.indices});
    mesh.cotangentsU = std::move(c.u);
    mesh.cotangentsV = std::move(c.v);
}

void deriveTangents(Mesh& mesh, const Texture& map, Frame frame)
{
    const std::vector<glm::vec2> uv = normalMapUv(mesh, map);
    const MeshView view{mesh.positions, mesh.normals, uv, mesh.indices};
    const auto corners = frame == Frame::mikktspace ? mikktspaceTangents(view) : vertexTangents(view);
    const VertexSplit split = splitVertices(mesh.vertexCount(), mesh.indices, corners);
    mesh.tangents.clear();
    applySplit(mesh, split);
    mesh.tangents.resize(mesh.vertexCount());
    for (std::size_t i = 0; i < corners.size(); ++i)
        mesh.tangents[mesh.indices[i]] = corners[i];
}

} // namespace

void deriveVertexFrames(Scene& scene, Frame frame, bool regenerate)
{
    if (info(frame).source != FrameSource::vertices)
        return;
    for (Mesh& mesh : scene.meshes) {
        const Texture& map = scene.materials[std::size_t(mesh.material)].normalMap;
        if (normalMapUv(mesh, map).empty() || mesh.indices.empty())
            continue;
        if (frame == Frame::smooth)
            deriveCotangents(mesh, map);
        else if (regenerate || mesh.tangents.empty())
            deriveTangents(mesh, map, frame);
    }
}

} // namespace cotan
