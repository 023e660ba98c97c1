// Declarations shared by the files of the glTF editor.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "cotan/gltf.hpp"
#include "elements.hpp"
#include "files/output.hpp"
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

// A root collection and the paths of all indices into it: member names with slashes, "*" for each item or member.
struct Collection {
    const char* name;
    std::span<const std::string_view> paths;
};
extern const Collection kAccessors, kBufferViews, kImages;

// Calls `visit` for every known location of an index into the collection, in the glTF core or in an extension. Values
// that are no index are skipped.
void forEachReference(Json& root, const Collection& collection, const std::function<void(Json&)>& visit);

// For each item of the collection, whether something refers to it. excluded: a path whose references do not count.
std::vector<bool> usedItems(const Json& root, const Collection& collection, std::string_view excluded = {});

// The names of all extensions within `object`, in order of first appearance.
std::vector<std::string> extensionsIn(const Json& object);

// The extensions of the file, sorted, that may refer to accessors, buffer views or buffers in unknown ways.
std::vector<std::string> unknownExtensions(const Json& root);

// Removes the marked items and adjusts all references. An empty collection is removed as a whole.
void removeItems(Json& root, const Collection& collection, const std::vector<bool>& removed);

// ---- values -----------------------------------------------------------------------------------

// The tangent with the unit length that glTF requires, (1, 0, 0) if it has no direction. One that is unit but for
// rounding is unchanged.
inline glm::vec4 withUnitTangent(const glm::vec4& tangent)
{
    const float length = glm::length(glm::vec3(tangent));
    if (std::abs(length - 1) < 1e-3f)
        return tangent;
    return {length > 0 && std::isfinite(length) ? glm::vec3(tangent) / length : glm::vec3(1, 0, 0), tangent.w};
}

// ---- edit.cpp ---------------------------------------------------------------------------------

// The bytes of a buffer view, from the file or added.
std::span<const std::byte> viewBytes(const GltfDocument& document, std::size_t view);

// An accessor of the document with its bytes.
gltf::Elements elementsOf(const GltfDocument& document, const Json& accessor);

// The corners of the primitive's triangles; empty for points and lines.
std::vector<std::uint32_t> readTriangles(const GltfDocument& document, const gltf::Primitive& primitive);

// Adds a buffer view; a stride or target of 0 is omitted. Returns its index.
std::size_t addView(GltfDocument& document, std::vector<std::byte> bytes, std::size_t stride = 0, int target = 0);

// Adds an accessor with a buffer view of its own; stride 0: tightly packed. Returns its index.
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
    ByteBlocks blocks;                           // content of the only buffer that has bytes; the document has them
    std::size_t size = 0;                        // of all blocks
    std::size_t decoded = 0;                     // decoded size of the views that stay compressed
    std::set<std::string> compressionExtensions; // extensions that compress these views
};

// Removes unused items and joins all bytes into one buffer. Consumes the JSON of `document`, and adds to its notes.
Layout layOut(GltfDocument& document);

} // namespace gltf_edit
} // namespace cotan
