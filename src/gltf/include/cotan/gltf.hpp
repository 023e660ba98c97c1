// Reads glTF files to a scene, and changes them while leaving alone what is not meant.
//
//     auto scene = cotan::loadGltf("model.glb");
//
//     auto document = cotan::openGltfDocument("in.gltf");
//     if (!document)
//         return fail(document.error().message);
//     auto given = cotan::giveTangents(*document, {.frame = cotan::Frame::mikktspace});
//     if (!given)
//         return fail(given.error().message);
//     auto written = cotan::writeGltf(*document, "out.glb");
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/files.hpp"
#include "cotan/frame.hpp"
#include "cotan/gpu_meshes.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/tangents.hpp"

namespace cotan {

// ---- to a scene ----------------------------------------------------------------------------

// Reads .gltf and .glb. What was odd but usable is said in Scene::warnings. Missing normals are flat ones, as
// glTF asks. Only files inside the model's own folder are opened.
// Errors: ErrorKind::input with one line: file, field, expected, found. Never throws for bad input.
Result<Scene> loadGltf(const std::filesystem::path& file, const LoadLimits& limits = {});

// ---- to be changed -------------------------------------------------------------------------

// Changing a glTF file and leaving alone what is not meant: names, extras, extensions that we do not
// know, attributes of any type, images, animations.
//
// Indices of materials, textures, images, meshes and nodes are the file's, and stay as they are while the
// document is open. Only writing removes what has fallen out of use, and works on a copy.

struct GltfSource; // the file as it was read; never changes

struct GltfJson; // what it says, as changed since

// The JSON of a document, which only Cotan's own parts look into: no JSON library is needed to use these functions. A
// copy is a whole one. What was moved from may be assigned to and destroyed.
struct GltfRoot {
    GltfRoot();
    GltfRoot(const GltfRoot& other);
    GltfRoot(GltfRoot&& other) noexcept;
    GltfRoot& operator=(const GltfRoot& other);
    GltfRoot& operator=(GltfRoot&& other) noexcept;
    ~GltfRoot();

