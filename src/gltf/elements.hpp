// The elements of accessors: their bytes and their values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/json/views.hpp"

namespace cotan::gltf {

// The bytes of a buffer view as accessors see them: decompressed if an extension compresses the view.
struct ViewBytes {
    std::span<const std::byte> bytes;
    std::size_t stride = 0; // as in BufferView
};
using ViewBytesOf = std::function<ViewBytes(std::size_t view)>;

// Rounds up to a multiple of four, the alignment of vertex attributes, buffer views and GLB chunks.
constexpr std::size_t aligned(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

// A run of equally spaced elements.
struct Run {
    const std::byte* first = nullptr; // null: all zero
    std::size_t stride = 0;
    std::size_t count = 0;

    const std::byte* at(std::size_t i) const { return first + i * stride; }
};

// An accessor with its bytes: the elements without the sparse values, and the sparse indices and values.
struct Elements {
    Accessor accessor;
    Run dense;
    Run sparseIndices, sparseValues; // of equal count; the indices ascend once checkSparse has passed

    std::uint32_t sparseIndex(std::size_t i) const;

    // The number of the first sparse value, from `first` on, whose element is not less than `element`; the count of
    // sparse values if there is none.
    std::size_t sparseLowerBound(std::uint32_t element, std::size_t first = 0) const;
};

// Throws GltfProblem if elements lie outside their view. field: for the message.
Elements findElements(const Accessor& accessor, const ViewBytesOf& viewBytes, const std::string& field);

// Throws GltfProblem if the sparse indices do not ascend or are not below the count.
void checkSparse(const Elements& elements, const std::string& field);

// Throws GltfProblem if a float is not finite.
void checkFinite(const Elements& elements, const std::string& field);

// Recomputes min and max in an accessor's JSON, if present, from its current elements. Removes them if the accessor is
// empty or has matrices or 32-bit integers.
void renewBounds(Json& accessor, Elements elements);

// ---- reading --------------------------------------------------------------------------------

// The elements to be read.
struct Choice {
    std::size_t count = 0;                   // required number of elements of the accessor
    bool all = true;                         // read all of them
    std::span<const std::uint32_t> chosen{}; // otherwise only these, ascending

    Choice(std::size_t total) : count(total) {}
    Choice(std::size_t total, std::span<const std::uint32_t> some) : count(total), all(false), chosen(some) {}
    std::size_t size() const { return all ? count : chosen.size(); }
};

// The use of an accessor, as messages name it.
struct Role {
    int accessor = -1;
    std::string field; // "meshes[0].primitives[1].NORMAL"
};

std::string_view nameOf(ElementType type);
const char* nameOfComponent(int componentType);

// Calls use(T()), where T is the C++ type of a component.
template<class Use> void withType(int componentType, const Use& use)
{
    switch (componentType) {
    case kByte: return use(std::int8_t());
    case kUnsignedByte: return use(std::uint8_t());
    case kShort: return use(std::int16_t());
    case kUnsignedShort: return use(std::uint16_t());
    case kUnsignedInt: return use(std::uint32_t());
    default: return use(float());
    }
}

// Throws GltfProblem for another element type or another number of elements.
void expectElements(const Accessor& accessor, ElementType type, std::uint64_t count, const Role& role);

// Throws GltfProblem if the elements are not unsigned integer scalars.
void expectIndices(const Accessor& accessor, const Role& role);

// Reads the chosen elements, with sparse values applied. Normalised integers become [0,1] or [-1,1], other integers
// keep their value. Out: float or std::uint32_t. out: zeros on entry; outStride: numbers from element to element there.
template<class Out> void readNumbers(const Elements& elements, const Choice& choice, std::size_t outStride, Out* out);

// The same as vectors. Throws GltfProblem if the element type or count differs, and for 32-bit integers.
template<class Vector>
std::vector<Vector> readVectors(const Elements& elements, const Choice& choice, const Role& role);

} // namespace cotan::gltf
