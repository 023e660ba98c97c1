// Reads glTF files to a scene, and edits glTF files while keeping all content that an edit does not concern.
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

// Reads .gltf and .glb. Unusual but usable content is reported in Scene::warnings. Missing normals become flat normals,
// as glTF requires. Only files inside the model's own folder are opened.
// Errors: ErrorKind::input with one line: file, field, expected, found. Never throws for bad input.
Result<Scene> loadGltf(const std::filesystem::path& file, const LoadLimits& limits = {});

// ---- editing -------------------------------------------------------------------------------

// Edits to a glTF file keep everything else in it: names, extras, unknown extensions, attributes of any type, images,
// animations.
//
// Indices of materials, textures, images, meshes and nodes are those of the file, and stay valid while the document is
// open. Only writing removes unused items, and does so on a copy.

struct GltfSource; // the file as read; immutable

struct GltfJson; // the JSON of a document, with its edits

// The JSON of a document, opaque to users: these functions need no JSON library. Copies are deep. A moved-from object
// may only be assigned to or destroyed.
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
    // Bytes of the new buffer views, which follow those of `source`. Copies of the document share them.
    std::vector<std::shared_ptr<const std::vector<std::byte>>> added;
    std::vector<std::string> notes; // what the user should know about the edits; one line each
    std::shared_ptr<const GltfSource> source;
};

// Reads a .gltf or .glb with its buffers, with the checks and limits of loadGltf except that images are not opened.
// Compressed geometry is decoded, and is uncompressed in the document; writing restores the file's own streams for
// geometry that was not changed. Errors: those of loadGltf.
Result<GltfDocument> openGltfDocument(const std::filesystem::path& file, const LoadLimits& limits = {});

// An open file: what it shows, and the document to edit.
struct OpenGltf {
    GltfDocument document;
    Scene scene; // of the file, as loadGltf returns it
};

// Reads and checks a file once for both. Errors: those of loadGltf and openGltfDocument.
Result<OpenGltf> openGltf(const std::filesystem::path& file, const LoadLimits& limits = {});

// The scene of a document with its edits. Nothing is read again but image files beside the model. limits.readFile is
// ignored: the document keeps the readFile that it was opened with. Errors: those of loadGltf.
Result<Scene> gltfScene(const GltfDocument& document, const LoadLimits& limits = {});

// The file that a document was read from, for messages; empty for a document made by gltfDocumentOf.
const std::filesystem::path& gltfPath(const GltfDocument& document);

// Converts a scene to a new document: one mesh with one primitive for each mesh, metallic-roughness materials, embedded
// PNG images. Lights, cameras and derived cotangents are left out. glTF does not allow meshes without vertices, so the
// scene must be a loaded one or have triangles in every mesh. Errors: ErrorKind::input for float images, which glTF
// cannot store; ErrorKind::output if there is no memory for a PNG.
Result<GltfDocument> gltfDocumentOf(const Scene& scene);

// ---- geometry -------------------------------------------------------------------------------

// One primitive as a triangle list. Attributes are dequantised but not normalised; arrays are empty or have one entry
// per vertex. Vertices that no triangle uses are left out. Morph targets and skins are not applied.
struct GltfGeometry {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> texcoords;   // of the uv set that the normal map reads
    std::vector<std::uint32_t> indices; // three a triangle; strips and fans are unrolled
    int texcoordSet = 0;                // the uv set that texcoords are from
};

// The normal maps of a material: its own and that of its clear coat (KHR_materials_clearcoat).
enum class NormalSlot { surface, coat };
inline constexpr NormalSlot kNormalSlots[] = {NormalSlot::surface, NormalSlot::coat};

// TEXCOORD and TANGENT as they are in the file, or as the normal map reads them: both with its transform
// (KHR_texture_transform). TANGENT of a file belongs to its TEXCOORD without transforms, as exporters write it.
enum class TexcoordSpace { file, map };

// Returns the geometry of a primitive. mesh, primitive: indices in the file, in range. slot: the normal map whose uv
// are read; uv set 0 if there is none. material: replaces the primitive's own. Points and lines, and primitives without
// POSITION, give an empty geometry. Errors (ErrorKind::input): an attribute of the wrong type.
Result<GltfGeometry> gltfGeometry(const GltfDocument& document, std::size_t mesh, std::size_t primitive,
                                  NormalSlot slot = NormalSlot::surface,
                                  std::optional<std::size_t> material = std::nullopt,
                                  TexcoordSpace space = TexcoordSpace::map);

// ---- tangents -------------------------------------------------------------------------------

