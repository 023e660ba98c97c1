// Tangents for the primitives of a glTF file: generated and written into it, or compared with those that it has.
//
//     auto document = openGltfDocument("in.gltf");
//     auto given = giveTangents(*document, {});
//     auto written = writeGltf(*document, "out.glb");
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/gltf/edit.hpp"
#include "cotan/progress.hpp"
#include "cotan/tangent_difference.hpp"
#include "cotan/tangents.hpp"

namespace cotan {

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

} // namespace cotan
