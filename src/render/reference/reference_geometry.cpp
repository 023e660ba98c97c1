#include "reference_geometry.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "cotan/covector.hpp"
#include "cotan/frame.hpp"

namespace cotan::reference {

namespace {

// How an instance moves points, vectors and covectors.
struct Transform {
    glm::mat3 vectors{1};
    glm::vec3 translation{0}; // relative to the eye
    glm::dmat3 covectors{1};  // inverse transpose, up to a positive factor
    bool mirrored = false;
};

Transform transformOf(const glm::mat4& toWorld, glm::dvec3 eye)
{
    Transform t;
    t.vectors = glm::mat3(toWorld);
    t.translation = glm::vec3(glm::dvec3(toWorld[3]) - eye);
    const LinearMap<double> map{glm::dmat3(toWorld)};
    const glm::dmat3 covectors = map.planeMatrix();
    t.mirrored = map.determinant() < 0;
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(covectors[column][row]));
    bool usable = largest > 0 && std::isfinite(largest);
    t.covectors = usable ? covectors / largest : glm::dmat3(0.0);
    return t;
}

glm::vec3 unitOrZero(glm::vec3 v) { return f32::cotan_normalize_or(v, glm::vec3(0)); }

glm::vec3 covector(const Transform& t, glm::vec3 v) { return glm::vec3(t.covectors * glm::dvec3(v)); }

// The one place where stored tangents meet our frames here: a judge does not take the sign from whom it judges
// (tangentAlongV). glTF has bitangent = cross(n, t) * w, along
// the map's green direction, which is up the image: against +v, since v runs down. Our b points
// along +v, hence the minus. A mirroring matrix reverses cross products once more.
glm::vec4 storedTangent(const Transform& t, glm::vec4 tangent)
{
    float handedness = -tangent.w * (t.mirrored ? -1.0f : 1.0f);
    return {unitOrZero(t.vectors * glm::vec3(tangent)), handedness};
}

template<class In, class Out, class Function>
void transformAll(const std::vector<In>& in, std::size_t count, std::vector<Out>& out, Function function)
{
    if (in.size() < count)
        return; // absent
    out.resize(count);
    parallelRanges<std::size_t>(0, count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            out[i] = function(in[i]);
    });
}

Draw makeDraw(const Mesh& mesh, const glm::mat4& toWorld, glm::dvec3 eye, Frame frame)
{
    Transform t = transformOf(toWorld, eye);
    std::size_t count = mesh.vertexCount();
    Draw draw;
    draw.mesh = &mesh;
    draw.material = mesh.material;
    draw.vectors = t.vectors;
    draw.mirrored = t.mirrored;
    transformAll(mesh.positions, count, draw.positions, [&](glm::vec3 p) { return t.vectors * p + t.translation; });
    transformAll(mesh.normals, count, draw.normals, [&](glm::vec3 n) { return unitOrZero(covector(t, n)); });
    if (readsTangents(frame))
        transformAll(mesh.tangents, count, draw.tangents, [&](glm::vec4 tangent) { return storedTangent(t, tangent); });
    if (readsCotangents(frame)) {
        auto asCovector = [&](glm::vec3 v) { return covector(t, v); };
        transformAll(mesh.cotangentsU, count, draw.cotangentsU, asCovector);
        transformAll(mesh.cotangentsV, count, draw.cotangentsV, asCovector);
    }
    return draw;
}

bool isTranslucent(const Scene& scene, const Draw& draw)
{
    return scene.materials[std::size_t(draw.material)].translucent();
}

} // namespace

std::vector<Draw> makeDraws(const Scene& scene, glm::dvec3 eye, Frame frame, bool blending)
{
    std::vector<Draw> draws;
    for (const Instance& instance : scene.instances) {
        if (instance.mesh < 0 || std::size_t(instance.mesh) >= scene.meshes.size())
            continue;
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        bool hasMaterial = mesh.material >= 0 && std::size_t(mesh.material) < scene.materials.size();
        if (hasMaterial && mesh.triangleCount() > 0)
            draws.push_back(makeDraw(mesh, instance.toWorld, eye, frame));
    }
    if (blending)
        std::stable_partition(draws.begin(), draws.end(),
                              [&](const Draw& draw) { return !isTranslucent(scene, draw); });
    return draws;
}

} // namespace cotan::reference
