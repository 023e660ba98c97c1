// The elements of accessors: where they lie, and their numbers.
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

// The bytes of a buffer view as accessors see them. Where an extension packs them, they are those after unpacking.
struct ViewBytes {
    std::span<const std::byte> bytes;
    std::size_t stride = 0; // as in BufferView
};
using ViewBytesOf = std::function<ViewBytes(std::size_t view)>;

// Up to a multiple of four, where attributes of vertices, views and chunks begin.
constexpr std::size_t aligned(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

// A run of equally spaced elements.
struct Run {
    const std::byte* first = nullptr; // null: all zero
    std::size_t stride = 0;
    std::size_t count = 0;

    const std::byte* at(std::size_t i) const { return first + i * stride; }
};

// An accessor with its bytes: the elements without sparse values, and the indices and values of those.
struct Elements {
    Accessor accessor;
    Run dense;
    Run sparseIndices, sparseValues; // equally many; the indices rise once checkSparse has looked at them

    std::uint32_t sparseIndex(std::size_t i) const;

    // The place of the sparse value of an element, from `first` on, or of the next one; their number where none
    // follows.
    std::size_t sparsePlace(std::uint32_t element, std::size_t first = 0) const;
};

// Throws GltfProblem where something lies outside its view. field: for the message.
Elements findElements(const Accessor& accessor, const ViewBytesOf& viewBytes, const std::string& field);

// Throws GltfProblem where the indices of sparse values do not rise or are not below the count.
void checkSparse(const Elements& elements, const std::string& field);

// Throws GltfProblem where a float is not finite.
void checkFinite(const Elements& elements, const std::string& field);

// Makes min and max of an accessor's JSON anew, where it has them, from the elements that it has now; takes them out
// where those are no floats or small integers.
void renewBounds(Json& accessor, Elements elements);

// ---- reading --------------------------------------------------------------------------------

// Which elements are read.
struct Choice {
    std::size_t count = 0;                   // how many the accessor must have
    bool all = true;                         // they are all read
    std::span<const std::uint32_t> chosen{}; // otherwise these, rising

    Choice(std::size_t of) : count(of) {}
    Choice(std::size_t of, std::span<const std::uint32_t> some) : count(of), all(false), chosen(some) {}
    std::size_t size() const { return all ? count : chosen.size(); }
};

// An accessor that serves as something: what messages call it.
struct Role {
    int accessor = -1;
    std::string field; // "meshes[0].primitives[1].NORMAL"
};

std::string_view nameOf(ElementType type);
const char* nameOfComponent(int componentType);

// Calls use(T()) with the type of a component.
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

// Throws GltfProblem for another type or number of elements.
void expectElements(const Accessor& accessor, ElementType type, std::uint64_t count, const Role& role);

// Throws GltfProblem for scalars that cannot be indices.
void expectIndices(const Accessor& accessor, const Role& role);

// The numbers of the chosen elements, sparse values put in: integers that are normalised become [0,1]
// or [-1,1], others their value. Out: float or std::uint32_t. out: zeros; an element has room for `room` numbers there.
template<class Out> void readNumbers(const Elements& elements, const Choice& choice, std::size_t room, Out* out);

// The same as vectors. Throws GltfProblem where the elements are none, and for unsigned integers.
template<class Vector>
std::vector<Vector> readVectors(const Elements& elements, const Choice& choice, const Role& role);

} // namespace cotan::gltf
