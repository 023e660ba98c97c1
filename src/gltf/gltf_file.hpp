// A glTF file with checked JSON structure and buffers in memory. Nothing here interprets the model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/files.hpp"
#include "gltf/json/views.hpp"
#include "problem.hpp"

namespace cotan {

// A resource of the model: a file in the model's folder, or decoded bytes.
struct GltfResource {
    std::filesystem::path file; // canonical; empty if `bytes` holds the resource
    std::vector<std::byte> bytes;
};

// Four-byte codes of GLB: the magic "glTF" and the chunk types.
inline constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbJson = 0x4E4F534A, kGlbBinary = 0x004E4942;

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";
inline constexpr const char* kMeshoptExtensions[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

// Compressed geometry as stored in the file. Writing restores the parts that were not changed without compressing
// again.
struct GltfPacked {
    struct Primitive {
        std::size_t mesh = 0, primitive = 0;
        gltf::Json draco;      // the object of KHR_draco_mesh_compression
        int indices = 0;       // accessor
        gltf::Json attributes; // accessors by name
    };
    std::vector<Primitive> primitives;
    std::map<int, gltf::Json> accessors;     // accessors that Draco fills, as stored in the file
    std::map<std::size_t, gltf::Json> views; // views compressed by meshoptimizer, as stored in the file
    std::vector<std::string> required;       // the compression extensions that the file requires
};

struct GltfFile {
    std::function<Result<std::vector<std::byte>>(const std::string&)> readFile; // LoadLimits::readFile, or none
    std::filesystem::path folder;                                               // canonical; no file outside is opened
    std::vector<std::byte> bytes;                                               // the whole file if it is a GLB
    std::span<const std::byte> binary; // the BIN chunk of a GLB; empty if there is none
    bool isBinary = false;
    std::size_t modelBytes = 0; // size of the model file
    std::size_t size = 0;       // modelBytes and, once loaded, the size of its buffer files
    gltf::Json json;
    std::vector<std::span<const std::byte>> buffers;                     // one for each buffer, exactly byteLength long
    std::map<std::filesystem::path, std::vector<std::byte>> bufferFiles; // each is read once
    std::vector<std::vector<std::byte>> bufferBytes;                     // decoded data URIs
    std::vector<std::vector<std::byte>> unpackedBytes;                   // of buffers that unpackGltf has made
    std::uint64_t unpacked = 0;                                          // total size of unpackedBytes
    GltfPacked packed;                                                   // the compressed source of unpackedBytes
};

// Parses JSON in time linear in the length of the text. If a name repeats in an object, the last member wins. Throws
// GltfProblem for invalid JSON, too deep nesting, and too many members in an object.
gltf::Json parseGltfJson(std::span<const std::byte> text);

// Reads the file, splits a GLB into chunks and parses the JSON. Every length is checked against the file size.
GltfFile readGltfFile(const std::filesystem::path& path, const LoadLimits& limits, GltfWarnings& warnings);

// The bytes of a resource that is a file, from LoadLimits::readFile or the disk.
Result<std::vector<std::byte>> readGltfResource(const GltfFile& file, const std::filesystem::path& resource,
                                                const LoadLimits& limits);

// Whether a buffer is a fallback of EXT_meshopt_compression: it has no bytes because all its views are compressed.
bool isGltfFallback(const gltf::Json& buffer);

// Fills GltfFile::buffers; fallback buffers stay empty. The JSON must have passed checkGltfShape.
void loadGltfBuffers(GltfFile& file, const LoadLimits& limits);

// The bytes of a buffer view. field: for the message. Throws GltfProblem if the view ends beyond its buffer.
std::span<const std::byte> gltfViewBytes(const GltfFile& file, const gltf::BufferView& view, const std::string& field);

// Decodes percent-encoding in a file name of a URI: "%20" becomes a space. A percent sign that starts no valid code is
// kept, because some exporters do not encode it.
std::string decodePercent(std::string_view uri);

// Resolves a URI of the model. Data URIs are decoded. Files are looked up in the model's folder; schemes, absolute
// paths and paths out of the folder, by ".." or a symbolic link, throw GltfProblem. field: the URI's location, for
// messages. mayMiss: a missing file gives an empty resource instead of an error.
GltfResource resolveGltfUri(const GltfFile& file, std::string_view uri, const std::string& field, bool mayMiss = false);

// Checks type, range and length of every member that the reader uses against the glTF 2.0 specification, all indices,
// the version and the required extensions. Throws GltfProblem.
void checkGltfShape(const gltf::Json& root, const LoadLimits& limits, GltfWarnings& warnings);

// The same for the members that poseGltf reads.
void checkGltfAnimations(const gltf::Json& root);

// ---- compressed geometry: KHR_draco_mesh_compression, EXT_ and KHR_meshopt_compression ------

// Decodes compressed geometry into new buffers, redirects views and accessors to them, and removes the extensions from
// the JSON, so that later code does not see any compression. If uncompressed data exist too, they are used instead. The
// buffers must be loaded. Decoded bytes count in GltfFile::unpacked; more than limits.geometryBytes plus 64 times the
// size of the file are refused before they are decoded.
// Throws GltfProblem: damaged streams; ErrorKind::unavailable if this build lacks the decoder.
void unpackGltf(GltfFile& file, const LoadLimits& limits);

// Adds `bytes` to `taken`. Throws GltfProblem if the sum exceeds `limit` or std::size_t. what: subject and verb of the
// message; fileBytes: the size of the file, for the message.
void takeBytes(std::uint64_t& taken, std::uint64_t bytes, std::uint64_t limit, const char* what, std::size_t fileBytes,
               const std::string& field);

// A buffer view compressed with EXT_meshopt_compression.
struct MeshoptView {
    std::span<const std::byte> bytes;
    std::size_t count = 0, stride = 0; // of the elements
    std::string mode, filter;          // names as in the extension
};

// Returns count * stride decoded bytes. field: for messages. Throws GltfProblem.
std::vector<std::byte> decodeMeshopt(const MeshoptView& view, const std::string& field);

} // namespace cotan