    std::unique_ptr<GltfJson> json;
};

struct GltfDocument {
    GltfRoot root;
    // Of the buffer views that are new: those after the ones in `source`.
    std::vector<std::vector<std::byte>> added;
    std::vector<std::string> notes; // what the user should know about the changes; one line each
    std::shared_ptr<const GltfSource> source;
};

// Reads a .gltf or .glb with its buffers, with the checks and limits of loadGltf except that images
// are not opened. Compressed geometry is decoded, and is plain in the document; writing puts the file's own streams in
// the place of what nobody changed. Errors: those of loadGltf.
Result<GltfDocument> openGltfDocument(const std::filesystem::path& file, const LoadLimits& limits = {});

// The file that a document was read from, for messages; empty for one that was made from a scene.
const std::filesystem::path& gltfPath(const GltfDocument& document);

// A scene as a new document: one mesh with one primitive for each of its meshes, materials of metallic-roughness,
// images as PNG inside. Lights, cameras and derived cotangents are left out. Meshes without vertices are not for glTF:
// the caller keeps to scenes that were loaded or made with triangles. Errors: ErrorKind::output where there is no
// memory for a PNG; images of floats cannot be stored (ErrorKind::input).
Result<GltfDocument> gltfDocumentOf(const Scene& scene);

// ---- geometry -------------------------------------------------------------------------------

// One primitive as a triangle list. Attributes are as the file has them, dequantised but not
// normalised; arrays are empty or have one entry a vertex. Vertices that no triangle uses are left
// out. Morph targets and skins are not applied.
struct GltfGeometry {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texcoords;   // as the normal map reads them: its uv set, transformed
    std::vector<std::uint32_t> indices; // three a triangle; strips and fans are unrolled
    int texcoordSet = 0;                // which uv set that is
};

// Where a material has normal maps: its own and that of its clear coat (KHR_materials_clearcoat).
enum class NormalSlot { surface, coat };
inline constexpr NormalSlot kNormalSlots[] = {NormalSlot::surface, NormalSlot::coat};

// mesh, primitive: indices into the file's. slot: the map whose uv are read; uv set 0 where there is none. material: in
// the place of the primitive's own. Points and lines, and primitives without POSITION, give an empty geometry. Errors
// (ErrorKind::input): indices out of range.
Result<GltfGeometry> gltfGeometry(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                                  NormalSlot slot = NormalSlot::surface,
                                  std::optional<std::size_t> material = std::nullopt);

// ---- tangents -------------------------------------------------------------------------------

// Tangents for one primitive, one per corner, in the order of GltfGeometry::indices.
struct GltfCornerTangents {
    std::size_t mesh = 0;
    std::size_t primitive = 0;
    std::vector<glm::vec4> corners;
};

// Gives primitives TANGENT, in place of what they had. A vertex is copied, with all its attributes and morph targets,
// only where corners that share it differ; primitives that share their attributes go on sharing them if all of them are
// given in one call. Strips and fans become lists. Returns how many vertices were added.
// Errors (ErrorKind::input): no NORMAL; ErrorKind::usage: corners of the wrong
// number. On error the document is unchanged.
Result<std::size_t> setGltfTangents(GltfDocument& document, std::span<const GltfCornerTangents> tangents);

// Takes TANGENT from a primitive and from its morph targets. Returns whether there was one.
bool dropGltfTangents(GltfDocument& document, std::size_t mesh, std::size_t primitive);

// ---- provoking vertices ---------------------------------------------------------------------

// What became of one primitive. Vertices: before, those that its triangles used.
struct GltfProvoked {
    std::size_t mesh = 0;
    std::size_t primitive = 0;
    std::size_t triangles = 0, verticesBefore = 0, verticesAfter = 0;
};

// Numbers every primitive anew, so that its vertex k < triangles provokes its triangle k (see provokingMesh). Its
// indices then say which vertices those of triangle k are, so that a vertex shader that reads them, and the positions,
// uv and normals, makes U and V of the frame `triangle`. Vertices are copied with all attributes and morph targets, to
// the bit. Triangles stay in their order; strips, fans and primitives without indices become lists. Vertices that no
// triangle uses are left out, and primitives that shared vertices get their own. Points and lines stay as they are.
// Returns what has triangles; primitives that draw the same arrays go on sharing them, and only the first is returned.
// Errors (ErrorKind::input): no memory for the copies; the document is then not to be used.
Result<std::vector<GltfProvoked>> setGltfProvoking(GltfDocument& document, ProvokingVertex provoking);

// ---- images ---------------------------------------------------------------------------------

// The encoded bytes of an image, wherever they are. Errors: ErrorKind::input.
Result<std::vector<std::byte>> gltfImageBytes(const GltfDocument& document, std::size_t image,
                                              const LoadLimits& limits = {});

// New content for an image: all textures that use it follow. mimeType: "image/png" or "image/jpeg". Whatever the image
// was before, the bytes go into the .glb, or into a file beside the .gltf; its name and extras are kept.
void replaceGltfImage(GltfDocument& document, std::size_t image, std::vector<std::byte> bytes,
                      const std::string& mimeType);

// A new image; returns its index.
std::size_t addGltfImage(GltfDocument& document, std::vector<std::byte> bytes, const std::string& mimeType,
                         const std::string& name);

// A texture that reads `image` and is else like `texture` (sampler, name, extras); returns its
// index. Extensions that name another source (KHR_texture_basisu, EXT_texture_webp, ...) are left out.
std::size_t copyGltfTexture(GltfDocument& document, std::size_t texture, std::size_t image);

// A copy of a material; returns its index.
std::size_t copyGltfMaterial(GltfDocument& document, std::size_t material);

// ---- writing --------------------------------------------------------------------------------

struct GltfWritten {
    std::vector<std::filesystem::path> files; // the model first
    std::size_t bytesBefore = 0;              // model, buffers and image files that it used; embedded or beside
    std::size_t bytesAfter = 0;
    std::vector<std::string> notes; // the document's and those of writing
};

// Writes NAME.glb (one file: image files are embedded) or NAME.gltf with NAME.bin; then images keep
// their relative URIs and are copied if the folder is another one, and new ones become files NAME-IMAGE.png or .jpg,
// with a number where another file has that name. All buffers become one.
// Accessors, views, images and bytes that the file used and now nothing uses are removed, and all
// indices follow; where an extension that we do not know might refer to them, they are kept, and a
// note says so. Whatever fails, nothing is left behind.
// Errors: ErrorKind::usage for another extension than .glb and .gltf; ErrorKind::output where a file cannot be written
// or an image to be copied would replace a different file; ErrorKind::input where an image file cannot be read.
Result<GltfWritten> writeGltf(const GltfDocument& document, const std::filesystem::path& file,
                              const LoadLimits& limits = {});

// The same as the bytes of a .glb, nothing written: what is beside the model is put inside. limits.readFile is not
// asked; the document remembers where it came from.
Result<std::vector<std::byte>> glbBytes(GltfDocument document, const LoadLimits& limits = {});

// ---- tangents of a whole file --------------------------------------------------------------

// A primitive with what its tangents are made from.
struct GltfPrimitiveGeometry {
    std::size_t mesh = 0, primitive = 0; // indices into the file's
    std::string name;      // of the mesh; where it has several primitives with "/" and the primitive's number
    GltfGeometry geometry; // with unit normals
    std::string cannot;    // why there are no tangents to be had: "no NORMAL"; empty if there are

