// Shared state of the glTF reader: structure, bytes, limits, and how much of the limits is used.
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

// Lights and cameras are at the origin and look along -z until a node places them.
struct Structure {
    std::vector<std::vector<int>> scenes; // the nodes of each scene
    int defaultScene = -1;
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Skin> skins;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<TextureUse> normalMaps; // one per material
    std::vector<Texture> textures;
    std::vector<Image> images; // their URIs point into the JSON
    std::vector<Sampler> samplers;
};

// root: has passed checkGltfShape. Throws GltfProblem if a camera or a spot light lacks the object of its type.
Structure readStructure(const Json& root);

// Reads a material except the frame of its maps. texture(owner, slot): returns the texture of a slot of the material or
// of an object in it; called only for layers that are present.
using TextureOf = std::function<cotan::Texture(const Json& owner, const char* slot)>;
Material readMaterial(const Json& source, const TextureOf& texture);

// Calls read(object) for each item of a collection of the root or of an extension.
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
    std::vector<gltf::ViewBytes> views;    // one per buffer view
    std::vector<gltf::Elements> accessors; // all checked
    std::size_t verticesTaken = 0;         // counted against limits.vertices
    std::size_t trianglesTaken = 0;        // counted against limits.triangles
    std::uint64_t bytesTaken = 0;          // size of vertex and triangle arrays, counted against gltfAllowance
};

// Opens and reads a file: checks the JSON, loads the buffers, decodes compressed geometry, fills structure, views and
// accessors, and poses the nodes (poseGltf).
void readGltfModel(GltfModel& model, const std::filesystem::path& path, const LoadLimits& limits);

// The part of readGltfModel that needs no file: fills structure and accessors from file.json and views.
void interpretGltfModel(GltfModel& model);

// Adds to the primitives the materials that variants put in place of their own (KHR_materials_variants). Of materials
// whose normal maps are read alike only the first counts, and those without normal maps do not. Throws GltfProblem:
// ErrorKind::input for damaged mappings.
void addVariantMaterials(GltfModel& model);

// Makes the scene of a model. path: the file, for the name. images: replace those that would be decoded; null: images
// are decoded. Throws GltfProblem: all that loadGltf reports about geometry, nodes, materials and images.
Scene buildGltfScene(GltfModel& model, const std::filesystem::path& path, const std::vector<Image>* images = nullptr);

// The maximum number of bytes that the geometry of this file may take: a constant plus a multiple of the file size,
// which only accessors without data and accessors that are read repeatedly can exceed. The factor 16 covers the largest
// growth, a strip of byte indices that becomes triangles with flat normals. Decompressed bytes, which have a limit of
// their own, grow by at most 4: bytes become floats.
inline std::uint64_t gltfAllowance(const GltfModel& model)
{
    return model.limits.geometryBytes + 16 * std::uint64_t(model.file.size) + 4 * model.file.unpacked;
}

// The index in `names` of `wanted`, which is a name (the first that matches) or a number. what: the plural for
// messages. Throws GltfProblem with ErrorKind::usage and the list of names if there is no match.
std::size_t findNamed(const std::vector<std::string>& names, const std::string& wanted, const char* what);

// Counts bytes before they are allocated. field: names the data in the message if they exceed the allowance.
void takeGltfBytes(GltfModel& model, std::uint64_t bytes, const std::string& field);

// Returns the elements of an accessor. field: the accessor's use, for messages. Throws GltfProblem for element or
// component types that do not fit, and for arrays that exceed the allowance.
template<class Vector>
std::vector<Vector> readGltfVectors(GltfModel& model, int accessor, const gltf::Choice& choice,
                                    const std::string& field)
{
    takeGltfBytes(model, std::uint64_t(choice.size()) * sizeof(Vector), field);
    return gltf::readVectors<Vector>(model.accessors[std::size_t(accessor)], choice, {accessor, field});
}

// ---- the node hierarchy, lights and cameras -------------------------------------------------

struct GltfNodes {
    std::vector<glm::dmat4> world; // of every node, in file order
    std::vector<int> visible;      // nodes of the displayed scene, parents first
};

// Resolves the hierarchy. Throws GltfProblem for cycles, nodes with two parents and transforms that are not affine or
// not finite. The displayed scene is the default scene, else the first, else all roots.
GltfNodes readGltfNodes(GltfModel& model);

// World matrices of the node's mesh: one, or one per instance of EXT_mesh_gpu_instancing.
std::vector<glm::mat4> gltfPlacements(GltfModel& model, const GltfNodes& nodes, int node);

// Adds the lights and cameras of the visible nodes to the scene.
void addGltfLightsAndCameras(const GltfModel& model, const GltfNodes& nodes, Scene& scene);

// ---- primitives to meshes --------------------------------------------------------------------

// A primitive as stored in the file, triangulated, with the vertices that its triangles use in file order. Arrays are
// empty or have one entry per vertex.
struct GltfPrimitive {
    std::string field; // meshes[i].primitives[j]
    // Named like the mesh of the file, plus the primitive's number if there are several. mesh.material is an index in
    // the file; -1: the default material.
    Mesh mesh;
    std::vector<std::vector<glm::uvec4>> joints; // one entry per set JOINTS_n with WEIGHTS_n
    std::vector<std::vector<glm::vec4>> weights;
};