// Tangents for one primitive, one per corner, in the order of GltfGeometry::indices. xyz is unit, or zero where a
// generator finds no direction: glTF requires unit length, so (1, 0, 0) is written there.
struct GltfCornerTangents {
    std::size_t mesh = 0;
    std::size_t primitive = 0;
    std::vector<glm::vec4> corners;
};

// Sets TANGENT of primitives, replacing any they had. A vertex is copied, with all its attributes and morph targets,
// only if corners that share it differ; primitives that share their attributes still share them if all of them are
// given in one call. Strips and fans become lists. Returns the number of added vertices.
// Errors: ErrorKind::input if NORMAL is missing; ErrorKind::usage for a wrong number of corners; both leave the
// document unchanged. ErrorKind::input without memory for the copies; the document must not be used afterwards.
Result<std::size_t> setGltfTangents(GltfDocument& document, std::span<const GltfCornerTangents> tangents);

// Removes TANGENT from a primitive and from its morph targets. Returns whether the primitive had it.
bool dropGltfTangents(GltfDocument& document, std::size_t mesh, std::size_t primitive);

// ---- provoking vertices ---------------------------------------------------------------------

// Result for one primitive. verticesBefore: the vertices that its triangles used.
struct GltfProvoked {
    std::size_t mesh = 0;
    std::size_t primitive = 0;
    std::size_t triangles = 0, verticesBefore = 0, verticesAfter = 0;
};

// Renumbers the vertices of every primitive so that vertex k < triangles provokes triangle k (see provokingMesh). The
// index buffer then lists the vertices of triangle k, so that a vertex shader that reads it, and the positions, uv and
// normals, can compute U and V of the frame `triangle`. Vertices are copied bit for bit with all attributes and morph
// targets. Triangles keep their order; strips, fans and primitives without indices become lists. Unused vertices are
// left out, and primitives that shared vertices get their own. Points and lines are unchanged. Returns the primitives
// with triangles; of primitives that draw the same arrays, which still share them, only the first is returned. Errors
// (ErrorKind::input): no memory for the copies; the document must not be used afterwards.
Result<std::vector<GltfProvoked>> setGltfProvoking(GltfDocument& document, ProvokingVertex provoking);

// ---- images ---------------------------------------------------------------------------------

// The encoded bytes of an image, from a buffer view, a data URI or a file. Errors: ErrorKind::input.
Result<std::vector<std::byte>> gltfImageBytes(const GltfDocument& document, std::size_t image,
                                              const LoadLimits& limits = {});

// Replaces the content of an image; all textures that use it follow. mimeType: "image/png" or "image/jpeg". The bytes
// are written into the .glb, or to a file beside the .gltf, wherever the old ones were; name and extras are kept.
void replaceGltfImage(GltfDocument& document, std::size_t image, std::vector<std::byte> bytes,
                      const std::string& mimeType);

// Adds an image; returns its index.
std::size_t addGltfImage(GltfDocument& document, std::vector<std::byte> bytes, const std::string& mimeType,
                         const std::string& name);

// Adds a copy of `texture` (sampler, name, extras) that reads `image`; returns its index. Extensions are left out,
// since they may name another source (KHR_texture_basisu, EXT_texture_webp, ...).
std::size_t copyGltfTexture(GltfDocument& document, std::size_t texture, std::size_t image);

// Adds a copy of a material; returns its index.
std::size_t copyGltfMaterial(GltfDocument& document, std::size_t material);

// ---- writing --------------------------------------------------------------------------------

struct GltfWritten {
    std::vector<std::filesystem::path> files; // the model first
    std::size_t bytesBefore = 0;              // model, buffers and the image files it used, embedded or beside it
    std::size_t bytesAfter = 0;
    std::vector<std::string> notes; // those of the document, then those of writing
};

// Writes NAME.glb, one file with all image files embedded, or NAME.gltf with NAME.bin. With the latter, images keep
// their relative URIs and are copied if the folder differs; new images become files NAME-IMAGE.png or .jpg, with a
// number if the name is taken. All buffers become one. Accessors, views, images and bytes that the file used and that
// are now unused are removed, and all indices are adjusted; if an unknown extension may refer to them they are kept,
// and a note says so. On failure no file is left behind.
// Errors: ErrorKind::usage for a file extension other than .glb and .gltf; ErrorKind::output if a file cannot be
// written or a copied image would replace a different file; ErrorKind::input if an image file cannot be read.
Result<GltfWritten> writeGltf(const GltfDocument& document, const std::filesystem::path& file,
                              const LoadLimits& limits = {});