    MeshView view() const { return {geometry.positions, geometry.normals, geometry.texcoords, geometry.indices}; }
};

// All primitives of a file, in its order. Errors (ErrorKind::input): compressed geometry (KHR_draco_mesh_compression).
Result<std::vector<GltfPrimitiveGeometry>> gltfPrimitives(const GltfDocument& document);

struct TangentsOptions {
    Frame frame = Frame::mikktspace; // or vertex
    bool replace = false;            // giveTangents: also where there is TANGENT; else only where it is missing
    bool mappedOnly = false;         // only primitives that some material shows with a normal map
    int threads = 0;                 // 0: all cores; the result does not depend on it
    Progress progress{};             // on the thread of the caller
};

// What became of one primitive.
struct PrimitiveTangents {
    std::size_t mesh = 0, primitive = 0;
    std::string name{}; // as in GltfPrimitiveGeometry
    std::size_t triangles = 0;
    bool stored = false;                           // the file had TANGENT
    bool generated = false;                        // giveTangents: it has new ones
    std::string cannot{};                          // why there are none to be had; empty if there are
    std::optional<TangentDifference> difference{}; // compareTangents: of the stored ones, where there are any
};

struct TangentsGiven {
    std::vector<PrimitiveTangents> primitives;
    std::size_t generated = 0, kept = 0,
                skipped = 0;       // primitives: with new tangents, with their own, with none to be had
    std::size_t verticesAdded = 0; // copies, where corners that shared a vertex differ
};

// Generates tangents and puts them into the file as TANGENT (see setGltfTangents).
// Errors: ErrorKind::usage for another frame than mikktspace and vertex; ErrorKind::input for compressed geometry;
// ErrorKind::stopped. On error the document is unchanged.
Result<TangentsGiven> giveTangents(GltfDocument& document, const TangentsOptions& options);

struct TangentsCompared {
    std::vector<PrimitiveTangents> primitives;
    TangentDifference whole; // of all that could be compared
    std::size_t without = 0; // primitives that could have TANGENT and have none
};

// Says how far the stored tangents are from those of the frame. Errors: as giveTangents.
Result<TangentsCompared> compareTangents(const GltfDocument& document, const TangentsOptions& options);

// ---- a model that moves --------------------------------------------------------------------

// A glTF model that moves: read once, and then at one moment after another.

struct GltfAnimation {
    std::string name;   // empty where the file gives none
    double seconds = 0; // to the last of its keys; 0 where none can be read
};

// Keeps the bytes of the file, and gives scenes of it. One thread at a time.
class AnimatedGltf {
public:
    // limits: also of each scene; its pose is not used. Errors: as loadGltf.
    static Result<std::unique_ptr<AnimatedGltf>> open(const std::filesystem::path& file, const LoadLimits& limits);
    ~AnimatedGltf();

    // In the order of the file; empty where it has none.
    const std::vector<GltfAnimation>& animations() const;

    // As loadGltf with that pose. images: those of a scene that was made here before, which are copied; null: they are
    // decoded. Errors: as loadGltf; ErrorKind::usage where there is no such animation.
    Result<Scene> at(const Pose& pose, const std::vector<Image>* images = nullptr);

    // Points, in the world, that the animation of that name or number reaches: of moments a thirtieth of a second
    // apart, from its start to its end; at most 256 of them, and of large models as many as pose 8 million vertices,
    // but 9 at least. Up to 300,000 points they are all vertices; beyond, those of each moment that lie furthest along
    // 64 directions, so that the box around them may be too small by 2 % of the model. Kept for the next call. Errors:
    // as at().
    Result<std::vector<glm::vec3>> reach(const std::string& animation);

private:
    struct Work;
    explicit AnimatedGltf(std::unique_ptr<Work> work);
    std::unique_ptr<Work> work_;
};

} // namespace cotan
