// Helpers for Scene and Mesh: vertex attributes, cameras, bounds, and what is drawn.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/tangents.hpp"
#include "cotan/vector.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- vertices --------------------------------------------------------------------------------

// The per-vertex arrays of a mesh, const or not; each is empty or has an entry per vertex.
template<class M> auto attributesOf(M& mesh)
{
    return std::tie(mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords[0], mesh.texcoords[1], mesh.colors,
                    mesh.cotangentsU, mesh.cotangentsV, mesh.bindPositions, mesh.bindNormals, mesh.skin[0],
                    mesh.skin[1], mesh.skin[2]);
}

// What vectors at the vertices are made from: the mesh, without its skin if it has one. Skinned: moves them as the skin
// moves that vertex; others stay.
MeshView bindView(const Mesh& mesh, std::span<const glm::vec2> uv);
glm::vec4 skinned(const Mesh& mesh, std::size_t vertex, glm::vec4 tangent);
glm::vec3 skinnedCotangent(const Mesh& mesh, std::size_t vertex, glm::vec3 cotangent);

// Replaces the mesh's normals by angle-weighted averages over corners that share a position. Faces that meet at more
// than `creaseDegrees` are kept separate (180: everything is smoothed). Vertices are split where needed, with all
// attributes. Degenerate triangles contribute nothing; a vertex without a usable triangle gets (0,0,1).
void generateNormals(Mesh& mesh, float creaseDegrees = 180);

// Merges vertices with bitwise equal attributes and drops unused ones. Triangles keep their order; vertices are ordered
// by first use.
void weldVertices(Mesh& mesh);

// Makes tangents that follow the stored uv follow the uv that a texture reads (KHR_texture_transform), as if the uv had
// been transformed before the tangents were made: each turns about its normal as dP/du turns in the triangles of its
// vertex, and w changes sign if the transform mirrors. With the transformed uv and the inverse transform it undoes
// this. tangents: one per vertex, as in glTF. mesh: with the stored uv. uRow, vRow: linear part of the transform.
// Degenerate input: a transform without area or not finite, and triangles without area in space or uv, turn nothing.
// Source: the Khronos glTF-Sample-Renderer, which moves t and b in its shader (pull request 16).
void transformTangents(std::vector<glm::vec4>& tangents, const MeshView& mesh, glm::dvec2 uRow, glm::dvec2 vRow);

// ---- several scenes --------------------------------------------------------------------------

// The textures of a material, const or not, with their names for messages.
template<class M> auto texturesOf(M& m)
{
    return std::to_array<std::pair<decltype(&m.normalMap), std::string_view>>(
        {{&m.baseColorMap, "base colour"},
         {&m.metallicRoughnessMap, "metal and roughness"},
         {&m.normalMap, "normal map"},
         {&m.occlusionMap, "occlusion"},
         {&m.emissiveMap, "emission"},
         {&m.coat.map, "coat"},
         {&m.coat.roughnessMap, "coat roughness"},
         {&m.coat.normalMap, "coat normal map"},
         {&m.anisotropy.map, "anisotropy"},
         {&m.specular.map, "specular"},
         {&m.specular.colorMap, "specular colour"},
         {&m.sheen.colorMap, "sheen colour"},
         {&m.sheen.roughnessMap, "sheen roughness"},
         {&m.transmission.map, "transmission"},
         {&m.heightMap.map, "height map"}});
}

// Adds what another scene has, except its name and Scene::reach.
void appendScene(Scene& scene, Scene more);

// ---- cameras ---------------------------------------------------------------------------------

// right, up and forward are orthonormal, with right = cross(forward, up).
struct CameraAxes {
    glm::dvec3 eye{0};
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
};

// Returns camera axes along the unit vector `forward`, with the eye at the origin. axes.up is as close to `up` as
// possible. If `up` is zero, not finite, or along forward, y is used instead, or -z if forward is nearly vertical.
CameraAxes axesAlong(const glm::dvec3& forward, const glm::dvec3& up);

// Returns the axes of a camera. A non-finite eye is replaced by the origin; with eye = target, the camera looks along
// -z.
CameraAxes cameraAxes(const Camera& camera);

// Returns a camera that shows the whole box from the front, right and above. An empty box gives the default camera.
Camera fitCamera(const Bounds& box, int width, int height);

// Returns the camera rotated by `angle` radians about the vertical (y) axis through its target, counterclockwise as
// seen from above. Height and distance stay the same, up to rounding.
Camera orbitedCamera(Camera camera, double angle);

// ---- placement and bounds --------------------------------------------------------------------

// Maximum number of instanced vertices for which exact bounds are computed, which takes a tenth of a second.
inline constexpr std::size_t kMaxExactBoundsVertices = std::size_t(1) << 24;

// Returns the mesh of an instance; null if its index is out of range.
inline const Mesh* meshPlacedBy(const Scene& scene, const Instance& instance)
{
    const bool known = instance.mesh >= 0 && std::size_t(instance.mesh) < scene.meshes.size();
    return known ? &scene.meshes[std::size_t(instance.mesh)] : nullptr;
}

