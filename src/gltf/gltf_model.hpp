// What the parts of the glTF reader share: the structure, the bytes, the limits, and what has been taken of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
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
    std::vector<TextureUse> normalMaps; // of every material
    std::vector<Texture> textures;
    std::vector<Image> images; // their URIs point into the JSON
    std::vector<Sampler> samplers;
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
    if (const Json* const list = member(owner, collection)) {
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
    std::uint64_t bytesTaken = 0;          // by arrays of vertices and triangles, against gltfAllowance
};

// Opens a file and reads what it holds: checks the JSON, loads the buffers, decodes compressed geometry, fills the
// structure, the views and the accessors, moves the nodes (poseGltf).
void readGltfModel(GltfModel& model, const std::filesystem::path& path, const LoadLimits& limits);

// The bytes that the geometry of this file may take: a part that every file has, and so many times
// its own size that only what is not in the file, or is read again and again, can go beyond it.
// (Sixteen: a strip of bytes that becomes triangles with flat normals grows by the most. Four of what was
// compressed, which has its own limit: bytes become floats.)
inline std::uint64_t gltfAllowance(const GltfModel& model)
{
    return model.limits.geometryBytes + 16 * std::uint64_t(model.file.size) + 4 * model.file.unpacked;
}

// The place in names of what is wanted, by its name, of several the first, or by its number. what: for the message, in
// the plural. Throws GltfProblem with ErrorKind::usage, which lists the names, where there is no such thing.
std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const char* what);

// Counts bytes before they are allocated. field: for the message where they are too many.
void takeGltfBytes(GltfModel& model, std::uint64_t bytes, const std::string& field);

// The elements of an accessor. field: for messages, what the accessor is used as. An element type or
// component type that cannot be used so is refused, and so is an array that goes over the allowance.
template<class Vector>
std::vector<Vector> readGltfVectors(GltfModel& model, int accessor, const gltf::Choice& choice,
                                    const std::string& field)
{
    takeGltfBytes(model, std::uint64_t(choice.size()) * sizeof(Vector), field);
    return gltf::readVectors<Vector>(model.accessors[std::size_t(accessor)], choice, {accessor, field});
}

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

// ---- primitives to meshes --------------------------------------------------------------------

// A primitive as it stands in the file, triangulated, with the vertices that its triangles use, in
// the order of the file. Arrays are empty or have one entry a vertex.
struct GltfPrimitive {
    std::string field; // meshes[i].primitives[j]
    // Named like the mesh of the file, with the primitive's number where there are several. Its material is an index
    // into the file's; -1: the default material.
    Mesh mesh;
    std::vector<std::vector<glm::uvec4>> joints; // one for each set JOINTS_n with WEIGHTS_n
    std::vector<std::vector<glm::vec4>> weights;
};

// Reads and checks one primitive and applies its morph targets. morphWeights: as in the file,
// empty: all zero. Nothing for points and lines (said in a warning).
std::optional<GltfPrimitive> readGltfPrimitive(GltfModel& model, int mesh, std::size_t primitive,
                                               const std::vector<double>& morphWeights);

// Three corners a triangle. order: those of a list, strip or fan (see gltf::Primitive::mode); other modes have no
// triangles. Strips and fans jump by triangles without area: those that join two equal vertices are left out.
std::vector<std::uint32_t> gltfTriangles(int mode, std::vector<std::uint32_t> order);

// The vertices that the corners name, rising, each once; the corners are renumbered to places in
// that list. Many primitives may share one accessor, each with a part of it, so neither time nor
// memory grows with `count`, the number of vertices that there are. Every corner must be below it.
std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count);

// Moves the vertices to where the joints put them. joints: for each joint of the skin, its world matrix times its
// inverse bind matrix. Normals go by the inverse transpose, tangents with the surface; where the joints mirror,
// TANGENT.w changes sign, and where they mirror everything, so does the winding.
void skinGltfPrimitive(GltfPrimitive& primitive, const std::vector<glm::dmat4>& joints, GltfWarnings& warnings);

// The unit vector of a normal. One that is unit up to rounding keeps its bits: normalising again would make some equal
// that differ, and weld their vertices. Zero where it has no length.
glm::vec3 unitNormal(const glm::vec3& normal);

// Gives each corner of the triangles a vertex of its own: positions, uv and colors; the indices then count up.
void separateCorners(Mesh& mesh);

// Makes the mesh: unit normals (flat ones where the file has none), tangents with w = +-1. What is
// odd about them is said. normalMapSet: the uv set that the material's normal map uses, or -1.
Mesh finishGltfMesh(GltfPrimitive&& primitive, int normalMapSet, GltfWarnings& warnings);

// ---- materials and the images they use --------------------------------------------------------

// Makes the scene's materials as meshes ask for them, so that only what is drawn is kept, and
// collects which images that needs.
class GltfMaterials {
public:
    GltfMaterials(GltfModel& model, Scene& scene)
        : model_(model), scene_(scene), materials_(gltf::member(model.file.json, "materials"))
    {
    }

    // The index in Scene::materials of the file's material (-1: the default material) as this
    // mesh can use it: textures whose uv set the mesh lacks are left out and said.
    int use(int material, const Mesh& mesh);

    // Decodes all images that `use` met, in parallel. Throws GltfProblem for the first that cannot
    // be read, by its number in the file.
    void decodeImages();

    // Looks at the images that `use` has not met, without decoding them: those that are not inside
    // the model's folder, or are a PNG without its header, are named in a warning. Where nothing is
    // drawn, throws GltfProblem for the first.
    void checkUnusedImages() const;

private:
    Texture texture(const gltf::TextureUse& use, const Mesh& mesh, const std::string& field);
    Material make(int material, const Mesh& mesh);
    int firstEqual(int image);
    std::uint64_t bytesOfFiles() const;

    GltfModel& model_;
    Scene& scene_;
    const gltf::Json* materials_;
    std::map<std::pair<int, int>, int> made_; // (material, which uv sets) to scene material
    std::map<int, int> slots_;                // image of the file to Scene::images
    // Images in views: by where their bytes are, and by size and bytes.
    std::map<std::pair<const char*, std::size_t>, int> imagesAt_;
    std::map<std::pair<std::size_t, std::string_view>, int> imagesLike_;
};

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
