// Small questions about Scene and Mesh: vertices, cameras, where things stand, what is drawn.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/vector.hpp"
#include "cotan/view.hpp"

namespace cotan {

// ---- vertices --------------------------------------------------------------------------------

// The arrays of a mesh, const or not, with an entry a vertex or none at all.
template<class M> auto attributesOf(M& mesh)
{
    return std::tie(mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords[0], mesh.texcoords[1], mesh.colors,
                    mesh.cotangentsU, mesh.cotangentsV);
}

// Replaces the mesh's normals by angle-weighted averages over corners that share a position, separated where faces meet
// at more than `creaseDegrees` (180: everything is smoothed). Vertices are split where needed, all attributes with
// them. Degenerate triangles add nothing; a vertex with no usable triangle gets (0,0,1).
void generateNormals(Mesh& mesh, float creaseDegrees = 180);

// Merges vertices whose attributes are equal bit for bit; drops those that no triangle uses.
// The triangles keep their order, the vertices the order of their first use.
void weldVertices(Mesh& mesh);

// ---- cameras ---------------------------------------------------------------------------------

// right, up and forward: unit and perpendicular to one another, right = cross(forward, up).
struct CameraAxes {
    glm::dvec3 eye{0};
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
};

// forward: unit. `up` is as near to the given one as it can be; where that is zero, not finite, or along forward, y
// takes its place, and -z where forward is nearly vertical. The eye is the origin.
CameraAxes axesAlong(const glm::dvec3& forward, const glm::dvec3& up);

// A camera whose eye is not finite stands at the origin; one that looks nowhere (eye = target) looks along -z.
CameraAxes cameraAxes(const Camera& camera);

// A camera that shows the whole box from the front, a little from the right and above.
// An empty box gives the default camera.
Camera fitCamera(const Bounds& box, int width, int height);

// The camera carried about the vertical (y) through its target by `angle` radians, counterclockwise as seen
// from above. It keeps its height and its distance, up to rounding.
Camera turnedAbout(Camera camera, double angle);

// ---- where it stands -------------------------------------------------------------------------

// Instances times vertices up to which the box is the smallest one: a tenth of a second.
inline constexpr std::size_t kMaxPlacedVertices = std::size_t(1) << 24;

// The mesh that an instance places; null where it has none.
inline const Mesh* meshPlacedBy(const Scene& scene, const Instance& instance)
{
    const bool known = instance.mesh >= 0 && std::size_t(instance.mesh) < scene.meshes.size();
    return known ? &scene.meshes[std::size_t(instance.mesh)] : nullptr;
}

// A box that holds nothing, and every float is outside of it on both sides.
inline Bounds emptyBounds()
{
    return {glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
}

// Makes the box hold the point as the matrix moves it, unless that is not finite.
inline void extend(Bounds& box, const glm::mat4& toWorld, const glm::vec3& p)
{
    const glm::vec3 world(toWorld * glm::vec4(p, 1));
    if (!isFinite(world))
        return;
    box.low = glm::min(box.low, world);
    box.high = glm::max(box.high, world);
}

// The box around the finite vertices of a mesh, in its own space.
inline Bounds bounds(const Mesh& mesh)
{
    Bounds box = emptyBounds();
    for (const glm::vec3& p : mesh.positions)
        extend(box, glm::mat4(1), p);
    return box;
}

// Calls work(toWorld, point) for the points in whose box a scene lies: every vertex of every instance up to
// kMaxPlacedVertices; beyond, the corners of each instance's mesh's box.
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
        if (placed <= kMaxPlacedVertices) {
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

// The box around all instances in world space; positions that are not finite count for nothing. Beyond
// kMaxPlacedVertices, a matrix that turns makes it larger than the smallest one: by sqrt(3) along an axis at most.
inline Bounds bounds(const Scene& scene)
{
    Bounds box = emptyBounds();
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& p) { extend(box, toWorld, p); });
    return box;
}

// The same for the points that a camera frames: those of Scene::reach where it has some.
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

// The light that casts the shadow, where the view asks for one: the first directional one. Null where there is none.
inline const Light* shadowLight(const View& view)
{
    const auto found = std::ranges::find(view.lights, LightKind::directional, &Light::kind);
    return found == view.lights.end() ? nullptr : &*found;
}

// Whether anything that is drawn reads a normal map: some instance of a mesh with triangles and the uv set that
// its material's map asks for. Else normals do not differ between frames, and a comparison of them says nothing.
bool drawsNormalMaps(const Scene& scene);

// Whether the scene can be drawn with the frame: every mesh that is drawn and has the uv of its normal map also has
// what the frame reads at its vertices. A renderer would show it without a frame otherwise. Errors: ErrorKind::usage,
// with the mesh, where deriveVertexFrames (cotan/view.hpp) was left out.
Status checkVertexAttributes(const Scene& scene, Frame frame);

// The name of an instance, or where it has none of its mesh; may be empty.
inline const std::string& objectName(const Scene& scene, const Instance& instance)
{
    return !instance.name.empty() ? instance.name : scene.meshes[std::size_t(instance.mesh)].name;
}

// Adds a linear map to the different ways in which a mesh stands, as far as frames can tell: unless it and one of them
// differ by a rotation, a mirroring and a uniform scale only, which all frames go along with.
void addPlacing(std::vector<glm::dmat3>& known, const glm::dmat3& linear);

// Gives each mesh that nothing shows the identity: it is looked at as it stands.
void placeUnshown(std::vector<std::vector<glm::dmat3>>& placings);

// Turns all of a scene whose up is z, as in the files of many programs, by 90 degrees about x, so that what was along
// +z is along +y (and +y along -z): instances, lights, cameras and reach. Meshes stay as they are.
void turnZUp(Scene& scene);

// What a picture may draw, instances multiplied: minutes on a processor, and the memory of the
// reference renderer, which takes about 150 bytes a triangle.
inline constexpr std::size_t kMaxTrianglesDrawn = 100'000'000;

// Triangles of all instances together.
inline std::size_t trianglesDrawn(const Scene& scene)
{
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        if (const Mesh* mesh = meshPlacedBy(scene, instance))
            count += mesh->triangleCount();
    return count;
}

// Refuses a scene that no renderer here draws in reasonable time, before memory is taken.
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