// Returns the bytes of a .glb without writing files; image files are embedded. limits.readFile is ignored: the document
// keeps the readFile that it was opened with.
Result<std::vector<std::byte>> glbBytes(GltfDocument document, const LoadLimits& limits = {});

// ---- tangents of a whole file --------------------------------------------------------------

// A primitive with the input of tangent generation.
struct GltfPrimitiveGeometry {
    std::size_t mesh = 0, primitive = 0; // indices into the file's
    std::string name;      // mesh name; "/" and the primitive's number are appended if the mesh has several
    GltfGeometry geometry; // with unit normals; TexcoordSpace::file
    std::string reason;    // why tangents cannot be generated: "no NORMAL"; empty if they can

    MeshView view() const { return {geometry.positions, geometry.normals, geometry.texcoords, geometry.indices}; }
};

// All primitives of a file, in file order. Errors: those of gltfGeometry.
Result<std::vector<GltfPrimitiveGeometry>> gltfPrimitives(const GltfDocument& document);

struct TangentsOptions {
    Frame frame = Frame::mikktspace; // or areaWeighted, vertex
    bool replace = false;            // giveTangents: also replace existing TANGENT
    bool mappedOnly = false;         // only primitives with a normal map in some material
    int threads = 0;                 // 0: all cores; the result does not depend on it
    Progress progress{};             // called on the caller's thread
};

// Result for one primitive.
struct PrimitiveTangents {
    std::size_t mesh = 0, primitive = 0;
    std::string name{}; // as in GltfPrimitiveGeometry
    std::size_t triangles = 0;
    bool stored = false;                           // the file had TANGENT
    bool generated = false;                        // giveTangents: the primitive has new tangents
    std::string reason{};                          // why tangents cannot be generated; empty if they can
    std::optional<TangentDifference> difference{}; // compareTangents: of the stored tangents, if any
    bool areaWeighted = false; // compareTangents with mikktspace: they are those of areaWeighted instead
};

struct GiveTangentsResult {
    std::vector<PrimitiveTangents> primitives;
    std::size_t generated = 0, kept = 0,
                skipped = 0;       // primitives with new tangents, with their own, without any
    std::size_t verticesAdded = 0; // copies, made where corners that shared a vertex differ
};

// Generates tangents and stores them in the document as TANGENT (see setGltfTangents).
// Errors: ErrorKind::usage for a frame other than mikktspace, areaWeighted and vertex; ErrorKind::stopped; those of
// gltfGeometry. On error the document is unchanged.
Result<GiveTangentsResult> giveTangents(GltfDocument& document, const TangentsOptions& options);

struct CompareTangentsResult {
    std::vector<PrimitiveTangents> primitives;
    TangentDifference whole; // over all primitives that could be compared
    std::size_t without = 0; // primitives that could have TANGENT but have none
};

// Measures how much the stored tangents differ from those of the frame. Errors: as giveTangents.
Result<CompareTangentsResult> compareTangents(const GltfDocument& document, const TangentsOptions& options);

// ---- animated models -----------------------------------------------------------------------

// An animated glTF model: read once, then posed at any number of times.

struct GltfAnimation {
    std::string name;   // empty if the file has none
    double seconds = 0; // time of the last key; 0 if no key can be read
};

// Holds the bytes of the file and makes scenes from them. Not thread-safe.
class AnimatedGltf {
public:
    // limits: apply to each scene too; limits.pose is ignored. Errors: as loadGltf.
    static Result<std::unique_ptr<AnimatedGltf>> open(const std::filesystem::path& file, const LoadLimits& limits);
    ~AnimatedGltf();

    // In file order; empty if there are none.
    const std::vector<GltfAnimation>& animations() const;

    // Like loadGltf with `pose`. images: those of an earlier scene of this object, which are copied; null: images are
    // decoded. Errors: as loadGltf; ErrorKind::usage if there is no such animation.
    Result<Scene> at(const Pose& pose, const std::vector<Image>* images = nullptr);

    // World-space points that bound the animation with this name or number over its whole duration. It is sampled every
    // 1/30 s, at most 256 times and, for large models, only as often as 8 million posed vertices allow, but at least 9
    // times. Up to 300,000 points all vertices are returned; beyond that the extreme points of each sample along 64
    // directions, whose bounding box may be too small by 2 % of the model. The result is cached. Errors: as at().
    Result<std::vector<glm::vec3>> reach(const std::string& animation);

private:
    struct Work;
    explicit AnimatedGltf(std::unique_ptr<Work> work);
    std::unique_ptr<Work> work_;
};

} // namespace cotan
