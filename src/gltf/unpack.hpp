// Compressed geometry of a glTF file, made plain: KHR_draco_mesh_compression, EXT_ and KHR_meshopt_compression.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gltf_file.hpp"

namespace cotan {

// Decodes what the extensions hold into new buffers, points views and accessors there, and takes the extensions out of
// the JSON: nothing behind this has to know of them. Where the plain numbers are in the file too, those are taken. The
// buffers must be loaded. Decoded bytes count in GltfFile::unpacked; over limits.geometryBytes and 64 times the size of
// the file they are refused before they are decoded.
// Throws GltfProblem: damaged streams; ErrorKind::unavailable
// where this build lacks the decoder.
void unpackGltf(GltfFile& file, const LoadLimits& limits);

namespace gltf {

// A buffer view as EXT_meshopt_compression has it.
struct MeshoptView {
    std::span<const std::byte> bytes;
    std::size_t count = 0, stride = 0; // of the elements
    std::string mode, filter;          // the extension's words
};

// count * stride bytes. field: for messages. Throws GltfProblem.
std::vector<std::byte> decodeMeshopt(const MeshoptView& view, const std::string& field);

} // namespace gltf
} // namespace cotan
