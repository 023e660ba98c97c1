#include "cotan/bake/low_surface.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cotan/scene/texture_uv.hpp"
#include "cotan/tangents.hpp"

namespace cotan {

namespace {

glm::vec3 normalizedOrZero(glm::vec3 v)
{
    const float length = glm::length(v);
    return length > 0 ? v / length : v;
}

// Appends one mesh as an instance places it.
void append(LowSurface& surface, const Mesh& mesh, const Texture& map, const glm::mat4& toWorld,
            std::uint32_t instance, bool storedTangents)
{
    const auto base = std::uint32_t(surface.positions.size());
    const glm::mat3 linear(toWorld);
    const float determinant = glm::determinant(linear);
    const glm::mat3 cofactors = glm::mat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                          glm::cross(linear[0], linear[1])) * (determinant < 0 ? -1.0f : 1.0f);
    // Where lengths do not change, neither do the numbers: what is baked is what the shader reads.
    const bool rigid = cofactors == linear;
    const auto& texcoords = mesh.texcoords[std::size_t(map.present() ? map.texcoord : 0)];
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        surface.positions.push_back(glm::vec3(toWorld * glm::vec4(mesh.positions[v], 1)));
        surface.normals.push_back(rigid ? linear * mesh.normals[v] : normalizedOrZero(cofactors * mesh.normals[v]));
        surface.texcoords.push_back(textureUv(map, texcoords[v]));
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::uint32_t corner[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        if (determinant < 0) // a mirrored instance turns its triangles round
            std::swap(corner[1], corner[2]);
        for (std::uint32_t c : corner) {
            surface.indices.push_back(base + c);
            if (storedTangents) {
                const glm::vec4 t = mesh.tangents[c];
                const glm::vec3 turned = rigid ? linear * glm::vec3(t) : normalizedOrZero(linear * glm::vec3(t));
                surface.tangents.push_back(glm::vec4(turned, determinant < 0 ? -t.w : t.w));
            }
        }
        surface.triangleInstance.push_back(instance);
    }
}

void deriveCotangents(LowSurface& s)
{
    const VertexSplit split = splitMirrored({s.positions, s.normals, s.texcoords, s.indices});
    LowSurface copy;
    for (std::uint32_t source : split.sources) {
        copy.positions.push_back(s.positions[source]);
        copy.normals.push_back(s.normals[source]);
        copy.texcoords.push_back(s.texcoords[source]);
    }
    s.positions = std::move(copy.positions);
    s.normals = std::move(copy.normals);
    s.texcoords = std::move(copy.texcoords);
    s.indices = split.indices;
    Cotangents c = smoothCotangents({s.positions, s.normals, s.texcoords, s.indices});
    s.cotangentsU = std::move(c.u);
    s.cotangentsV = std::move(c.v);
}

} // namespace

Result<LowSurface> makeLowSurface(const Scene& scene, int material, Frame frame, TangentSource source)
{
    if (dependsOnView(frame))
        return usageError(fmt::format("the frame {} depends on the view: no map can be made for it", name(frame)));
    const bool needsTangents = frame == Frame::vertex || frame == Frame::mikktspace;
    LowSurface surface;
    bool allStored = needsTangents && source == TangentSource::stored;
    auto chosen = [&](const Mesh& mesh) { return material < 0 || mesh.material == material; };
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        if (chosen(mesh) && !mesh.indices.empty())
            allStored = allStored && !mesh.tangents.empty();
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[std::size_t(scene.instances[i].mesh)];
        if (!chosen(mesh) || mesh.indices.empty())
            continue;
        const Texture& map = scene.materials[std::size_t(mesh.material)].normalMap;
        if (mesh.texcoords[std::size_t(map.present() ? map.texcoord : 0)].empty())
            return inputError(fmt::format("{}: mesh '{}' has no texture coordinates (uv set {})", scene.name, mesh.name,
                                          map.present() ? map.texcoord : 0));
        append(surface, mesh, map, scene.instances[i].toWorld, std::uint32_t(i), allStored);
    }
    if (surface.indices.empty())
        return inputError(fmt::format("{}: expected triangles; found none", scene.name));
    const MeshView view{surface.positions, surface.normals, surface.texcoords, surface.indices};
    if (frame == Frame::smooth)
        deriveCotangents(surface);
    else if (needsTangents && !allStored)
        surface.tangents = frame == Frame::mikktspace ? mikktspaceTangents(view) : vertexTangents(view);
    return surface;
}

Differences<double> differencesOf(const LowSurface& s, Frame frame, std::uint32_t triangle)
{
    const std::uint32_t* v = &s.indices[3 * std::size_t(triangle)];
    const glm::dvec3 e1 = glm::dvec3(s.positions[v[1]]) - glm::dvec3(s.positions[v[0]]);
    const glm::dvec3 e2 = glm::dvec3(s.positions[v[2]]) - glm::dvec3(s.positions[v[0]]);
    const glm::dvec2 w1 = glm::dvec2(s.texcoords[v[1]]) - glm::dvec2(s.texcoords[v[0]]);
    const glm::dvec2 w2 = glm::dvec2(s.texcoords[v[2]]) - glm::dvec2(s.texcoords[v[0]]);
    const double determinant = w1.x * w2.y - w1.y * w2.x;
    if (determinant == 0 || frame == Frame::exact)
        return {Vector3d(e1), Vector3d(e2), w1, w2};
    return {Vector3d((e1 * w2.y - e2 * w1.y) / determinant), Vector3d((e2 * w1.x - e1 * w2.x) / determinant), {1, 0}, {0, 1}};
}

LowPoint pointOf(const LowSurface& s, Frame frame, std::uint32_t triangle, double b1, double b2)
{
    const std::size_t first = 3 * std::size_t(triangle);
    const std::uint32_t* v = &s.indices[first];
    const double b0 = 1 - b1 - b2;
    auto blend = [&](const auto& a, const auto& b, const auto& c) {
        return glm::dvec3(a) * b0 + glm::dvec3(b) * b1 + glm::dvec3(c) * b2;
    };
    auto typed = [](const f64::cotan_frame& f) {
        return CotangentFrame<double>{Covector3d(f.t), Covector3d(f.b), Covector3d(f.n)};
    };
    LowPoint p;
    p.position = blend(s.positions[v[0]], s.positions[v[1]], s.positions[v[2]]);
    const glm::dvec3 raw = blend(s.normals[v[0]], s.normals[v[1]], s.normals[v[2]]);
    const double length = glm::length(raw);
    p.normal = length > 0 ? raw / length : raw;
    if (frame == Frame::smooth) {
        p.frame = typed(f64::cotan_frame_smooth(raw, blend(s.cotangentsU[v[0]], s.cotangentsU[v[1]], s.cotangentsU[v[2]]),
                                                blend(s.cotangentsV[v[0]], s.cotangentsV[v[1]], s.cotangentsV[v[2]])));
    } else if (!s.tangents.empty()) {
        const glm::dvec3 t = blend(s.tangents[first], s.tangents[first + 1], s.tangents[first + 2]);
        const double handedness = -s.tangents[first].w; // glTF's w has v up
        p.frame = frame == Frame::mikktspace ? typed(f64::cotan_frame_mikktspace(raw, t, handedness))
                                             : typed(f64::cotan_frame_vertex(raw, t, handedness));
    } else {
        p.frame = makeFrame(frame, Covector3d(p.normal), differencesOf(s, frame, triangle));
    }
    return p;
}

} // namespace cotan
