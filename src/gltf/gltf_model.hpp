// What the parts of the glTF reader share: the structure, the bytes, the limits, and what has been taken of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/files.hpp"
#include "cotan/gltf.hpp"
#include "elements.hpp"
#include "gltf_file.hpp"
#include "problem.hpp"

namespace cotan::gltf {

// Lights and cameras stand at the origin and look along -z, until a node places them.
struct Structure {
    std::vector<std::vector<int>> scenes; // the nodes that each lists
    int defaultScene = -1;
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Skin> skins;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
};

// root: has passed checkGltfShape. Throws GltfProblem where a camera or a spot light is not described.
Structure readStructure(const Json& root);

// A material without the frame of its maps. texture(owner, slot): the one that a member of the material, or of an
// object in it, asks for; it is called for layers that are there alone.
using TextureOf = std::function<cotan::Texture(const Json& owner, const char* slot)>;
Material readMaterial(const Json& source, const TextureOf& texture);

// Calls read(object) for each of a collection of the root, or of an extension of it.
template<class Read> auto readAll(const Json* owner, const char* collection, const Read& read)
{
    std::vector<decltype(read(std::declval<const Json&>()))> all;
    if (const Json* const list = owner ? member(*owner, collection) : nullptr) {
        all.reserve(list->size());
        for (const Json& item : *list)
            all.push_back(read(item));
    }
    return all;
}

} // namespace cotan::gltf

namespace cotan {

struct GltfModel {
    GltfFile file;
    LoadLimits limits;
    GltfWarnings warnings;
    gltf::Structure structure;
    std::vector<gltf::ViewBytes> views;    // the buffer views
    std::vector<gltf::Elements> accessors; // all have been checked
    std::size_t verticesTaken = 0;         // against limits.vertices
    std::size_t trianglesTaken = 0;        // against limits.triangles
    std::size_t bytesTaken = 0;            // by arrays of vertices and triangles, against gltfAllowance
};

// Reads what `file`, just opened, holds, within `limits`: checks the JSON, loads the buffers, decodes compressed
// geometry, fills the structure, the views and the accessors, moves the nodes (poseGltf).
void readGltfModel(GltfModel& model);

// The bytes that the geometry of this file may take: a part that every file has, and so many times
// its own size that only what is not in the file, or is read again and again, can go beyond it.
// (Sixteen: a strip of bytes that becomes triangles with flat normals grows by the most. Four of what was
// compressed, which has its own limit: bytes become floats.)
inline std::size_t gltfAllowance(const GltfModel& model)
{
    return model.limits.geometryBytes + 16 * model.file.size + 4 * model.file.unpacked;
}

// The place in names of what is wanted, by its name, of several the first, or by its number. what: for the message, in
// the plural. Throws GltfProblem with ErrorKind::usage, which lists the names, where there is no such thing.
std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const char* what);

// Counts bytes before they are allocated. field: for the message where they are too many.
void takeGltfBytes(GltfModel& model, std::size_t bytes, const std::string& field);

// The elements of an accessor. field: for messages, what the accessor is used as. An element type or
// component type that cannot be used so is refused, and so is an array that goes over the allowance.
template<class Vector>
std::vector<Vector> readGltfVectors(GltfModel& model, int accessor, const gltf::Choice& choice,
                                    const std::string& field)
{
    takeGltfBytes(model, choice.size() * sizeof(Vector), field);
    return gltf::readVectors<Vector>(model.accessors[std::size_t(accessor)], choice, {accessor, field});
}

// VEC3 (w = 1) or VEC4.
std::vector<glm::vec4> readGltfColors(GltfModel& model, int accessor, const gltf::Choice& choice,
                                      const std::string& field);
std::vector<glm::uvec4> readGltfJoints(GltfModel& model, int accessor, const gltf::Choice& choice,
                                       const std::string& field);
// The first `count` float matrices; there may be more.
std::vector<glm::mat4> readGltfMatrices(GltfModel& model, int accessor, std::size_t count, const std::string& field);
// Vertex indices, each below vertexCount and none the primitive restart value.
std::vector<std::uint32_t> readGltfIndices(GltfModel& model, int accessor, std::size_t vertexCount,
                                           const std::string& field);

// ---- the node hierarchy, and what hangs on it besides meshes --------------------------------

struct GltfNodes {
    std::vector<glm::dmat4> world; // of every node, in the order of the file
    std::vector<int> visible;      // nodes of the scene that is shown, parents first
};

// Resolves the hierarchy. Cycles, nodes with two parents and transforms that are not affine or
// not finite are refused. The scene shown is the default one, else the first, else all roots.
GltfNodes readGltfNodes(GltfModel& model);

// Where the node's mesh stands: one matrix, or one for each instance of EXT_mesh_gpu_instancing.
std::vector<glm::mat4> gltfPlacements(GltfModel& model, const GltfNodes& nodes, int node);

// Lights and cameras of the visible nodes.
void addGltfLightsAndCameras(const GltfModel& model, const GltfNodes& nodes, Scene& scene);

// ---- animations -----------------------------------------------------------------------------

// Sets translation, rotation, scale and weights of the nodes that limits.pose moves; everything that is read from the
// structure afterwards follows. Nothing where no animation is asked for. The accessors must have been found. Times
// before the first and behind the last key of a channel give that key.
// Throws GltfProblem: ErrorKind::usage where the model has no such animation; damaged channels. Source: glTF 2.0,
// section 3.11 and appendix C.
void poseGltf(GltfModel& model);

// The animations of the file and how long they are. Never fails: what is damaged in one is said where it is asked for.
std::vector<GltfAnimation> gltfAnimations(GltfModel& model);

// As AnimatedGltf::reach, each time anew.
Result<std::vector<glm::vec3>> pointsReached(AnimatedGltf& model, const std::string& animation);

} // namespace cotan
