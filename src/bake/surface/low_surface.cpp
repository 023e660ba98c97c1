#include "bake/surface/low_surface.hpp"

#include <array>
#include <string>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "cotan/covector.hpp"
#include "cotan/tangents.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

glm::vec3 normalizedOrZero(glm::vec3 v)
{
    const float length = glm::length(v);
    return length > 0 ? v / length : v;
}

// Appends one mesh, transformed by an instance.
void append(LowSurface& surface, const Mesh& mesh, const Texture& map, const glm::mat4& toWorld, std::uint32_t instance,
            bool storedTangents)
{
    const auto base = std::uint32_t(surface.positions.size());
    const glm::mat3 linear(toWorld);
    const LinearMap<float> placing(linear);
    const float determinant = placing.determinant();
    const glm::mat3 covectors = placing.planeMatrix();
    // If lengths do not change, normals are not renormalised: the bake uses the shader's exact numbers.
    const bool rigid = covectors == linear;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        surface.positions.push_back(glm::vec3(toWorld * glm::vec4(mesh.positions[v], 1)));
        surface.normals.push_back(rigid ? linear * mesh.normals[v] : normalizedOrZero(covectors * mesh.normals[v]));
    }
    if (!mesh.colors.empty()) {
        surface.reds.resize(base, 1);
        for (const glm::vec4& color : mesh.colors)
            surface.reds.push_back(color.x);
    }
    const std::vector<glm::vec2> uv = textureUv(map, mesh);
    surface.texcoords.insert(surface.texcoords.end(), uv.begin(), uv.end());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::uint32_t corner[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        if (determinant < 0) // a mirrored instance reverses the winding
            std::swap(corner[1], corner[2]);
        for (std::uint32_t c : corner) {
            surface.indices.push_back(base + c);
            if (storedTangents) {
                const glm::vec4 t = tangentAlongV(mesh.tangents[c]);
                const glm::vec3 tangent = rigid ? linear * glm::vec3(t) : normalizedOrZero(linear * glm::vec3(t));
                surface.tangents.push_back(glm::vec4(tangent, determinant < 0 ? -t.w : t.w));
            }
        }
        surface.triangleInstance.push_back(instance);
    }
}

void deriveCotangents(LowSurface& s)
{
    SplitCotangents made = splitSmoothCotangents({s.positions, s.normals, s.texcoords, s.indices});
    const auto gather = [&](auto& values) { values = gathered(std::span(std::as_const(values)), made.split); };
    gather(s.positions);
    gather(s.normals);
    gather(s.texcoords);
    if (!s.reds.empty())
        gather(s.reds);
    s.indices = std::move(made.split.indices);
    s.cotangentsU = std::move(made.cotangents.u);
    s.cotangentsV = std::move(made.cotangents.v);
}

template<class TextFrame> CotangentFrame<double> typed(const TextFrame& f)
{
    return {Covector3d(f.t), Covector3d(f.b), Covector3d(f.n)};
}

} // namespace

Result<LowSurface> makeLowSurface(const Scene& scene, int material, Frame frame, TangentOrigin tangents,
                                  std::span<const Instance> instances)
{
    if (dependsOnView(frame))
        return usageError("the frame " + std::string(name(frame)) + " depends on the view: no map can be made for it");
    LowSurface surface;
    surface.frame = frame;
    bool allStored = readsTangents(frame) && tangents == TangentOrigin::stored;
    auto chosen = [&](const Mesh& mesh) { return material < 0 || mesh.material == material; };
    for (const Instance& instance : instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        if (chosen(mesh) && !mesh.indices.empty())
            allStored = allStored && !mesh.tangents.empty();
    }
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[std::size_t(instances[i].mesh)];
        if (!chosen(mesh) || mesh.indices.empty())
            continue;
        const Texture& map = scene.materials[std::size_t(mesh.material)].normalMap;
        if (mesh.texcoords[uvSetOf(map)].empty())
            return inputError(scene.name + ": mesh '" + mesh.name + "' has no texture coordinates (uv set "
                              + std::to_string(uvSetOf(map)) + ")");
        append(surface, mesh, map, instances[i].toWorld, std::uint32_t(i), allStored);
    }
    if (surface.indices.empty())
        return inputError(scene.name + ": expected triangles; found none");
    if (!surface.reds.empty())
        surface.reds.resize(surface.positions.size(), 1);
    if (readsCotangents(frame)) {
        deriveCotangents(surface);
    } else if (readsTangents(frame) && !allStored) {
        surface.tangents =
            generateTangents(frame, {surface.positions, surface.normals, surface.texcoords, surface.indices});
        for (glm::vec4& t : surface.tangents)
            t = tangentAlongV(t);
    }
    return surface;
}

TriangleEdges edgesOf(const LowSurface& s, std::size_t triangle)
{
    const std::uint32_t* const v = &s.indices[3 * triangle];
    const glm::dvec3 p0(s.positions[v[0]]);
    const glm::dvec2 uv0(s.texcoords[v[0]]);
    return {glm::dvec3(s.positions[v[1]]) - p0, glm::dvec3(s.positions[v[2]]) - p0, glm::dvec2(s.texcoords[v[1]]) - uv0,
            glm::dvec2(s.texcoords[v[2]]) - uv0};
}

Differences<double> differencesOf(const LowSurface& s, std::uint32_t triangle)
{
    const TriangleEdges e = edgesOf(s, triangle);
    const double determinant = e.uvArea2();
    if (determinant == 0 || info(s.frame).source == FrameSource::triangle)
        return {Vector3d(e.p1), Vector3d(e.p2), e.uv1, e.uv2};
    return {Vector3d((e.p1 * e.uv2.y - e.p2 * e.uv1.y) / determinant),
            Vector3d((e.p2 * e.uv1.x - e.p1 * e.uv2.x) / determinant),
            {1, 0},
            {0, 1}};
}

LowPoint pointOf(const LowSurface& s, std::uint32_t triangle, double b1, double b2)
{
    const std::size_t first = 3 * std::size_t(triangle);
    const std::uint32_t* const at = &s.indices[first];
    const glm::dvec3 weights(1 - b1 - b2, b1, b2);
    LowPoint p;
    p.position = atCorners(s.positions, at, weights);
    const glm::dvec3 raw = atCorners(s.normals, at, weights);
    const double length = glm::length(raw);
    p.normal = length > 0 ? raw / length : raw;
    if (readsCotangents(s.frame)) {
        p.frame = typed(evaluateCotangents(s.frame, raw, atCorners(s.cotangentsU, at, weights),
                                           atCorners(s.cotangentsV, at, weights)));
    } else if (readsTangents(s.frame)) {
        const glm::dvec3 t(atCorners(s.tangents, std::array{first, first + 1, first + 2}, weights));
        p.frame = typed(evaluateTangents(s.frame, raw, t, double(s.tangents[first].w)));
    } else {
        p.frame = makeFrame(s.frame, Covector3d(p.normal), differencesOf(s, triangle));
    }
    return p;
}

} // namespace cotan
