// What the parts of the glTF reader share: the parsed structure, the bytes, the limits, and the
// scene under construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/files/limits.hpp"
#include "file.hpp"
#include "problem.hpp"
#include "tiny.hpp"

namespace cotan {

struct GltfModel {
    GltfFile file;
    tinygltf::Model tiny; // its buffers and images stay empty: those are in `file`
    LoadLimits limits;
    GltfWarnings warnings;
    std::size_t verticesTaken = 0;  // against limits.vertices
    std::size_t trianglesTaken = 0; // against limits.triangles
    std::size_t bytesTaken = 0;     // by arrays of vertices and triangles, against gltfAllowance
};

// The bytes that the geometry of this file may take: a part that every file has, and so many times
// its own size that only what is not in the file, or is read again and again, can go beyond it.
// (Sixteen: a strip of bytes that becomes triangles with flat normals grows by the most.)
inline std::size_t gltfAllowance(const GltfModel& model)
{
    return model.limits.geometryBytes + 16 * model.file.size;
}

// Counts bytes before they are allocated. field: for the message where they are too many.
void takeGltfBytes(GltfModel& model, std::size_t bytes, const std::string& field);

// Which elements of an accessor are read.
struct GltfChoice {
    std::size_t count = 0;                  // how many the accessor must have
    bool all = true;                        // they are all read
    std::span<const std::uint32_t> chosen{}; // otherwise these, rising

    GltfChoice(std::size_t of) : count(of) {}
    GltfChoice(std::size_t of, std::span<const std::uint32_t> some) : count(of), all(false), chosen(some) {}
    std::size_t size() const { return all ? count : chosen.size(); }
};

// ---- gltf_structure.cpp ---------------------------------------------------------------------

// The structure as tinygltf understands it. Buffers and images are kept from it and are all that
// is left in `json` afterwards; animations are not used.
tinygltf::Model parseGltfStructure(nlohmann::json& json);

// ---- gltf_accessor.cpp ----------------------------------------------------------------------

// Checks all buffer views, and all accessors with their sparse parts, against the buffers and
// against the allowance, and refuses NaN and infinity in float accessors other than texture
// coordinates. The readers below rely on it.
void checkGltfAccessors(const GltfModel& model);

// Bytes of a buffer view.
std::span<const std::byte> gltfView(const GltfModel& model, int view);

// The elements as floats: integers that are normalised become [0,1] or [-1,1], others their
// value. Sparse values are put in; an accessor without a view starts from zeros. field: for
// messages, what the accessor is used as. An element type or component type that cannot be used
// so is refused, and so is an array that goes over the allowance.
std::vector<glm::vec2> readGltfVec2(GltfModel& model, int accessor, const GltfChoice& choice,
                                    const std::string& field);
std::vector<glm::vec3> readGltfVec3(GltfModel& model, int accessor, const GltfChoice& choice,
                                    const std::string& field);
std::vector<glm::vec4> readGltfVec4(GltfModel& model, int accessor, const GltfChoice& choice,
                                    const std::string& field);
// VEC3 (w = 1) or VEC4.
std::vector<glm::vec4> readGltfColors(GltfModel& model, int accessor, const GltfChoice& choice,
                                      const std::string& field);
std::vector<glm::uvec4> readGltfJoints(GltfModel& model, int accessor, const GltfChoice& choice,
                                       const std::string& field);
// The first `count` float matrices; there may be more.
std::vector<glm::mat4> readGltfMatrices(GltfModel& model, int accessor, std::size_t count,
                                        const std::string& field);
// Vertex indices, each below vertexCount and none the primitive restart value.
std::vector<std::uint32_t> readGltfIndices(GltfModel& model, int accessor,
                                           std::size_t vertexCount, const std::string& field);

} // namespace cotan