// Reads and checks one primitive and applies its morph targets. morphWeights: as in the file; missing weights are zero.
// Returns nothing, with a warning, for points and lines.
std::optional<GltfPrimitive> readGltfPrimitive(GltfModel& model, int mesh, std::size_t primitive,
                                               const std::vector<double>& morphWeights);

// Returns three corners per triangle. order: the indices of a list, strip or fan (see gltf::Primitive::mode); other
// modes have no triangles. Triangles of strips and fans that repeat a vertex only connect others and are left out.
std::vector<std::uint32_t> gltfTriangles(int mode, std::vector<std::uint32_t> order);

// Returns the vertices that the corners refer to, ascending and unique, and renumbers the corners to indices into that
// list. Many primitives may share one accessor and use a part of it each, so neither time nor memory grows with
// `count`, the number of vertices. Every corner must be below `count`.
std::vector<std::uint32_t> takeUsedVertices(std::vector<std::uint32_t>& corners, std::size_t count);

// Applies a skin to the vertices. joints: for each joint, its world matrix times its inverse bind matrix. Normals are
// transformed by the inverse transpose, tangents like directions in the surface. TANGENT.w changes sign where the
// joints mirror; if they mirror all vertices, the winding is reversed too.
void skinGltfPrimitive(GltfPrimitive& primitive, const std::vector<glm::dmat4>& joints, GltfWarnings& warnings);

// The unit vector of a normal; zero if its length is zero. A normal that is unit up to rounding keeps its bits:
// normalising it again could make different normals equal, and weld their vertices.
glm::vec3 unitNormal(const glm::vec3& normal);

// Gives each corner of the triangles a vertex of its own, with positions, uv, colours and the normal of its triangle,
// as glTF requires of primitives without normals. The normal is zero if the triangle has no area.
void makeFlat(Mesh& mesh);

// Makes the mesh: unit normals (flat ones if the file has none) and tangents with w = +-1. Warns about unusual values.
// normalMapSet: the uv set of the material's normal map, or -1.
Mesh finishGltfMesh(GltfPrimitive&& primitive, int normalMapSet, GltfWarnings& warnings);

// ---- materials and the images they use --------------------------------------------------------

// The frame of this name (kFrameExtra); none if the name is empty or unknown, which is a warning. field: its owner.
std::optional<Frame> gltfFrame(const std::string& text, const std::string& field, GltfWarnings& warnings);

// Creates the scene's materials when meshes first use them, and collects the images that they need.
class GltfMaterials {
public:
    GltfMaterials(GltfModel& model, Scene& scene)
        : model_(model), scene_(scene), materials_(gltf::member(model.file.json, "materials"))
    {
    }

    // Returns the index in Scene::materials of a material of the file (-1: the default material) for this mesh.
    // Textures whose uv set the mesh lacks are left out, with a warning.
    int use(int material, const Mesh& mesh);

    // Decodes all images that `use` met, in parallel. Throws GltfProblem for the unreadable image with the lowest
    // number in the file.
    void decodeImages();

    // Checks the images that decodeImages leaves out. Throws GltfProblem for the first that is outside the model's
    // folder or a PNG without a complete header; if `use` has not met it and the scene has instances, it gets a
    // warning.
    void checkOtherImages() const;

private:
    Texture texture(const gltf::TextureUse& use, const Mesh& mesh, const std::string& field);
    Material make(int material, const Mesh& mesh);
    int firstEqual(int image);
    std::vector<std::pair<int, int>> imagesToDecode() const; // as in slots_
    std::uint64_t bytesOfFiles() const;

    GltfModel& model_;
    Scene& scene_;
    const gltf::Json* materials_;
    std::map<std::pair<int, int>, int> made_; // (material, mask of uv sets) to scene material
    std::map<int, int> slots_;                // image of the file to Scene::images
    // Images in views: by the address and size of their bytes, and by size and content.
    std::map<std::pair<const char*, std::size_t>, int> imagesAt_;
    std::map<std::pair<std::size_t, std::string_view>, int> imagesLike_;
};

// ---- animations -----------------------------------------------------------------------------

// Sets translation, rotation, scale and weights of the nodes that limits.pose animates; scenes built afterwards use
// them. Does nothing if no animation is requested. Requires GltfModel::accessors. Times before the first or after the
// last key of a channel give that key. Throws GltfProblem: ErrorKind::usage if there is no such animation;
// ErrorKind::input for damaged channels. Source: glTF 2.0, section 3.11 and appendix C.
void poseGltf(GltfModel& model);

// The animations of the file and their durations. Never fails: errors in an animation are reported when it is
// requested.
std::vector<GltfAnimation> gltfAnimations(GltfModel& model);

// Like AnimatedGltf::reach, without its cache.
Result<std::vector<glm::vec3>> pointsReached(AnimatedGltf& model, const std::string& animation);

} // namespace cotan
