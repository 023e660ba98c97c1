// A glTF file up to the point where its JSON is known to have the right shape and its buffers are
// in memory. Nothing here interprets the model.
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

// Where the bytes of a resource come from: a file in the model's folder, or decoded bytes.
struct GltfResource {
    std::filesystem::path file; // canonical; empty if the bytes are here
    std::vector<std::byte> bytes;
};

// Words of a GLB: its first, "glTF", and the types of its chunks.
inline constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbJson = 0x4E4F534A, kGlbBinary = 0x004E4942;

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";
inline constexpr const char* kMeshoptExtensions[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

// Compressed geometry as the file has it, for who writes the file again: nobody has to compress what nobody changed.
struct GltfPacked {
    struct Primitive {
        std::size_t mesh = 0, primitive = 0;
        gltf::Json draco;      // what KHR_draco_mesh_compression says
        int indices = 0;       // the accessor
        gltf::Json attributes; // by name the accessors
    };
    std::vector<Primitive> primitives;
    std::map<int, gltf::Json> accessors;     // those that the streams fill, as the file has them
    std::map<std::size_t, gltf::Json> views; // those of meshoptimizer, likewise
    std::vector<std::string> required;       // which of the extensions the file requires
};

struct GltfFile {
    std::function<Result<std::vector<std::byte>>(const std::string&)> readFile; // in place of the disk; LoadLimits
    std::filesystem::path folder;                                               // canonical; nothing outside is opened
    std::vector<std::byte> bytes;                                               // the whole file, where it is a GLB
    std::span<const std::byte> binary; // the BIN chunk of a GLB; empty if there is none
    bool isBinary = false;
    std::size_t modelBytes = 0; // of the model itself
    std::size_t size = 0;       // the same and, once they are loaded, the bytes of its buffer files
    gltf::Json json;
    std::vector<std::span<const std::byte>> buffers;                     // one for each buffer, exactly byteLength long
    std::map<std::filesystem::path, std::vector<std::byte>> bufferFiles; // each is read once
    std::vector<std::vector<std::byte>> bufferBytes;                     // decoded data URIs
    std::vector<std::vector<std::byte>> unpackedBytes;                   // of buffers that unpackGltf has made
    std::uint64_t unpacked = 0;                                          // how many bytes those are
    GltfPacked packed;                                                   // what they were made of
};

// In time that grows with the length of the text alone. Of members of the same name the last counts. Throws
// GltfProblem where it is no JSON, and where it is nested too deep.
gltf::Json parseGltfJson(std::span<const std::byte> text);

// Reads the file, splits a GLB into chunks and parses the JSON. Every length is checked against the file.
GltfFile openGltf(const std::filesystem::path& path, const LoadLimits& limits, GltfWarnings& warnings);

// The bytes of a resource that is a file, be it on the disk or not.
Result<std::vector<std::byte>> readGltfResource(const GltfFile& file, const std::filesystem::path& resource,
                                                const LoadLimits& limits);

// Whether a buffer has no bytes because all its views are compressed: EXT_meshopt_compression's fallback.
bool isGltfFallback(const gltf::Json& buffer);

// Fills GltfFile::buffers; those of isGltfFallback stay empty. The JSON must have passed checkGltfShape.
void loadGltfBuffers(GltfFile& file, const LoadLimits& limits);

// The bytes of a buffer view. field: for the message. Throws GltfProblem where it ends behind its buffer.
std::span<const std::byte> gltfViewBytes(const GltfFile& file, const gltf::BufferView& view, const std::string& field);

// The name of a file as a URI has it: "%20" becomes a space. A percent sign that starts no code stands for itself:
// files named so exist, written by exporters that do not encode.
std::string decodePercent(std::string_view uri);

// What a URI of the model stands for. Data URIs are decoded. Files are looked up in the model's folder; schemes,
// absolute paths and anything that leads out of the folder, be it by ".." or by a symbolic link, are refused. field:
// where the URI stands, for messages. mayMiss: a file that does not exist gives an empty resource instead of a failure.
GltfResource resolveGltfUri(const GltfFile& file, std::string_view uri, const std::string& field, bool mayMiss = false);

// Checks that every member the reader uses has the type, range and length that the glTF 2.0 specification asks for, and
// that every index points at something. Also the version and the required extensions.
void checkGltfShape(const gltf::Json& root, const LoadLimits& limits, GltfWarnings& warnings);

// The same for what poseGltf reads.
void checkGltfAnimations(const gltf::Json& root);

// ---- compressed geometry: KHR_draco_mesh_compression, EXT_ and KHR_meshopt_compression ------

// Decodes what the extensions hold into new buffers, points views and accessors there, and takes the extensions out of
// the JSON: nothing behind this has to know of them. Where the plain numbers are in the file too, those are taken. The
// buffers must be loaded. Decoded bytes count in GltfFile::unpacked; over limits.geometryBytes and 64 times the size of
// the file they are refused before they are decoded.
// Throws GltfProblem: damaged streams; ErrorKind::unavailable where this build lacks the decoder.
void unpackGltf(GltfFile& file, const LoadLimits& limits);

// Adds bytes to those that are taken already. Throws GltfProblem where they are more than `most`, or than std::size_t
// holds, with it. what: the message's subject and verb; fileBytes: the size of the file, for the message too.
void takeBytes(std::uint64_t& taken, std::uint64_t bytes, std::uint64_t most, const char* what, std::size_t fileBytes,
               const std::string& field);

// A buffer view as EXT_meshopt_compression has it.
struct MeshoptView {
    std::span<const std::byte> bytes;
    std::size_t count = 0, stride = 0; // of the elements
    std::string mode, filter;          // the extension's words
};

// count * stride bytes. field: for messages. Throws GltfProblem.
std::vector<std::byte> decodeMeshopt(const MeshoptView& view, const std::string& field);

} // namespace cotan
