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

#include "cotan/asset/load.hpp"
#include "gltf_file.hpp"
#include "gltf_problem.hpp"
#include "gltf_tiny.hpp"

namespace cotan {

struct GltfModel {
    GltfFile file;
    tinygltf::Model tiny; // its buffers and images stay empty: those are in `file`
    LoadLimits limits;
    GltfWarnings warnings;
    std::size_t verticesTaken = 0;  // against limits.vertices
    std::size_t trianglesTaken = 0; // against limits.triangles
};

// ---- gltf_structure.cpp ---------------------------------------------------------------------

// The structure as tinygltf understands it. Buffers and images are kept from it and are all that
// is left in `json` afterwards; animations are not used.
tinygltf::Model parseGltfStructure(nlohmann::json& json);

// ---- gltf_accessor.cpp ----------------------------------------------------------------------

// Checks all buffer views, and all accessors with their sparse parts, against the buffers, and
// refuses NaN and infinity in float accessors other than texture coordinates. The readers below
// rely on it.
void checkGltfAccessors(const GltfModel& model);

// Bytes of a buffer view.
std::span<const std::byte> gltfView(const GltfModel& model, int view);

// The elements as floats: integers that are normalised become [0,1] or [-1,1], others their
// value. Sparse values are put in; an accessor without a view starts from zeros. field: for
// messages, what the accessor is used as. An element type or component type that cannot be used
// so is refused. count: how many elements there must be.
std::vector<glm::vec2> readGltfVec2(const GltfModel& model, int accessor, std::size_t count,
                                    const std::string& field);
std::vector<glm::vec3> readGltfVec3(const GltfModel& model, int accessor, std::size_t count,
                                    const std::string& field);
std::vector<glm::vec4> readGltfVec4(const GltfModel& model, int accessor, std::size_t count,
                                    const std::string& field);
// VEC3 (w = 1) or VEC4.
std::vector<glm::vec4> readGltfColors(const GltfModel& model, int accessor, std::size_t count,
                                      const std::string& field);
std::vector<glm::uvec4> readGltfJoints(const GltfModel& model, int accessor, std::size_t count,
                                       const std::string& field);
// The first `count` float matrices; there may be more.
std::vector<glm::mat4> readGltfMatrices(const GltfModel& model, int accessor, std::size_t count,
                                        const std::string& field);
// Vertex indices, each below vertexCount and none the primitive restart value.
std::vector<std::uint32_t> readGltfIndices(const GltfModel& model, int accessor,
                                           std::size_t vertexCount, const std::string& field);

} // namespace cotan