// Returns an empty box: extending it by any point makes it exactly that point.
inline Bounds emptyBounds()
{
    return {glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
}

// Extends the box to include toWorld * p, unless that is not finite.
inline void extend(Bounds& box, const glm::mat4& toWorld, const glm::vec3& p)
{
    const glm::vec3 world(toWorld * glm::vec4(p, 1));
    if (!isFinite(world))
        return;
    box.low = glm::min(box.low, world);
    box.high = glm::max(box.high, world);
}

// Returns the bounding box of a mesh's finite vertices in object space.
inline Bounds bounds(const Mesh& mesh)
{
    Bounds box = emptyBounds();
    for (const glm::vec3& p : mesh.positions)
        extend(box, glm::mat4(1), p);
    return box;
}

// Calls work(toWorld, point) for points that bound the scene: all vertices of all instances up to
// kMaxExactBoundsVertices; beyond that, the corners of each instance's object-space bounding box.
template<class Work> void forEachPlacedPoint(const Scene& scene, const Work& work)
{
    std::size_t placed = 0;
    for (const Instance& instance : scene.instances)
        if (const Mesh* mesh = meshPlacedBy(scene, instance))
            placed += mesh->positions.size();

    std::vector<std::optional<Bounds>> own(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
        const Mesh* mesh = meshPlacedBy(scene, instance);
        if (!mesh)
            continue;
        if (placed <= kMaxExactBoundsVertices) {
            for (const glm::vec3& p : mesh->positions)
                work(instance.toWorld, p);
            continue;
        }
        std::optional<Bounds>& b = own[std::size_t(instance.mesh)];
        if (!b)
            b = bounds(*mesh);
        for (int corner = 0; corner < 8 && !b->empty(); ++corner)
            work(instance.toWorld, glm::mix(b->low, b->high, glm::bvec3(corner & 1, corner & 2, corner & 4)));
    }
}

// Returns the world-space bounding box of all instances; non-finite positions are ignored. Beyond
// kMaxExactBoundsVertices the box is too large for rotated instances, by a factor of up to sqrt(3) along an axis.
inline Bounds bounds(const Scene& scene)
{
    Bounds box = emptyBounds();
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& p) { extend(box, toWorld, p); });
    return box;
}

// Like forEachPlacedPoint, but for the points that a camera frames: Scene::reach if it is not empty.
template<class Work> void forEachFramedPoint(const Scene& scene, const Work& work)
{
    for (const glm::vec3& p : scene.reach)
        work(glm::mat4(1), p);
    if (scene.reach.empty())
        forEachPlacedPoint(scene, work);
}

inline Bounds framedBounds(const Scene& scene)
{
    Bounds box = emptyBounds();
    forEachFramedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& p) { extend(box, toWorld, p); });
    return box;
}

// ---- what is drawn ---------------------------------------------------------------------------

// Returns the shadow-casting light, the first directional one; null if there is none. Ignores View::shadows.
inline const Light* shadowLight(const View& view)
{
    const auto found = std::ranges::find(view.lights, LightKind::directional, &Light::kind);
    return found == view.lights.end() ? nullptr : &*found;
}

// Whether any drawn mesh reads a normal map: it has triangles, and the uv set that its material's map uses. Otherwise
// normals are the same in all frames and comparing them is meaningless.
bool drawsNormalMaps(const Scene& scene);

// The frame that a view draws a mesh with.
inline Frame frameOf(const Mesh& mesh, Frame ofView, bool framesOfMeshes)
{
    return framesOfMeshes && mesh.readWith ? *mesh.readWith : ofView;
}

// Checks that every drawn mesh with the uv of its normal map also has the vertex attributes that its frame reads (see
// frameOf); without them a renderer would have no frame for the mesh. Errors: ErrorKind::usage, naming the mesh, if
// deriveVertexFrames (cotan/view.hpp) was not called.
Status checkVertexAttributes(const Scene& scene, Frame ofView, bool framesOfMeshes = false);

// Returns the name of an instance, or of its mesh if the instance has none; may be empty.
inline const std::string& objectName(const Scene& scene, const Instance& instance)
{
    return !instance.name.empty() ? instance.name : scene.meshes[std::size_t(instance.mesh)].name;
}

// Adds the linear part of an instance transform to `known`, unless a known one differs from it only by a rotation,
// mirroring and uniform scale, under which all frames are equivariant.
void addDistinctLinearMap(std::vector<glm::dmat3>& known, const glm::dmat3& linear);

// The number of such maps of one mesh for which its normal maps are judged, where frames are chosen.
inline constexpr std::size_t kMaxStretches = 8;

// Adds the identity for meshes without instances, which are examined in object space.
void addIdentityWhereEmpty(std::vector<std::vector<glm::dmat3>>& placings);

// Rotates a z-up scene by 90 degrees about x, so that +z becomes +y (and +y becomes -z): instances, lights, cameras and
// reach. Meshes are not changed.
void rotateZUpToYUp(Scene& scene);

// Maximum number of triangles per image, counting instances. More would take minutes on a CPU; the reference renderer
// needs about 150 bytes per triangle.
inline constexpr std::size_t kMaxTrianglesDrawn = 100'000'000;

// Total number of triangles of all instances.
inline std::size_t trianglesDrawn(const Scene& scene)
{
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        if (const Mesh* mesh = meshPlacedBy(scene, instance))
            count += mesh->triangleCount();
    return count;
}

// Refuses a scene that no renderer here can draw in reasonable time, before memory is allocated.
inline Status checkTrianglesDrawn(const Scene& scene)
{
    const std::size_t count = trianglesDrawn(scene);
    if (count <= kMaxTrianglesDrawn)
        return Done{};
    return inputError((scene.name.empty() ? "scene" : scene.name) + ": " + std::to_string(scene.instances.size())
                      + " instances draw " + std::to_string(count) + " triangles: expected at most "
                      + std::to_string(kMaxTrianglesDrawn));
}

} // namespace cotan
