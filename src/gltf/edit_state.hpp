// What the parts of the glTF editor share.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/gltf.hpp"
#include "elements.hpp"
#include "gltf/json/lookup.hpp"
#include "gltf_file.hpp"

namespace cotan {

using gltf::Json;

struct GltfSource {
    std::filesystem::path path;
    GltfFile file;                      // folder, buffers, and the JSON as read
    std::vector<gltf::ViewBytes> views; // of the file
};

namespace gltf_edit {

// ---- edit_references.cpp ----------------------------------------------------------------------

// What indices point into, and where those are: names of members with slashes between, "*" for each item or member.
struct Collection {
    const char* name;
    std::span<const std::string_view> paths;
};
extern const Collection kAccessors, kBufferViews, kImages;

// Calls `visit` for every place known to us that holds an index into the collection, be it in the
// core of glTF or in an extension. Values that are no index are passed over.
void forEachReference(Json& root, const Collection& collection, const std::function<void(Json&)>& visit);

// For each item of the collection whether something refers to it. besides: references that do not count, as their path.
std::vector<bool> usedItems(const Json& root, const Collection& collection, std::string_view besides = {});

// The names of extensions in it, in the order in which they are met.
std::vector<std::string> extensionsIn(const Json& object);

// Those in the file, sorted, that are not known to leave accessors, buffer views and buffers alone.
std::vector<std::string> unknownExtensions(const Json& root);

// Removes the items marked and lets all references follow; an empty collection goes as a whole.
void removeItems(Json& root, const Collection& collection, const std::vector<bool>& removed);

// ---- edit.cpp ---------------------------------------------------------------------------------

// The bytes of a buffer view, of the file or added.
std::span<const std::byte> viewBytes(const GltfDocument& document, std::size_t view);

// An accessor of the document with its bytes.
gltf::Elements elementsOf(const GltfDocument& document, const Json& accessor);

// The primitive's triangles; none for points and lines.
std::vector<std::uint32_t> readTriangles(const GltfDocument& document, const gltf::Primitive& primitive);

// Adds a buffer view; stride and target 0: left out. Returns its index.
std::size_t addView(GltfDocument& document, std::vector<std::byte> bytes, std::size_t stride = 0, int target = 0);

// Adds an accessor with a view of its own; stride 0: packed. Returns its index.
template<class T>
std::size_t addElements(GltfDocument& document, const std::vector<T>& elements, const char* type,
                        std::size_t stride = 0, int componentType = gltf::kFloat, int target = gltf::kArrayBuffer)
{
    const auto bytes = std::as_bytes(std::span(elements));
    const std::size_t view = addView(document, {bytes.begin(), bytes.end()}, stride, target);
    return addItem(
        document, "accessors",
        {{"bufferView", view}, {"componentType", componentType}, {"count", elements.size()}, {"type", type}});
}

// ---- edit_layout.cpp --------------------------------------------------------------------------

struct Layout {
    Json root;
    std::vector<std::byte> buffer; // the only one with bytes; empty: none
    std::size_t decoded = 0;       // bytes of the views that stay compressed, once somebody decodes them
    std::set<std::string> packers; // the extensions of these
};

// Removes what has fallen out of use and joins all bytes. `document` is used up; notes go there.
Layout layOut(GltfDocument& document);

} // namespace gltf_edit
} // namespace cotan
