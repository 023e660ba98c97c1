// Small questions about Scene and Mesh: vertices, cameras, names, where meshes stand, what is drawn.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "cotan/frame.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"
#include "scene/bounds.hpp"

namespace cotan {

// ---- vertices --------------------------------------------------------------------------------

// The arrays of a mesh, const or not, with an entry a vertex or none at all.
template<class M> auto attributesOf(M& mesh)
{
    return std::tie(mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords[0], mesh.texcoords[1], mesh.colors,
                    mesh.cotangentsU, mesh.cotangentsV);
}

// Replaces the mesh's normals by angle-weighted averages over corners that share a position,
// separated where faces meet at more than `creaseDegrees` (180: everything is smoothed).
// Vertices are split where needed, all attributes with them. Degenerate triangles add nothing; a
// vertex with no usable triangle gets (0,0,1).
void generateNormals(Mesh& mesh, float creaseDegrees = 180);

// Merges vertices whose attributes are equal bit for bit; drops those that no triangle uses.
// The triangles keep their order, the vertices the order of their first use.
void weldVertices(Mesh& mesh);

// Numbers from 0 on in groups that grow by joining (union-find). A group is known by its lowest number.
class JoinedGroups {
public:
    explicit JoinedGroups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t number)
    {
        while (parent_[number] != number)
            number = parent_[number] = parent_[parent_[number]];
        return number;
    }
    void join(std::uint32_t a, std::uint32_t b)
    {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

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

// ---- what is drawn, and where it stands ------------------------------------------------------

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

} // namespace cotan
