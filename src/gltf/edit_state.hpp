// What the parts of the glTF editor share.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cotan/gltf/edit.hpp"
#include "cotan/gltf/lookup.hpp"
#include "file.hpp"
#include "problem.hpp"

namespace cotan {

using OrderedJson = nlohmann::ordered_json;

struct GltfSource {
    std::filesystem::path path;
    std::size_t bytes = 0; // of the model file itself
    GltfFile file;         // folder and buffers
    OrderedJson root;      // as read
};

namespace gltf_edit {

// ---- JSON -----------------------------------------------------------------------------------

inline std::size_t sizeOr(const OrderedJson& object, const char* member, std::size_t fallback)
{
    const auto found = object.find(member);
    return found == object.end() ? fallback : found->get<std::size_t>();
}

// ---- gltf_edit_references.cpp -----------------------------------------------------------------

// Which collection an index points into.
enum class Collection { accessors, bufferViews, images };

const char* nameOf(Collection collection);

// Calls `visit` for every place known to us that holds an index into the collection, be it in the
// core of glTF or in an extension. Values that are no index are passed over.
void forEachReference(OrderedJson& root, Collection collection,
                      const std::function<void(OrderedJson&)>& visit);

// For each item of the collection whether something refers to it.
std::vector<bool> usedItems(const OrderedJson& root, Collection collection);

// Extensions in the file that are not known to leave accessors, buffer views and buffers alone.
std::vector<std::string> unknownExtensions(const OrderedJson& root);

// Removes the items marked and lets all references follow; an empty collection goes as a whole.
void removeItems(OrderedJson& root, Collection collection, const std::vector<bool>& removed);

// ---- gltf_edit_elements.cpp -------------------------------------------------------------------

// The bytes of a buffer view, of the file or added.
std::span<const std::byte> viewBytes(const GltfDocument& document, std::size_t view);

// Bytes of one element of an accessor, columns of small matrices padded as the specification says.
std::size_t elementSize(const OrderedJson& accessor);

// The elements one after the other, without sparse values; all zero where there is no view.
std::vector<std::byte> baseElements(const GltfDocument& document, const OrderedJson& accessor);

// Sparse values: which elements they replace, and their bytes; empty where there are none.
struct SparseElements {
    std::vector<std::uint32_t> places;
    std::vector<std::byte> values;
};
SparseElements sparseElements(const GltfDocument& document, const OrderedJson& accessor);

// Scalars that are indices, sparse values put in.
std::vector<std::uint32_t> readIndices(const GltfDocument& document, const OrderedJson& accessor);

// The primitive's triangles; none for points and lines.
std::vector<std::uint32_t> readTriangles(const GltfDocument& document,
                                         const OrderedJson& primitive);

// Adds a buffer view; stride and target 0: left out. Returns its index.
std::size_t addView(GltfDocument& document, std::vector<std::byte> bytes, std::size_t stride = 0,
                    int target = 0);
std::size_t addAccessor(GltfDocument& document, OrderedJson accessor);

inline constexpr int kArrayBuffer = 34962;
inline constexpr int kElementArrayBuffer = 34963;

// Refuses geometry that cannot be read without a decoder. field: meshes[i].primitives[j].
void refuseCompressed(const OrderedJson& primitive, const std::string& field);

// ---- gltf_edit_repack.cpp ---------------------------------------------------------------------

// Takes the bytes of accessors marked as removed out of views that others still use: ranges are
// cut out, columns of interleaved views too. Such views are replaced by added ones.
void repackViews(GltfDocument& document, const std::vector<bool>& removedAccessors);

// ---- gltf_edit_layout.cpp ---------------------------------------------------------------------

struct Layout {
    OrderedJson root;
    std::vector<std::byte> buffer; // the only one; empty: none
};

// Removes what has fallen out of use and joins all bytes. `document` is used up; notes go there.
Layout layOut(GltfDocument& document);

} // namespace gltf_edit
} // namespace cotan
