// Where the elements of an accessor lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "model.hpp"

namespace cotan {

// A run of equally spaced elements.
struct GltfRun {
    const std::byte* first = nullptr; // null: all zero
    std::size_t stride = 0;
    std::size_t count = 0;
};

// Bytes of a component; components of an element; bytes of an element, columns of matrices of bytes
// and shorts padded to four.
std::size_t componentSize(int type);
std::size_t componentCount(const tinygltf::Accessor& a);
std::size_t elementSize(const tinygltf::Accessor& a);

// The elements of an accessor without its sparse values, and the indices and values of those. What
// lies outside its view throws GltfProblem. field: for the message.
GltfRun denseRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field);
GltfRun sparseIndexRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field);
GltfRun sparseValueRun(const GltfModel& model, const tinygltf::Accessor& a, const std::string& field);

// An unsigned integer of a component type.
std::uint32_t readIndex(const std::byte* at, int componentType);

} // namespace cotan
